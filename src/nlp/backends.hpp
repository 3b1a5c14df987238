#pragma once

#include <memory>

#include "slalom/nlp/solver.hpp"

namespace slalom::nlp {

/// Ipopt (Waechter & Biegler, Math. Program. 106, 2006); only in builds with SLALOM_WITH_IPOPT.
std::unique_ptr<Solver> make_ipopt();

/// The interior-point method on the stage-structured factorisation.
std::unique_ptr<Solver> make_interior_point();

}  // namespace slalom::nlp
