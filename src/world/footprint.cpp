#include "slalom/world/footprint.hpp"

#include <algorithm>
#include <cmath>

#include "covering.hpp"

namespace slalom::world {

using vehicle::State;

Footprint::Footprint(const vehicle::Parameters& vehicle) {
  if (vehicle.footprint == vehicle::FootprintKind::point) return;
  corners_ = Polygon::rectangle(vehicle.length, vehicle.width,
                                {vehicle.front_overhang - vehicle.length / 2, 0})
                 .corners();
  for (const Point& p : corners_) reach_ = std::max(reach_, p.norm());
}

std::vector<Point> Footprint::at(const State& state) const {
  const Pose pose{state[vehicle::X], state[vehicle::Y], state[vehicle::PSI]};
  std::vector<Point> corners;
  corners.reserve(corners_.size());
  for (const Point& p : corners_) corners.push_back(pose.to_world(p));
  return corners;
}

std::vector<Disc> Footprint::covering_discs(double excess) const {
  if (is_point()) return {{}};
  const double front = corners_[0].x, back = corners_[1].x;
  auto discs = discs_along(front - back, 2 * corners_[0].y, excess);
  for (Disc& disc : discs) disc.ahead += (front + back) / 2;
  return discs;
}

double Footprint::distance(const Obstacle& obstacle, const State& state, double t) const {
  if (is_point()) return world::distance(obstacle, state[vehicle::X], state[vehicle::Y], t);
  return world::distance(obstacle, at(state), t);
}

double Footprint::edge_distance(const Road& road, const State& state) const {
  if (is_point()) return road.edge_distance(Point{state[vehicle::X], state[vehicle::Y]});
  return road.edge_distance(at(state));
}

}  // namespace slalom::world
