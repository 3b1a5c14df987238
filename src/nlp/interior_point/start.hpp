#pragma once

#include <vector>

#include "descent.hpp"
#include "slalom/nlp/solver.hpp"

namespace slalom::nlp::ipm {

/// Of the objective: what all products of slacks and multipliers together may hold it off its
/// least.
inline constexpr double kMostGap = 1e-5;
/// What each bound may at least add to the gap, whatever the objective's scale: less cannot be told
/// from rounding.
inline constexpr double kLeastGap = 1e-12;

/// Sets scales, barrier and the first point of a solve (Waechter & Biegler 2006, sections 3.6 and
/// 3.8).
///
/// Variables are moved inside their bounds; slacks take their rows' values, moved inside likewise.
/// Cold, multipliers of bounds are mu / slack and those of rows fit the gradient. Warm, the
/// multipliers given are kept where they are central, else set to mu / slack, and a slack keeps the
/// distance from its bound at which its multiplier would hold it.
class Starter {
 public:
  /// `form`: of `descent`.
  Starter(SlackForm& form, Descent& descent);
  /// False when a function is not finite at the first point, which otherwise is complete.
  [[nodiscard]] bool prepare(const Start& start, const Options& options);

 private:
  [[nodiscard]] bool evaluate_scaled();

  SlackForm& form_;
  Descent& descent_;
  const std::vector<double> unscaled_;  ///< by row: 1
  std::vector<double> row_scale_;
};

/// A point of the method in the problem's terms.
void hand_out(const SlackForm& form, const Iterate& at, Start& out);

}  // namespace slalom::nlp::ipm
