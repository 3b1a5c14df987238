#pragma once

#include "slalom/ocp/mpc.hpp"

namespace slalom::ocp {

/// A cart drawn to x = target with bounded thrust; `wall` keeps v from 0.9 up, say.
struct Cart {
  Problem problem{"cart"};
  Expr x = problem.state("x", {-10, 10}), v = problem.state("v", {-3, 3});
  Expr u = problem.control("u", {-1, 1}), target = problem.parameter("target", 1);
  ConstraintId wall = problem.path("wall", v, Bounds::at_most(2.5));
  Cart() {
    problem.dynamics(x, v);
    problem.dynamics(v, u);
    problem.lagrange("cost", square(x - target) + square(v) / 10 + square(u) / 10);
    problem.final_time(Bounds::equal(4), 4);
  }
  MpcSettings settings() const {
    return {.solve = {.mesh = Mesh::uniform(20)},
            .tex = 0.25,
            .max_cycles = 60,
            .goal = {{"x", 1, 0.01}, {"v", 0, 0.01}}};
  }
};

/// A plant with drag and an actuator that lags, by names of its own order.
inline System lagging_cart() {
  return {
      "lagging cart",
      {"thrust", "v", "x"},
      {"u"},
      [](double, std::span<const double> x, std::span<const double> u, std::span<double> rates) {
        rates[0] = (u[0] - x[0]) / 0.05;
        rates[1] = x[0] - 0.1 * x[1];
        rates[2] = x[1];
      }};
}

}  // namespace slalom::ocp
