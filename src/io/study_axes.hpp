#pragma once

#include <string>
#include <vector>

#include "document.hpp"
#include "slalom/io/study.hpp"

namespace slalom::io {

/// An axis with the places of its keys and values, for messages.
struct PlacedAxis {
  Axis axis;
  std::vector<Place> keys;
  std::vector<std::vector<Value>> values;  ///< [point][key]
};

/// Reads one member of `axes:`. `stream` tells the draws of one axis from those of the others.
/// Throws InvalidValue for anything that gives no points.
PlacedAxis read_axis(const Value& map, int seed, std::size_t stream);

}  // namespace slalom::io
