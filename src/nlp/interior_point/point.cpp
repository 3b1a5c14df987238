#include "point.hpp"

#include <cassert>
#include <utility>

namespace slalom::nlp::ipm {

Point::Point(SlackForm& form) : form_(&form) {
  at_.resize(form.primal(), form.rows());
  e_.gradient.resize(form.variables());
  e_.rows.resize(form.rows());
  e_.jacobian.resize(form.shape().jacobian_row.size());
  e_.hessian.resize(form.shape().hessian_row.size());
  residuals_.resize(form.rows());
  over_lower_.resize(form.primal());
  over_upper_.resize(form.primal());
}

void Point::forget_slacks() const {
  residuals_known_ = logs_known_ = reciprocals_known_ = false;
}

/// Where the form has taken other limits or scales since.
void Point::forget_old_slacks() const {
  if (slacks_revision_ == form_->revision().functions) return;
  forget_slacks();
  slacks_revision_ = form_->revision().functions;
}

std::span<double> Point::change_w() {
  evaluated_ = {};
  forget_slacks();
  return at_.w;
}

std::span<double> Point::change_slacks() {
  forget_slacks();
  return std::span(at_.w).subspan(form_->variables(), form_->rows());
}

std::span<double> Point::change_y() {
  evaluated_.hessian = false;
  return at_.y;
}

void Point::set_along(const Point& from, const Step& step, double alpha, double alpha_y) {
  const auto& kernels = vector_kernels();
  kernels.combine(form_->primal(), from.at_.w.data(), alpha, step.w.data(), change_w().data());
  kernels.combine(form_->rows(), from.at_.y.data(), alpha_y, step.y.data(), change_y().data());
}

void Point::set(const Iterate& at) {
  evaluated_ = {};
  forget_slacks();
  at_ = at;
}

void Point::swap_all_but_bounds(Point& other) {
  std::swap(at_.zl, other.at_.zl);
  std::swap(at_.zu, other.at_.zu);
  std::swap(*this, other);
}

Parts Point::known() const {
  const SlackForm::Revision& now = form_->revision();
  const bool functions = now.functions == revision_.functions;
  const bool objective = functions && now.objective == revision_.objective;
  return {.values = evaluated_.values && objective,
          .derivatives = evaluated_.derivatives && objective,
          .hessian = evaluated_.hessian && functions};
}

bool Point::evaluate(Parts parts) {
  const Parts before = known();
  evaluated_ = {};
  if (!form_->evaluate(at_, parts, e_)) return false;
  evaluated_ = {.values = before.values || parts.values,
                .derivatives = before.derivatives || parts.derivatives,
                .hessian = before.hessian || parts.hessian};
  revision_ = form_->revision();
  return true;
}

bool Point::complete(Parts wanted) {
  const Parts have = known();
  const Parts missing{.values = wanted.values && !have.values,
                      .derivatives = wanted.derivatives && !have.derivatives,
                      .hessian = wanted.hessian && !have.hessian};
  if (!missing.values && !missing.derivatives && !missing.hessian) return true;
  return evaluate(missing);
}

void Point::scale_functions() {
  form_->scale(evaluated_, e_);
  revision_ = form_->revision();
}

void Point::find_residuals() const {
  forget_old_slacks();
  if (residuals_known_) return;
  assert(evaluated_.values);
  violation_ = form_->residuals(e_, at_.w, residuals_);
  residuals_known_ = true;
}

std::span<const double> Point::residuals() const {
  find_residuals();
  return residuals_;
}

double Point::violation() const {
  find_residuals();
  return violation_;
}

double Point::log_slacks() const {
  forget_old_slacks();
  if (!logs_known_)
    logs_ = vector_kernels().log_slacks(form_->segments(), bounded_with(over_lower_, over_upper_));
  logs_known_ = true;
  return logs_;
}

BoundedVector Point::bounded() const {
  forget_old_slacks();
  const BoundedVector v = bounded_with(over_lower_, over_upper_);
  if (!reciprocals_known_)
    vector_kernels().reciprocals(form_->segments(), v, over_lower_.data(), over_upper_.data());
  reciprocals_known_ = true;
  return v;
}

BoundedVector Point::bounded_with(const std::vector<double>& over_lower,
                                  const std::vector<double>& over_upper) const {
  return {at_.w.data(),  form_->lower().data(), form_->upper().data(), at_.zl.data(),
          at_.zu.data(), over_lower.data(),     over_upper.data()};
}

double barrier_function(const Point& point, double mu) {
  return point.functions().objective - mu * point.log_slacks();
}

}  // namespace slalom::nlp::ipm
