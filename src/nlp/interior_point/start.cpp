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

/// Without a floor: so far below the tolerances that complementarity can meet them.
double least_barrier(const Options& options) {
  return std::min(options.tol, options.dual_tol) / 10;
}

/// Gradient-based scales (section 3.8); a floor's point does not move with a row's scale, and would
/// with the objective's, so there are none.
void set_scales(Descent& descent, const Options& options) {
  Model& model = descent.model;
  std::vector<double>& rows = descent.step.y;  // room for one number a row
  std::fill(rows.begin(), rows.end(), 0.0);
  if (options.floor > 0) {
    std::fill(rows.begin(), rows.end(), 1.0);
    model.set_scale(1, rows);
    return;
  }
  const Evaluation& e = descent.point.e;
  for (std::size_t t = 0; t < e.jacobian.size(); ++t) {
    double& most = rows[model.shape().jacobian_row[t]];
    most = std::max(most, std::fabs(e.jacobian[t]));
  }
  const auto scale = [](double most) {
    return most > kMostGradient ? std::max(kMostGradient / most, kLeastScale) : 1.0;
  };
  double most = 0;
  for (double g : e.gradient) most = std::max(most, std::fabs(g));
  for (double& row : rows) row = scale(row);
  model.set_scale(scale(most), rows);
}

class Beginning {
 public:
  Beginning(Descent& descent, const Start& start, const Options& options)
      : model_(descent.model),
        at_(descent.point.at),
        rows_(descent.point.e.rows),
        start_(start),
        warm_(options.warm_start),
        floor_(options.floor > 0),
        push_(!options.warm_start ? kPush
              : options.floor > 0 ? kFloorPush
                                  : kWarmPush),
        barrier_(descent.barrier) {}

  void variables() {
    for (std::size_t i = 0; i < model_.variables(); ++i)
      at_.w[i] = model_.fixed(i) ? model_.constant(i)
                                 : inside(start_.x[i], model_.lower()[i], model_.upper()[i], push_);
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
    const double objective = model_.objective_scale();
    for (std::size_t i = 0; i < model_.variables(); ++i) {
      add(at_.w[i] - model_.lower()[i], objective * start_.zl[i]);
      add(model_.upper()[i] - at_.w[i], objective * start_.zu[i]);
    }
    for (std::size_t r = 0; r < model_.rows(); ++r) {
      const double y = objective * start_.y[r] / model_.row_scale()[r];
      add(rows_[r] - model_.lower()[model_.slack(r)], std::max(-y, 0.0));
      add(model_.upper()[model_.slack(r)] - rows_[r], std::max(y, 0.0));
    }
    return bounds > 0 ? std::min(kFarther * sum / static_cast<double>(bounds), kFirstBarrier) : 0;
  }

  void multipliers() {
    const double objective = model_.objective_scale();
    for (std::size_t i = 0; i < model_.variables(); ++i) {
      at_.zl[i] = multiplier(at_.w[i] - model_.lower()[i], warm_ ? objective * start_.zl[i] : 0);
      at_.zu[i] = multiplier(model_.upper()[i] - at_.w[i], warm_ ? objective * start_.zu[i] : 0);
    }
    for (std::size_t r = 0; r < model_.rows(); ++r) {
      const std::size_t i = model_.slack(r);
      const double y = warm_ ? objective * start_.y[r] / model_.row_scale()[r] : 0;
      at_.y[r] = y;
      if (model_.equation(r)) {
        at_.w[i] = model_.constant(i);
        continue;
      }
      at_.w[i] = slack(rows_[r], model_.lower()[i], model_.upper()[i], y);
      at_.zl[i] = multiplier(at_.w[i] - model_.lower()[i], std::max(-y, 0.0));
      at_.zu[i] = multiplier(model_.upper()[i] - at_.w[i], std::max(y, 0.0));
      if (!warm_) at_.y[r] = at_.zu[i] - at_.zl[i];
    }
  }

 private:
  /// The row's value, but off its bound by as much as its multiplier would hold it there, within
  /// reason.
  double slack(double row, double lower, double upper, double y) const {
    const double value = inside(row, lower, upper, push_);
    if (!warm_) return value;
    const auto room = [&](double z, double bound) {
      const double held = z > 0 ? 0.1 * barrier_.mu() / z : push_;
      return floor_ ? held : std::min(held, kMostRoom * std::max(1.0, std::fabs(bound)));
    };
    if (std::isfinite(lower) && !std::isfinite(upper))
      return std::max(value, lower + room(-y, lower));
    if (std::isfinite(upper) && !std::isfinite(lower))
      return std::min(value, upper - room(y, upper));
    return value;
  }
  /// The given multiplier or mu / slack, whichever is more central; 0 for an absent bound.
  double multiplier(double slack, double given) const {
    if (!std::isfinite(slack)) return 0;
    const double mu = barrier_.mu(), ratio = slack * given / mu;
    return ratio > 0.1 && ratio < 10 ? given : mu / slack;
  }

  const Model& model_;
  Iterate& at_;
  const std::vector<double>& rows_;
  const Start& start_;
  const bool warm_, floor_;
  const double push_;
  const Barrier& barrier_;
};

}  // namespace

bool prepare(Descent& descent, const Start& start, const Options& options) {
  Point& point = descent.point;
  const bool floor = options.floor > 0;
  descent.barrier.begin(options.barrier_rule, floor ? options.floor : kFirstBarrier,
                        floor ? options.floor : least_barrier(options));
  descent.newton.restart();
  descent.search.filter().clear();
  Beginning beginning(descent, start, options);
  beginning.variables();
  std::fill(descent.step.y.begin(), descent.step.y.end(), 1.0);
  descent.model.set_scale(1, descent.step.y);
  // The rows' multipliers are known only of a warm start, so with it the Hessian comes along.
  if (options.warm_start) std::copy(start.y.begin(), start.y.end(), point.at.y.begin());
  point.have = {.values = true, .derivatives = true, .hessian = floor && options.warm_start};
  point.measured = false;
  if (!descent.model.evaluate(point.at, point.have, point.e)) return false;
  set_scales(descent, options);
  if (!floor && !descent.model.evaluate(point.at, point.have, point.e)) return false;
  if (!floor && options.warm_start)
    descent.barrier.begin(options.barrier_rule, beginning.complementarity(),
                          least_barrier(options));
  beginning.multipliers();
  if (!options.warm_start) descent.estimate_multipliers();
  return descent.complete();
}

void hand_out(const Model& model, const Iterate& at, Start& out) {
  const std::size_t n = model.variables();
  const double objective = model.objective_scale();
  out.x.resize(n);
  out.zl.resize(n);
  out.zu.resize(n);
  out.y.resize(model.rows());
  for (std::size_t i = 0; i < n; ++i) {
    out.x[i] = at.w[i];
    out.zl[i] = at.zl[i] / objective;
    out.zu[i] = at.zu[i] / objective;
  }
  for (std::size_t r = 0; r < model.rows(); ++r)
    out.y[r] = at.y[r] * model.row_scale()[r] / objective;
}

}  // namespace slalom::nlp::ipm
