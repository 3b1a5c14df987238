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
/// The name by which nlp::backends() and files know it.
const char* to_string(SolverChoice solver);
/// Form of the wheel-load cost: the paper's tanh pair, or with 2 added (zero when safe).
enum class WheelLoadCost { paper, shifted };

/// Whether a plan must stay off obstacles, or pays for going into them.
enum class ObstacleConstraint { hard, soft };

/// The obstacles that a plan avoids.
enum class ObstacleChoice { all, in_reach, nearest };

/// How a planner takes obstacles to move that move by a trajectory: along it; on from where they
/// are when it plans, straight at their velocity; or at their speed and turn rate.
enum class Prediction { known, constant_velocity, constant_turn };

/// What becomes of a plan that goes through an obstacle between its nodes: nothing; it says so; it
/// is solved again on finer meshes; the last where something has a shape, else it says so.
enum class BetweenNodes { ignore, report, refine, by_shape };

/// How a planner plans: the paper's OCP over a receding horizon; whole ways to the goal of which
/// none is driven before it is verified; or the fastest motion along a road without obstacles.
enum class Method { receding_horizon, verified, along_road };

/// The obstacles that a verifying planner is told of: all, or those within L_range.
enum class Known { all, range };

/// What a verifying planner assumes beyond L_range, where it knows of obstacles within it alone:
/// nothing, or that anything may stand there.
enum class Unseen { nothing, standing };

/// Settings of the trajectory-planning OCP; names as in section 3 of docs/formulation.md.
struct Settings {
  std::string name = "P_D";
  Method method = Method::receding_horizon;

  // What tells the planners P_A to P_D apart.
  double w_t = 100;              ///< weight of final time [1/s]
  double w_ce = 1;               ///< weight of control effort [1]
  bool moving_avoidance = true;  ///< predict obstacle motion over the horizon

  // Which obstacles a plan knows of.
  ObstacleChoice obstacle_choice = ObstacleChoice::all;
  int obstacle_count = 5;         ///< of `nearest`
  double obstacle_group_gap = 0;  ///< nearer ones become one ellipse [m]; 0: none
  ObstacleConstraint obstacle_constraint = ObstacleConstraint::hard;
  double w_obstacle = 1000;  ///< of `soft`: weight of the rows' excess (l1) [1/s]
  Prediction prediction = Prediction::known;
  double cover_excess = 0.2;  ///< by which discs stick out of the bodies that they cover [m]
  BetweenNodes between_nodes = BetweenNodes::by_shape;
  double passage_depth = 0.5;  ///< a plan may go into a margin between its nodes [m]
  /// How deep it may, which is no deeper than the margin [m].
  double most_passage() const { return std::min({passage_depth, sm_start, sm_end}); }
  bool retry_sides = false;  ///< try again from the left and the right before there is no plan

  /// The vehicle as the planner has it, whatever drives.
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
  double Fz_a = 1300, Fz_b = 100;  ///< of the wheel-load cost [N]
  WheelLoadCost wheel_load_cost = WheelLoadCost::paper;
  double tyre_force_limit = 0;  ///< optional limit on linear tyre forces [N]; 0 leaves it out

  // Horizon and mesh.
  int N = 10;  ///< mesh intervals
  SchemeChoice scheme = SchemeChoice::trapezoidal;
  double tf_min = 0.1, tf_max = 10;   ///< [s]
  double L_range = 50, kappa = 5;     ///< LiDAR range and its relaxation [m]
  double sm_start = 2.5, sm_end = 4;  ///< safety margin at the first and last node [m]

  double road_margin = 0.1;   ///< that a plan along a road keeps from its edges [m]
  double edge_clearance = 0;  ///< that any other plan keeps from them [m]

  // Tolerances of the slacked conditions.
  std::array<double, 8> X0_tol = {0.5, 0.5, 0.5, 0.005, 0.5, 0.025, 0.5, 0.5};
  double XF_tol = 5;  ///< [m]

  // Solver.
  SolverChoice solver = SolverChoice::interior_point;
  double floor = 0.9;  ///< barrier floor mu [cost units]; 0: solve to `tol`
  double tol = 1e-6;   ///< optimality tolerance
  int max_iterations = 500;

  // Of `verified` alone.
  Known known = Known::all;
  Unseen unseen = Unseen::standing;
  double verified_clearance = 2.15;  ///< from obstacles' edges, at all times [m]
  double verified_wheel_load = 400;  ///< [N]
  double kept_clearance = 2.05;      ///< by its rest, where belief was wrong [m]
  double kept_wheel_load = 200;      ///< [N]
  double standing_horizon = 60;      ///< for which standing must be clear of obstacles [s]
  double arrival_margin = 0.3;       ///< of the OCP's obstacles beyond verified_clearance [m]
  double arrival_floor = 0.1;        ///< barrier floor of that OCP [cost units]
  int arrival_N = 40;                ///< mesh intervals of a whole way
  double arrival_tf_max = 70;        ///< longest way [s]
  int arrival_max_iterations = 500;  ///< of one solve
  double improvement_period = 0.5;   ///< between searches for a better way than the last [s]
  double improvement_time = 0.01;    ///< of a cycle, for a better way than the last [s]
  double hysteresis = 0.02;          ///< by which a new way must be sooner to be driven [s]
  int search_places = 150'000;       ///< a search looks at when no way is known
  int improvement_places = 20'000;   ///< a search looks at for a better way
  int ways = 6;                      ///< of the search that are followed at the most
  // Parts that a study may leave out.
  bool guidance = true, rows_between = true, verification = true, fallback = true;
};

/// The registered options of Settings with unit, range, meaning and source.
const OptionTable<Settings>& setting_options();

/// Throws InvalidValue, naming `where`, when a value is outside its registered range or not finite,
/// or when values contradict each other: L_range <= kappa, tf_min >= tf_max; and for a solver that
/// is not there.
void check(const Settings& settings, const std::string& where);

}  // namespace slalom::planner
