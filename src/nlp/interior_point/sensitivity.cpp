#include "slalom/nlp/sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "newton.hpp"
#include "point.hpp"
#include "slack_form.hpp"

namespace slalom::nlp {
namespace {

using namespace ipm;

/// Slack of an active bound at least, relative to its size: below, rounding decides.
constexpr double kLeastSlack = 1e-10;
constexpr int kRefinements = 10;
/// What may be left of the equations, relative to their right-hand side: good enough to stop, and
/// to be an answer.
constexpr double kGoodResidual = 1e-13, kFairResidual = 1e-6;
constexpr int kInverseIterations = 3;
constexpr double kGolden = 0.6180339887498949;

/// Slacks and multipliers >= 0 of the two sides of a variable or row; infinite and 0 of none.
struct Sides {
  double below = std::numeric_limits<double>::infinity(), above = below;
  double z_below = 0, z_above = 0;

  double weight_below() const { return z_below / below; }
  double weight_above() const { return z_above / above; }
};

double least_slack(double bound) {
  return kLeastSlack * std::max(1.0, std::fabs(bound));
}

/// A row between l and u whose multiplier is y, at the value at which mu / (u - s) - mu / (s - l)
/// is y, but no further than `room` from `value`. Of an answer at a floor, that is its slack.
Sides central_row(double l, double u, double y, double value, double mu, double room) {
  Sides sides;
  if (std::isfinite(l) && std::isfinite(u)) {
    // With c = (l + u) / 2, d = (u - l) / 2 and s = c + e: y e^2 + 2 mu e - y d^2 = 0.
    const double d = (u - l) / 2;
    const double e = y * d * d / (mu + std::hypot(mu, y * d));
    const double s = std::clamp((l + u) / 2 + e, value - room, value + room);
    sides.below = std::clamp(s - l, std::min(least_slack(l), d), 2 * d);
    sides.above = std::clamp(u - s, std::min(least_slack(u), d), 2 * d);
    sides.z_below = mu / sides.below;
    sides.z_above = mu / sides.above;
    return sides;
  }
  const auto one = [&](double z, double measured, double bound, double& slack, double& multiplier) {
    if (!(z > 0)) return;
    multiplier = z;
    slack = std::max(std::clamp(mu / z, measured - room, measured + room), least_slack(bound));
  };
  if (std::isfinite(l)) one(-y, value - l, l, sides.below, sides.z_below);
  if (std::isfinite(u)) one(y, u - value, u, sides.above, sides.z_above);
  return sides;
}

/// The sides of anything between l and u, from its value and their multipliers.
Sides measured_sides(double l, double u, double value, double zl, double zu) {
  Sides sides;
  if (std::isfinite(l)) {
    sides.below = std::max(value - l, least_slack(l));
    sides.z_below = std::max(zl, 0.0);
  }
  if (std::isfinite(u)) {
    sides.above = std::max(u - value, least_slack(u));
    sides.z_above = std::max(zu, 0.0);
  }
  return sides;
}

}  // namespace

Dependence no_dependence(const Structure& shape) {
  Dependence none;
  none.gradient.assign(shape.variables, 0.0);
  none.rows.assign(shape.rows, 0.0);
  for (auto* list : {&none.limits.xl, &none.limits.xu}) list->assign(shape.variables, 0.0);
  for (auto* list : {&none.limits.gl, &none.limits.gu}) list->assign(shape.rows, 0.0);
  return none;
}

class Sensitivities::Impl {
 public:
  explicit Impl(Problem& problem) : problem_(problem), form_(problem), newton_(form_), at_(form_) {
    for (auto* list : {&terms_.sigma, &terms_.slope, &below_, &above_})
      list->assign(form_.primal(), 0.0);
    const std::size_t n = form_.variables(), equations = form_.equations().size();
    for (auto* list : {&a_, &force_, &along_, &e_, &dx_}) list->assign(n, 0.0);
    for (auto* list : {&b_, &jdx_, &dy_, &rho_, &pull_}) list->assign(form_.rows(), 0.0);
    correction_.assign(n + equations, 0.0);
  }

  Regularity factorize(const Start& answer, const Options& options) {
    form_.refresh(problem_);
    take(answer);
    if (!at_.complete()) return Regularity::invalid_number;
    weigh(answer, options);
    newton_.restart();
    const bool found = newton_.factorize(at_, terms_);
    if (found && newton_.regularisation() == 0 && newton_.row_regularisation() == 0)
      return Regularity::regular;
    find_undetermined(found);
    return Regularity::irregular;
  }

  bool solve(const Dependence& p, Sensitivity& out) {
    set_right_hand_side(p);
    if (!refine()) return false;
    hand_out(p, out);
    return true;
  }

  std::string undetermined() const { return undetermined_; }
  const Fault& fault() const { return form_.fault(); }

 private:
  // --- the point ---------------------------------------------------------------------------
  void take(const Start& answer) {
    std::copy(answer.x.begin(), answer.x.end(), at_.change_w().begin());
    std::copy(answer.y.begin(), answer.y.end(), at_.change_y().begin());
  }

  /// z / slack of all bounds.
  void weigh(const Start& answer, const Options& options) {
    const Limits& limits = problem_.limits();
    const std::size_t n = form_.variables();
    const std::vector<double>& rows = at_.functions().rows;
    terms_.mu = options.floor > 0 ? options.floor : options.tol;
    for (std::size_t i = 0; i < n; ++i)
      set_weights(i, form_.fixed(i) ? Sides{}
                                    : measured_sides(limits.xl[i], limits.xu[i], answer.x[i],
                                                     answer.zl[i], answer.zu[i]));
    for (std::size_t r = 0; r < form_.rows(); ++r) {
      const double l = limits.gl[r], u = limits.gu[r], y = answer.y[r];
      Sides sides;
      if (!form_.equation(r))
        sides = options.floor > 0 ? central_row(l, u, y, rows[r], options.floor,
                                                options.constraint_tol * form_.shape().row_scale[r])
                                  : measured_sides(l, u, rows[r], -y, y);
      set_weights(form_.slack(r), sides);
    }
  }
  void set_weights(std::size_t entry, const Sides& sides) {
    below_[entry] = sides.weight_below();
    above_[entry] = sides.weight_above();
    terms_.sigma[entry] = below_[entry] + above_[entry];
  }

  // --- the equations -----------------------------------------------------------------------
  // With the weights sigma = sigma_l + sigma_u of its two sides, a variable goes along with its
  // bounds by d = (sigma_l dxl/dp + sigma_u dxu/dp) / sigma and moves by e beyond that, dx = d + e:
  //
  //   H dx + sigma e + J' dy = a,    a = -d(gradient of the Lagrangian)/dp,
  //
  // and a row's value by its own d and dy / sigma: J dx - dy / sigma = b, b = d - dg/dp, of an
  // equation J dx = b. Numbers of the active set are so not differences of large ones.
  void set_right_hand_side(const Dependence& p) {
    for (std::size_t i = 0; i < a_.size(); ++i) {
      a_[i] = form_.fixed(i) ? 0 : -p.gradient[i];
      along_[i] = form_.fixed(i) ? p.limits.xl[i] : along(i, p.limits.xl[i], p.limits.xu[i]);
    }
    for (std::size_t r = 0; r < b_.size(); ++r)
      b_[r] = (form_.equation(r) ? p.limits.gl[r]
                                 : along(form_.slack(r), p.limits.gl[r], p.limits.gu[r])) -
              p.rows[r];
  }
  double along(std::size_t entry, double lower, double upper) const {
    const double below = below_[entry], above = above_[entry];
    if (above == 0) return below == 0 ? 0 : lower;
    if (below == 0) return upper;
    return (below * lower + above * upper) / (below + above);
  }

  /// Solves by corrections, the first of which starts from what goes along with its bounds.
  bool refine() {
    std::fill(e_.begin(), e_.end(), 0.0);
    std::fill(dy_.begin(), dy_.end(), 0.0);
    double size = 0, before = std::numeric_limits<double>::infinity();
    for (int pass = 0;; ++pass) {
      const double left = find_remainder();
      if (pass == 0) size = left;
      if (!std::isfinite(left)) return false;
      if (left <= kGoodResidual * size || left > 0.5 * before || pass == kRefinements)
        return left <= kFairResidual * size;
      before = left;
      correct();
    }
  }

  /// What dx and dy leave of the equations: of the variables' and the equations' in correction_, of
  /// the inequalities' in rho_. Returns the largest.
  double find_remainder() {
    const auto& kernels = vector_kernels();
    const Evaluation& e = at_.functions();
    const std::size_t n = form_.variables();
    for (std::size_t i = 0; i < n; ++i) dx_[i] = along_[i] + e_[i];
    form_.row_blocks().multiply(e.jacobian, dx_, jdx_);
    std::fill(force_.begin(), force_.end(), 0.0);
    form_.row_blocks().add_transposed(e.jacobian, dy_, force_);
    form_.hessian_runs().add_product(e.hessian, dx_, force_);
    for (std::size_t i = 0; i < n; ++i)
      correction_[i] = form_.fixed(i) ? 0 : a_[i] - force_[i] - terms_.sigma[i] * e_[i];
    for (std::size_t r = 0; r < rho_.size(); ++r) {
      const double sigma = terms_.sigma[form_.slack(r)];
      rho_[r] = sigma > 0 ? b_[r] - jdx_[r] + dy_[r] / sigma : 0;
    }
    for (std::size_t k = 0; k < form_.equations().size(); ++k)
      correction_[n + k] = b_[form_.equations()[k]] - jdx_[form_.equations()[k]];
    return std::max(kernels.largest_magnitude(correction_.size(), correction_.data()),
                    kernels.largest_magnitude(rho_.size(), rho_.data()));
  }

  /// Solves for a correction of what is left, the inequalities condensed: their dy changes by
  /// sigma (J de - rho).
  void correct() {
    const Evaluation& e = at_.functions();
    const std::size_t n = form_.variables();
    for (std::size_t r = 0; r < rho_.size(); ++r) pull_[r] = terms_.sigma[form_.slack(r)] * rho_[r];
    std::fill(force_.begin(), force_.end(), 0.0);
    form_.row_blocks().add_transposed(e.jacobian, pull_, force_);
    for (std::size_t i = 0; i < n; ++i) correction_[i] += form_.fixed(i) ? 0 : force_[i];
    newton_.backend().solve(correction_);
    const std::span<const double> de = std::span(correction_).first(n);
    for (std::size_t i = 0; i < n; ++i) e_[i] += de[i];
    form_.row_blocks().multiply(e.jacobian, de, jdx_);
    for (std::size_t r = 0; r < rho_.size(); ++r)
      dy_[r] += terms_.sigma[form_.slack(r)] * (jdx_[r] - rho_[r]);
    for (std::size_t k = 0; k < form_.equations().size(); ++k)
      dy_[form_.equations()[k]] += correction_[n + k];
  }

  static double product(double weight, double number) { return weight == 0 ? 0 : weight * number; }

  void hand_out(const Dependence& p, Sensitivity& out) const {
    const std::size_t n = form_.variables();
    out.point.x = dx_;
    out.point.y = dy_;
    out.point.zl.resize(n);
    out.point.zu.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      out.point.zl[i] = product(below_[i], p.limits.xl[i] - along_[i] - e_[i]);
      out.point.zu[i] = product(above_[i], e_[i] + along_[i] - p.limits.xu[i]);
    }
    out.objective = p.objective;
    for (std::size_t i = 0; i < n; ++i) out.objective += at_.functions().gradient[i] * dx_[i];
  }

  // --- what is not determined --------------------------------------------------------------
  /// By inverse iteration with the regularised matrix: its least eigenvector.
  void find_undetermined(bool factorised) {
    undetermined_.clear();
    if (!factorised) return;
    std::vector<double>& v = correction_;
    const auto magnitude = [](double a, double b) { return std::fabs(a) < std::fabs(b); };
    for (std::size_t i = 0; i < v.size(); ++i)  // no multiple of an eigenvector, most likely
      v[i] =
          i < a_.size() && form_.fixed(i) ? 0 : std::fmod(kGolden * static_cast<double>(i + 1), 1);
    for (int pass = 0; pass < kInverseIterations; ++pass) {
      newton_.backend().solve(v);
      const double largest = std::fabs(*std::max_element(v.begin(), v.end(), magnitude));
      if (!(largest > 0) || !std::isfinite(largest)) return;
      for (double& each : v) each /= largest;
    }
    const auto place =
        static_cast<std::size_t>(std::max_element(v.begin(), v.end(), magnitude) - v.begin());
    undetermined_ = place < form_.variables()
                        ? problem_.variable_name(place)
                        : problem_.row_name(form_.equations()[place - form_.variables()]);
  }

  Problem& problem_;
  SlackForm form_;
  Newton newton_;
  Point at_;
  BarrierTerms terms_;
  std::vector<double> below_, above_;               ///< z / slack of the two sides, by entry of w
  std::vector<double> a_, along_, e_, dx_, force_;  ///< by variable
  std::vector<double> b_, dy_, jdx_, rho_, pull_;   ///< by row
  std::vector<double> correction_;                  ///< of e and of the equations' dy
  std::string undetermined_;
};

Sensitivities::Sensitivities(Problem& problem) : impl_(std::make_unique<Impl>(problem)) {}
Sensitivities::~Sensitivities() = default;
Sensitivities::Sensitivities(Sensitivities&&) noexcept = default;
Sensitivities& Sensitivities::operator=(Sensitivities&&) noexcept = default;

Regularity Sensitivities::factorize(const Start& answer, const Options& options) {
  return impl_->factorize(answer, options);
}
std::string Sensitivities::undetermined() const {
  return impl_->undetermined();
}
const Fault& Sensitivities::fault() const {
  return impl_->fault();
}
bool Sensitivities::solve(const Dependence& dependence, Sensitivity& out) {
  return impl_->solve(dependence, out);
}

}  // namespace slalom::nlp
