#pragma once

#include <string>
#include <vector>

#include "../io/document.hpp"
#include "slalom/sweep/study.hpp"

namespace slalom::sweep {

/// An axis with the places of its keys and values, for messages.
struct PlacedAxis {
  Axis axis;
  std::vector<io::Place> keys;
  std::vector<std::vector<io::Value>> values;  ///< [point][key]
};

/// Reads one member of `axes:`. `stream` tells the draws of one axis from those of the others.
/// Throws InvalidValue for anything that gives no points.
PlacedAxis read_axis(const io::Value& map, int seed, std::size_t stream);

}  // namespace slalom::sweep
