// Landing on the moon in closed loop: the plan is made anew every fifth of a second while the
// lander flies the last one. Its engine gives 3 % more thrust than the plans believe.

#include <cstdio>

#include "slalom/ocp.hpp"

int main() {
  using namespace slalom::ocp;

  Problem problem("moon lander");
  const Expr h = problem.state("h"), v = problem.state("v"), thrust = problem.control("T", {0, 3});
  problem.dynamics(h, v);
  problem.dynamics(v, thrust - 1.5);
  problem.lagrange("fuel", thrust);
  problem.final_time({0.01, 20}, 5);
  problem.final_bounds(h, {-0.1, 0.1});
  problem.final_bounds(v, {-0.1, 0.1});

  MpcSettings settings;
  settings.solve = {.mesh = Mesh::uniform(20), .scheme = trapezoidal()};
  settings.tex = 0.2;
  settings.start_tolerance = {{"h", 0.1}, {"v", 0.1}};
  settings.goal = {{"h", 0, 0.1}, {"v", 0, 0.2}};
  settings.plant = System{
      "lander",
      {"h", "v"},
      {"T"},
      [](double, std::span<const double> x, std::span<const double> u, std::span<double> rates) {
        rates[0] = x[1];
        rates[1] = 1.03 * u[0] - 1.5;
      }};
  const MpcResult flight = Mpc(problem, settings).run({10, -2});

  std::printf("%s: %s; %zu plans, h = %.3f, v = %.3f\n", to_string(flight.status),
              flight.message.c_str(), flight.cycles.size(), flight.states.back()[0],
              flight.states.back()[1]);
  return flight.status == MpcStatus::goal || flight.status == MpcStatus::expanded_goal ? 0 : 1;
}
