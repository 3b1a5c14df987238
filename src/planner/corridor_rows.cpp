#include "corridor_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace slalom::planner {
namespace {

using namespace vehicle;
using ocp::Expr;
using world::Point;

/// The sharpest circle that an edge is taken for [1/m]: where an inner edge folds it has none.
constexpr double kSharpest = 0.5;
/// How far an answer's points may be from the guess's along the road: while it turns by so much
/// [rad], within these bounds [m].
constexpr double kShiftTurn = 0.15, kLeastShift = 3, kMostShift = 12;
/// A start that is nearer to an edge than discs are to be leaves it at this rate [m/s], from so
/// much nearer still [m].
constexpr double kLeaving = 0.5, kNearer = 0.03;

/// An edge about a place along the road.
struct Edge {
  Point at, inwards;
  double bend;  ///< curvature, positive where the road lies on its centre's side [1/m]
};

Edge edge_at(const world::RoadPlace& road, bool left) {
  const double side = left ? 1 : -1, width = left ? road.left : road.right;
  const double slope = left ? road.left_slope : road.right_slope;
  const double shrink = 1 - side * road.curvature * width;  // of lengths along the edge
  const Point along = road.ahead() * std::max(shrink, 0.1) + road.aside() * (side * slope);
  const double length = along.norm();
  const Point tangent = along * (1 / length);
  const double bend = -side * road.curvature / std::max(shrink, 0.1);
  return {road.point() + road.aside() * (side * width), Point{side * tangent.y, -side * tangent.x},
          std::clamp(bend, -kSharpest, kSharpest)};
}

double spare_of(double radius, double bend) {
  return radius - bend * radius * radius / 2;
}

}  // namespace

std::vector<world::Disc> edge_discs(const world::Footprint& footprint) {
  if (footprint.is_point()) return {{}};
  const double front = footprint.corners()[0].x, back = footprint.corners()[1].x;
  const double half = footprint.corners()[0].y;
  return {{back, half}, {(back + front) / 2, half}, {front, half}};
}

CorridorRows::CorridorRows(ocp::Problem& problem, const Expr& X, const Expr& Y, const Expr& psi,
                           const world::Footprint& footprint)
    : discs_(edge_discs(footprint)), rows_{}, along_{} {
  const auto symbol = [](const char* name) { return Expr::symbol(name); };
  const Symbols s{symbol("xe"),   symbol("ye"),    symbol("nx"),   symbol("ny"),
                  symbol("bend"), symbol("spare"), symbol("ahead")};
  const bool point = footprint.is_point();
  const Expr dx = (point ? X : X + s.ahead * cos(psi)) - s.x;
  const Expr dy = (point ? Y : Y + s.ahead * sin(psi)) - s.y;
  std::vector<Expr> symbols{s.x, s.y, s.nx, s.ny, s.bend, s.spare};
  if (!point) symbols.push_back(s.ahead);
  rows_ =
      problem.path_family("road edge", symbols,
                          s.nx * dx + s.ny * dy - s.bend * (square(dx) + square(dy)) / 2 - s.spare,
                          ocp::Bounds::at_least(0), ocp::Points::after_first);
  std::vector<std::string> names;
  std::vector<std::vector<double>> nothing;
  for (std::size_t k = 0; k < 2 * discs_.size(); ++k) {
    names.push_back(fmt::format("{}", k));
    nothing.push_back(std::vector<double>(symbols.size(), 0));
  }
  problem.set_members(rows_, std::move(names), std::move(nothing));
  along_ = problem.path_family("along the guess", {s.x, s.y, s.nx, s.ny, s.spare},
                               (s.nx * (X - s.x) + s.ny * (Y - s.y)) / s.spare, {-1, 1},
                               ocp::Points::after_first);
  problem.set_members(along_, {"guess"}, {{0, 0, 1, 0, 1}});
}

void CorridorRows::set_along(ocp::Problem& problem, const world::Road& road,
                             const std::vector<State>& at) const {
  std::vector<double> list;
  for (const State& x : at) {
    const double s = road.project({x[X], x[Y]}).s;
    double sharpest = 0;
    for (double part = -1; part <= 1; part += 0.5)
      sharpest = std::max(sharpest, std::fabs(road.at(s + part * kMostShift).curvature));
    const double shift = std::clamp(kShiftTurn / sharpest, kLeastShift, kMostShift);
    const Point ahead = road.at(s).ahead();
    list.insert(list.end(), {x[X], x[Y], ahead.x, ahead.y, shift});
  }
  problem.set_members(along_, {"guess"}, {std::move(list)});
}

void CorridorRows::set(ocp::Problem& problem, const world::Road& road, const std::vector<State>& at,
                       const std::vector<double>& after, double margin) const {
  const bool point = discs_.size() == 1 && discs_[0].radius == 0;
  std::vector<std::string> names;
  std::vector<std::vector<double>> numbers;
  for (const auto& disc : discs_)
    for (const bool left : {false, true}) {
      std::vector<double> list;
      const double wanted = disc.radius + margin;
      double first = wanted;
      for (std::size_t k = 0; k < at.size(); ++k) {
        const Point centre{at[k][X] + disc.ahead * std::cos(at[k][PSI]),
                           at[k][Y] + disc.ahead * std::sin(at[k][PSI])};
        const world::OnRoad on = road.project(centre);
        const world::RoadPlace place = road.at(on.s);
        if (k == 0) first = (left ? place.left - on.n : place.right + on.n) - kNearer;
        const double radius = std::min(wanted, first + kLeaving * after[k]);
        const Edge edge = edge_at(place, left);
        list.insert(list.end(), {edge.at.x, edge.at.y, edge.inwards.x, edge.inwards.y, edge.bend,
                                 spare_of(radius, edge.bend)});
        if (!point) list.push_back(disc.ahead);
      }
      names.push_back(fmt::format("{}", numbers.size()));
      numbers.push_back(std::move(list));
    }
  problem.set_members(rows_, std::move(names), std::move(numbers));
  set_along(problem, road, at);
}

}  // namespace slalom::planner
