#pragma once

#include "slalom/ocp/solve.hpp"

namespace slalom::python {

/// What Python knows as Solution.
struct Solved {
  ocp::Solution answer;
  double elapsed_s = 0;  ///< of ocp::solve as a whole
};

}  // namespace slalom::python
