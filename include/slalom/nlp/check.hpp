#pragma once

#include <string>

#include "slalom/nlp/problem.hpp"
#include "slalom/nlp/solver.hpp"

namespace slalom::nlp {

/// Residuals of an answer, recomputed from the answer and the problem's functions alone.
struct Residuals {
  double violation = 0;          ///< largest violation of a row or bound, in its own unit
  std::string worst_constraint;  ///< its name
  double stationarity = 0;       ///< largest |gradient of the Lagrangian|, user's units
  std::string worst_variable;    ///< its name
  double complementarity = 0;    ///< largest |s z / mu - 1| at a floor; largest |s z| without
  std::string worst_pair;        ///< the row or bound where it stands
  /// In the NLP's own units (of the scales); the last two over the largest term of the Lagrangian's
  /// slopes, and the objective, where these are above 1. Large units do not matter to them, and
  /// they are what "solved" means without a floor.
  double relative_violation = 0, relative_stationarity = 0, relative_complementarity = 0;
  Fault fault;  ///< where a function is not finite; all numbers here are then NaN
  double objective = 0;
  double phi = 0;  ///< f - mu sum log s, rows and bounds unscaled

  /// Whether these make the answer "solved" in the sense of `options` (floor or not).
  bool solved(const Options& options) const;
};

/// Judges the point of `answer` (section 3 of docs/formulation.md, "Solved at a barrier floor").
/// Each finite side of an inequality row or bound counts once. Slack s is the row's own value; at a
/// floor it may differ from it by constraint_tol, whichever makes s z / mu nearest to 1. A
/// multiplier of the wrong sign, or of a side that does not exist, counts whole as complementarity.
/// Throws InvalidValue when `point` has not the problem's sizes.
Residuals check(Problem& problem, const Start& point, const Options& options);

}  // namespace slalom::nlp
