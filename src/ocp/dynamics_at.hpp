#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "slalom/expr/function.hpp"
#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/trajectory.hpp"

namespace slalom::ocp {

/// The rates by states and controls, with their values and slopes at one point of a guess.
struct DynamicsAt {
  /// `numbers`: the values of a list of symbols there, for what is neither state nor control.
  template <class Numbers>
  DynamicsAt(const Problem& problem, const Trajectory& guess, std::size_t point,
             const Numbers& numbers) {
    std::vector<Expr> variables, data, rates;
    for (const auto& state : problem.states()) {
      variables.push_back(state.symbol);
      rates.push_back(state.rate);
    }
    for (const auto& control : problem.controls()) variables.push_back(control.symbol);
    for (const auto& symbol : expr::symbols_of(rates))
      if (std::none_of(variables.begin(), variables.end(),
                       [&](const Expr& each) { return each.same(symbol); }))
        data.push_back(symbol);
    f = expr::Function(variables, data, rates);
    values.resize(rates.size());
    slopes.resize(f.jacobian_pattern().size());
    std::vector<double> x = guess.states[point], none;
    x.insert(x.end(), guess.controls[point].begin(), guess.controls[point].end());
    f.evaluate(1, x, numbers(data), none, {.values = true, .jacobian = true}, values, slopes, none);
  }

  expr::Function f;
  std::vector<double> values, slopes;
};

}  // namespace slalom::ocp
