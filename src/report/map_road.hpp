#pragma once

#include "map.hpp"
#include "map_view.hpp"

namespace slalom::report {

/// The road's surface, edges, lanes and reference line; nothing without a road.
void draw_road(Svg& svg, const Map& map, const View& view);

/// The goal, if it is a place or a line.
void draw_goal(Svg& svg, const Map& map, const View& view);

}  // namespace slalom::report
