#pragma once

#include <functional>
#include <vector>

#include "slalom/nlp/problem.hpp"

namespace slalom::ocp {

/// Takes the bounds off equations that no free variable meets and that hold, such as the link of
/// two fixed times: they ask for nothing, and counted as equations there would be too many. One
/// that does not hold stays, for the solver to name. `rows` gives the rows' values at a point.
void relax_constant_rows(
    const nlp::Structure& shape,
    const std::function<std::vector<double>(const std::vector<double>& x)>& rows,
    nlp::Limits& limits);

}  // namespace slalom::ocp
