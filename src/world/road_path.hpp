#pragma once

#include <cstddef>
#include <vector>

#include "road_band.hpp"
#include "slalom/vehicle/parameters.hpp"
#include "slalom/vehicle/state.hpp"
#include "slalom/world/road.hpp"

namespace slalom::world {

/// A place of a path: of the front axle's centre [m], the direction it moves in and that of the
/// body [rad], by how much the body turns [rad/m], and how fast the steering angle changes [rad/m].
struct PathPlace {
  double x = 0, y = 0, heading = 0, psi = 0, kappa = 0, steering = 0;
};

/// A path of the front axle's centre along a road, by places kStep apart: a band (RoadBand) from
/// where a state is, in the direction that it moves in.
class RoadPath {
 public:
  static constexpr double kStep = 0.5;  ///< [m]

  /// Where it is to lead: drawn to `offset` [m] from the line within about `over` [m], `spare` [m]
  /// off the edges and past what narrows the road, for `length` [m].
  struct Course {
    double offset = 0, over = 10, spare = 0.2, length = 50;
    std::vector<Narrowing> narrowings{};
  };
  RoadPath(const Road& road, const vehicle::Parameters& vehicle, const vehicle::State& start,
           const OnRoad& on, const Course& course);

  std::size_t size() const { return places_.size(); }
  double length() const { return kStep * static_cast<double>(places_.size() - 1); }
  /// The nearest place to s [m] along the path, on it.
  std::size_t index(double s) const;
  const PathPlace& operator[](std::size_t k) const { return places_[k]; }
  /// Linear between the places.
  PathPlace at(double s) const;

 private:
  void sample(const std::vector<Point>& points, double heading);
  void turn_body(const vehicle::Parameters& vehicle, double psi);

  std::vector<PathPlace> places_;
};

/// In which the front axle's centre of a vehicle moves [rad], and the curvature of its path [1/m].
double direction_of(const vehicle::State& state, const vehicle::Parameters& vehicle);
double curvature_of(const vehicle::State& state, const vehicle::Parameters& vehicle);

}  // namespace slalom::world
