#pragma once

#include "slalom/problems/library.hpp"

namespace slalom::planner {

/// The planner's own OCP as an entry like those of problems::library(): the first cycle of the
/// paper's closed loop in environment E_A with planner P_C (docs/formulation.md, sections 3, 4 and
/// 6), solved to its optimum, not to a barrier floor.
problems::Entry vehicle_cycle();

}  // namespace slalom::planner
