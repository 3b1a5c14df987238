#include "../../src/base/extrapolated_euler.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../../src/base/integrate.hpp"

namespace slalom {
namespace {

/// x0' = -rate (x0 - cos t) - sin t, whose answer from x0 = 1 is cos t at any rate; and x1' = x1
/// x0.
struct Relaxes {
  double rate;
  mutable int asked = 0;

  void operator()(const std::array<double, 2>& x, std::array<double, 2>& slope, double t) const {
    ++asked;
    slope = {-rate * (x[0] - std::cos(t)) - std::sin(t), x[1] * x[0]};
  }
  Square<2> jacobian(const std::array<double, 2>& x, double) const {
    return {{{-rate, 0}, {x[1], x[0]}}};
  }
};

TEST(ExtrapolatedEuler, ComesToTheClosedFormHoweverStiff) {
  for (const double rate : {0., 1., 1e2, 1e4, 1e8}) {
    std::array<double, 2> x{1, 1};
    double t = 0;
    const Relaxes system{rate};
    ASSERT_TRUE(integrate(ExtrapolatedEuler<2>(1e-10), system, 2, 0, x, t)) << rate;
    EXPECT_NEAR(x[0], std::cos(2.), 2e-9) << rate;
    EXPECT_NEAR(x[1], std::exp(std::sin(2.)), 2e-8) << rate;
    EXPECT_LT(system.asked, 4000) << rate;  // explicit methods: about the rate
  }
}

TEST(ExtrapolatedEuler, IsOfAboutOrderSeven) {
  const auto error = [](int steps) {
    std::array<double, 2> x{1, 1};
    double t = 0, step = 4. / steps;
    for (int k = 0; k < steps; ++k) {
      step = 4. / steps;
      // So loose that each step is taken.
      EXPECT_EQ(ExtrapolatedEuler<2>(1e9).try_step(Relaxes{1}, x, t, step),
                boost::numeric::odeint::success);
    }
    return std::fabs(x[1] - std::exp(std::sin(4.)));
  };
  EXPECT_NEAR(std::log2(error(24) / error(48)), 7, 1.2);
}

TEST(ExtrapolatedEuler, ASmallerToleranceTakesShorterSteps) {
  std::array<double, 2> x{0, 1};
  double t = 0, step = 1;
  EXPECT_EQ(ExtrapolatedEuler<2>(1e-12).try_step(Relaxes{20}, x, t, step),
            boost::numeric::odeint::fail);
  EXPECT_EQ(t, 0);
  EXPECT_EQ(x[0], 0);
  EXPECT_LT(step, 0.5);
}

}  // namespace
}  // namespace slalom
