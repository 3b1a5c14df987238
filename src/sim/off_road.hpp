#pragma once

#include <optional>

#include "slalom/sim/watch.hpp"

namespace slalom::sim {

/// When, in seconds since a stretch began, a part of the footprint first leaves the road, to 1e-9
/// s; as Road::edge_distance() has it, so at most Road::kSag too early. Its distance to the edge
/// falls no faster than its fastest point moves, and is looked at as often as that allows it to be
/// gone: a graze of less than .05 mm may be missed.
std::optional<double> first_off_road(const world::Road& road, const world::Footprint& footprint,
                                     const vehicle::Dynamics& dynamics, const Stretch& stretch);

}  // namespace slalom::sim
