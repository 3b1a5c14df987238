#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "../io/document.hpp"
#include "slalom/base/options.hpp"
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

/// Puts numbers in the place of the values of an axis that name a file of them: what the trials are
/// must not depend on where the sweep runs, or on a file that may change. `option_of` knows keys.
/// Throws InvalidValue for a file that cannot be read.
void take_in_files(
    io::Value& map,
    const std::function<std::optional<OptionInfo>(const std::string& key)>& option_of);

/// Reads one member of `axes:`. `stream` tells the draws of one axis from those of the others.
/// Throws InvalidValue for anything that gives no points. `map` must outlive what is returned.
PlacedAxis read_axis(const io::Value& map, int seed, std::size_t stream);

}  // namespace slalom::sweep
