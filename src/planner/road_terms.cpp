#include "road_terms.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "corridor_rows.hpp"
#include "slalom/expr/spline.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;
using ocp::Bounds;
using ocp::Expr;
using world::Point;

/// Shares of lateral acceleration and braking by which a vehicle can drive on from a plan's end.
constexpr double kLateralShare = 0.8, kBrakingShare = 0.7;
/// The slowest at which plans end [m/s].
constexpr double kCreep = 0.6;
/// Price of being faster at the end [1/(m/s)]; it is beside the cost of a final time of 1 s.
constexpr double kEndSpeed = 100;
/// How far tables go on before and beyond the road [m].
constexpr double kBeyond = 60;
/// The straight beyond an open road's end is looked at so far [m].
constexpr double kFarBeyond = 1e6;
/// An edge this far within the region lies within it [m].
constexpr double kWithin = 1e-6;

enum Column : std::size_t { kX, kY, kCos, kSin, kCurvature, kLeft, kRight };

/// Whether a straight from a to b enters the inside of a box: by its slabs.
bool enters(const world::Region& box, Point a, Point b) {
  double from = 0, to = 1;
  const auto cut = [&](double p, double q, double least, double most) {
    const double way = q - p;
    if (way == 0) return p > least + kWithin && p < most - kWithin;
    const double t0 = (least + kWithin - p) / way, t1 = (most - kWithin - p) / way;
    from = std::max(from, std::min(t0, t1));
    to = std::min(to, std::max(t0, t1));
    return from < to;
  };
  return cut(a.x, b.x, box.x_min, box.x_max) && cut(a.y, b.y, box.y_min, box.y_max);
}

/// Whether an edge, or what lies so far inwards of it [m], is within the region anywhere.
bool within_region(const world::Road& road, const world::Region& region, bool left,
                   double inwards) {
  std::vector<Point> edge;
  const auto add = [&](double s) {
    const auto at = road.at(s);
    edge.push_back(at.point() + at.aside() * (left ? at.left - inwards : inwards - at.right));
  };
  if (!road.closed()) add(-kFarBeyond);
  const double parts = std::ceil(road.length() / RoadTables::kKnot);
  for (double k = 0; k <= parts; ++k) add(road.length() * k / parts);
  if (!road.closed()) add(road.length() + kFarBeyond);
  for (std::size_t k = 0; k + 1 < edge.size(); ++k)
    if (enters(region, edge[k], edge[k + 1])) return true;
  return false;
}

}  // namespace

RoadTables::RoadTables(const world::Road& road, double radius, double margin, double beyond) {
  const double end = road.length() + (road.closed() ? beyond : kBeyond);
  for (double s = -kBeyond; s < end; s += kKnot) {
    const auto at = road.at(s);
    knots_.push_back(s);
    const std::array<double, 7> row = {at.x,
                                       at.y,
                                       std::cos(at.psi),
                                       std::sin(at.psi),
                                       at.curvature,
                                       at.left - margin - radius * std::hypot(1, at.left_slope),
                                       at.right - margin - radius * std::hypot(1, at.right_slope)};
    for (std::size_t k = 0; k < row.size(); ++k) columns_[k].push_back(row[k]);
  }
}

Expr RoadTables::table(const Expr& s, std::size_t column, bool goes_on) const {
  // Of a straight, and of one width: a number, of which all that follows is worked out beforehand.
  const auto& values = columns_[column];
  if (std::all_of(values.begin(), values.end(), [&](double v) { return v == values.front(); }))
    return values.front();
  return expr::cubic_spline(s, knots_, values, goes_on ? expr::Beyond::line : expr::Beyond::hold);
}

RoadTables::At RoadTables::at(const Expr& s) const {
  return {table(s, kX, true),     table(s, kY, true),          table(s, kCos, false),
          table(s, kSin, false),  table(s, kCurvature, false), table(s, kLeft, false),
          table(s, kRight, false)};
}

/// Of the vector (a, b) from the line's place to p along and across it, f = b - k (a^2 + b^2)/2 is
/// n - k n^2/2 of the offset n from the circle of curvature k.
Expr RoadTables::At::offset(const Expr& px, const Expr& py) const {
  const Expr dx = px - x, dy = py - y;
  const Expr f = cos * dy - sin * dx - curvature * (square(dx) + square(dy)) / 2;
  return 2 * f / (1 + sqrt(1 - 2 * curvature * f));
}

RoadTerms::RoadTerms(ocp::Problem& problem, const Task& task, const States& X, const States& rate)
    : road_(task.road), across_(!task.goal.is_place()) {
  const Settings& settings = task.planner;
  const auto discs = edge_discs(world::Footprint(task.vehicle));
  const RoadTables tables(*road_, discs.front().radius, settings.edge_clearance,
                          2 * (settings.L_range + settings.kappa) + kBeyond);
  const Expr s = problem.state("s");
  const auto place = [&](const Expr& along, const Expr& x, const Expr& y) {
    return Place{along, tables.at(along).offset(x, y)};
  };
  here_ = place(s, X[vehicle::X], X[Y]);
  const auto line = tables.at(s);
  direction_ = {line.cos, line.sin};
  problem.dynamics(
      s, (rate[vehicle::X] * line.cos + rate[Y] * line.sin) / (1 - line.curvature * here_[1]));
  const Expr s0 = problem.initial(s), x0 = problem.initial(X[vehicle::X]),
             y0 = problem.initial(X[Y]);
  initial_ = place(s0, x0, y0);
  final_ = place(problem.final(s), problem.final(X[vehicle::X]), problem.final(X[Y]));
  const auto begin = tables.at(s0);
  problem.boundary("foot of X(0)", (x0 - begin.x) * begin.cos + (y0 - begin.y) * begin.sin,
                   Bounds::equal(0));
  aim_ = problem.parameter("aim", 0);
  goal_ = {aim_, goal_offset(task).value_or(0)};
  add_edges(problem, task, X, tables, s);
  add_end_speed(problem, task, X);
}

void RoadTerms::add_edges(ocp::Problem& problem, const Task& task, const States& X,
                          const RoadTables& tables, const Expr& s) const {
  const auto discs = edge_discs(world::Footprint(task.vehicle));
  const std::array where = {" at the rear", " in the middle", " at the front"};
  const double inwards = task.planner.edge_clearance;
  const bool left = within_region(*road_, task.region, true, inwards);
  const bool right = within_region(*road_, task.region, false, inwards);
  for (std::size_t k = 0; k < discs.size(); ++k) {
    const double ahead = discs[k].ahead;
    const auto line = tables.at(s + ahead);
    const Expr n = discs.size() == 1 ? here_[1]
                                     : tables.at(s).offset(X[vehicle::X] + ahead * cos(X[PSI]),
                                                           X[Y] + ahead * sin(X[PSI]));
    const std::string of = discs.size() == 1 ? "" : where[k];
    if (left) problem.path("left edge of the road" + of, line.left - n, Bounds::at_least(0));
    if (right) problem.path("right edge of the road" + of, line.right + n, Bounds::at_least(0));
  }
}

/// Where the road is nowhere too sharp for the vehicle's greatest speed, there is no such row.
void RoadTerms::add_end_speed(ocp::Problem& problem, const Task& task, const States& X) {
  profile_ = drivable_speeds(*road_, task.vehicle, kLateralShare, kBrakingShare);
  if (profile_->slowest() >= task.vehicle.ux_max) return;
  reach_ = {task.planner.L_range - task.planner.kappa, task.planner.L_range + task.planner.kappa};
  end_speed_ = problem.parameter("end_speed", task.vehicle.ux_max);
  const auto row =
      problem.boundary("speed at the end", *end_speed_ - problem.final(X[UX]), Bounds::at_least(0));
  problem.soften(row, {ocp::Norm::l1, kEndSpeed, 0});
}

void RoadTerms::set(ocp::Problem& problem, const WayAhead& way) const {
  problem.set_parameter(aim_, way.aim);
  if (!end_speed_) return;
  double slowest = profile_->at(way.s + reach_[0]);
  for (double s = reach_[0]; s < reach_[1]; s += RoadTables::kKnot)
    slowest = std::min(slowest, profile_->at(way.s + s));
  problem.set_parameter(*end_speed_, std::max(slowest, kCreep));
}

std::vector<double> RoadTerms::along(double s, const ocp::Trajectory& trajectory) const {
  std::vector<Point> places;
  for (const auto& state : trajectory.states) places.push_back({state[vehicle::X], state[Y]});
  return follow(*road_, s, places);
}

Expr RoadTerms::turned(const Expr& psi) const {
  return 2 - 2 * (direction_[0] * cos(psi) + direction_[1] * sin(psi));
}

}  // namespace slalom::planner
