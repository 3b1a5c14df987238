#include "slalom/vehicle/model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "vehicle/reference_model.hpp"

namespace slalom::vehicle {
namespace {

void expect_relative(double value, double expected, double tolerance, const std::string& what) {
  EXPECT_NEAR(value, expected, tolerance * std::max(std::abs(expected), 1e-30)) << what;
}

struct PublishedCase {
  State state;
  Control control;
  std::array<double, 2> forces;
  State derivative;
  WheelLoads loads;
};

// Section 6 of docs/formulation.md: computed with 40 digits, printed with 12.
const PublishedCase kPublished[] = {
    {{0, 0, .3, .1, 1.5, .05, 20, .5},
     {.02, -.5},
     {2190.14050521, -511.816514459},
     {.958140703236, 19.9822796861, -1.37578607106, 1.05534518045, .1, .02, .5, -.5},
     {5865.75581246, 7209.06418754, 6229.24559796, 7071.93440204}},
    {{10, -4, -1.2, -.25, .4, -.2, 8, -2},
     {0, 1},
     {-363.712769812, 5552.35929217},
     {7.98936682154, 1.64683011616, 3.92979749409, -2.46923444532, -.25, 0, -2, 1},
     {3344.63789636, 7497.56210364, 6464.28669149, 9069.51330851}}};

TEST(Model, PublishedValues) {
  const Dynamics dynamics{Parameters{}};
  for (const auto& c : kPublished) {
    const auto forces = dynamics.tyre_forces(c.state);
    const auto derivative = dynamics.derivative(c.state, c.control);
    const auto loads = dynamics.wheel_loads(c.state);
    for (std::size_t i = 0; i < 2; ++i) expect_relative(forces[i], c.forces[i], 5e-12, "Fy");
    for (std::size_t i = 0; i < kStates; ++i)
      expect_relative(derivative[i], c.derivative[i], 5e-12, kStateNames[i]);
    for (std::size_t i = 0; i < kWheels; ++i)
      expect_relative(loads[i], c.loads[i], 5e-12, kWheelNames[i]);
  }
}

/// Random states of a moving vehicle within its bounds, and somewhat beyond in slip.
struct Sampler {
  std::mt19937_64 engine{7};
  double between(double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(engine);
  }
  State state() {
    return {between(-500, 500), between(-500, 500), between(-3, 3), between(-1, 1),
            between(-6, 6),     between(-.5, .5),   between(1, 29), between(-3, 2)};
  }
  Control control() { return {between(-.09, .09), between(-5, 5)}; }
};

void compare_with_reference(bool asymmetry) {
  Parameters parameters;
  parameters.tyre_asymmetry = asymmetry;
  const Dynamics dynamics(parameters);
  const reference::HMMWV reference{asymmetry};
  Sampler sample;
  for (int n = 0; n < 2000; ++n) {
    const State state = sample.state();
    const Control control = sample.control();
    const auto loads = dynamics.wheel_loads(state);
    const auto expected_loads = reference.forces(state);
    // 1e-12 of each quantity's size: differences of forces lose digits against either force.
    EXPECT_NEAR(loads[RL], expected_loads.rl, 1e-12 * 13000);
    EXPECT_NEAR(loads[RR], expected_loads.rr, 1e-12 * 13000);
    EXPECT_NEAR(loads[FL], expected_loads.fl, 1e-12 * 13000);
    EXPECT_NEAR(loads[FR], expected_loads.fr, 1e-12 * 13000);
    const auto forces = dynamics.tyre_forces(state);
    EXPECT_NEAR(forces[0], expected_loads.front, 1e-12 * 10000);
    EXPECT_NEAR(forces[1], expected_loads.rear, 1e-12 * 10000);
    const auto derivative = dynamics.derivative(state, control);
    const auto expected = reference.derivative(state, control);
    const State size = {30, 30, 40, 10, 1, 1, 3, 5};
    for (std::size_t i = 0; i < kStates; ++i)
      EXPECT_NEAR(derivative[i], expected[i], 1e-12 * size[i]) << kStateNames[i];
  }
}

TEST(Model, AgreesWithAnIndependentImplementation) {
  compare_with_reference(true);
}

TEST(Model, AgreesWithAnIndependentImplementationWithoutAsymmetry) {
  compare_with_reference(false);
}

TEST(Model, OffsetsMakeStraightDrivingForceFree) {
  const Dynamics dynamics{Parameters{}};
  const auto forces = dynamics.tyre_forces({0, 0, 0, 0, 1.5, 0, 17, 0});
  EXPECT_NEAR(forces[0], 0, .03);
  EXPECT_NEAR(forces[1], 0, .03);

  Parameters bare;
  bare.F_offset_front = bare.F_offset_rear = 0;
  const auto without = Dynamics(bare).tyre_forces({0, 0, 0, 0, 1.5, 0, 17, 0});
  EXPECT_NEAR(forces[0] - without[0], 278.2789450759981, 1e-9);
  EXPECT_NEAR(forces[1] - without[1], 259.95925391136984, 1e-9);
}

TEST(Model, WheelLoadsAddUpToTheAxles) {
  const Parameters p;
  const Dynamics dynamics(p);
  const auto still = dynamics.wheel_loads({0, 0, 0, 0, 0, 0, 17, 0});
  EXPECT_NEAR(still[FL] + still[FR], p.FzF0, 1e-9);
  EXPECT_NEAR(still[RL] + still[RR], p.FzR0, 1e-9);
  Sampler sample;
  for (int n = 0; n < 100; ++n) {
    const State state = sample.state();
    const auto loads = dynamics.wheel_loads(state);
    const double transfer = p.KZX * (state[AX] - state[V] * state[R]);
    EXPECT_NEAR(loads[FL] + loads[FR], p.FzF0 - transfer, 1e-8);
    EXPECT_NEAR(loads[RL] + loads[RR], p.FzR0 + transfer, 1e-8);
  }
}

TEST(Model, AccelerationLoadsTheRearAndALeftTurnTheRight) {
  const Dynamics dynamics{Parameters{}};
  const auto still = dynamics.wheel_loads({0, 0, 0, 0, 0, 0, 17, 0});
  const auto forward = dynamics.wheel_loads({0, 0, 0, 0, 0, 0, 17, 1});
  EXPECT_GT(forward[RL], still[RL]);
  EXPECT_LT(forward[FL], still[FL]);
  const auto left = dynamics.wheel_loads({0, 0, 0, 0, 0, .05, 17, 0});
  EXPECT_GT(left[RR], left[RL]);
  EXPECT_GT(left[FR], left[FL]);
  EXPECT_GT(dynamics.tyre_forces({0, 0, 0, 0, 0, .05, 17, 0})[0], 1000);
}

TEST(Model, WithoutAsymmetryLeftAndRightMirror) {
  Parameters p;
  p.tyre_asymmetry = false;
  const Dynamics dynamics(p);
  Sampler sample;
  for (int n = 0; n < 500; ++n) {
    const State state = sample.state();
    State mirrored = state;
    for (const auto i : {Y, V, R, PSI, SA}) mirrored[i] = -state[i];
    const auto forces = dynamics.tyre_forces(state), other = dynamics.tyre_forces(mirrored);
    EXPECT_NEAR(forces[0], -other[0], 1e-9);
    EXPECT_NEAR(forces[1], -other[1], 1e-9);
    const auto loads = dynamics.wheel_loads(state), swapped = dynamics.wheel_loads(mirrored);
    EXPECT_NEAR(loads[RL], swapped[RR], 1e-9);
    EXPECT_NEAR(loads[FL], swapped[FR], 1e-9);
    const auto a = dynamics.derivative(state, {.05, 1}),
               b = dynamics.derivative(mirrored, {-.05, 1});
    for (const auto i : {Y, V, R, PSI, SA}) EXPECT_NEAR(a[i], -b[i], 1e-11) << kStateNames[i];
    for (const auto i : {X, UX, AX}) EXPECT_NEAR(a[i], b[i], 1e-11) << kStateNames[i];
  }
}

TEST(Model, ExpressionsAndNumbersAreOneModel) {
  const Parameters p;
  const Model model = make_model(p);
  const expr::Function limits({model.state.begin(), model.state.end()}, {},
                              {model.ax_min, model.ax_max, model.alpha_f, model.alpha_r});
  const State state = {0, 0, .3, .1, 1.5, .05, 20, .5};
  std::array<double, 4> values{};
  limits(state, {}, values);
  EXPECT_NEAR(values[0], p.ax_min_at(20), 1e-14);
  EXPECT_NEAR(values[1], p.ax_max_at(20), 1e-14);
  EXPECT_NEAR(values[2], std::atan((.3 + 1.5775 * .1) / 20.01) - .05, 1e-15);
  EXPECT_NEAR(values[3], std::atan((.3 - 1.7245 * .1) / 20.01), 1e-15);
}

TEST(Model, AccelerationLimitsAtStandstillAndTopSpeed) {
  const Parameters p;
  EXPECT_DOUBLE_EQ(p.ax_max_at(0), 3.08283259993589);
  EXPECT_DOUBLE_EQ(p.ax_min_at(0), -3.55886697370079);
  EXPECT_NEAR(p.ax_max_at(29),
              -0.000128015180401862 * 24389 + 0.00858618595422724 * 841 - 0.225657108071454 * 29 +
                  3.08283259993589,
              1e-12);
}

}  // namespace
}  // namespace slalom::vehicle
