#include "slalom/expr/derivative_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "slalom/base/error.hpp"

namespace slalom::expr {
namespace {

using Vector = std::vector<double>;
using VectorFunction = std::function<void(std::span<const double>, std::span<double>)>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFirstStep =
    0.11;                    ///< of a variable's scale; no power of 2, so that few periods fit it
constexpr int kLevels = 18;  ///< halvings of the step, down to about 1e-6 of the scale
constexpr int kMaxHalvings = 24;  ///< into the domain, on top
constexpr double kFloor = 1e-3;   ///< of a row's largest value, see the header

double scale_of(double x) {
  return std::max(1.0, std::fabs(x));
}

void require(bool condition, const std::string& what) {
  if (!condition) throw Error("derivative check: " + what);
}

std::string name_of(const std::vector<std::string>& names, const char* kind, std::size_t i) {
  return names.empty() ? fmt::format("{} {}", kind, i) : names[i];
}

/// Ridders' table for one component: central differences at halved steps, extrapolated.
class Extrapolation {
 public:
  void add(double difference) {
    Vector row{difference};
    double factor = 1;
    for (double coarser : last_) {
      factor *= 4;
      const double finer = row.back();
      row.push_back(finer + (finer - coarser) / (factor - 1));
      const double spread =
          std::max(std::fabs(row.back() - finer), std::fabs(row.back() - coarser));
      if (spread <= spread_) {
        spread_ = spread;
        best_ = row.back();
      }
    }
    last_ = std::move(row);
  }
  double best() const { return best_; }

 private:
  Vector last_;
  double best_ = std::numeric_limits<double>::quiet_NaN();
  double spread_ = kInfinity;
};

/// d f / d x[col] at x by differences of the vector function f; `largest` gathers max |f| by
/// component.
Vector difference(const VectorFunction& f, Vector x, std::size_t col, Vector& largest) {
  const std::size_t n = largest.size();
  Vector above(n), below(n);
  const double at = x[col];
  double step = kFirstStep * scale_of(at);
  std::vector<Extrapolation> tables(n);
  int usable = 0;
  for (int tries = 0; usable < kLevels && tries < kLevels + kMaxHalvings; ++tries, step /= 2) {
    x[col] = at + step;
    const double up = x[col];
    f(x, above);
    x[col] = at - step;
    const double width = up - x[col];  // as represented, not as meant
    f(x, below);
    const auto finite = [](double v) { return std::isfinite(v); };
    if (!std::all_of(above.begin(), above.end(), finite) ||
        !std::all_of(below.begin(), below.end(), finite))
      continue;
    ++usable;
    for (std::size_t i = 0; i < n; ++i) {
      largest[i] = std::max({largest[i], std::fabs(above[i]), std::fabs(below[i])});
      tables[i].add((above[i] - below[i]) / width);
    }
  }
  Vector result;
  for (const auto& table : tables) result.push_back(table.best());
  return result;
}

double relative_error(double stated, double measured, double floor) {
  if (!std::isfinite(stated) || !std::isfinite(measured)) return kInfinity;
  const double scale = std::max({std::fabs(stated), std::fabs(measured), floor});
  return scale == 0 ? 0 : std::fabs(stated - measured) / scale;
}

/// Values of a sparse pattern spread over a full matrix, row by row.
struct Dense {
  std::size_t cols;
  Vector value;
  std::vector<char> in_pattern;

  Dense(std::size_t rows, std::size_t columns, const std::vector<Entry>& pattern,
        const Vector& entries)
      : cols(columns), value(rows * columns, 0), in_pattern(rows * columns, 0) {
    for (std::size_t k = 0; k < pattern.size(); ++k) {
      value[pattern[k].row * cols + pattern[k].col] = entries[k];
      in_pattern[pattern[k].row * cols + pattern[k].col] = 1;
    }
  }
};

class Check {
 public:
  Check(const StatedDerivatives& stated, const DerivativeCheckOptions& options)
      : stated_(stated), weights_(options.weights) {
    if (weights_.empty())
      for (std::size_t k = 0; k < stated.outputs; ++k)
        weights_.push_back(1 + std::fmod(0.6180339887 * static_cast<double>(k), 1.0));
    require(static_cast<bool>(stated.values), "the callback for values is missing");
    require(static_cast<bool>(stated.jacobian), "the callback for the Jacobian is missing");
    require(weights_.size() == stated.outputs, "as many weights as outputs are needed");
    require(stated.variable_names.empty() || stated.variable_names.size() == stated.variables,
            "as many variable names as variables are needed");
    require(stated.output_names.empty() || stated.output_names.size() == stated.outputs,
            "as many output names as outputs are needed");
    check_pattern("Jacobian", stated.jacobian_pattern, stated.outputs, false);
    check_pattern("Hessian", stated.hessian_pattern, stated.variables, true);
    report_.tolerance = options.tolerance;
    report_.has_hessian = static_cast<bool>(stated.hessian);
  }

  void at(const Vector& x) {
    require(x.size() == stated_.variables,
            fmt::format("point {} has {} coordinates, the function {} variables", report_.points,
                        x.size(), stated_.variables));
    jacobian_at(x);
    if (report_.has_hessian) hessian_at(x);
    ++report_.points;
  }

  DerivativeReport report() {
    report_.passed =
        report_.jacobian.error <= report_.tolerance && report_.hessian.error <= report_.tolerance;
    return report_;
  }

 private:
  void check_pattern(const char* what, std::vector<Entry> pattern, std::size_t rows,
                     bool lower) const {
    const auto before = [](const Entry& a, const Entry& b) {
      return std::pair(a.row, a.col) < std::pair(b.row, b.col);
    };
    for (const auto& [row, col] : pattern) {
      require(row < rows && col < stated_.variables,
              fmt::format("{} entry ({}, {}) is outside the matrix, {} x {}", what, row, col, rows,
                          stated_.variables));
      require(!lower || row >= col,
              fmt::format("{} entry ({}, {}) is above the diagonal", what, row, col));
    }
    std::sort(pattern.begin(), pattern.end(), before);
    const auto twice = std::adjacent_find(pattern.begin(), pattern.end());
    if (twice != pattern.end())
      throw Error(fmt::format("derivative check: {} entry ({}, {}) is listed twice", what,
                              twice->row, twice->col));
  }

  void jacobian_at(const Vector& x) {
    Vector entries(stated_.jacobian_pattern.size());
    stated_.jacobian(x, entries);
    const Dense stated(stated_.outputs, x.size(), stated_.jacobian_pattern, entries);
    for (std::size_t col = 0; col < x.size(); ++col) {
      Vector largest(stated_.outputs, 0);
      const Vector measured = difference(stated_.values, x, col, largest);
      for (std::size_t row = 0; row < stated_.outputs; ++row)
        compare(report_.jacobian, {row, col}, stated, measured[row],
                kFloor * largest[row] / scale_of(x[col]), "output");
    }
  }

  void hessian_at(const Vector& x) {
    Vector entries(stated_.hessian_pattern.size());
    stated_.hessian(x, weights_, entries);
    const Dense stated(x.size(), x.size(), stated_.hessian_pattern, entries);
    const auto gradient = [&](std::span<const double> at, std::span<double> result) {
      Vector jacobian(stated_.jacobian_pattern.size());
      stated_.jacobian(at, jacobian);
      std::fill(result.begin(), result.end(), 0.0);
      for (std::size_t k = 0; k < jacobian.size(); ++k)
        result[stated_.jacobian_pattern[k].col] +=
            weights_[stated_.jacobian_pattern[k].row] * jacobian[k];
    };
    for (std::size_t col = 0; col < x.size(); ++col) {
      Vector largest(x.size(), 0);
      const Vector measured = difference(gradient, x, col, largest);
      for (std::size_t row = col; row < x.size(); ++row)
        compare(report_.hessian, {row, col}, stated, measured[row],
                kFloor * largest[row] / scale_of(x[col]), "variable");
    }
  }

  void compare(WorstEntry& worst, Entry entry, const Dense& stated, double measured, double floor,
               const char* row_kind) const {
    const std::size_t k = entry.row * stated.cols + entry.col;
    const double error = relative_error(stated.value[k], measured, floor);
    if (error <= worst.error && !worst.row_name.empty()) return;
    const bool is_output = &worst == &report_.jacobian;
    const auto& row_names = is_output ? stated_.output_names : stated_.variable_names;
    worst = {error,
             report_.points,
             entry.row,
             entry.col,
             name_of(row_names, row_kind, entry.row),
             name_of(stated_.variable_names, "variable", entry.col),
             stated.value[k],
             measured,
             stated.in_pattern[k] != 0};
  }

  const StatedDerivatives& stated_;
  Vector weights_;
  DerivativeReport report_;
};

std::string line(const char* what, const WorstEntry& worst) {
  if (worst.row_name.empty()) return fmt::format("  {}: no entries\n", what);
  return fmt::format(
      "  {}: relative error {:.2e} at ({}, {}), {} by {}, point {}: stated {}{}, "
      "by differences {}\n",
      what, worst.error, worst.row, worst.col, worst.row_name, worst.col_name, worst.point,
      worst.stated, worst.in_pattern ? "" : " (not in the pattern)", worst.measured);
}

}  // namespace

std::string to_string(const DerivativeReport& report) {
  std::string text = fmt::format("derivatives {} (tolerance {}, {} point{})\n",
                                 report.passed ? "agree" : "DISAGREE", report.tolerance,
                                 report.points, report.points == 1 ? "" : "s");
  text += line("Jacobian", report.jacobian);
  text += report.has_hessian ? line("Hessian", report.hessian) : "  Hessian: not given\n";
  return text;
}

DerivativeReport check_derivatives(const StatedDerivatives& stated,
                                   const std::vector<Vector>& points,
                                   const DerivativeCheckOptions& options) {
  require(!points.empty(), "at least one point is needed");
  Check check(stated, options);
  for (const auto& point : points) check.at(point);
  return check.report();
}

DerivativeReport check_derivatives(const Function& function, const std::vector<Vector>& points,
                                   std::span<const double> data,
                                   const DerivativeCheckOptions& options) {
  require(data.size() == function.data(), "the data's length does not match the function's");
  StatedDerivatives stated;
  stated.variables = function.variables();
  stated.outputs = function.outputs();
  stated.variable_names = options.variable_names;
  stated.output_names = options.output_names;
  stated.jacobian_pattern = function.jacobian_pattern();
  stated.hessian_pattern = function.hessian_pattern();
  stated.values = [&](std::span<const double> x, std::span<double> values) {
    function(x, data, values);
  };
  stated.jacobian = [&](std::span<const double> x, std::span<double> entries) {
    function.evaluate(1, x, data, {}, {.values = false, .jacobian = true}, {}, entries, {});
  };
  stated.hessian = [&](std::span<const double> x, std::span<const double> weights,
                       std::span<double> entries) {
    function.evaluate(1, x, data, weights, {.values = false, .hessian = true}, {}, {}, entries);
  };
  return check_derivatives(stated, points, options);
}

}  // namespace slalom::expr
