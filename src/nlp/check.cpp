#include "slalom/nlp/check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rounding.hpp"

namespace slalom::nlp {
namespace {

/// Of what is relative, in dual_tol.
constexpr double kRelativeTolerance = 0.1;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// One variable or row between its limits, in the user's units.
struct Item {
  double value, lower, upper;
  double z_lower, z_upper;  ///< multipliers >= 0 of the two sides, user's units
  bool is_row;              ///< of a row only the difference z_upper - z_lower is known
  double terms;             ///< sum of the sizes of what adds up to the value
};

/// |s z / mu - 1| for the slack nearest to s, within tol, that brings it to zero.
double centrality(double s, double z, double mu, double tol) {
  const double wanted = z > 0 ? mu / z : std::numeric_limits<double>::infinity();
  const double nearest = std::clamp(wanted, s - tol, s + tol);
  return std::fabs(nearest * z / mu - 1);
}

/// The least of the largest |s z / mu - 1| of a two-sided row's two sides, of whose multipliers
/// only the difference y is known: |y - (mu/su - mu/sl)| / (mu/su + mu/sl), at the value within tol
/// of the row's that brings it nearest to zero. mu/su - mu/sl rises with the value.
double two_sided_centrality(const Item& item, double mu, double tol) {
  const double y = item.z_upper - item.z_lower;
  const auto distance = [&](double value) {
    const double lower = mu / (value - item.lower), upper = mu / (item.upper - value);
    return (y - (upper - lower)) / std::fabs(upper + lower);
  };
  // Within tol of a limit, and so of the value that is next to it: any side's multiplier is there.
  const double lowest = item.value - tol, highest = item.value + tol;
  if (lowest >= item.upper || highest <= item.lower) return std::numeric_limits<double>::infinity();
  const double low = lowest > item.lower ? distance(lowest) : 1;
  const double high = highest < item.upper ? distance(highest) : -1;
  return low > 0 && high < 0 ? 0 : std::min(std::fabs(low), std::fabs(high));
}

/// |s z| of one side without a floor; of a z that is negative or has no side, |z| itself.
double product(double s, double z) {
  return z < 0 || std::isinf(s) ? std::fabs(z) : std::fabs(s * z);
}

/// NaN of either is NaN.
double larger(double a, double b) {
  return std::isnan(b) ? b : std::max(a, b);
}

double complementarity(const Item& item, const Options& options) {
  const bool lower = std::isfinite(item.lower), upper = std::isfinite(item.upper);
  const double sl = item.value - item.lower, su = item.upper - item.value;
  const double mu = options.floor;
  if (mu <= 0) return larger(product(sl, item.z_lower), product(su, item.z_upper));
  const double tol = std::max(options.constraint_tol, kRounding * item.terms);
  if (item.is_row && lower && upper) return two_sided_centrality(item, mu, tol);
  const auto side = [&](bool exists, double s, double z) {
    return exists ? centrality(s, z, mu, tol) : std::fabs(z);
  };
  return larger(side(lower, sl, item.z_lower), side(upper, su, item.z_upper));
}

double violation(const Item& item) {
  if (std::isnan(item.value)) return item.value;
  return std::max({0.0, item.lower - item.value, item.value - item.upper});
}

/// The largest value so far and which it was; NaN is larger than any number.
struct Worst {
  double value = 0;
  std::size_t which = kNone;

  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  void keep(double other, std::size_t id) {
    if (!(other > value || (std::isnan(other) && !std::isnan(value)))) return;
    value = other;
    which = id;
  }
};

/// Sum of logarithms, by products of as many numbers as stay in range.
class LogSum {
 public:
  void add(double number) {
    if (!(number > kSmall && number < kLarge)) {
      sum_ += std::log(number);
      return;
    }
    product_ *= number;
    if (product_ < kSmall || product_ > kLarge) flush();
  }
  double total() {
    flush();
    return sum_;
  }

 private:
  static constexpr double kSmall = 1e-100, kLarge = 1e100;
  void flush() {
    sum_ += std::log(product_);
    product_ = 1;
  }
  double product_ = 1, sum_ = 0;
};

/// Rows count from 0, variables on from the last row.
class Judge {
 public:
  explicit Judge(const Options& options) : options_(options) {}

  void add(const Item& item, std::size_t id) {
    const double outside = nlp::violation(item);
    violation.keep(outside, id);
    if (!is_rounding(outside, item.terms)) beyond_rounding.keep(outside, id);
    if (item.lower == item.upper) return;  // an equation has no barrier
    complementarity.keep(nlp::complementarity(item, options_), id);
    if (std::isfinite(item.lower)) logs.add(item.value - item.lower);
    if (std::isfinite(item.upper)) logs.add(item.upper - item.value);
  }

  Worst violation, beyond_rounding, complementarity, stationarity;
  LogSum logs;

 private:
  const Options& options_;
};

}  // namespace

bool Residuals::solved(const Options& options) const {
  if (fault) return false;
  if (options.floor > 0)
    return violation_beyond_rounding <= options.constraint_tol &&
           stationarity <= options.dual_tol && complementarity <= options.floor_tol;
  const double tol = kRelativeTolerance * options.dual_tol;
  return relative_violation <= options.constraint_tol && relative_stationarity <= tol &&
         relative_complementarity <= tol;
}

namespace {

/// The residuals in the NLP's own units, whose scales are the user's idea of what is large; those
/// of duals relative to what adds up in them, of which `most` is the largest slope, and to the
/// objective.
void judge_scaled(const Structure& shape, const Limits& limits, const Start& point,
                  const Evaluation& at, const std::vector<double>& lagrangian, Worst most,
                  Residuals& result) {
  Worst violated, stationarity, complementarity;
  const auto add = [&](const Item& item) {
    violated.keep(violation(item), 0);
    if (item.lower == item.upper) return;
    complementarity.keep(product(item.value - item.lower, item.z_lower), 0);
    complementarity.keep(product(item.upper - item.value, item.z_upper), 0);
  };
  for (std::size_t r = 0; r < shape.rows; ++r)
    add({at.rows[r], limits.gl[r], limits.gu[r], std::max(-point.y[r], 0.0),
         std::max(point.y[r], 0.0), true, 0});
  for (std::size_t i = 0; i < shape.variables; ++i) {
    add({point.x[i], limits.xl[i], limits.xu[i], point.zl[i], point.zu[i], false, 0});
    if (limits.xl[i] == limits.xu[i]) continue;
    most.keep(std::fabs(point.zl[i]), 0);
    most.keep(std::fabs(point.zu[i]), 0);
    stationarity.keep(std::fabs(lagrangian[i] - point.zl[i] + point.zu[i]), 0);
  }
  result.relative_violation = violated.value;
  result.relative_stationarity = stationarity.value / most.value;
  result.relative_complementarity =
      complementarity.value / larger(std::fabs(at.objective), most.value);
}

}  // namespace

Residuals check(Problem& problem, const Start& point, const Options& options) {
  const Structure& shape = problem.structure();
  const Limits& limits = problem.limits();
  check_sizes(point, shape, true);
  Evaluation at;
  Residuals result;
  result.fault = problem.evaluate(point.x, 1, {}, {.values = true, .derivatives = true}, at);
  if (result.fault) {
    result.violation = result.violation_beyond_rounding = kNaN;
    result.stationarity = result.complementarity = kNaN;
    result.relative_violation = result.relative_stationarity = kNaN;
    result.relative_complementarity = result.objective = result.phi = kNaN;
    return result;
  }
  result.objective = at.objective;
  Judge judge(options);
  std::vector<double> lagrangian = at.gradient;
  Worst most{1};
  for (const double slope : at.gradient) most.keep(std::fabs(slope), 0);
  for (std::size_t e = 0; e < at.jacobian.size(); ++e) {
    const double term = point.y[shape.jacobian_row[e]] * at.jacobian[e];
    lagrangian[shape.jacobian_col[e]] += term;
    most.keep(std::fabs(term), 0);
  }
  std::vector<double> terms(shape.rows);
  sum_terms(shape, at.jacobian, point.x, terms);
  for (std::size_t r = 0; r < shape.rows; ++r) {
    const double scale = shape.row_scale[r], y = point.y[r] * scale;
    judge.add({at.rows[r] / scale, limits.gl[r] / scale, limits.gu[r] / scale, std::max(-y, 0.0),
               std::max(y, 0.0), true, terms[r] / scale},
              r);
  }
  for (std::size_t i = 0; i < shape.variables; ++i) {
    const double scale = shape.variable_scale[i];
    judge.add({point.x[i] * scale, limits.xl[i] * scale, limits.xu[i] * scale, point.zl[i] / scale,
               point.zu[i] / scale, false, std::fabs(point.x[i] * scale)},
              shape.rows + i);
    if (limits.xl[i] == limits.xu[i]) continue;  // fixed: its multiplier is free
    judge.stationarity.keep(std::fabs(lagrangian[i] - point.zl[i] + point.zu[i]) / scale,
                            shape.rows + i);
  }
  const auto tell = [&](const Worst& worst, double& value, std::string& name) {
    value = worst.value;
    if (worst.which == Worst::kNone) return;
    name = worst.which < shape.rows ? problem.row_name(worst.which)
                                    : problem.variable_name(worst.which - shape.rows);
  };
  judge_scaled(shape, limits, point, at, lagrangian, most, result);
  result.violation_beyond_rounding = judge.beyond_rounding.value;
  tell(judge.violation, result.violation, result.worst_constraint);
  tell(judge.stationarity, result.stationarity, result.worst_variable);
  tell(judge.complementarity, result.complementarity, result.worst_pair);
  result.phi = at.objective;
  if (options.floor > 0) result.phi -= options.floor * judge.logs.total();
  return result;
}

}  // namespace slalom::nlp
