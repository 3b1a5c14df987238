#include "slalom/ocp/values.hpp"

#include <algorithm>

#include "point_functions.hpp"
#include "slalom/base/error.hpp"
#include "slalom/ocp/interpolant.hpp"

namespace slalom::ocp {
namespace {

/// One expression, at a time with its states and controls.
class Along {
 public:
  Along(const Problem& problem, const Solution& solution, const Expr& expression)
      : at_(solution.trajectory), value_(compiled(problem, at_, expression)) {}

  double operator()(double t, const std::vector<double>& states,
                    const std::vector<double>& controls) const {
    std::vector<double> inputs = states;
    inputs.insert(inputs.end(), controls.begin(), controls.end());
    inputs.push_back(t);
    inputs.push_back(at_.tf > at_.t0 ? (t - at_.t0) / (at_.tf - at_.t0) : 0);
    double value = 0;
    value_(inputs, {}, {&value, 1});
    return value;
  }

 private:
  static expr::Function compiled(const Problem& problem, const Trajectory& at,
                                 const Expr& expression) {
    try {
      return function_along(problem, at, {expression});
    } catch (const Error& error) {
      throw InvalidValue(problem.name() + ": values along the solution", error.what(),
                         "symbols of this problem");
    }
  }

  const Trajectory& at_;
  expr::Function value_;
};

}  // namespace

std::vector<double> values(const Problem& problem, const Solution& solution,
                           const Expr& expression) {
  const Along value(problem, solution, expression);
  const Trajectory& at = solution.trajectory;
  std::vector<double> list;
  for (std::size_t k = 0; k < at.tau.size(); ++k)
    list.push_back(value(at.time(k), at.states[k], at.controls[k]));
  return list;
}

std::vector<double> values(const Problem& problem, const Solution& solution, const Expr& expression,
                           const std::vector<double>& times) {
  const Along value(problem, solution, expression);
  const Trajectory& at = solution.trajectory;
  const Interpolant between(problem, at, solution.mesh, solution.scheme);
  std::vector<double> list;
  for (const double time : times) {
    const double t = std::clamp(time, at.t0, at.tf);
    list.push_back(value(t, between.states(t), between.controls(t)));
  }
  return list;
}

bool changes_over_time(const Problem& problem, const Expr& expression) {
  const auto is = [](const auto& list, const Expr& symbol) {
    return std::any_of(list.begin(), list.end(),
                       [&](const auto& each) { return each.symbol.same(symbol); });
  };
  const auto symbols = expr::symbols_of({expression});
  return std::any_of(symbols.begin(), symbols.end(), [&](const Expr& symbol) {
    return symbol.same(problem.time()) || symbol.same(problem.tau()) ||
           is(problem.states(), symbol) || is(problem.controls(), symbol);
  });
}

}  // namespace slalom::ocp
