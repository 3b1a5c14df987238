#pragma once

#include <vector>

#include "slalom/nlp/solver.hpp"

namespace slalom::ocp {

/// Solves `problem` with its objective multiplied until its largest slope by a scaled variable that
/// `measured` counts, at the start or beside it, is 1, so that tolerances mean the same in any unit
/// of it (as Waechter & Biegler 2006, section 3.8, do for large ones); where the slope is much
/// smaller at the answer, it is solved again from there. The answer is the problem's own. A floor,
/// given in the objective's unit, leaves the objective as it is.
nlp::Answer solve_scaled(nlp::Problem& problem, nlp::Solver& solver, const nlp::Start& start,
                         const nlp::Options& options, const std::vector<char>& measured);

}  // namespace slalom::ocp
