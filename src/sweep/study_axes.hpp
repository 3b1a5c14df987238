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
  /// By key, the values that stand in the file; none where its numbers were computed.
  std::vector<std::vector<const io::Value*>> listed;
  std::vector<io::Place> computed;  ///< by key, where what they were computed from stands
  bool drawn = false;               ///< its numbers are drawn from intervals
};

/// Reads one member of `axes:`. `stream` tells the draws of one axis from those of the others.
/// Throws InvalidValue for anything that gives no points. `map` must outlive what is returned.
PlacedAxis read_axis(const io::Value& map, int seed, std::size_t stream);

}  // namespace slalom::sweep
