#include "newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace slalom::nlp::ipm {
namespace {

// Algorithm IC of Waechter & Biegler 2006.
constexpr double kFirstDelta = 1e-4, kLeastDelta = 1e-20, kMostDelta = 1e40;
constexpr double kFirstGrowth = 100, kGrowth = 8, kShrink = 1.0 / 3;
constexpr double kRowDelta = 1e-8, kRowPower = 0.25;
/// Attempts with no stable pivot although rows may give: beyond, it is rounding, not the rank.
constexpr int kMostSingular = 3;

constexpr int kRefinements = 5;
/// Residuals relative to the right-hand side: good enough to stop refining, bad enough to ask for
/// other pivots.
constexpr double kGoodResidual = 1e-9, kBadResidual = 1e-5;

/// Rows of a stage's front, at least, for it to be looked into: below, one dense front is faster.
constexpr std::size_t kLargeStage = 250;
/// Entries of a variable with which it is eliminated by itself for next to nothing, and the share
/// of such ones that makes up for finding the order.
constexpr std::size_t kFewEntries = 8;
constexpr double kMostlyFew = 0.75;

/// One front a stage; the order of least fill where a stage is large and most of its variables,
/// such as many controls, meet few others.
std::unique_ptr<kkt::Backend> make_backend(const kkt::Pattern& pattern) {
  std::vector<std::size_t> rows(pattern.stages + 1, 0), entries(pattern.variables, 0);
  for (std::size_t i = 0; i < pattern.variables; ++i)
    rows[pattern.variable_stage[i]] += pattern.fixed[i] ? 0 : 1;
  for (const auto stage : pattern.equation_stage) ++rows[stage];
  rows.pop_back();  // what all stages share is a border in either
  if (rows.empty() || *std::max_element(rows.begin(), rows.end()) < kLargeStage)
    return kkt::make_stage_ldlt(pattern);
  for (const auto& place : pattern.hessian) {
    ++entries[place.row];
    if (place.row != place.col) ++entries[place.col];
  }
  for (const auto& entry : pattern.jacobian) ++entries[entry.variable];
  const auto few = std::count_if(entries.begin(), entries.end(),
                                 [](std::size_t count) { return count <= kFewEntries; });
  return static_cast<double>(few) >= kMostlyFew * static_cast<double>(entries.size())
             ? kkt::make_sparse_ldlt(pattern)
             : kkt::make_stage_ldlt(pattern);
}

}  // namespace

kkt::Inertia inertia_of_minimum(const SlackForm& form) {
  kkt::Inertia inertia;
  for (const char fixed : form.fixed()) inertia.positive += fixed ? 0 : 1;
  inertia.negative = form.equations().size();
  return inertia;
}

Newton::Newton(const SlackForm& form)
    : form_(form),
      elimination_(form.elimination()),
      backend_(make_backend(form.pattern())),
      wanted_(inertia_of_minimum(form)) {
  const std::size_t equations = form.equations().size();
  hessian_.resize(form.condensed().places().size());
  flexibility_.resize(equations);
  for (auto* list : {&diagonal_, &force_}) list->resize(form.variables());
  for (auto* list : {&jdx_, &corrected_jdx_, &next_y_}) list->resize(form.rows());
  for (auto* list : {&rhs_, &solution_, &remainder_, &correction_})
    list->resize(form.variables() + equations);
}

void Newton::restart() {
  last_delta_w_ = 0;
  backend_->distrust();
}

// --- factorisation -----------------------------------------------------------------------------

bool Newton::factorize(const Point& point, const BarrierTerms& terms) {
  const Evaluation& e = point.functions();
  elimination_->weigh(terms);
  form_.condensed().sum(e.hessian, e.jacobian, elimination_->weight(), hessian_);
  delta_c_ = 0;
  return find_regularisation(point, terms);
}

bool Newton::factorize_as_singular(const Point& point, const BarrierTerms& terms) {
  delta_c_ = row_regularisation(terms.mu);
  return find_regularisation(point, terms);
}

double Newton::row_regularisation(double mu) {
  return kRowDelta * std::pow(mu, kRowPower);
}

bool Newton::deadline_passed(void* self) {
  auto* newton = static_cast<Newton*>(self);
  return newton->gave_up_ = newton->deadline_->passed();
}

/// Algorithm IC.
bool Newton::find_regularisation(const Point& point, const BarrierTerms& terms) {
  gave_up_ = false;
  delta_w_ = 0;
  auto inertia = attempt(point, terms);
  if (gave_up_) return false;
  if (inertia == wanted_) return true;
  if (inertia.zero > 0) delta_c_ = row_regularisation(terms.mu);
  delta_w_ = last_delta_w_ == 0 ? kFirstDelta : std::max(kLeastDelta, last_delta_w_ * kShrink);
  for (int singular = 0; delta_w_ < kMostDelta && singular < kMostSingular;) {
    const bool relaxed = delta_c_ > 0;
    inertia = attempt(point, terms);
    if (gave_up_) return false;
    if (inertia == wanted_) {
      last_delta_w_ = delta_w_;
      return true;
    }
    singular += relaxed && inertia.zero > 0;
    if (inertia.zero > 0) delta_c_ = row_regularisation(terms.mu);
    delta_w_ *= last_delta_w_ == 0 ? kFirstGrowth : kGrowth;
  }
  return false;
}

/// Factorises with the regularisation as it is.
kkt::Inertia Newton::attempt(const Point& point, const BarrierTerms& terms) {
  for (std::size_t i = 0; i < diagonal_.size(); ++i) diagonal_[i] = terms.sigma[i] + delta_w_;
  elimination_->add_curvature(diagonal_);
  for (std::size_t k = 0; k < flexibility_.size(); ++k)
    flexibility_[k] = delta_c_ + elimination_->give()[form_.equations()[k]];
  return backend_->factorize({hessian_, diagonal_, point.functions().jacobian, flexibility_, true,
                              deadline_ != nullptr ? &Newton::deadline_passed : nullptr, this});
}

// --- step --------------------------------------------------------------------------------------

bool Newton::step(const Point& point, const BarrierTerms& terms, Step& out) {
  return step_for(point, terms, point.residuals(), out);
}

bool Newton::step_for(const Point& point, const BarrierTerms& terms,
                      std::span<const double> residuals, Step& out) {
  const double size = set_right_hand_side(point, terms, residuals);
  solve(rhs_, solution_);
  recover(point, terms, residuals, out);
  const double left = refine(point, terms, residuals, size, out);
  accurate_ = left <= kBadResidual * size;
  if (!accurate_) backend_->distrust();
  out.reach = vector_kernels().dual_step(form_.segments(), point.bounded(), terms.mu, out.w.data(),
                                         out.zl.data(), out.zu.data());
  return std::isfinite(left + out.reach.primal + out.reach.dual);
}

/// Returns how large it is: what residuals are to be compared with.
double Newton::set_right_hand_side(const Point& point, const BarrierTerms& terms,
                                   std::span<const double> residuals) {
  const Evaluation& e = point.functions();
  const std::size_t n = form_.variables();
  elimination_->shift(terms, point.at(), residuals);
  std::fill(force_.begin(), force_.end(), 0.0);
  form_.row_blocks().add_transposed(e.jacobian, elimination_->multipliers(), force_);
  for (std::size_t i = 0; i < n; ++i)
    rhs_[i] = form_.fixed(i) ? 0 : -e.gradient[i] - terms.slope[i] - force_[i];
  for (std::size_t k = 0; k < form_.equations().size(); ++k)
    rhs_[n + k] = elimination_->right_hand_side()[form_.equations()[k]];
  return std::max(vector_kernels().largest_magnitude(rhs_.size(), rhs_.data()), 1e-3);
}

void Newton::solve(const std::vector<double>& rhs, std::vector<double>& solution) {
  std::copy(rhs.begin(), rhs.end(), solution.begin());
  backend_->solve(solution);
}

/// The whole step from the condensed system's solution.
void Newton::recover(const Point& point, const BarrierTerms& terms,
                     std::span<const double> residuals, Step& out) {
  const auto dx = primal_part(solution_);
  std::copy(dx.begin(), dx.end(), out.w.begin());
  form_.row_blocks().multiply(point.functions().jacobian, dx, jdx_);
  elimination_->recover(terms, point.at(), residuals, jdx_, equations_part(solution_), out);
}

/// Corrects the step until its remainder is small beside `size` or falls no more; returns that.
double Newton::refine(const Point& point, const BarrierTerms& terms,
                      std::span<const double> residuals, double size, Step& out) {
  double before = std::numeric_limits<double>::infinity();
  for (int pass = 0;; ++pass) {
    const double left = find_remainder(point, terms, residuals, out);
    if (!(left > kGoodResidual * size) || !(left < 0.5 * before) || pass == kRefinements)
      return left;
    before = left;
    solve(remainder_, correction_);
    add_correction(point, terms, out);
  }
}

/// What the step leaves of the unreduced equations; returns the largest. Of what is eliminated
/// nothing is left, by construction.
double Newton::find_remainder(const Point& point, const BarrierTerms& terms,
                              std::span<const double> residuals, const Step& out) {
  const auto& kernels = vector_kernels();
  const Evaluation& e = point.functions();
  const std::size_t n = form_.variables();
  kernels.combine(form_.rows(), point.at().y.data(), 1, out.y.data(), next_y_.data());
  std::fill(force_.begin(), force_.end(), 0.0);
  form_.row_blocks().add_transposed(e.jacobian, next_y_, force_);
  form_.hessian_runs().add_product(e.hessian, std::span(out.w).first(n), force_);
  for (std::size_t i = 0; i < n; ++i)
    remainder_[i] = form_.fixed(i)
                        ? 0
                        : -(e.gradient[i] + terms.slope[i] + force_[i] + diagonal_[i] * out.w[i]);
  for (std::size_t k = 0; k < form_.equations().size(); ++k) {
    const std::size_t r = form_.equations()[k];
    remainder_[n + k] = -residuals[r] - jdx_[r] + delta_c_ * out.y[r];
  }
  elimination_->add_to_equations(out, std::span(remainder_).subspan(n));
  return kernels.largest_magnitude(remainder_.size(), remainder_.data());
}

void Newton::add_correction(const Point& point, const BarrierTerms& terms, Step& out) {
  const auto dx = primal_part(correction_);
  for (std::size_t i = 0; i < dx.size(); ++i) out.w[i] += dx[i];
  form_.row_blocks().multiply(point.functions().jacobian, dx, corrected_jdx_);
  for (std::size_t r = 0; r < jdx_.size(); ++r) jdx_[r] += corrected_jdx_[r];
  elimination_->correct(terms, corrected_jdx_, equations_part(correction_), out);
}

std::span<const double> Newton::primal_part(const std::vector<double>& condensed) const {
  return std::span(condensed).first(form_.variables());
}

std::span<const double> Newton::equations_part(const std::vector<double>& condensed) const {
  return std::span(condensed).subspan(form_.variables());
}

}  // namespace slalom::nlp::ipm
