#include "slalom/world/road_ways.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "path_speeds.hpp"
#include "road_path.hpp"
#include "slalom/world/footprint.hpp"

namespace slalom::world {
namespace {

using vehicle::State;

/// Within so many seconds at the vehicle's speed, and so many metres at the least, a path has moved
/// over.
struct MoveOver {
  double time, least;
};
constexpr std::array kMoves = {MoveOver{1.5, 12}, MoveOver{0.8, 6}, MoveOver{3, 25}};
/// Offsets that are nearer to each other are one [m]; from an edge to the body at the outmost [m].
constexpr double kSameOffset = 0.2, kSpare = 0.15;
/// What a way costs for each metre that its path moves over [s].
constexpr double kMovingOver = 0.05;
/// Longest paths [m], and beyond the goal [m].
constexpr double kLongest = 400, kBeyond = 30;
/// From the edges paths keep so much more than ways are to keep [m].
constexpr double kBand = 0.06;
/// Beside what stands paths keep so much more than ways are to keep [m].
constexpr double kBeside = 0.1;

}  // namespace

class RoadWays::Impl {
 public:
  Impl(const Environment& environment, const vehicle::Parameters& vehicle)
      : environment_(environment), vehicle_(vehicle), speeds_(environment_, vehicle) {}

  std::vector<RoadWay> find(PathSpeeds::Aim aim, const State& start, double t_start,
                            const std::vector<Obstacle>& obstacles, const RoadWaySearch& search,
                            const std::function<bool()>& out_of_budget) {
    const Road& road = *environment_.road;
    const OnRoad on = road.project({start[vehicle::X], start[vehicle::Y]});
    const double v = std::max(start[vehicle::UX], 0.);
    const auto [to_go, to_leave] = goal_ahead(aim, on);
    const PathSpeeds::Question question{aim,    start, t_start,  obstacles,
                                        search, to_go, to_leave, out_of_budget};
    std::vector<RoadWay> found;
    const auto narrow = narrowings(obstacles, search.clearance + kBeside);
    for (const double offset : offsets(on))
      for (const MoveOver& by : kMoves) {
        if (out_of_budget && out_of_budget()) return found;
        const double over = std::max(by.least, by.time * v);
        const RoadPath path(
            road, vehicle_, start, on,
            {offset, over, search.edge + kBand, length_of(aim, v, t_start, to_go), narrow});
        if (auto way = speeds_.run(path, question)) {
          way->cost += kMovingOver * std::fabs(offset - on.n);
          found.push_back(std::move(*way));
        }
      }
    std::stable_sort(found.begin(), found.end(), [](const RoadWay& a, const RoadWay& b) {
      if (a.complete != b.complete) return a.complete;
      return a.complete ? a.cost < b.cost : a.end > b.end;
    });
    return found;
  }

 private:
  /// From a place on the road along it to where the goal begins and ends [m].
  std::pair<double, double> goal_ahead(PathSpeeds::Aim aim, const OnRoad& on) const {
    constexpr double kNowhere = std::numeric_limits<double>::infinity();
    const Road& road = *environment_.road;
    const Goal& goal = environment_.goal;
    const bool line = goal.kind() == GoalKind::line;
    if (aim == PathSpeeds::Aim::stand || (!line && !goal.is_place())) return {0, kNowhere};
    const double half = goal_half();
    double ahead = (line ? goal.s : road.project({goal.x, goal.y}).s) - on.s;
    if (road.closed() && ahead < -half) ahead += road.length();
    return {std::max(ahead - half, 0.), line ? kNowhere : ahead + half};
  }

  double length_of(PathSpeeds::Aim aim, double v, double t_start, double to_go) const {
    const Goal& goal = environment_.goal;
    const double stop = v * v / -vehicle_.ax_min_at(v) + v + kBeyond;
    if (aim == PathSpeeds::Aim::stand) return std::min(kLongest, 2 * stop);
    if (goal.kind() != GoalKind::time)
      return std::min(kLongest, to_go + 2 * goal_half() + stop + kBeyond);
    const double t = std::max(0., goal.time - t_start) + 2;
    return std::min(kLongest, v * t + vehicle_.ax_max_at(v) * t * t / 2 + kBeyond);
  }

  double goal_half() const {
    const Goal& goal = environment_.goal;
    if (!goal.is_place()) return 0;
    return goal.kind() == GoalKind::square ? goal.sigma : goal.length / 2;
  }

  /// What stands on the road, to be passed where there is more room.
  std::vector<Narrowing> narrowings(const std::vector<Obstacle>& obstacles,
                                    double clearance) const {
    const Road& road = *environment_.road;
    const Footprint footprint(vehicle_);
    double ahead = 0, behind = 0;
    for (const Point& corner : footprint.corners()) {
      ahead = std::max(ahead, corner.x);
      behind = std::max(behind, -corner.x);
    }
    std::vector<Narrowing> result;
    for (const Obstacle& o : obstacles) {
      if (o.moves()) continue;
      auto corners = o.grown(clearance).corners_at(0);
      if (corners.empty())
        for (const double x : {-1., 1.})
          for (const double y : {-1., 1.})
            corners.push_back(
                {o.x + x * (o.reach() + clearance), o.y + y * (o.reach() + clearance)});
      OnRoad least{HUGE_VAL, HUGE_VAL}, most{-HUGE_VAL, -HUGE_VAL};
      for (const Point& corner : corners) {
        const OnRoad on = road.project(corner);
        least = {std::min(least.s, on.s), std::min(least.n, on.n)};
        most = {std::max(most.s, on.s), std::max(most.n, on.n)};
      }
      const RoadPlace at = road.at((least.s + most.s) / 2);
      if (least.n > at.left || most.n < -at.right) continue;
      const bool on_the_left = least.n + at.right > at.left - most.n;
      result.push_back(
          {least.s - ahead, most.s + behind, on_the_left, on_the_left ? least.n : most.n});
    }
    return result;
  }

  /// Offsets from the line that paths come to: the goal's, that of the start, and across the road.
  std::vector<double> offsets(const OnRoad& on) const {
    const RoadPlace at = environment_.road->at(on.s);
    const bool point = vehicle_.footprint == vehicle::FootprintKind::point;
    const double half = (point ? 0 : vehicle_.width / 2) + kSpare;
    const double middle = (at.left - at.right) / 2;
    const double right = std::min(half - at.right, middle), left = std::max(at.left - half, middle);
    std::vector<double> result;
    const auto put = [&](double offset) {
      for (const double before : result)
        if (std::fabs(before - offset) < kSameOffset) return;
      result.push_back(offset);
    };
    const Goal& goal = environment_.goal;
    if (goal.is_place()) put(environment_.road->project({goal.x, goal.y}).n);
    put(std::clamp(on.n, right, left));
    put(middle);
    put(right);
    put(left);
    return result;
  }

  const Environment environment_;
  const vehicle::Parameters vehicle_;
  PathSpeeds speeds_;
};

RoadWays::RoadWays(const Environment& environment, const vehicle::Parameters& vehicle)
    : impl_(std::make_unique<Impl>(environment, vehicle)) {}
RoadWays::~RoadWays() = default;
RoadWays::RoadWays(RoadWays&&) noexcept = default;
RoadWays& RoadWays::operator=(RoadWays&&) noexcept = default;

std::vector<RoadWay> RoadWays::to_goal(const State& start, double t_start,
                                       const std::vector<Obstacle>& obstacles,
                                       const RoadWaySearch& search,
                                       const std::function<bool()>& out_of_budget) {
  return impl_->find(PathSpeeds::Aim::arrive, start, t_start, obstacles, search, out_of_budget);
}

std::vector<RoadWay> RoadWays::to_stand(const State& start, double t_start,
                                        const std::vector<Obstacle>& obstacles,
                                        const RoadWaySearch& search,
                                        const std::function<bool()>& out_of_budget) {
  return impl_->find(PathSpeeds::Aim::stand, start, t_start, obstacles, search, out_of_budget);
}

}  // namespace slalom::world
