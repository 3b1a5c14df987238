#pragma once

#include <random>
#include <vector>

#include "slalom/ocp/transcription.hpp"

namespace slalom::ocp {

/// A problem that uses everything a problem can have: t0 and tf free, explicit time and tau, end
/// values away from their ends, scales other than 1, slacks, families, both kinds of cost.
struct KitchenSink {
  Problem problem{"sink"};
  Expr x = problem.state("x", {-5, 5}, 2);
  Expr y = problem.state("y", {}, 0.1);
  Expr u = problem.control("u", {-3, 3}, 5);
  Expr w = problem.control("w");
  Expr p = problem.static_parameter("p", {0.1, 4}, 1, 3);
  Expr s = problem.slack("s", End::initial, Bounds::at_most(2), 0.5);
  Expr e = problem.slack("e", End::final, Bounds::at_most(2), 0.25);
  Expr q = problem.parameter("q", 0.7);
  ConstraintId wall, band, family, start, end;

  KitchenSink() {
    const Expr t = problem.time(), tau = problem.tau();
    const Expr x0 = problem.initial(x), xf = problem.final(x), yf = problem.final(y);
    problem.initial_time({-1, 1}, 0.2);
    problem.final_time({1.5, 9}, 2.5);
    problem.dynamics(x, u * sin(y) + p * t + 0.1 * x0 * w);
    problem.dynamics(y, -x * y + exp(-0.2 * w * w) + q * tau * yf);
    problem.lagrange("effort", p * square(u) + square(w) * t + 0.3 * x0 * x);
    problem.lagrange("unused", square(x));
    problem.enable_cost("unused", false);
    problem.mayer("ends", x0 * xf * p + e * problem.final_time() * problem.initial_time());
    problem.mayer("start cost", s * exp(x0));
    wall = problem.path("wall", square(x) + q * w * problem.final_time(), {-4, 9});
    band = problem.path("band", y * u - xf * tau, Bounds::at_most(6), Points::after_first);
    const Expr a = Expr::symbol("a"), b = Expr::symbol("b");
    family = problem.path_family("disc", {a, b}, square(x - a * t) + square(y - b) * p,
                                 Bounds::at_least(0.01), Points::after_first);
    problem.set_members(family, {"one", "two", "three"}, {{1, 2}, {-0.5, 3}, {0.2, -1}});
    start = problem.boundary("start", square(x0) + s * problem.initial(y), {-1, 8});
    end = problem.boundary("end", xf * yf * problem.final_time() + e * x0, {-5, 7});
  }
};

/// A point strictly within the bounds, the same at every call.
inline std::vector<double> some_point(const nlp::Problem& problem, unsigned seed = 3) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> share(0.2, 0.8);
  const auto& limits = problem.limits();
  std::vector<double> x;
  for (std::size_t i = 0; i < problem.structure().variables; ++i) {
    const double low = std::max(limits.xl[i], -1.0), high = std::min(limits.xu[i], 1.5);
    x.push_back(low + share(engine) * (high - low));
  }
  return x;
}

}  // namespace slalom::ocp
