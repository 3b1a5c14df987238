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
constexpr double kLongest = 1000, kBeyond = 30;
/// From the edges paths keep so much more than ways are to keep [m].
constexpr double kBand = 0.06;
/// Beside what stands paths keep so much more than ways are to keep [m].
constexpr double kBeside = 0.1;
/// A path that comes aside by at most twice this slope keeps the distance aside of what stands also
/// before and behind it, if it keeps it for this share of it longer.
constexpr double kSlant = 0.25;

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
    const double length = length_of(aim, v, t_start, to_go);
    if (length > kLongest) return found;
    const auto narrow = narrowings(question, on, search.clearance + kBeside);
    for (const double offset : offsets(on))
      for (const MoveOver& by : kMoves) {
        if (out_of_budget && out_of_budget()) return found;
        const double over = std::max(by.least, by.time * v);
        const RoadPath path(road, vehicle_, start, on,
                            {offset, over, search.edge + kBand, length, narrow});
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
    const double half = goal.half_length();
    const double ahead =
        by_the_lap(goal, road, (line ? goal.s : road.project({goal.x, goal.y}).s) - on.s);
    return {std::max(ahead - half, 0.), line ? kNowhere : ahead + half};
  }

  /// Of the paths that are wanted [m]: as far as the vehicle may come.
  double length_of(PathSpeeds::Aim aim, double v, double t_start, double to_go) const {
    const Goal& goal = environment_.goal;
    const double stop = v * v / -vehicle_.ax_min_at(v) + v + kBeyond;
    if (aim == PathSpeeds::Aim::stand) return std::min(kLongest, 2 * stop);
    if (goal.kind() != GoalKind::time) return to_go + 2 * goal.half_length() + stop + kBeyond;
    const double t = std::max(0., goal.time - t_start) + 2;
    const double fastest = std::max(v, vehicle_.ux_max) * t;
    return std::min(fastest, v * t + vehicle_.ax_max_at(v) * t * t / 2) + kBeyond;
  }

  /// What stands on the road ahead, to be passed where there is more room; of a closed road as
  /// often as the longest path comes by.
  std::vector<Narrowing> narrowings(const PathSpeeds::Question& question, const OnRoad& on,
                                    double clearance) const {
    const Road& road = *environment_.road;
    const Footprint footprint(vehicle_);
    double ahead = 0, behind = 0;
    for (const Point& corner : footprint.corners()) {
      ahead = std::max(ahead, corner.x);
      behind = std::max(behind, -corner.x);
    }
    std::vector<Narrowing> result;
    for (const Obstacle& o : question.obstacles) {
      if (o.moves()) continue;
      const auto [least, most] = taken(o, clearance + o.margin(question.t_start));
      const RoadPlace at = road.at((least.s + most.s) / 2);
      if (least.n > at.left || most.n < -at.right) continue;
      const bool on_the_left = least.n + at.right > at.left - most.n;
      const double edge = on_the_left ? least.n : most.n;
      double from = least.s - ahead, to = most.s + behind;
      if (road.closed()) {
        const double passed = road.length() * std::ceil((on.s - to) / road.length());
        from += passed;
        to += passed;
      }
      do {
        result.push_back({from, to, on_the_left, edge});
        from += road.length();
        to += road.length();
      } while (road.closed() && from < on.s + kLongest);
    }
    return result;
  }

  /// What an obstacle takes of the road, larger by so much: its least and greatest n, and the s
  /// between which paths are beside it. Of a closed road s is that of its first point or about it,
  /// for the seam may lie between.
  std::pair<OnRoad, OnRoad> taken(const Obstacle& obstacle, double larger) const {
    const Road& road = *environment_.road;
    const Obstacle large = obstacle.grown(larger);
    // Where the road bends, a side's middle may be nearer to its line than both corners are. A
    // polygon grows by its rounding: its corners stay where they are.
    std::vector<Point> points = large.corners_at(0);
    const std::size_t sides = points.size();
    const double around = sides == 0 ? large.reach() : large.rounding;
    for (std::size_t k = 0; k < sides; ++k)
      points.push_back((points[k] + points[(k + 1) % sides]) * 0.5);
    if (sides == 0) points.push_back({large.x, large.y});
    OnRoad least{HUGE_VAL, HUGE_VAL}, most{-HUGE_VAL, -HUGE_VAL};
    const double first = road.project(points[0]).s;
    for (const Point& point : points) {
      const auto [s, n] = road.project(point);
      const double near = road.unwrapped(s, first);
      least = {std::min(least.s, near - kSlant * around), std::min(least.n, n - around)};
      most = {std::max(most.s, near + kSlant * around), std::max(most.n, n + around)};
    }
    return {least, most};
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
