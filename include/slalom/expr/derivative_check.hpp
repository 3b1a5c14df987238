#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "slalom/expr/function.hpp"

namespace slalom::expr {

/// Derivatives as somebody states them, to be compared with differences of the values. A pattern
/// also states that every entry outside it is zero. Sizes: x is `variables` long, values and
/// weights `outputs` long, entries as long as their pattern.
struct StatedDerivatives {
  std::size_t variables = 0, outputs = 0;
  std::function<void(std::span<const double> x, std::span<double> values)> values;

  std::vector<Entry> jacobian_pattern;  ///< row: output, col: variable; each entry once
  std::function<void(std::span<const double> x, std::span<double> entries)> jacobian;

  /// Lower triangle (row >= col) of the Hessian of sum weights[k] * values[k]; may be left out.
  std::vector<Entry> hessian_pattern;
  std::function<void(std::span<const double> x, std::span<const double> weights,
                     std::span<double> entries)>
      hessian;

  std::vector<std::string> variable_names, output_names;  ///< for the report; may be empty
};

struct DerivativeCheckOptions {
  double tolerance = 1e-7;  ///< largest relative error that passes
  /// Weights of the outputs in the Hessian. Empty: 1, 1.62, 1.24, ..., which differ between
  /// neighbours so that the errors of two outputs do not cancel.
  std::vector<double> weights{};
  std::vector<std::string> variable_names{}, output_names{};  ///< for a Function, which has none
};

/// The entry of one derivative that is furthest from its difference.
struct WorstEntry {
  double error = 0;  ///< relative, see check_derivatives; infinite when either is not finite
  std::size_t point = 0, row = 0, col = 0;
  std::string row_name, col_name;  ///< given names, else "output 3", "variable 0"
  double stated = 0, measured = 0;
  bool in_pattern = true;  ///< false: stated to be zero by being absent
};

struct DerivativeReport {
  bool passed = true;
  double tolerance = 0;
  std::size_t points = 0;
  bool has_hessian = false;
  WorstEntry jacobian, hessian;
};

/// For people: passed or failed, and the worst entry of each derivative.
std::string to_string(const DerivativeReport& report);

/// Compares stated derivatives with measured ones at each of `points`, every entry of the full
/// matrices, whether in the pattern or not:
///   Jacobian: central differences of the values, extrapolated to step 0 (Ridders, Adv. Eng.
///             Software 4(2), 1982); good to about 1e-10 of a smooth function's scale.
///   Hessian:  the same differences of weights' * Jacobian, with the stated Jacobian. Wrong first
///             derivatives therefore show in both parts; mend the Jacobian first.
/// Error of an entry: |stated - measured| / max(|stated|, |measured|, floor), where the floor is a
/// thousandth of (largest value met in the row's function) / max(1, |x_col|), since rounding in the
/// values hides anything far smaller.
///
/// Where it does not apply: at a kink (abs, min, max, select, sign at the switch) a difference
/// measures the mean of both sides, while the derivative is that of one side, so the entry fails
/// although it is as documented. Steps are halved from 0.11 max(1, |x|) until both ends lie in the
/// function's domain (finite values); on its very edge (sqrt or log at 0) there is no such step and
/// the entry fails as not finite. A wrong entry can pass where the right one happens to vanish, so
/// take several points, without zeros or symmetries.
///
/// Throws Error for a pattern entry out of range, listed twice or above the diagonal of the
/// Hessian, for no point at all, for a point, weights or names of the wrong length, and for a
/// missing callback.
DerivativeReport check_derivatives(const StatedDerivatives& stated,
                                   const std::vector<std::vector<double>>& points,
                                   const DerivativeCheckOptions& options = {});

/// The same for a compiled function, Jacobian and Hessian, at fixed `data`.
DerivativeReport check_derivatives(const Function& function,
                                   const std::vector<std::vector<double>>& points,
                                   std::span<const double> data = {},
                                   const DerivativeCheckOptions& options = {});

}  // namespace slalom::expr
