#pragma once

#include <string>

#include "slalom/nlp/problem.hpp"
#include "slalom/nlp/solver.hpp"

namespace slalom::nlp {

/// Residuals of an answer, recomputed from the answer and the problem's functions alone.
struct Residuals {
  double violation = 0;          ///< largest violation of a row or bound, in its own unit
  std::string worst_constraint;  ///< its name
  /// The largest violation that is more than the rounding of its own terms (16 times 2^-52 of the
  /// sum of |slope * variable|): of 1.5e11 m, 1e-6 m cannot be asked for.
  double violation_beyond_rounding = 0;
  double stationarity = 0;     ///< largest |gradient of the Lagrangian|, user's units
  std::string worst_variable;  ///< its name
  double complementarity = 0;  ///< largest |s z / mu - 1| at a floor; largest |s z| without
  std::string worst_pair;      ///< the row or bound it belongs to
  /// Violation, stationarity and complementarity in the NLP's own, scaled units. Stationarity is
  /// divided by the largest term of the Lagrangian's slopes, complementarity by that or the
  /// objective, whichever is larger; neither divisor is less than 1. So large units do not matter
  /// to these three. They decide "solved" without a floor.
  double relative_violation = 0, relative_stationarity = 0, relative_complementarity = 0;
  Fault fault;  ///< where a function is not finite; all numbers here are then NaN
  double objective = 0;
  double phi = 0;  ///< f - mu sum log s, rows and bounds unscaled

  /// Whether these make the answer "solved" in the sense of `options` (floor or not).
  bool solved(const Options& options) const;
};

/// Judges the point of `answer` (section 3 of docs/formulation.md, "Solved at a barrier floor").
/// Each finite side of an inequality row or bound counts once. The slack s is the row's own value;
/// at a floor it may differ from that by up to constraint_tol or the rounding of the row's terms,
/// and the value that brings s z / mu nearest to 1 is taken. A multiplier of the wrong sign, or of
/// a side that does not exist, counts in full as complementarity. Throws InvalidValue when `point`
/// does not have the problem's sizes.
Residuals check(Problem& problem, const Start& point, const Options& options);

}  // namespace slalom::nlp
