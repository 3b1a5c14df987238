#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "slalom/vehicle/model.hpp"

namespace slalom::vehicle {
namespace {

Parameters combined() {
  Parameters p;
  p.tyre = TyreKind::combined_slip;
  p.PDX1 = 0.9;
  p.drive_front = 0.2;
  p.brake_front = 0.7;
  return p;
}

/// A tyre of which no coefficient depends on load, as CommonRoad's: cornering stiffness 21.92 Fz.
Parameters commonroad_tyre() {
  Parameters p;
  p.PCY1 = 1.3507;
  p.PDY1 = 1.0489;
  p.PEY1 = -0.0074722;
  p.PKY1 = -10960;
  p.PKY2 = 1000;
  p.PDY2 = p.PEY2 = 0;
  p.tyre_asymmetry = false;
  return p;
}

/// The rear axle's lateral force at a slip angle, with `ax` so far below the load that it is Fz.
double rear_force(const Parameters& p, double alpha, double ax = 0) {
  State x{};
  x[UX] = 20 - p.EP;
  x[V] = 20 * std::tan(alpha);
  x[AX] = ax;
  return Dynamics(p).tyre_forces(x)[1];
}

// formula_lateral(alpha, 0, 5000, p) of vehiclemodels.utils.tire_model in commonroad-vehicle-models
// 3.0.2, with its parameters_tire.yaml.
TEST(CombinedSlip, CommonRoadsTyreIsOneOfOurs) {
  auto p = commonroad_tyre();
  p.FzR0 = 5000;
  const std::vector<std::pair<double, double>> theirs = {
      {-0.3, 5060.43256},   {-0.12, 5210.0549}, {-0.05, 4075.60506}, {-0.01, 1079.6655},
      {0.002, -219.066844}, {0.03, -2905.6935}, {0.08, -4897.88116}, {0.2, -5199.94992}};
  for (const auto& [alpha, force] : theirs)
    EXPECT_NEAR(rear_force(p, alpha), force, 1e-4 * std::fabs(force)) << alpha;
}

TEST(CombinedSlip, WithoutLongitudinalForceIsPureSlip) {
  auto pure = combined();
  pure.tyre = TyreKind::pure_slip;
  const State x = {0, 0, .3, .1, 1.5, .05, 20, .3 * .1};  // ax = v r
  EXPECT_EQ(Dynamics(combined()).tyre_forces(x), Dynamics(pure).tyre_forces(x));
}

/// The peak is D sqrt(1 - (Fx/(mu Fz))^2); the stiffness at no slip stays.
TEST(CombinedSlip, ForceTakesFromThePeakByTheEllipse) {
  auto p = commonroad_tyre();
  p.tyre = TyreKind::combined_slip;
  p.PDX1 = 1.1739;
  p.KZX = 0;
  p.brake_front = 0.4;
  const auto peak = [&](double ax) {
    double most = 0;
    for (double alpha = 0; alpha < 0.5; alpha += 0.001)
      most = std::max(most, rear_force(p, -alpha, ax));
    return most;
  };
  EXPECT_NEAR(peak(0), p.PDY1 * p.FzR0, 1);
  for (const double ax : {-2., -4., -6.}) {
    const double used = 0.6 * p.m * ax / (p.PDX1 * p.FzR0);
    EXPECT_NEAR(peak(ax), p.PDY1 * p.FzR0 * std::sqrt(1 - used * used), 0.003 * peak(0)) << ax;
    EXPECT_NEAR(rear_force(p, 1e-4, ax), rear_force(p, 1e-4), 1e-3 * rear_force(p, -1e-4));
  }
  // More than all friction: all but nothing is left, and it is a number.
  EXPECT_LT(peak(-20), 0.02 * peak(0));
}

/// Driving and braking are of different axles.
TEST(CombinedSlip, TheDistributionSaysWhichAxleSuffers) {
  auto p = combined();
  p.drive_front = 1;
  p.brake_front = 0;
  State x = {0, 0, .6, .2, 0, .15, 20, 0};
  const auto free = Dynamics(p).tyre_forces(x);
  p.KZX = 0;
  x[AX] = 4;
  const auto driven = Dynamics(p).tyre_forces(x);
  x[AX] = -4;
  const auto braked = Dynamics(p).tyre_forces(x);
  EXPECT_LT(std::fabs(driven[0]), 0.9 * std::fabs(free[0]));
  EXPECT_NEAR(driven[1], free[1], 0.01 * std::fabs(free[1]));
  EXPECT_NEAR(braked[0], free[0], 0.01 * std::fabs(free[0]));
  EXPECT_LT(std::fabs(braked[1]), 0.98 * std::fabs(free[1]));
}

struct Derivatives {
  std::vector<double> values, jacobian, hessian;
};

Derivatives derivatives(const expr::Function& f, const std::vector<double>& x,
                        const std::vector<double>& weights) {
  Derivatives d{std::vector<double>(f.outputs()), std::vector<double>(f.jacobian_pattern().size()),
                std::vector<double>(f.hessian_pattern().size())};
  f.evaluate(1, x, {}, weights, {.jacobian = true, .hessian = true}, d.values, d.jacobian,
             d.hessian);
  return d;
}

/// The gradient of the weighted outputs, dense.
std::vector<double> gradient(const expr::Function& f, const Derivatives& d,
                             const std::vector<double>& weights) {
  std::vector<double> result(f.variables());
  const auto& pattern = f.jacobian_pattern();
  for (std::size_t e = 0; e < pattern.size(); ++e)
    result[pattern[e].col] += weights[pattern[e].row] * d.jacobian[e];
  return result;
}

TEST(CombinedSlip, DerivativesAreThoseOfDifferences) {
  const Dynamics dynamics(combined());
  const auto& f = dynamics.derivative_function();
  std::mt19937_64 engine{3};
  const auto between = [&](double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(engine);
  };
  std::vector<double> weights(f.outputs(), 1);
  for (int n = 0; n < 200; ++n) {
    // Up to twice the friction of an axle, so that the rounded end of the ellipse is within.
    const std::vector<double> x = {0,
                                   0,
                                   between(-1, 1),
                                   between(-.5, .5),
                                   between(-3, 3),
                                   between(-.3, .3),
                                   between(5, 29),
                                   between(-14, 10),
                                   between(-.1, .1),
                                   between(-5, 5)};
    for (auto& w : weights) w = between(-1, 1);
    const auto at = derivatives(f, x, weights);
    const auto slope = gradient(f, at, weights);
    for (std::size_t i = 0; i < x.size(); ++i) {
      constexpr double h = 1e-5;
      auto more = x, less = x;
      more[i] += h;
      less[i] -= h;
      const auto above = derivatives(f, more, weights), below = derivatives(f, less, weights);
      double difference = 0;
      for (std::size_t k = 0; k < weights.size(); ++k)
        difference += weights[k] * (above.values[k] - below.values[k]) / (2 * h);
      EXPECT_NEAR(slope[i], difference, 1e-5 * (1 + std::fabs(slope[i])));
      const auto g1 = gradient(f, above, weights), g0 = gradient(f, below, weights);
      for (std::size_t e = 0; e < f.hessian_pattern().size(); ++e) {
        const auto [row, col] = f.hessian_pattern()[e];
        if (col != i) continue;
        EXPECT_NEAR(at.hessian[e], (g1[row] - g0[row]) / (2 * h),
                    1e-4 * (1 + std::fabs(at.hessian[e])))
            << "row " << row << " col " << col;
      }
    }
  }
}

}  // namespace
}  // namespace slalom::vehicle
