#include "batch.hpp"

#include <algorithm>
#include <cmath>

#include "set_up_watch.hpp"

namespace slalom::ocp {
namespace {

std::size_t first_bad(std::span<const double> numbers) {
  const auto it =
      std::find_if_not(numbers.begin(), numbers.end(), [](double v) { return std::isfinite(v); });
  return static_cast<std::size_t>(it - numbers.begin());
}

}  // namespace

void Batch::finish() {
  SetUpWatch::ask_now();
  evaluator.emplace(function, lanes);
  for (const nlp::Parts parts : {nlp::Parts{.values = true},
                                 {.values = true, .derivatives = true},
                                 {.hessian = true},
                                 {.derivatives = true, .hessian = true},
                                 {.values = true, .derivatives = true, .hessian = true}})
    evaluator->prepare({parts.values, parts.derivatives, parts.hessian});
  std::vector<Scatter> copies;
  copied_.resize(function.variables() * lanes);
  for (std::size_t i = 0; i < function.variables(); ++i) {
    SetUpWatch::ask_now();
    const std::uint32_t* from = &gather[i * lanes];
    bool run = true, same = true;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      run = run && from[lane] == from[0] + lane;
      same = same && from[lane] == from[0];
    }
    using Kind = Source::Kind;
    const bool in_place = gather_scale[i] == 1 && (run || same);
    sources_.push_back({!in_place ? Kind::copied : same ? Kind::same : Kind::run, from[0]});
    if (in_place) continue;
    evaluator->set_variable(i, &copied_[i * lanes], false);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      copies.push_back({from[lane], static_cast<std::uint32_t>(i * lanes + lane), gather_scale[i]});
  }
  copies_ = LaneRuns(copies);
}

void Batch::load(std::span<const double> point) {
  if (copies_.runs() > 0) {
    std::fill(copied_.begin(), copied_.end(), 0.0);
    copies_.scatter(point, copied_);
  }
  for (std::size_t i = 0; i < sources_.size(); ++i)
    if (sources_[i].kind != Source::Kind::copied)
      evaluator->set_variable(i, point.data() + sources_[i].first,
                              sources_[i].kind == Source::Kind::same);
}

void Batch::set_weights(double sigma, std::span<const double> y) {
  const auto weights = evaluator->weights();
  std::fill(weights.begin(), weights.end(), 0.0);
  to_rows.gather(y, weights);
  to_terms.add_to_sources(sigma, weights);
}

void Batch::run(nlp::Parts parts) {
  evaluator->evaluate({parts.values, parts.derivatives, parts.hessian});
}

Batch::BadNumber Batch::find_bad_number(nlp::Parts parts) const {
  if (parts.values) {
    const std::size_t bad = first_bad(evaluator->values());
    if (bad < evaluator->values().size()) return {true, bad / lanes, bad % lanes, ""};
  }
  if (parts.derivatives) {
    const std::size_t bad = first_bad(evaluator->jacobian());
    if (bad < evaluator->jacobian().size()) {
      const auto entry = function.jacobian_pattern()[bad / lanes];
      return {true, entry.row, bad % lanes, variables[entry.col]};
    }
  }
  if (parts.hessian) {
    const std::size_t bad = first_bad(evaluator->hessian());
    if (bad < evaluator->hessian().size()) {
      const auto entry = function.hessian_pattern()[bad / lanes];
      return {true, 0, bad % lanes, variables[entry.row] + ", " + variables[entry.col]};
    }
  }
  return {};
}

}  // namespace slalom::ocp
