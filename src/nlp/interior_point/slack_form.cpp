#include "slack_form.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "../rounding.hpp"
#include "row_elimination.hpp"

namespace slalom::nlp::ipm {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<char> equal(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<char> result;
  for (std::size_t i = 0; i < a.size(); ++i) result.push_back(a[i] == b[i]);
  return result;
}

std::vector<char> opposite(std::vector<char> flags) {
  for (char& flag : flags) flag = !flag;
  return flags;
}

}  // namespace

SlackForm::SlackForm(Problem& problem, std::size_t more)
    : problem_(&problem),
      shape_(&problem.structure()),
      equation_(equal(problem.limits().gl, problem.limits().gu)),
      fixed_(equal(problem.limits().xl, problem.limits().xu)),
      row_blocks_(shape_->rows, shape_->jacobian_row, shape_->jacobian_col, equation_),
      hessian_runs_(shape_->hessian_row, shape_->hessian_col),
      condensed_(shape_->hessian_row, shape_->hessian_col, row_blocks_, opposite(equation_)),
      row_scale_(shape_->rows, 1.0),
      users_unit_(shape_->rows),
      entry_scale_(shape_->jacobian_row.size(), 1.0),
      scaled_y_(shape_->rows),
      row_size_(shape_->rows) {
  for (std::size_t r = 0; r < rows(); ++r)
    if (equation_[r]) equations_.push_back(static_cast<std::uint32_t>(r));
  for (std::size_t i = 0; i < variables(); ++i)
    if (fixed_[i]) constant_.push_back(static_cast<std::uint32_t>(i));
  for (const auto r : equations_) constant_.push_back(static_cast<std::uint32_t>(slack(r)));
  const std::size_t size = variables() + rows() + more;
  lower_.assign(size, 0.0);
  upper_.assign(size, kInfinity);
  constants_.assign(size, 0.0);
  refresh(problem);
  find_segments();
}

bool SlackForm::fits(const Limits& limits) const {
  const auto same = [&](double lower, double upper, bool constant, std::size_t i) {
    return constant == (lower == upper) &&
           (constant || (std::isfinite(lower) == std::isfinite(lower_[i]) &&
                         std::isfinite(upper) == std::isfinite(upper_[i])));
  };
  const std::size_t n = fixed_.size();
  for (std::size_t i = 0; i < n; ++i)
    if (!same(limits.xl[i], limits.xu[i], fixed_[i] != 0, i)) return false;
  for (std::size_t r = 0; r < equation_.size(); ++r)
    if (!same(limits.gl[r], limits.gu[r], equation_[r] != 0, n + r)) return false;
  return true;
}

void SlackForm::refresh(Problem& problem) {
  ++revision_.functions;
  problem_ = &problem;
  shape_ = &problem.structure();
  const Limits& limits = problem.limits();
  const std::size_t n = variables();
  std::copy(limits.xl.begin(), limits.xl.end(), lower_.begin());
  std::copy(limits.xu.begin(), limits.xu.end(), upper_.begin());
  for (std::size_t i = 0; room_.least > 0 && i < n; ++i) {
    if (fixed_[i]) continue;
    lower_[i] -= std::min(room_.least * std::max(1.0, std::fabs(lower_[i])), room_.most);
    upper_[i] += std::min(room_.least * std::max(1.0, std::fabs(upper_[i])), room_.most);
  }
  for (std::size_t r = 0; r < rows(); ++r) {
    const double room = equation_[r] ? 0 : room_.least;
    lower_[n + r] = (limits.gl[r] - room) * row_scale_[r];
    upper_[n + r] = (limits.gu[r] + room) * row_scale_[r];
    users_unit_[r] = 1 / (row_scale_[r] * shape_->row_scale[r]);
  }
  for (const auto i : constant_) {
    constants_[i] = lower_[i];
    lower_[i] = -kInfinity;
    upper_[i] = kInfinity;
  }
}

void SlackForm::set_scale(double objective, std::span<const double> rows) {
  const bool same = std::equal(rows.begin(), rows.end(), row_scale_.begin());
  if (objective != objective_scale_) ++revision_.functions;
  objective_scale_ = objective;
  scaled_ =
      objective != 1 || std::any_of(rows.begin(), rows.end(), [](double s) { return s != 1; });
  if (same) return;
  std::copy(rows.begin(), rows.end(), row_scale_.begin());
  for (std::size_t t = 0; t < entry_scale_.size(); ++t)
    entry_scale_[t] = row_scale_[shape_->jacobian_row[t]];
  refresh(*problem_);
}

void SlackForm::find_segments() {
  const auto lower = [&](std::size_t i) { return std::isfinite(lower_[i]); };
  const auto upper = [&](std::size_t i) { return std::isfinite(upper_[i]); };
  for (std::size_t i = 0; i < primal();) {
    std::size_t end = i + 1;
    while (end < primal() && lower(end) == lower(i) && upper(end) == upper(i)) ++end;
    if (lower(i) || upper(i))
      segments_.push_back(
          {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(end), lower(i), upper(i)});
    i = end;
  }
}

kkt::Pattern SlackForm::pattern() const {
  kkt::Pattern pattern;
  pattern.variables = variables();
  pattern.equations = equations_.size();
  pattern.stages = shape_->stages;
  pattern.variable_stage = shape_->variable_stage;
  pattern.fixed = fixed_;
  pattern.hessian = condensed_.places();
  std::vector<std::uint32_t> number(rows(), 0);
  for (std::size_t e = 0; e < equations_.size(); ++e) {
    const std::size_t r = equations_[e];
    number[r] = static_cast<std::uint32_t>(e);
    pattern.equation_stage.push_back(shape_->row_stage[r]);
  }
  for (std::size_t t = 0; t < shape_->jacobian_row.size(); ++t) {
    const std::size_t r = shape_->jacobian_row[t];
    if (equation_[r])
      pattern.jacobian.push_back(
          {static_cast<std::uint32_t>(t), number[r], shape_->jacobian_col[t]});
  }
  return pattern;
}

std::unique_ptr<RowElimination> SlackForm::elimination() const {
  return std::make_unique<SlackElimination>(*this);
}

bool SlackForm::evaluate(const Iterate& at, Parts parts, Evaluation& out) {
  return evaluate_functions(objective_scale_, at, parts, out);
}

bool SlackForm::evaluate_functions(double objective_factor, const Iterate& at, Parts parts,
                                   Evaluation& out) {
  const std::span x(at.w.data(), variables());
  std::span<const double> y = at.y;
  if (scaled_) {
    for (std::size_t r = 0; r < rows(); ++r) scaled_y_[r] = at.y[r] * row_scale_[r];
    y = scaled_y_;
  }
  fault_ = problem_->evaluate(x, objective_factor, y, parts, out);
  if (fault_) return false;
  scale(parts, out);
  return true;
}

void SlackForm::scale(Parts parts, Evaluation& out) const {
  if (!scaled_) return;
  if (parts.values) {
    out.objective *= objective_scale_;
    for (std::size_t r = 0; r < rows(); ++r) out.rows[r] *= row_scale_[r];
  }
  if (parts.derivatives) {
    for (double& g : out.gradient) g *= objective_scale_;
    for (std::size_t t = 0; t < out.jacobian.size(); ++t) out.jacobian[t] *= entry_scale_[t];
  }
}

double SlackForm::residuals(const Evaluation& e, std::span<const double> w,
                            std::span<double> out) const {
  const auto& kernels = vector_kernels();
  kernels.combine(rows(), e.rows.data(), -1, w.data() + variables(), out.data());
  return kernels.sum_magnitudes(rows(), out.data());
}

void SlackForm::lagrangian_gradient(const Evaluation& e, std::span<const double> y,
                                    std::span<double> out) const {
  std::copy(e.gradient.begin(), e.gradient.end(), out.begin());
  row_blocks_.add_transposed(e.jacobian, y, out.first(variables()));
  for (std::size_t r = 0; r < rows(); ++r) out[slack(r)] = -y[r];
}

double SlackForm::derivative_along(const Evaluation& e, std::span<const double> slope,
                                   std::span<const double> dw) const {
  const auto& kernels = vector_kernels();
  return kernels.dot(variables(), e.gradient.data(), dw.data()) +
         kernels.dot(primal(), slope.data(), dw.data());
}

double SlackForm::violation(const Evaluation& e) const {
  const Limits& limits = problem_->limits();
  return vector_kernels().most_outside(rows(), e.rows.data(), limits.gl.data(), limits.gu.data(),
                                       row_scale_.data(), users_unit_.data());
}

bool SlackForm::met_to_rounding(const Evaluation& e, std::span<const double> w, double tolerance) {
  const Limits& limits = problem_->limits();
  sum_terms(*shape_, e.jacobian, w, row_size_);
  for (std::size_t r = 0; r < rows(); ++r) {
    const double outside = std::max(row_scale_[r] * limits.gl[r] - e.rows[r],
                                    e.rows[r] - row_scale_[r] * limits.gu[r]);
    if (outside * users_unit_[r] > tolerance && !is_rounding(outside, row_size_[r])) return false;
  }
  return true;
}

double SlackForm::bounds() const {
  std::size_t count = 0;
  for (const Segment& s : segments_)
    count += (s.end - s.begin) * ((s.lower ? 1u : 0u) + (s.upper ? 1u : 0u));
  return static_cast<double>(count);
}

std::size_t SlackForm::worst_row(const Evaluation& e) const {
  const Limits& limits = problem_->limits();
  std::size_t worst = 0;
  double largest = 0;
  for (std::size_t r = 0; r < rows(); ++r) {
    const double outside = std::max(row_scale_[r] * limits.gl[r] - e.rows[r],
                                    e.rows[r] - row_scale_[r] * limits.gu[r]) *
                           users_unit_[r];
    if (outside > largest) {
      largest = outside;
      worst = r;
    }
  }
  return worst;
}

}  // namespace slalom::nlp::ipm
