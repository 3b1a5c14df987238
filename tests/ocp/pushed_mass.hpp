#pragma once

#include <string>

#include "slalom/ocp/problem.hpp"

namespace slalom::ocp {

/// A mass pushed by |u| <= 1 from rest to rest over 1; times and costs are the test's own.
struct PushedMass {
  Problem problem;
  Expr x = problem.state("x"), v = problem.state("v"), u = problem.control("u", {-1, 1});
  explicit PushedMass(const std::string& name) : problem(name) {
    problem.dynamics(x, v);
    problem.dynamics(v, u);
    problem.fix(x, 0, 1);
    problem.fix(v, 0, 0);
  }
};

}  // namespace slalom::ocp
