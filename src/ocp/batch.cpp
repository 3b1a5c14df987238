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
  std::vector<std::size_t> copied;
  period_ = find_period();
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
    for (std::size_t lane = 0; lane < period_; ++lane)
      copies.push_back({from[lane], static_cast<std::uint32_t>(copied.size() * period_ + lane),
                        gather_scale[i]});
    copied.push_back(i);
  }
  copies_ = LaneRuns(copies);
  gathered_.resize(copied.size() * period_);
  if (period_ < lanes) copied_.resize(copied.size() * lanes);
  for (std::size_t k = 0; k < copied.size(); ++k)
    evaluator->set_variable(copied[k], (period_ < lanes ? copied_ : gathered_).data() + k * lanes,
                            false);
}

/// The points of one member, where each member's lanes are at the same.
std::size_t Batch::find_period() const {
  const auto next = std::find_if(lane_member.begin(), lane_member.end(),
                                 [&](auto member) { return member != lane_member.front(); });
  const auto period = static_cast<std::size_t>(next - lane_member.begin());
  if (period == 0 || lanes % period != 0) return lanes;
  for (std::size_t i = 0; i < function.variables(); ++i)
    if (const auto first = gather.begin() + static_cast<std::ptrdiff_t>(i * lanes);
        !std::equal(first + static_cast<std::ptrdiff_t>(period),
                    first + static_cast<std::ptrdiff_t>(lanes), first))
      return lanes;
  return period;
}

void Batch::load(std::span<const double> point) {
  if (copies_.runs() > 0) {
    std::fill(gathered_.begin(), gathered_.end(), 0.0);
    copies_.scatter(point, gathered_);
    if (period_ < lanes) {
      double* to = copied_.data();
      for (const double* from = gathered_.data(); to != copied_.data() + copied_.size();
           from += period_)
        for (std::size_t lane = 0; lane < lanes; lane += period_)
          to = std::copy_n(from, period_, to);
    }
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
