// The models a planner may use: their equations, and plans made with them.

#include <gtest/gtest.h>

#include <cmath>

#include "../../src/planner/model_map.hpp"
#include "planner/scenes.hpp"
#include "slalom/expr/function.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;

constexpr ModelKind kKinds[] = {ModelKind::pacejka, ModelKind::linear_tyre,
                                ModelKind::constant_speed, ModelKind::kinematic};

/// The model as numbers: derivative of the state.
class Numbers {
 public:
  explicit Numbers(ModelKind kind) {
    const Model model = make_model({}, kind);
    std::vector<expr::Expr> inputs(model.state.begin(), model.state.end());
    inputs.insert(inputs.end(), model.control.begin(), model.control.end());
    rate_ = expr::Function(inputs, {}, {model.derivative.begin(), model.derivative.end()});
  }
  State rate(const State& x, const Control& u) const {
    std::vector<double> inputs(x.begin(), x.end());
    inputs.insert(inputs.end(), u.begin(), u.end());
    State rate;
    rate_(inputs, {}, rate);
    return rate;
  }

 private:
  expr::Function rate_;
};

/// Largest trapezoidal defect of the plan under its own model, over all entries it has a rate for.
double worst_defect(const Plan& plan, ModelKind kind) {
  const Numbers numbers(kind);
  const Model model = make_model({}, kind);
  double worst = 0;
  for (std::size_t k = 0; k + 1 < plan.t.size(); ++k) {
    const State a = numbers.rate(plan.states[k], plan.controls[k]);
    const State b = numbers.rate(plan.states[k + 1], plan.controls[k + 1]);
    for (std::size_t i = 0; i < kStates; ++i)
      if (model.role[i] == Role::state)
        worst = std::max(worst, std::fabs(plan.states[k + 1][i] - plan.states[k][i] -
                                          (plan.t[k + 1] - plan.t[k]) / 2 * (a[i] + b[i])));
  }
  return worst;
}

TEST(Models, APlanObeysItsOwnModelAndTheNextStartsFromIt) {
  for (const ModelKind kind : kKinds)
    for (const bool near : {false, true}) {
      SCOPED_TRACE(model_names()[static_cast<std::size_t>(kind)] + (near ? ", in range" : ""));
      Scene scene = E_B();
      scene.planner.model = kind;
      if (near) {
        scene.first.X0p[Y] = 85;
        scene.obstacles.clear();
      }
      Planner planner = Planner(scene);
      const Plan first = planner.plan(scene.first);
      ASSERT_TRUE(first.report.solved) << first.report.status_text();
      EXPECT_LT(worst_defect(first, kind), 1e-5);
      const Plan again = planner.plan(scene.first);
      ASSERT_TRUE(again.report.solved);
      EXPECT_NEAR(again.report.phi, first.report.phi, 1e-3 * std::fabs(first.report.phi));
      EXPECT_LE(again.report.iterations, first.report.iterations);
      EXPECT_GE(least_obstacle_row(scene, first), 0) << "obstacle rows hold whatever the model";
    }
}

TEST(Models, ConstantSpeedPlansSteeringAlone) {
  Scene scene = E_B();
  scene.planner.model = ModelKind::constant_speed;
  scene.first.X0p[UX] = 16.25;
  const Plan plan = Planner(scene).plan(scene.first);
  ASSERT_TRUE(plan.report.solved);
  for (std::size_t k = 0; k < plan.t.size(); ++k) {
    EXPECT_EQ(plan.states[k][UX], 16.25);
    EXPECT_EQ(plan.states[k][AX], 0);
    EXPECT_EQ(plan.controls[k][JX], 0);
  }
}

TEST(Models, TheKinematicBicycleDoesNotSlip) {
  Scene scene = E_B();
  scene.planner.model = ModelKind::kinematic;
  const Plan plan = Planner(scene).plan(scene.first);
  ASSERT_TRUE(plan.report.solved);
  const Parameters p;
  double steered = 0;
  for (const State& x : plan.states) {
    EXPECT_NEAR(x[V] - p.lb * x[R], 0, 1e-12) << "rear";
    EXPECT_NEAR(x[V] + p.la * x[R], x[UX] * std::tan(x[SA]), 1e-12) << "front";
    steered = std::max(steered, std::fabs(x[SA]));
  }
  EXPECT_GT(steered, 0.005);
}

/// Without slip and at constant steering angle the front axle's centre runs on a circle of radius
/// (la + lb)/sin(sa), at speed ux/cos(sa).
TEST(Models, TheKinematicBicycleRunsOnItsCircle) {
  const Parameters p;
  const Numbers numbers(ModelKind::kinematic);
  const State x{0, 0, 0, 0, 0.7, 0.2, 12, 0};
  const State rate = numbers.rate(x, {0, 0});
  const double speed = std::hypot(rate[X], rate[Y]);
  EXPECT_NEAR(speed, 12 / std::cos(0.2), 1e-12);
  EXPECT_NEAR(speed / rate[PSI], (p.la + p.lb) / std::sin(0.2), 1e-10);
  EXPECT_NEAR(std::atan2(rate[Y], rate[X]), 0.7 + 0.2, 1e-12);
}

/// The load rows of the kinematic model: load moves with its own lateral acceleration, v' + ux r.
TEST(Models, TheKinematicWheelLoadsFollowItsAcceleration) {
  const Parameters p;
  const Model model = make_model(p, ModelKind::kinematic);
  std::vector<expr::Expr> inputs(model.state.begin(), model.state.end());
  inputs.insert(inputs.end(), model.control.begin(), model.control.end());
  const expr::Function loads(inputs, {}, {model.wheel_loads[RL], model.wheel_loads[RR]});
  const double L = p.la + p.lb, sa = 0.05, ux = 15, ax = 0.4, sr = 0.03, h = 1e-6;
  const auto v = [&](double t) { return p.lb * (ux + ax * t) * std::tan(sa + sr * t) / L; };
  const double r = ux * std::tan(sa) / L;
  const double lateral = (v(h) - v(-h)) / (2 * h) + ux * r;
  std::vector<double> values(2);
  loads(std::vector<double>{0, 0, v(0), r, 0, sa, ux, ax, sr, 0}, {}, values);
  EXPECT_NEAR(values[1] - values[0], 2 * p.KZYR * lateral, 1e-3);
}

TEST(Models, LinearTyresAgreeWithPacejkasNearZeroSlipOnly) {
  Parameters symmetric;
  symmetric.tyre_asymmetry = false;
  const auto lateral = [&](ModelKind kind, double sa) {
    const Model model = make_model(symmetric, kind);
    const expr::Function f({model.state.begin(), model.state.end()}, {}, {model.Fyf});
    std::vector<double> value(1);
    f(std::vector<double>{0, 0, 0, 0, 0, sa, 20, 0}, {}, value);
    return value[0];
  };
  EXPECT_NEAR(lateral(ModelKind::linear_tyre, 1e-4) / lateral(ModelKind::pacejka, 1e-4), 1, 1e-3);
  EXPECT_GT(lateral(ModelKind::linear_tyre, 0.2), 1.5 * lateral(ModelKind::pacejka, 0.2));
}

TEST(ModelMap, ThereAndBackGivesWhatTheModelMakesOfIt) {
  const State X0p{1, 2, 3, 4, 5, 0.1, 7, 0};
  ocp::Trajectory t{0, 1, {0, 1}, {}, {}, {}, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10}};
  t.states.assign(2, {1, 2, 30, 40, 5, 0.1, 70, 80});
  t.controls.assign(2, {0.5, 0.6});
  auto same = t;
  const ModelMap pacejka({}, ModelKind::pacejka);
  pacejka.to_planner(same);
  pacejka.to_plant(X0p, same);
  EXPECT_EQ(same.states, t.states);
  EXPECT_EQ(same.slacks, t.slacks);
  auto held = t;
  const ModelMap constant({}, ModelKind::constant_speed);
  constant.to_planner(held);
  EXPECT_EQ(held.states[0], (std::vector<double>{1, 2, 30, 40, 5, 0.1}));
  EXPECT_EQ(held.controls[0], (std::vector<double>{0.5}));
  EXPECT_EQ(held.slacks, (std::vector<double>{1, 2, 3, 4, 5, 6, 9, 10})) << "the final ones stay";
  constant.to_plant(X0p, held);
  EXPECT_EQ(held.states[1], (std::vector<double>{1, 2, 30, 40, 5, 0.1, 7, 0}));
  EXPECT_EQ(held.controls[1], (std::vector<double>{0.5, 0}));
  EXPECT_EQ(held.slacks, (std::vector<double>{1, 2, 3, 4, 5, 6, 0, 0, 9, 10}));
}

}  // namespace
}  // namespace slalom::planner
