#pragma once

#include <vector>

#include "slalom/problems/library.hpp"

namespace slalom::app {

/// The problems that the program knows: the library's, and the planner's own.
const std::vector<problems::Entry>& all_problems();

}  // namespace slalom::app
