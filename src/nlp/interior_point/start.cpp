#include "start.hpp"

#include <algorithm>
#include <cmath>

namespace slalom::nlp::ipm {
namespace {

constexpr double kFirstBarrier = 0.1, kPush = 1e-2, kWarmPush = 1e-2, kFloorPush = 1e-6;
constexpr double kFarther = 10;
/// How far a multiplier may hold a slack off its bound at a warm start: at a floor as far as it
/// says, for there it is mu / slack; without, one next to zero says nothing.
constexpr double kMostRoom = 0.1;
constexpr double kMostGradient = 100, kLeastScale = 1e-8;

/// A value inside its bounds by an absolute and a relative distance (section 3.6).
double inside(double value, double lower, double upper, double push) {
  const bool has_lower = std::isfinite(lower), has_upper = std::isfinite(upper);
  if (has_lower) {
    double room = push * std::max(1.0, std::fabs(lower));
    if (has_upper) room = std::min(room, push * (upper - lower));
    value = std::max(value, lower + room);
  }
  if (has_upper) {
    double room = push * std::max(1.0, std::fabs(upper));
    if (has_lower) room = std::min(room, push * (upper - lower));
    value = std::min(value, upper - room);
  }
  return value;
}

/// Without a floor: so far below the tolerances that complementarity can meet them, each product by
/// itself and, of very many, their sum, in the user's unit of the objective.
double least_barrier(const Options& options, const SlackForm& form) {
  const double unit = form.objective_scale();
  const double gap = kMostGap / 2 / std::max(form.bounds(), 1.0);
  return std::min({options.tol / 10, options.dual_tol * unit / 10,
                   std::max(gap * unit, std::min(gap, kLeastGap))});
}

/// Of the gradient of a function whose largest entry is `most` (section 3.8).
double gradient_scale(double most) {
  return most > kMostGradient ? std::max(kMostGradient / most, kLeastScale) : 1.0;
}

/// The first point, as far as it is known at each of its parts' turn.
class FirstPoint {
 public:
  FirstPoint(const SlackForm& form, Point& point, const Start& start, const Options& options)
      : form_(form),
        point_(point),
        start_(start),
        warm_(options.warm_start),
        floor_(options.floor > 0),
        push_(!options.warm_start ? kPush
              : options.floor > 0 ? kFloorPush
                                  : kWarmPush) {}

  void set_variables() {
    const auto w = point_.change_w();
    for (std::size_t i = 0; i < form_.variables(); ++i)
      w[i] = form_.fixed(i) ? form_.constant(i)
                            : inside(start_.x[i], form_.lower()[i], form_.upper()[i], push_);
  }

  /// Those of a warm start.
  void set_row_multipliers() {
    const auto y = point_.change_y();
    for (std::size_t r = 0; r < form_.rows(); ++r)
      y[r] = form_.objective_scale() * start_.y[r] / form_.row_scale()[r];
  }

  /// Mu for a warm start without floor: ten times the mean of slack * multiplier, which is about
  /// the mu of a central point, and larger the further a shift has carried it off; at most that of
  /// a cold start.
  double complementarity() const {
    double sum = 0;
    std::size_t bounds = 0;
    const auto add = [&](double slack, double z) {
      if (!std::isfinite(slack)) return;
      sum += std::fabs(slack) * z;
      ++bounds;
    };
    const double objective = form_.objective_scale();
    const Iterate& at = point_.at();
    for (std::size_t i = 0; i < form_.variables(); ++i) {
      add(at.w[i] - form_.lower()[i], objective * start_.zl[i]);
      add(form_.upper()[i] - at.w[i], objective * start_.zu[i]);
    }
    const std::vector<double>& rows = point_.functions().rows;
    for (std::size_t r = 0; r < form_.rows(); ++r) {
      add(rows[r] - form_.lower()[form_.slack(r)], std::max(-at.y[r], 0.0));
      add(form_.upper()[form_.slack(r)] - rows[r], std::max(at.y[r], 0.0));
    }
    return bounds > 0 ? std::min(kFarther * sum / static_cast<double>(bounds), kFirstBarrier) : 0;
  }

  /// At the rows' values.
  void set_slacks(double mu) {
    const std::vector<double>& rows = point_.functions().rows;
    const auto slacks = point_.change_slacks();
    for (std::size_t r = 0; r < form_.rows(); ++r) {
      const std::size_t i = form_.slack(r);
      slacks[r] = form_.equation(r)
                      ? form_.constant(i)
                      : slack(rows[r], form_.lower()[i], form_.upper()[i], point_.at().y[r], mu);
    }
  }

  void set_bound_multipliers(double mu) {
    const double objective = form_.objective_scale();
    const Iterate& at = point_.at();
    const auto zl = point_.change_zl(), zu = point_.change_zu();
    const auto set = [&](std::size_t i, double lower, double upper) {
      zl[i] = multiplier(at.w[i] - form_.lower()[i], lower, mu);
      zu[i] = multiplier(form_.upper()[i] - at.w[i], upper, mu);
    };
    for (std::size_t i = 0; i < form_.variables(); ++i)
      set(i, warm_ ? objective * start_.zl[i] : 0, warm_ ? objective * start_.zu[i] : 0);
    for (std::size_t r = 0; r < form_.rows(); ++r) {
      if (form_.equation(r)) continue;
      const double y = warm_ ? at.y[r] : 0;
      set(form_.slack(r), std::max(-y, 0.0), std::max(y, 0.0));
    }
  }

 private:
  /// The row's value, but off its bound by as much as its multiplier would hold it there, within
  /// reason.
  double slack(double row, double lower, double upper, double y, double mu) const {
    const double value = inside(row, lower, upper, push_);
    if (!warm_) return value;
    const auto room = [&](double z, double bound) {
      const double held = z > 0 ? 0.1 * mu / z : push_;
      return floor_ ? held : std::min(held, kMostRoom * std::max(1.0, std::fabs(bound)));
    };
    if (std::isfinite(lower) && !std::isfinite(upper))
      return std::max(value, lower + room(-y, lower));
    if (std::isfinite(upper) && !std::isfinite(lower))
      return std::min(value, upper - room(y, upper));
    return value;
  }
  /// The given multiplier or mu / slack, whichever is more central; 0 for an absent bound.
  static double multiplier(double slack, double given, double mu) {
    if (!std::isfinite(slack)) return 0;
    const double ratio = slack * given / mu;
    return ratio > 0.1 && ratio < 10 ? given : mu / slack;
  }

  const SlackForm& form_;
  Point& point_;
  const Start& start_;
  const bool warm_, floor_;
  const double push_;
};

}  // namespace

Starter::Starter(SlackForm& form, Descent& descent)
    : form_(form), descent_(descent), unscaled_(form.rows(), 1.0), row_scale_(form.rows()) {}

bool Starter::prepare(const Start& start, const Options& options) {
  const bool floor = options.floor > 0, warm = options.warm_start;
  Point& point = descent_.point();
  FirstPoint first(form_, point, start, options);
  form_.set_scale(1, unscaled_);
  first.set_variables();
  // A floor's point does not move with a row's scale, and would with the objective's.
  if (!floor && !evaluate_scaled()) return false;
  // The rows' multipliers are known only of a warm start, so with it the Hessian comes along.
  if (warm) first.set_row_multipliers();
  if (floor && !point.complete({.values = true, .derivatives = true, .hessian = warm}))
    return false;
  const double mu = floor ? options.floor : warm ? first.complementarity() : kFirstBarrier;
  descent_.begin(options.barrier_rule, mu, floor ? options.floor : least_barrier(options, form_));
  first.set_slacks(descent_.barrier().mu());
  first.set_bound_multipliers(descent_.barrier().mu());
  if (!warm) descent_.estimate_multipliers();
  return descent_.start();
}

/// Evaluates objective and rows, and scales them by their gradients (section 3.8).
bool Starter::evaluate_scaled() {
  const Parts parts{.values = true, .derivatives = true};
  Point& point = descent_.point();
  if (!point.complete(parts)) return false;
  const Evaluation& e = point.functions();
  std::fill(row_scale_.begin(), row_scale_.end(), 0.0);
  for (std::size_t t = 0; t < e.jacobian.size(); ++t) {
    double& most = row_scale_[form_.shape().jacobian_row[t]];
    most = std::max(most, std::fabs(e.jacobian[t]));
  }
  for (double& row : row_scale_) row = gradient_scale(row);
  double most = 0;
  for (double g : e.gradient) most = std::max(most, std::fabs(g));
  form_.set_scale(gradient_scale(most), row_scale_);
  point.scale_functions();
  return true;
}

void hand_out(const SlackForm& form, const Iterate& at, Start& out) {
  const std::size_t n = form.variables();
  const double objective = form.objective_scale();
  const Limits& limits = form.problem().limits();  // which a form with room goes beyond
  out.x.resize(n);
  out.zl.resize(n);
  out.zu.resize(n);
  out.y.resize(form.rows());
  for (std::size_t i = 0; i < n; ++i) {
    out.x[i] = std::clamp(at.w[i], limits.xl[i], limits.xu[i]);
    out.zl[i] = at.zl[i] / objective;
    out.zu[i] = at.zu[i] / objective;
  }
  for (std::size_t r = 0; r < form.rows(); ++r)
    out.y[r] = at.y[r] * form.row_scale()[r] / objective;
}

}  // namespace slalom::nlp::ipm
