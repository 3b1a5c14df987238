#pragma once

#include <algorithm>
#include <array>
#include <string>

#include "slalom/base/options.hpp"
#include "slalom/vehicle/model.hpp"

namespace slalom::planner {

enum class SchemeChoice { trapezoidal, hermite_simpson, backward_euler };
/// The method that solves the NLP.
enum class SolverChoice { interior_point, ipopt };
/// Its name in nlp::backends() and in files.
const char* to_string(SolverChoice solver);
/// Form of the wheel-load cost: the paper's tanh pair, or with 2 added (zero when safe).
enum class WheelLoadCost { paper, shifted };

/// Whether a plan must keep off obstacles, or pays a cost for entering them.
enum class ObstacleConstraint { hard, soft };

/// The obstacles that a plan avoids.
enum class ObstacleChoice { all, in_reach, nearest };

/// The predicted motion of an obstacle with a trajectory: along the trajectory; from its position
/// at planning straight on at its velocity; or from there on at its speed and turn rate.
enum class Prediction { known, constant_velocity, constant_turn };

/// What happens to a plan that goes through an obstacle between its nodes: nothing; a report; a new
/// solve on finer meshes; the last if something has a shape (refines()), else a report.
enum class BetweenNodes { ignore, report, refine, by_shape };

/// How a planner plans: the paper's OCP over a receding horizon; whole ways to the goal, verified
/// before they are driven; or the fastest motion along a road without obstacles.
enum class Method { receding_horizon, verified, along_road };

/// The obstacles that a verifying planner knows: all, or those within L_range.
enum class Known { all, range };

/// What a verifying planner assumes beyond L_range if it knows only the obstacles within it: that
/// there is nothing, or that anything may stand there.
enum class Unseen { nothing, standing };

/// Settings of the trajectory-planning OCP; names as in section 3 of docs/formulation.md.
struct Settings {
  std::string name = "P_D";
  Method method = Method::receding_horizon;

  // The differences between the planners P_A to P_D.
  double w_t = 100;              ///< weight of final time [1/s]
  double w_ce = 1;               ///< weight of control effort [1]
  bool moving_avoidance = true;  ///< predict obstacle motion over the horizon

  // Obstacles and how a plan keeps off them.
  ObstacleChoice obstacle_choice = ObstacleChoice::all;
  int obstacle_count = 5;         ///< for `nearest`
  double obstacle_group_gap = 0;  ///< nearer obstacles become one ellipse [m]; 0: none
  ObstacleConstraint obstacle_constraint = ObstacleConstraint::hard;
  double w_obstacle = 1000;  ///< for `soft`: weight of the rows' excess (l1) [1/s]
  Prediction prediction = Prediction::known;
  double cover_excess = 0.2;  ///< by which discs stick out of the bodies that they cover [m]
  BetweenNodes between_nodes = BetweenNodes::by_shape;
  double passage_depth = 0.5;  ///< how deep a plan may enter a margin between its nodes [m]
  /// The same, but no deeper than the margin [m].
  double most_passage() const { return std::min({passage_depth, sm_start, sm_end}); }
  bool retry_sides = false;  ///< if there is no plan, try again from the left and the right

  /// The planner's model of the vehicle, whatever the plant is.
  vehicle::ModelKind model = vehicle::ModelKind::pacejka;

  // The other weights.
  double w_g = 10;
  double w_haf = 1;
  double w_Fz = 0.5;
  double w_sa = 0.1, w_sr = 1, w_jx = 0.01;
  double w_ax = 0;   ///< optional; 0 leaves the term out
  double w_psi = 0;  ///< optional; 0 leaves the term out
  double w_ic = 100;
  std::array<double, 8> w_s0 = {1, 1, 10, 10, 10, 2, 0.1, 0.1};
  double w_xf = 100;
  double Fz_a = 1300, Fz_b = 100;  ///< constants of the wheel-load cost [N]
  WheelLoadCost wheel_load_cost = WheelLoadCost::paper;
  double tyre_force_limit = 0;  ///< optional limit on linear tyre forces [N]; 0 leaves it out

  // Horizon and mesh.
  int N = 10;  ///< mesh intervals
  SchemeChoice scheme = SchemeChoice::trapezoidal;
  double tf_min = 0.1, tf_max = 10;   ///< [s]
  double L_range = 50, kappa = 5;     ///< LiDAR range and its relaxation [m]
  double sm_start = 2.5, sm_end = 4;  ///< safety margin at the first and last node [m]

  double road_margin = 0.1;   ///< distance of a plan of `along_road` from the road's edges [m]
  double edge_clearance = 0;  ///< distance of any other plan from them [m]

  // Tolerances of the slacked conditions.
  std::array<double, 8> X0_tol = {0.5, 0.5, 0.5, 0.005, 0.5, 0.025, 0.5, 0.5};
  double XF_tol = 5;  ///< [m]

  // Solver.
  SolverChoice solver = SolverChoice::interior_point;
  double floor = 0.9;  ///< barrier floor mu [cost units]; 0: solve to `tol`
  double tol = 1e-6;   ///< optimality tolerance
  int max_iterations = 500;

  // Only for `verified`.
  Known known = Known::all;
  Unseen unseen = Unseen::standing;
  double verified_clearance = 2.15;  ///< from obstacles' edges, at all times [m]
  double verified_wheel_load = 400;  ///< [N]
  double kept_clearance = 2.05;      ///< the same for the rest of a plan, if belief was wrong [m]
  double kept_wheel_load = 200;      ///< the same for the rest of a plan [N]
  double standing_horizon = 60;      ///< how long a standing place must stay clear [s]
  double arrival_margin = 0.3;       ///< of the OCP's obstacles beyond verified_clearance [m]
  double arrival_floor = 0.1;        ///< barrier floor of that OCP [cost units]
  int arrival_N = 40;                ///< mesh intervals of a whole way
  double arrival_tf_max = 70;        ///< longest way [s]
  int arrival_max_iterations = 500;  ///< of one solve
  double improvement_period = 0.5;   ///< between searches for a better way than the last [s]
  double improvement_time = 0.01;    ///< time of a cycle for a better way than the last [s]
  double hysteresis = 0.02;          ///< how much sooner a new way must be to be driven [s]
  int search_places = 150'000;       ///< places that a search may examine if no way is known
  int improvement_places = 20'000;   ///< places that a search may examine for a better way
  int ways = 6;                      ///< greatest number of the search's ways that are followed
  // Parts that a study may switch off.
  bool guidance = true, rows_between = true, verification = true, fallback = true;
};

/// The registered options of Settings with unit, range, meaning and source.
const OptionTable<Settings>& setting_options();

/// Throws InvalidValue, naming `where`, if a value is outside its registered range or not finite,
/// if values contradict each other (L_range <= kappa, tf_min >= tf_max), or if the solver is not
/// available.
void check(const Settings& settings, const std::string& where);

}  // namespace slalom::planner
