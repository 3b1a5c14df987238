#include "slalom/world/footprint.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slalom::world {

using vehicle::State;

namespace {

/// Discs of one radius along the middle of a rectangle, `ahead` of its centre, that cover it: the
/// fewest that stick out of its long sides by at most `excess` [m]; kMostDiscs if that is too few.
std::vector<Disc> discs_along(double length, double width, double excess) {
  const double half = width / 2, radius = half + excess;
  const double part = 2 * std::sqrt(radius * radius - half * half);
  const double wanted = std::clamp(std::ceil(length / part - 1e-9), 1.0, double{kMostDiscs});
  std::vector<Disc> discs;
  for (double k = 0; k < wanted; ++k)
    discs.push_back({length * ((k + 0.5) / wanted - 0.5), std::hypot(length / wanted / 2, half)});
  return discs;
}

}  // namespace

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

double Footprint::outside(const Region& region, const State& state) const {
  if (is_point()) return region.outside(state[vehicle::X], state[vehicle::Y]);
  double most = -std::numeric_limits<double>::infinity();
  for (const Point& p : at(state)) most = std::max(most, region.outside(p.x, p.y));
  return most;
}

}  // namespace slalom::world
