#include "links.hpp"

#include <algorithm>
#include <cmath>

#include "slalom/base/error.hpp"

namespace slalom::ocp {
namespace {

/// The phase that has the symbol, and its variable there.
std::pair<std::size_t, std::size_t> find(const PhasedProblem& problem,
                                         const std::vector<std::unique_ptr<Transcription>>& parts,
                                         const Expr& symbol) {
  for (std::size_t p = 0; p < parts.size(); ++p)
    if (const auto variable = parts[p]->end_variable(symbol)) return {p, *variable};
  throw InvalidValue(problem.name() + ": links and cost terms",
                     "the symbol '" + symbol.name() + "'",
                     "end values, times, static parameters and integrals of its phases");
}

}  // namespace

Links::Links(const PhasedProblem& problem, const std::vector<std::unique_ptr<Transcription>>& parts,
             const std::vector<Offsets>& offsets) {
  for (const auto& link : problem.links()) values_.push_back(link.value);
  std::vector<char> touched(parts.size(), parts.size() == 1);
  for (const auto& symbol : expr::symbols_of(values_))
    touched[find(problem, parts, symbol).first] = 1;
  for (const auto& cost : problem.costs()) values_.push_back(cost.value);
  for (const auto& symbol : expr::symbols_of(values_)) {
    symbols_.push_back(symbol);
    const auto [p, at] = find(problem, parts, symbol);
    variables_.push_back(offsets[p].variables + at);
    scales_.push_back(parts[p]->structure().variable_scale[at]);
  }
  for (std::size_t p = 0; p < parts.size(); ++p)
    if (!touched[p])
      throw InvalidValue(problem.name() + ": phase " + problem.phases()[p].name(), "no link",
                         "a link with another phase");
  function_ = expr::Function(symbols_, {}, values_);
  evaluator_.emplace(function_, 1);
  evaluator_->prepare({.values = true, .jacobian = true, .hessian = true});
  inputs_.resize(symbols_.size());
  for (std::size_t i = 0; i < inputs_.size(); ++i) evaluator_->set_variable(i, &inputs_[i], true);
}

std::vector<double> Links::row_scales() {
  for (std::size_t i = 0; i < inputs_.size(); ++i) inputs_[i] = scales_[i];
  evaluator_->evaluate({.values = true, .jacobian = true});
  std::vector<double> most(function_.outputs(), 0.0);
  for (std::size_t e = 0; e < function_.jacobian_pattern().size(); ++e) {
    const auto [row, col] = function_.jacobian_pattern()[e];
    most[row] = std::max(most[row], std::fabs(evaluator_->jacobian()[e]) * scales_[col]);
  }
  for (double& scale : most) scale = std::isfinite(scale) && scale > 0 ? 1 / scale : 1;
  return most;
}

void Links::evaluate(std::span<const double> x, std::span<const double> weights, nlp::Parts parts) {
  for (std::size_t i = 0; i < inputs_.size(); ++i) inputs_[i] = scales_[i] * x[variables_[i]];
  if (parts.hessian) std::copy(weights.begin(), weights.end(), evaluator_->weights().begin());
  evaluator_->evaluate({parts.values, parts.derivatives, parts.hessian});
}

std::vector<Expr> Links::formulas(const std::vector<Expr>& variables) const {
  std::vector<Expr> inputs;
  for (std::size_t i = 0; i < inputs_.size(); ++i)
    inputs.push_back(scales_[i] * variables[variables_[i]]);
  return function_(inputs, {});
}

std::size_t Links::with_bad_curvature() const {
  const std::vector<double> one{1.0};
  std::vector<double> none;
  for (std::size_t output = 0; output < values_.size(); ++output) {
    const expr::Function alone(symbols_, {}, {values_[output]});
    std::vector<double> curvature(alone.hessian_pattern().size());
    alone.evaluate(1, inputs_, {}, one, {.values = false, .hessian = true}, none, none, curvature);
    if (!std::all_of(curvature.begin(), curvature.end(),
                     [](double entry) { return std::isfinite(entry); }))
      return output;
  }
  return values_.size();
}

}  // namespace slalom::ocp
