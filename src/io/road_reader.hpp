#pragma once

#include <memory>
#include <string>

#include "document.hpp"
#include "slalom/world/road.hpp"

namespace slalom::io {

/// The road of a scenario's section. Throws InvalidValue at the place of what is wrong.
std::shared_ptr<const world::Road> read_road(const Value& map);

/// The section as files have it, from behind "road:" on.
std::string road_text(const world::Road& road);

}  // namespace slalom::io
