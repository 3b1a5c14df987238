#pragma once

#include <array>
#include <vector>

#include "slalom/vehicle/parameters.hpp"
#include "slalom/world/road.hpp"

namespace slalom::world {

/// What stands on a road and is passed on one side: from where to where along the line a vehicle's
/// front axle is beside it, and to where its body may reach [m].
struct Narrowing {
  double from = 0, to = 0;
  bool on_the_left = false;  ///< the vehicle passes with it on its left
  double edge = 0;           ///< offset of the side that is passed
};

/// A band along a road: offsets from its line, evenly far apart along that, of a path that bends as
/// little as the road's edges let it (elastic bands: S. Quinlan and O. Khatib, "Elastic bands:
/// connecting path planning and control", ICRA 1993).
struct RoadBand {
  static constexpr double kStep = 0.5;  ///< between the places [m of the line]

  double from = 0;                ///< where on the line it begins [m]
  std::array<double, 3> first{};  ///< its first offsets, which are kept [m]
  double wanted = 0;              ///< the offset that it is drawn to [m]
  double over = 10;               ///< and within about what length it comes there [m]
  double spare = 0.1;             ///< beside the vehicle's body to the road's edges [m]
  std::vector<Narrowing> narrowings{};
};

/// The offsets [m], `count` of them, at least 3: they minimise the squares of the path's bends and
/// of its distances from the offset wanted, within the edges less half the body and what its ends
/// are off the path in a bend.
std::vector<double> offsets_of(const RoadBand& band, const Road& road,
                               const vehicle::Parameters& vehicle, std::size_t count);

}  // namespace slalom::world
