// Where a path leaves room for the vehicle's body: on the road, and off obstacles in time.

#include <algorithm>
#include <cmath>

#include "path_speeds.hpp"

namespace slalom::world {
namespace {

using vehicle::State;

/// Nearer than this to what is to be kept a place is looked at itself, not the path's next [m]: so
/// far a body's points are from each other there.
constexpr double kNear = 0.3;
/// After such a way from a start that is too near to an edge a body keeps from it what is to be
/// kept [m]; it leaves the edge ever faster.
constexpr double kComesBack = 8;
/// A stop is looked at so often [s].
constexpr double kStandLook = 0.25;

}  // namespace

State PathSpeeds::state_of(const PathPlace& place, double v) {
  State x{};
  x[vehicle::X] = place.x;
  x[vehicle::Y] = place.y;
  x[vehicle::PSI] = place.psi;
  x[vehicle::UX] = v;
  return x;
}

bool PathSpeeds::is_free(double along, std::int32_t look) {
  const std::size_t at = path_->index(along);
  auto& known = free_[static_cast<std::size_t>(look) * path_->size() + at];
  const double t = time_at(look);
  if (known == Known::nothing) {
    const double spare = on_road(at) ? spare_at((*path_)[at], t) : -kNear;
    known = spare >= kNear ? Known::free : spare <= -kNear ? Known::taken : Known::near;
  }
  if (known == Known::near) return spare_at(path_->at(along), t) >= 0;
  return known == Known::free;
}

/// Near to the start the body is as near to an edge as it was there, and then comes back, which a
/// body does that stands, too.
bool PathSpeeds::on_road(std::size_t at) const {
  const double here = RoadPath::kStep * static_cast<double>(at), wanted = question_->search.edge;
  double edge = wanted;
  if (first_edge_ < wanted && here < question_->start[vehicle::UX] * kToComeBack)
    edge = first_edge_;
  else if (first_edge_ < wanted)
    edge += (first_edge_ - wanted) * (1 - std::pow(std::min(1., here / kComesBack), 2));
  return footprint_.edge_distance(*environment_.road, state_of((*path_)[at], 0)) >= edge;
}

/// By how much the body keeps off what is to be kept, up to kNear [m].
double PathSpeeds::spare_at(const PathPlace& place, double t) const {
  const State x = state_of(place, 0);
  double least = kNear;
  for (std::size_t k = 0; k < keeps_.size() && least > -kNear; ++k) {
    const Obstacle& o = question_->obstacles[k];
    if (!o.present(t, t)) continue;
    const double need = keeps_[k] + o.margin(t);
    const Pose pose = o.pose_at(t);
    const double reach = o.reach() + footprint_.reach() + need + kNear;
    const double dx = pose.x - place.x, dy = pose.y - place.y;
    if (dx * dx + dy * dy > reach * reach) continue;
    least = std::min(least, footprint_.distance(o, x, t) - need);
  }
  return least;
}

/// Whether nothing stands there.
bool PathSpeeds::stays_clear(std::size_t at) const {
  const State x = state_of((*path_)[at], 0);
  const double t = question_->t_start;
  for (std::size_t k = 0; k < keeps_.size(); ++k) {
    const Obstacle& o = question_->obstacles[k];
    if (!o.moves() && footprint_.distance(o, x, t) < keeps_[k] + o.margin(t)) return false;
  }
  return true;
}

bool PathSpeeds::stands_for_good(const Place& place) const {
  const PathPlace at = path_->at(place.s);
  const double begin = time_at(place.looks), end = begin + question_->search.standing_horizon;
  for (double t = begin; t <= end; t += kStandLook) {
    if (spare_at(at, t) < 0) return false;
    const auto& obstacles = question_->obstacles;
    if (std::none_of(obstacles.begin(), obstacles.end(),
                     [&](const auto& o) { return o.moves() && o.present(t, end); }))
      return true;
  }
  return true;
}

}  // namespace slalom::world
