#pragma once

#include "map.hpp"
#include "map_view.hpp"

namespace slalom::report {

/// Takes in all that is drawn of a map's obstacles.
void add_obstacles(Box& box, const Map& map);

/// Obstacles at the map's instants, from pale to dark, with the edge that is a crash, and the ways
/// of those that move by a table or along a path.
void draw_obstacles(Svg& svg, const Map& map, const View& view);

/// Where a plan takes the moving obstacles to be, if it holds them.
void draw_held_obstacles(Svg& svg, const Map& map, const MapVehicle& vehicle, const View& view);

/// Names of the larger obstacles, inside where there is room; with the instant for those that move.
void name_obstacles(Svg& svg, Labels& labels, const Map& map, const View& view);

/// Words keep off the obstacles.
void keep_clear_of_obstacles(Labels& labels, const Map& map, const View& view);

}  // namespace slalom::report
