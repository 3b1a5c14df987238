#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "slalom/nlp/solver.hpp"
#include "slalom/planner/planner.hpp"
#include "vehicle/reference_model.hpp"

namespace slalom::planner {

using vehicle::State;

/// The back ends a planner can be asked for, as far as this build has them.
inline std::vector<SolverChoice> solvers() {
  std::vector<SolverChoice> list;
  for (const auto& name : nlp::backends())
    for (const auto solver : {SolverChoice::interior_point, SolverChoice::ipopt})
      if (name == to_string(solver)) list.push_back(solver);
  return list;
}

/// What a planner plans in.
struct Scene : Task {
  Request first;
};

/// The paper's E_A with planner P_B (section 4 of docs/formulation.md).
inline Scene E_A() {
  Scene scene;
  scene.planner.w_ce = 0;
  scene.planner.moving_avoidance = false;
  scene.planner.floor = 0.8;
  scene.goal = {.x = 200, .y = 125, .sigma = 15};
  scene.obstacles = {
      {"O1", 205, 57, 5, 5, 0, 0}, {"O2", 180, 75, 4, 4, 0, 0}, {"O3", 200, 63, 2, 2, 0, 0}};
  scene.first = {{200, 8.5, 0, 0, std::numbers::pi / 2, 0, 17, 0}, 0, 0.5};
  return scene;
}

/// E_A's obstacles, moving, with planner P_D.
inline Scene E_B() {
  Scene scene = E_A();
  scene.planner.w_ce = 1;
  scene.planner.moving_avoidance = true;
  const double vx[] = {-2, -1, -0.5}, vy[] = {0, 1, 6};
  for (std::size_t i = 0; i < 3; ++i) {
    scene.obstacles[i].vx = vx[i];
    scene.obstacles[i].vy = vy[i];
  }
  return scene;
}

/// The paper's E_C with planner P_D.
inline Scene E_C() {
  Scene scene;
  scene.planner.floor = 0.8;
  scene.planner.N = 15;
  scene.planner.L_range = 90;
  scene.planner.kappa = 10;
  scene.goal = {.x = 18, .y = 700, .sigma = 25};
  scene.region.x_min = 0;
  scene.region.x_max = 24;
  scene.obstacles = {{"O1", 6, 281, 6, 6, 0, 0}, {"O2", 18, 650, 6, 6, 0, -10}};
  for (int i = 0; i < 36; ++i)
    scene.obstacles.push_back(
        {"cone" + std::to_string(i + 1), 12, 5.0 * i, 0.38735, 0.38735, 0, 0});
  scene.first = {{6, 8.5, 0, 0, std::numbers::pi / 2, 0, 17, 0}, 0, 0.5};
  return scene;
}

/// A scene elsewhere.
inline Scene moved(Scene scene, double dx, double dy) {
  scene.first.X0p[0] += dx;
  scene.first.X0p[1] += dy;
  scene.goal.x += dx;
  scene.goal.y += dy;
  scene.region.x_min += dx;
  scene.region.x_max += dx;
  for (auto& o : scene.obstacles) {
    o.x += dx;
    o.y += dy;
  }
  return scene;
}

/// How a plan's controls run between its points: linear, or as Hermite-Simpson has them, quadratic
/// over each interval of two.
enum class Controls { linear, quadratic };

inline vehicle::Control control_at(const Plan& plan, double t, Controls kind) {
  const std::size_t step = kind == Controls::linear ? 1 : 2;
  std::size_t k = step;
  while (k + step < plan.t.size() && plan.t[k] < t) k += step;
  const auto *first = &plan.controls[k - step], *last = &plan.controls[k];
  const double s = std::min((t - plan.t[k - step]) / (plan.t[k] - plan.t[k - step]), 1.0);
  vehicle::Control u{};
  for (std::size_t i = 0; i < vehicle::kControls; ++i) {
    u[i] = (*first)[i] + s * ((*last)[i] - (*first)[i]);
    if (kind == Controls::quadratic)
      u[i] += 4 * s * (1 - s) * (plan.controls[k - 1][i] - ((*first)[i] + (*last)[i]) / 2);
  }
  return u;
}

/// The plan's controls through the reference model by Runge and Kutta's method of order 4 from the
/// plan's first state; the state `time` after it.
inline State integrate(const Plan& plan, double time, Controls kind = Controls::linear,
                       double step = 1e-3) {
  const reference::HMMWV model;
  const auto control = [&](double t) { return control_at(plan, t, kind); };
  const auto plus = [](State x, double h, const State& slope) {
    for (std::size_t i = 0; i < vehicle::kStates; ++i) x[i] += h * slope[i];
    return x;
  };
  State x = plan.states.front();
  const int steps = static_cast<int>(std::ceil(time / step));
  const double h = time / steps;
  for (int n = 0; n < steps; ++n) {
    const double t = n * h;
    const State a = model.derivative(x, control(t));
    const State b = model.derivative(plus(x, h / 2, a), control(t + h / 2));
    const State c = model.derivative(plus(x, h / 2, b), control(t + h / 2));
    const State d = model.derivative(plus(x, h, c), control(t + h));
    for (std::size_t i = 0; i < vehicle::kStates; ++i)
      x[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
  }
  return x;
}

/// The next cycle of a vehicle that follows `plan` from its own first state.
inline Request next_cycle(const Request& request, const Plan& plan) {
  Request next = request;
  const double tex = request.t_start - request.t0;
  next.t0 = request.t_start;
  next.t_start = next.t0 + tex;
  next.X0p = integrate(plan, tex);
  return next;
}

/// Largest distance between the nodes of `a` and those of `b` moved by `map` [m].
template <class Map>
double distance(const Plan& a, const Plan& b, Map map) {
  double worst = 0;
  for (std::size_t k = 0; k < a.states.size(); ++k) {
    const auto [x, y] = map(b.states[k]);
    worst = std::max(worst, std::hypot(a.states[k][0] - x, a.states[k][1] - y));
  }
  return worst;
}

/// ((x - xo) / (a + sm))^2 + ((y - yo) / (b + sm))^2 - 1, least over nodes after the first.
inline double least_obstacle_row(const Scene& scene, const Plan& plan) {
  double least = 1e300;
  const auto& s = scene.planner;
  for (std::size_t k = 1; k < plan.t.size(); ++k)
    for (const auto& o : scene.obstacles) {
      const double t = plan.obstacle_time(k);
      const double sm = s.sm_start + (s.sm_end - s.sm_start) * plan.t[k] / plan.tf;
      const double dx = (plan.states[k][0] - o.x_at(t)) / (o.a + sm);
      const double dy = (plan.states[k][1] - o.y_at(t)) / (o.b + sm);
      least = std::min(least, dx * dx + dy * dy - 1);
    }
  return least;
}

}  // namespace slalom::planner
