#include "fit.hpp"

#include <algorithm>
#include <string>

namespace slalom::problems {
namespace {

Expr squares(const Problem& p, const std::vector<Expr>& states, const std::vector<double>& data,
             bool at_begin) {
  Expr sum = 0;
  for (std::size_t i = 0; i < states.size(); ++i)
    sum += square((at_begin ? p.initial(states[i]) : p.final(states[i])) - data[i]);
  return sum;
}

}  // namespace

Statement fitted(const Fit& fit) {
  PhasedProblem all(fit.name);
  Statement statement{all};
  const bool measured_at_0 = fit.times.front() == 0;
  double t0 = 0;
  std::vector<double> from = fit.begin.empty() ? fit.data.front() : fit.begin;
  for (std::size_t k = measured_at_0 ? 1 : 0; k < fit.times.size(); ++k) {
    Problem p("to t = " + std::to_string(fit.times[k]));
    std::vector<Expr> states, constants;
    for (std::size_t i = 0; i < fit.states.size(); ++i) {
      double most = 0;
      for (const auto& row : fit.data) most = std::max(most, row[i]);
      states.push_back(p.state(fit.states[i], {}, most));
    }
    for (std::size_t i = 0; i < fit.constants.size(); ++i)
      constants.push_back(p.state(fit.constants[i], Bounds::at_least(0), fit.guess[i]));
    const auto rates = fit.rates(states, constants, p.time());
    for (std::size_t i = 0; i < states.size(); ++i) p.dynamics(states[i], rates[i]);
    for (const auto& constant : constants) p.dynamics(constant, 0);
    const bool first = all.phases().empty();
    for (std::size_t i = 0; first && i < fit.begin.size(); ++i) starts(p, states[i], fit.begin[i]);
    Expr cost = squares(p, states, fit.data[k], false);
    if (first && measured_at_0) cost += squares(p, states, fit.data.front(), true);
    p.mayer("residuals", cost);
    p.initial_time(Bounds::equal(t0), t0);
    horizon(p, fit.times[k]);
    all.add(p);
    const auto with_constants = [&](std::vector<double> values) {
      values.insert(values.end(), fit.guess.begin(), fit.guess.end());
      return values;
    };
    statement.guesses.push_back(
        line(t0, fit.times[k], with_constants(from), with_constants(fit.data[k]), {}, {}));
    from = fit.data[k];
    t0 = fit.times[k];
  }
  // Times are given: linking them too would state equations twice.
  for (std::size_t k = 0; k + 1 < all.phases().size(); ++k) {
    const Problem &before = all.phases()[k], &after = all.phases()[k + 1];
    for (std::size_t i = 0; i < before.states().size(); ++i)
      all.link(before.states()[i].name + " after " + before.name(),
               after.initial(after.states()[i].symbol) - before.final(before.states()[i].symbol));
  }
  statement.problem = all;
  return statement;
}

}  // namespace slalom::problems
