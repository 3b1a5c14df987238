#pragma once

#include <vector>

namespace slalom::world {

/// Second derivatives at the knots of the cubic spline through y, whose intervals have lengths h:
/// natural, or periodic where there are as many intervals as values.
std::vector<double> spline_curvatures(const std::vector<double>& h, const std::vector<double>& y);

/// Slopes of a monotone cubic through y over intervals of lengths h, likewise.
std::vector<double> monotone_slopes(const std::vector<double>& h, const std::vector<double>& y);

}  // namespace slalom::world
