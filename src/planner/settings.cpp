#include "slalom/planner/settings.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "slalom/base/error.hpp"
#include "slalom/nlp/solver.hpp"

namespace slalom::planner {
namespace {

using Table = OptionTable<Settings>;
using Range = OptionRange;
constexpr const char* kTable = "paper, table of simulation parameters; formulation section 3";
constexpr const char* kSection = "formulation section 3";

const std::vector<std::string>& solver_names() {
  static const std::vector<std::string> names = {"interior_point", "ipopt"};
  return names;
}

void add_what_tells_planners_apart(Table& table) {
  using S = Settings;
  table.text("name", &S::name, "Name of the planner, shown in reports.")
      .choice("method", &S::method, {"receding_horizon", "verified", "along_road"},
              "receding_horizon: the paper's OCP, from cycle to cycle. verified: whole ways to the "
              "goal, found by a search in place and time, of which none is driven before the plant "
              "as it is believed in has driven it; see docs/verified-planner.md. along_road: the "
              "fastest motion over the next L_range metres of a road without obstacles.")
      .real("w_t", &S::w_t, Range::non_negative(), "1/s",
            "Weight of the final time tf in the cost (paper Eqn. 5, first term): 0 for P_A, 100 "
            "for P_B, P_C and P_D.",
            kTable)
      .real("w_ce", &S::w_ce, Range::non_negative(), "1",
            "Weight of the control effort (paper Eqn. 5, third term, there w_cf): 0 for P_A and "
            "P_B, 1 for P_C and P_D.",
            kTable)
      .boolean("moving_avoidance", &S::moving_avoidance,
               "true: obstacles move over the horizon (paper Eqn. 7); false: they are held where "
               "they are at the moment of planning (paper Eqn. 21). Only P_D has it.",
               kTable)
      .choice(
          "model", &S::model, vehicle::model_names(),
          "The vehicle as the planner has it; the one that drives is always pacejka, the 3DoF "
          "vehicle of the paper. linear_tyre: tyre forces linear in the slip angle; "
          "constant_speed: ux stays as it is, steering alone is planned; kinematic: the bicycle "
          "without slip. See docs/planner-models.md.")
      .choice("obstacle_choice", &S::obstacle_choice, {"all", "in_reach", "nearest"},
              "The obstacles a plan knows of. in_reach: those that can come, grown by sm_end, into "
              "the LiDAR's range about the start within tf_max; no plan can touch the others. "
              "nearest: the obstacle_count nearest ones at the moment the plan begins. See "
              "docs/measured/obstacle-choice.md.")
      .integer("obstacle_count", &S::obstacle_count, Range::closed(1, 1000), "1",
               "How many obstacles `nearest` keeps.")
      .real(
          "obstacle_group_gap", &S::obstacle_group_gap, Range::non_negative(), "m",
          "Obstacles of one velocity and margin with less between their edges than this become one "
          "ellipse that covers them; 0: each stays on its own.")
      .choice(
          "obstacle_constraint", &S::obstacle_constraint, {"hard", "soft"},
          "hard: a plan stays off its obstacles (paper Eqn. 7); soft: it pays w_obstacle for how "
          "far its rows fall below 1, integrated over time (l1). A plan that is so let into a "
          "margin "
          "deeper than passage_depth is driven, with the status passes_through.")
      .real("w_obstacle", &S::w_obstacle, Range::positive(), "1/s",
            "Weight of going into obstacles, where they are soft.")
      .choice(
          "prediction", &S::prediction, {"known", "constant_velocity", "constant_turn"},
          "How obstacles with a table or a path are believed to move, each time a plan is made. "
          "known: as they will; constant_velocity: straight on at the velocity that they have "
          "then; constant_turn: on at their speed and turn rate. By the last two, one that is "
          "not there yet is not known of. Obstacles without either go straight on anyway.")
      .real(
          "cover_excess", &S::cover_excess, Range::positive(), "m",
          "By how much the discs that stand in for a box, a polygon, a turned ellipse or the "
          "vehicle's body may stick out of it in the search, where 16 discs do; half as much takes "
          "1.4 times as many. In the OCP one circle stands in for a body out of which it sticks by "
          "no more. What judges plans and drives has the exact shapes.")
      .choice(
          "between_nodes", &S::between_nodes, {"ignore", "report", "refine", "by_shape"},
          "Rows of obstacles, and of the edges of a road, hold at nodes alone, as in the paper. A "
          "plan that between them goes deeper than passage_depth into the margin of an obstacle, "
          "by the smaller of sm_start and sm_end, or into the obstacle, or whose footprint leaves "
          "the road: report: has the status passes_through, and is driven; refine: is solved again "
          "on finer meshes, up to eight times the intervals, and is not solved if that does not "
          "help; by_shape: is solved again where the vehicle has a body or an obstacle is no plain "
          "ellipse, and driven if that does not help; where all is as in the paper, as report; "
          "ignore: is not looked for. A plan that soft rows let in at its nodes is not solved "
          "again.")
      .real(
          "passage_depth", &S::passage_depth, Range::non_negative(), "m",
          "How deep a plan may go into a margin between its nodes: by the defaults, down to the 2 "
          "m at which a drive counts as a crash.")
      .boolean(
          "retry_sides", &S::retry_sides,
          "A cycle whose solve fails is tried again from guesses that pass the obstacle in the "
          "way to the left and to the right, as long as there is time.");
}

void add_weights(Table& table) {
  using S = Settings;
  const auto weight = Range::non_negative();
  table
      .real("w_g", &S::w_g, weight, "1",
            "Weight of the distance from the horizon's end to the goal while the goal is out of "
            "range (paper Eqn. 5, second term).",
            kTable)
      .real("w_haf", &S::w_haf, weight, "1/(m^2 s)",
            "Weight of the squared distance to the line through the goal in its direction (paper "
            "Eqn. 5, last term).",
            kTable)
      .real("w_Fz", &S::w_Fz, weight, "1/s",
            "Weight of the rear wheels' nearness to their least load (paper Eqn. 5, fourth term).",
            kTable)
      .real("w_sa", &S::w_sa, weight, "1/(rad^2 s)",
            "Weight of the squared steering angle in the control effort (paper Eqn. 5).", kTable)
      .real("w_sr", &S::w_sr, weight, "s/rad^2",
            "Weight of the squared steering rate in the control effort (paper Eqn. 5).", kTable)
      .real("w_jx", &S::w_jx, weight, "s^5/m^2",
            "Weight of the squared longitudinal jerk in the control effort (paper Eqn. 5).", kTable)
      .real("w_ax", &S::w_ax, weight, "s^3/m^2",
            "Weight of the squared longitudinal acceleration; 0 leaves the term out, as the "
            "paper's cost does, though its table lists 0.1.",
            kSection)
      .real("w_psi", &S::w_psi, weight, "1/(rad^2 s)",
            "Weight of the squared heading off the goal's direction; 0 leaves the term out.",
            kSection)
      .real("w_ic", &S::w_ic, weight, "1",
            "Common weight of the slacks on the initial state (paper Eqn. 15).", kTable)
      .vector("w_s0", &S::w_s0, weight, "1/(unit of the state)",
              "Weights of the slacks on the initial state, in the order x, y, v, r, psi, sa, ux, "
              "ax (paper Eqn. 15).",
              kTable)
      .real("w_xf", &S::w_xf, weight, "1/m",
            "Weight of the slacks on the final position while the goal is in range (paper Eqn. "
            "15).",
            kTable)
      .real("Fz_a", &S::Fz_a, Range::any(), "N",
            "Wheel load at which the wheel-load cost is half-way (a in paper Eqn. 5).", kTable)
      .real("Fz_b", &S::Fz_b, Range::positive(), "N",
            "Width over which the wheel-load cost falls off (b in paper Eqn. 5).", kTable)
      .choice("wheel_load_cost", &S::wheel_load_cost, {"paper", "shifted"},
              "paper: the pair of tanh, -2 w_Fz a second when safe; shifted: 2 added, so zero when "
              "safe. It changes P_A, which has w_t = 0.")
      .real("tyre_force_limit", &S::tyre_force_limit, Range::non_negative(), "N",
            "Limit on the axles' linear tyre forces, 7500 N in the authors' code; 0 leaves it out.",
            kSection);
}

void add_horizon(Table& table) {
  using S = Settings;
  table
      .integer("N", &S::N, Range::closed(1, 1000), "1",
               "Mesh intervals of the horizon: 10, and 15 in E_C.", kTable)
      .choice(
          "scheme", &S::scheme, {"trapezoidal", "hermite_simpson", "backward_euler"},
          "Collocation scheme; the paper's is trapezoidal, that of earlier work backward Euler.")
      .real("tf_min", &S::tf_min, Range::positive(), "s", "Shortest horizon.", kSection)
      .real("tf_max", &S::tf_max, Range::positive(), "s", "Longest horizon, the paper's tfMax.",
            kSection)
      .real("L_range", &S::L_range, Range::positive(), "m",
            "Range of the LiDAR, which bounds the plan (paper Eqn. 8, 19, 20): 50, and 90 in E_C.",
            kTable)
      .real("kappa", &S::kappa, Range::non_negative(), "m",
            "Relaxation of the LiDAR's range (paper Eqn. 8, 19, 20): 5, and 10 in E_C.", kTable)
      .real(
          "road_margin", &S::road_margin, Range::non_negative(), "m",
          "What a plan along a road keeps the body from the road's edges by, for they are kept at "
          "the nodes of its mesh and the plant's path between.")
      .real("edge_clearance", &S::edge_clearance, Range::non_negative(), "m",
            "Least distance of the footprint from the road's edges, where there is a road: at the "
            "nodes of the OCP's mesh, which at a barrier floor keep off them anyway; of a verified "
            "plan at all times, whose rest keeps on the road.")
      .real("sm_start", &S::sm_start, Range::non_negative(), "m",
            "Margin by which obstacles grow at the first node (sm_1 in paper Eqn. 7).", kTable)
      .real("sm_end", &S::sm_end, Range::non_negative(), "m",
            "Margin by which obstacles grow at the last node (sm_2 in paper Eqn. 7).", kTable);
}

void add_tolerances_and_solver(Table& table) {
  using S = Settings;
  table
      .vector("X0_tol", &S::X0_tol, Range::positive(), "unit of the state",
              "Largest slack on the initial state, in the order x, y, v, r, psi, sa, ux, ax (paper "
              "Eqn. 16). The paper's table prints .25 for sa; with it the solver lives off the "
              "slack and the loop fails.",
              kSection)
      .real("XF_tol", &S::XF_tol, Range::positive(), "m",
            "Largest slack on the final position while the goal is in range (paper Eqn. 17, 18).",
            kTable)
      .choice("solver", &S::solver, solver_names(),
              "The method that solves the NLP: the interior-point method on the stage-structured "
              "factorisation, or Ipopt, if the machine has its library.")
      .real("floor", &S::floor, Range::non_negative(), "cost",
            "Barrier floor mu: how far a plan stays off the limits. 0 solves to tol. The paper's "
            "solver stopped at about 1.",
            "formulation section 5")
      .real("tol", &S::tol, Range::positive(), "1", "Optimality tolerance of the solver.", kSection)
      .integer("max_iterations", &S::max_iterations, Range::closed(1, 1000000), "1",
               "Iterations after which the NLP counts as not solved.", kSection);
}

void add_verification(Table& table) {
  using S = Settings;
  table
      .choice(
          "known", &S::known, {"all", "range"},
          "Of method verified: which obstacles it is told of. all: every one, as the paper's "
          "planners; range: those whose edge lies within L_range of the vehicle at that moment.")
      .choice(
          "unseen", &S::unseen, {"nothing", "standing"},
          "Of known range: what may be beyond L_range. standing: anything that stands, so that a "
          "plan ends within what is seen; nothing: the way there is free. Neither tells of what "
          "moves there.")
      .real("verified_clearance", &S::verified_clearance, Range::non_negative(), "m",
            "Least distance of a verified plan from the edges of obstacles as they are predicted: "
            "the 2 m of a crash and .15 m for errors of belief.")
      .real(
          "verified_wheel_load", &S::verified_wheel_load, Range::any(), "N",
          "Least wheel load of a verified plan. A wheel lifts at 100 N; the OCP's rows keep 1000 N "
          "at the points of its mesh.")
      .real("kept_clearance", &S::kept_clearance, Range::non_negative(), "m",
            "Least distance of the rest of a plan where state or obstacles are not those it was "
            "verified for; a new plan keeps this and the greatest error of the last 5 s.")
      .real("kept_wheel_load", &S::kept_wheel_load, Range::any(), "N",
            "Least wheel load of such a rest.")
      .real("standing_horizon", &S::standing_horizon, Range::positive(), "s",
            "How long a plan that ends standing must stay clear of all obstacles as predicted.")
      .real("arrival_margin", &S::arrival_margin, Range::non_negative(), "m",
            "Margin of the OCP's obstacles beyond verified_clearance: a tracked motion is off its "
            "reference by up to this.")
      .real(
          "arrival_floor", &S::arrival_floor, Range::non_negative(), "cost",
          "Barrier floor of the OCP over the whole way. At the paper's floor the thousands of rows "
          "of a whole way weigh more than seconds.")
      .integer("arrival_N", &S::arrival_N, Range::closed(2, 1000), "1",
               "Mesh intervals of the OCP over the whole way, by Hermite-Simpson.")
      .real("arrival_tf_max", &S::arrival_tf_max, Range::positive(), "s", "Longest way of the OCP.")
      .integer("arrival_max_iterations", &S::arrival_max_iterations, Range::closed(1, 1000000), "1",
               "Iterations after which a solve of a whole way is given up.")
      .real(
          "improvement_period", &S::improvement_period, Range::non_negative(), "s",
          "While the last plan still leads to the goal, a better one is looked for this long after "
          "a new one, and then in intervals that double, up to eightfold, while none is found.")
      .real(
          "improvement_time", &S::improvement_time, Range::positive(), "s",
          "While the last plan still leads to the goal, a cycle looks so long for a better one, at "
          "most .3 of the execution horizon, and the next cycle goes on. It is counted in work, "
          "not by a clock, so that drives repeat.")
      .real("hysteresis", &S::hysteresis, Range::non_negative(), "s",
            "A new plan is driven when it is sooner at the goal by this, so that plans do not "
            "alternate.")
      .integer("search_places", &S::search_places, Range::closed(1, 100000000), "1",
               "Places a search for a way looks at before it gives up, while none is known.")
      .integer("improvement_places", &S::improvement_places, Range::closed(1, 100000000), "1",
               "Places a search for a better way looks at.")
      .integer("ways", &S::ways, Range::closed(0, 1000), "1",
               "Ways of the search that are followed while none is known, which pass obstacles "
               "differently from those that were good.")
      .boolean("guidance", &S::guidance,
               "Off: the OCP of the whole way starts straight on. For studies, as the next three.")
      .boolean("rows_between", &S::rows_between,
               "Off: rows of the OCP's obstacles hold at the points of its mesh alone.")
      .boolean("verification", &S::verification,
               "Off: the cheapest candidate is driven, verified or not.")
      .boolean("fallback", &S::fallback,
               "Off: neither the rest of the last plan nor a stop is driven; a cycle without a new "
               "plan has none.");
}

}  // namespace

const char* to_string(SolverChoice solver) {
  return solver_names().at(static_cast<std::size_t>(solver)).c_str();
}

const OptionTable<Settings>& setting_options() {
  static const auto table = [] {
    Table options;
    add_what_tells_planners_apart(options);
    add_weights(options);
    add_horizon(options);
    add_tolerances_and_solver(options);
    add_verification(options);
    return options;
  }();
  return table;
}

void check(const Settings& settings, const std::string& where) {
  setting_options().check(settings, where);
  if (settings.L_range <= settings.kappa)
    throw InvalidValue(where, fmt::format("L_range = {}", settings.L_range),
                       fmt::format("a number above kappa = {}", settings.kappa),
                       {"L_range", "kappa"});
  if (settings.tf_min >= settings.tf_max)
    throw InvalidValue(where, fmt::format("tf_min = {}", settings.tf_min),
                       fmt::format("a number below tf_max = {}", settings.tf_max),
                       {"tf_min", "tf_max"});
  try {
    (void)nlp::make_solver(to_string(settings.solver));
  } catch (const InvalidValue& none) {
    throw InvalidValue(where, fmt::format("solver = {}", to_string(settings.solver)),
                       none.expected(), {"solver"});
  }
}

}  // namespace slalom::planner
