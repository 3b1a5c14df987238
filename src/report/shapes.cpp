#include "shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slalom::report {
namespace {

using world::TrajectoryRow;

constexpr int kPoints = 48;      ///< of a whole turn
constexpr double kRoadStep = 2;  ///< along a road [m], and of a long one so many steps:
constexpr double kRoadSteps = 8000;
constexpr double kStep = 0.1;     ///< between looks at a motion [s]
constexpr double kMoment = 1e-3;  ///< [s]
constexpr double kPlace = 0.01;   ///< [m]
constexpr double kTurn = 0.0087;  ///< [rad]

/// A polygon's edge, its corners rounded by the obstacle's rounding, in the body's frame.
std::vector<world::Point> rounded(const std::vector<world::Point>& corners, double rounding) {
  if (rounding == 0) return corners;
  std::vector<world::Point> edge;
  const std::size_t n = corners.size();
  for (std::size_t k = 0; k < n; ++k) {
    const world::Point in = corners[k] - corners[(k + n - 1) % n],
                       out = corners[(k + 1) % n] - corners[k];
    const double turn = std::atan2(world::cross(in, out), world::dot(in, out));
    const double from = std::atan2(in.y, in.x) - std::numbers::pi / 2;
    const double parts = std::ceil(turn / (2 * std::numbers::pi) * kPoints) + 1;
    for (double i = 0; i <= parts; ++i) {
      const double angle = from + turn * i / parts;
      edge.push_back(corners[k] + world::Point{std::cos(angle), std::sin(angle)} * rounding);
    }
  }
  return edge;
}

/// Keeps, of rows[first] to rows[last], those that the others lie evenly between.
void thin_out(const std::vector<TrajectoryRow>& rows, std::size_t first, std::size_t last,
              std::vector<TrajectoryRow>& kept) {
  const auto &a = rows[first], &b = rows[last];
  double most = 1;
  std::size_t at = last;
  for (std::size_t k = first + 1; k < last; ++k) {
    const double share = (rows[k].t - a.t) / (b.t - a.t);
    const auto off = [&](double TrajectoryRow::*of) {
      return std::fabs(rows[k].*of - a.*of - share * (b.*of - a.*of));
    };
    const double error = std::max({off(&TrajectoryRow::x), off(&TrajectoryRow::y)}) / kPlace +
                         off(&TrajectoryRow::psi) / kTurn;
    if (error <= most) continue;
    most = error;
    at = k;
  }
  if (at == last) {
    kept.push_back(b);
    return;
  }
  thin_out(rows, first, at, kept);
  thin_out(rows, at, last, kept);
}

}  // namespace

std::vector<world::Point> edge_of(const world::Obstacle& obstacle, double t) {
  std::vector<world::Point> edge;
  if (obstacle.outline) {
    edge = rounded(obstacle.outline->corners(), obstacle.rounding);
  } else {
    for (int k = 0; k < kPoints; ++k) {
      const double angle = 2 * std::numbers::pi * k / kPoints;
      edge.push_back({obstacle.a * std::cos(angle), obstacle.b * std::sin(angle)});
    }
  }
  const world::Pose pose = obstacle.pose_at(t);
  for (world::Point& p : edge) p = pose.to_world(p);
  return edge;
}

Track track_of(const world::Trajectory& trajectory, double begin, double end, std::size_t most) {
  Track track;
  std::vector<TrajectoryRow> rows;
  const auto add = [&](double t) {
    const auto pose = trajectory.at(t);
    rows.push_back({t, pose.x, pose.y, pose.psi});
  };
  // The last time at which it is there, or the first, between that and one at which it is not.
  const auto edge = [&](double there, double gone) {
    while (std::fabs(gone - there) > kMoment) {
      const double t = (there + gone) / 2;
      (trajectory.present(t, t) ? there : gone) = t;
    }
    return there;
  };
  const auto count = std::clamp<std::size_t>(
      static_cast<std::size_t>(std::ceil(std::max(end - begin, 0.0) / kStep)), 1, most);
  double last = begin;
  bool was = trajectory.present(begin, begin);
  for (std::size_t k = 0; k <= count; ++k) {
    const double t = begin + (end - begin) * static_cast<double>(k) / static_cast<double>(count);
    const bool is = trajectory.present(t, t);
    if (is && !was) add(edge(t, last));
    if (was && !is) add(edge(last, t));
    if (is && (rows.empty() || t > rows.back().t)) add(t);
    was = is;
    last = t;
  }
  if (rows.empty()) return track;
  track.appears = rows.front().t > begin;
  track.vanishes = rows.back().t < end;
  track.rows.push_back(rows.front());
  if (rows.size() > 1) thin_out(rows, 0, rows.size() - 1, track.rows);
  return track;
}

RoadLines lines_of(const world::Road& road) {
  const double step = std::max(kRoadStep, road.length() / kRoadSteps);
  RoadLines lines{road.edge(true, step), road.edge(false, step), {}};
  const double parts = std::ceil(road.length() / step);
  for (double k = 0; k <= parts; ++k)
    lines.middle.push_back(road.at(road.length() * k / parts).point());
  if (road.closed())
    for (auto* line : {&lines.left, &lines.right}) line->push_back(line->front());
  return lines;
}

std::vector<world::Point> goal_shape(const sim::Scenario& scenario) {
  const auto& goal = scenario.goal;
  const auto across = [&](double s) {
    const auto at = scenario.road->at(s);
    return std::vector<world::Point>{at.point() + at.aside() * at.left,
                                     at.point() - at.aside() * at.right};
  };
  const auto box = [&](double psi, double length, double width) {
    const world::Pose pose{goal.x, goal.y, psi};
    std::vector<world::Point> corners;
    const auto rectangle = world::Polygon::rectangle(length, width);
    for (const auto& p : rectangle.corners()) corners.push_back(pose.to_world(p));
    return corners;
  };
  switch (goal.kind()) {
    case world::GoalKind::square:
      return box(0, 2 * goal.sigma, 2 * goal.sigma);
    case world::GoalKind::rectangle:
      return box(goal.psi, goal.length, goal.width);
    case world::GoalKind::line:
      return across(goal.s);
    case world::GoalKind::laps:
      return across(
          scenario.road->project({scenario.start[vehicle::X], scenario.start[vehicle::Y]}).s);
    case world::GoalKind::time:
      break;
  }
  return {};
}

}  // namespace slalom::report
