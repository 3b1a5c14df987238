#pragma once

#include <vector>

#include "slalom/vehicle/parameters.hpp"
#include "slalom/vehicle/state.hpp"
#include "slalom/world/obstacle.hpp"
#include "slalom/world/region.hpp"
#include "slalom/world/road.hpp"

namespace slalom::world {

/// A disc fixed to the vehicle: how far its centre lies ahead of the front axle's [m], on the
/// vehicle's axis, and its radius [m].
struct Disc {
  double ahead = 0, radius = 0;
};

/// What of a vehicle keeps off obstacles, on the road and in the region: the front axle's centre
/// alone, or the rectangle of the vehicle's length and width (Parameters::footprint).
class Footprint {
 public:
  explicit Footprint(const vehicle::Parameters& vehicle);

  bool is_point() const { return corners_.empty(); }
  /// Corners in the vehicle's frame, whose origin is the front axle's centre; none of a point.
  const std::vector<Point>& corners() const { return corners_; }
  /// Corners in the world's frame.
  std::vector<Point> at(const vehicle::State& state) const;
  /// How far its farthest point is from the front axle's centre [m].
  double reach() const { return reach_; }

  /// Discs of one radius that cover it and stick out of its sides by at most `excess` [m], but for
  /// no more than kMostDiscs; of its ends they stick out by more. A point's is of radius 0.
  std::vector<Disc> covering_discs(double excess) const;

  /// Distance between the footprint of a vehicle in this state and the obstacle at t [s]; negative
  /// where they overlap.
  double distance(const Obstacle& obstacle, const vehicle::State& state, double t) const;
  /// How far all of the footprint is from the road's nearer edge; negative where a part of it is
  /// off the road (Road::edge_distance).
  double edge_distance(const Road& road, const vehicle::State& state) const;
  /// How far the part of it that is farthest out is outside a region [m]; at most 0 within.
  double outside(const Region& region, const vehicle::State& state) const;

 private:
  std::vector<Point> corners_;
  double reach_ = 0;
};

}  // namespace slalom::world
