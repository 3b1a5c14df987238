#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "drivable_speed.hpp"
#include "road_way.hpp"
#include "slalom/ocp/problem.hpp"
#include "slalom/planner/task.hpp"
#include "slalom/vehicle/state.hpp"

namespace slalom::planner {

/// A road's line and widths as functions of the length along it in an OCP, by splines through knots
/// kKnot apart.
class RoadTables {
 public:
  /// What a length of the line is like: its place, its direction, its curvature, and how far to the
  /// left and to the right of it a disc of the vehicle may be.
  struct At {
    ocp::Expr x, y, cos, sin, curvature, left, right;

    /// How far a place near it lies to the left of the line [m]: beside the circle that touches
    /// the line, which is the line itself to second order in the way along it.
    ocp::Expr offset(const ocp::Expr& px, const ocp::Expr& py) const;
  };

  /// Of discs of a radius that keep a margin [m] from the edges. A closed road goes on for `beyond`
  /// [m] after its end.
  RoadTables(const world::Road& road, double radius, double margin, double beyond);

  At at(const ocp::Expr& s) const;
  static constexpr double kKnot = 1;  ///< [m]

 private:
  ocp::Expr table(const ocp::Expr& s, std::size_t column, bool goes_on) const;

  std::vector<double> knots_;
  std::array<std::vector<double>, 7> columns_;
};

/// A road in the paper's OCP. Its region, its edge of the LiDAR's range, its terms of the goal and
/// of the area beside the line through it are stated along and across the road's line, as if that
/// were unrolled: on a straight road nothing changes. For that, the length s along the line is a
/// state, s' = (x' cos + y' sin)/(1 - curvature n) (R. Verschueren et al., "Towards time-optimal
/// race car driving using nonlinear MPC in real-time", IEEE CDC 2014), which begins at the foot of
/// X(0). An edge that lies nowhere within the region is not there: the region's own bounds keep the
/// vehicle from it.
class RoadTerms {
 public:
  using States = std::array<ocp::Expr, vehicle::kStates>;
  /// Along the line and across it [m].
  using Place = std::array<ocp::Expr, 2>;

  /// Adds the state and the rows of the edges to a problem with these states and rates.
  RoadTerms(ocp::Problem& problem, const Task& task, const States& states, const States& rates);

  const Place& here() const { return here_; }
  const Place& initial() const { return initial_; }
  const Place& final() const { return final_; }
  /// Where a plan that comes to the goal ends; of a goal across the whole road, on the line.
  const Place& goal() const { return goal_; }
  bool goal_is_across() const { return across_; }
  /// How many times the paper's price the slack on the initial state has: 1, unless the vehicle
  /// must slow down for the road's bends. At that price a plan that comes near to an edge begins
  /// with, say, .025 rad of steering that the vehicle has not, in each cycle anew, and it runs
  /// wide.
  double slack_price() const { return end_speed_ ? 10 : 1; }
  void set(ocp::Problem& problem, const WayAhead& way) const;
  /// The state along a trajectory of the plant's states that begins about s [m].
  std::vector<double> along(double s, const ocp::Trajectory& trajectory) const;
  /// The square of the angle between a heading and the line's direction [rad^2], to fourth order in
  /// it; of whatever turn.
  ocp::Expr turned(const ocp::Expr& psi) const;

 private:
  void add_edges(ocp::Problem& problem, const Task& task, const States& states,
                 const RoadTables& tables, const ocp::Expr& s) const;
  void add_end_speed(ocp::Problem& problem, const Task& task, const States& states);

  std::shared_ptr<const world::Road> road_;
  Place here_, initial_, final_, goal_;
  Place direction_;  ///< of the line beside the vehicle, as cosine and sine
  ocp::Expr aim_;
  bool across_ = false;
  std::optional<SpeedProfile> profile_;
  std::optional<ocp::Expr> end_speed_;  ///< a parameter
  std::array<double, 2> reach_{};       ///< along the line, within which plans end [m]
};

}  // namespace slalom::planner
