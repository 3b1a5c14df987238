#include "trajectory_problem.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "arrival_end.hpp"
#include "in_terms_of.hpp"
#include "local_frame.hpp"
#include "obstacle_view.hpp"
#include "region_rows.hpp"

namespace slalom::planner {

using ocp::Bounds;
using ocp::End;
using ocp::Points;
using namespace vehicle;

namespace {

/// A radian off the heading asked for at the goal costs as much as so many metres off it.
constexpr double kHeadingPrice = 10;

}  // namespace

const ocp::Scheme& scheme_of(const Settings& settings) {
  static const ocp::Scheme backward_euler = ocp::backward_euler();
  switch (settings.scheme) {
    case SchemeChoice::hermite_simpson:
      return ocp::hermite_simpson();
    case SchemeChoice::backward_euler:
      return backward_euler;
    default:
      return ocp::trapezoidal();
  }
}

std::vector<double> obstacle_times(const Settings& settings, const Request& request,
                                   const ocp::Transcription& transcription,
                                   std::span<const double> x) {
  if (!settings.moving_avoidance) return {request.t0};
  const auto trajectory = transcription.trajectory(x);
  std::vector<double> times;
  for (std::size_t k = 0; k < trajectory.tau.size(); ++k)
    times.push_back(request.t_start + trajectory.time(k));
  return times;
}

TrajectoryProblem::TrajectoryProblem(const Task& task,
                                     const std::vector<world::Obstacle>& obstacles,
                                     bool goal_in_range)
    : settings_(task.planner),
      vehicle_(task.vehicle),
      goal_(task.goal),
      goal_in_range_(goal_in_range),
      map_(task.vehicle, task.planner.model),
      rows_(world::Footprint(vehicle_), std::min(settings_.sm_start, settings_.sm_end),
            ObstacleRows::counts(obstacles)[2] > 0),
      problem_("trajectory") {
  const Model& model = map_.model();
  add_variables(model, task.region);
  add_dynamics(model, task);
  add_cost(model);
  add_initial_state(model);
  add_vehicle_limits(model);
  add_obstacles();
  set_obstacles(obstacles, {0});
  add_region_rows(problem_, task.region, world::Footprint(vehicle_), X_, Points::all);
  add_lidar_region();
  add_goal();
  if (goal_in_range_) add_arrival();
}

void TrajectoryProblem::add_variables(const Model& model, const world::Region& region) {
  std::array<Bounds, kStates> bounds;
  const auto place = region_bounds(region, world::Footprint(vehicle_));
  bounds[X] = place[0];
  bounds[Y] = place[1];
  bounds[PSI] = {-vehicle_.psi_max, vehicle_.psi_max};
  bounds[SA] = {-vehicle_.sa_max(), vehicle_.sa_max()};
  bounds[UX] = {vehicle_.ux_min, vehicle_.ux_max};
  for (std::size_t i = 0; i < kStates; ++i) {
    const std::string name = kStateNames[i];
    const Role role = model.role[i];
    if (role == Role::state) X_[i] = problem_.state(name, bounds[i]);
    if (role != Role::derived) X0p_[i] = problem_.parameter("X0p_" + name, 0);
    if (role == Role::held) X_[i] = X0p_[i];
    if (role == Role::state)
      x0s_[i] = problem_.slack("x0s_" + name, End::initial, Bounds::at_most(settings_.X0_tol[i]));
  }
  U_[SR] = problem_.control("sr", {-vehicle_.sr_max(), vehicle_.sr_max()});
  if (model.used[JX]) U_[JX] = problem_.control("jx", {-vehicle_.jx_max, vehicle_.jx_max});
  const auto derived = in_terms_of(model.value, model, X_, U_);
  for (std::size_t i = 0; i < kStates; ++i)
    if (model.role[i] == Role::derived) X_[i] = derived[i];
  t_start_ = problem_.parameter("t_start", 0);
  t_planning_ = problem_.parameter("t_planning", 0);
  problem_.initial_time(Bounds::equal(0), 0);
  problem_.final_time({settings_.tf_min, settings_.tf_max}, settings_.tf_max / 2);
}

void TrajectoryProblem::add_dynamics(const Model& model, const Task& task) {
  const auto rate = in_terms_of(model.derivative, model, X_, U_);
  for (std::size_t i = 0; i < kStates; ++i)
    if (model.role[i] == Role::state) problem_.dynamics(X_[i], rate[i]);
  if (task.road) {
    road_.emplace(problem_, task, X_, rate);
    here_ = road_->here();
    initial_ = road_->initial();
    final_ = road_->final();
    goal_place_ = road_->goal();
  } else {
    here_ = {X_[X], X_[Y]};
    initial_ = {problem_.initial(X_[X]), problem_.initial(X_[Y])};
    final_ = {problem_.final(X_[X]), problem_.final(X_[Y])};
    goal_place_ = {goal_.x, goal_.y};
  }
  // A goal across the whole road is reached along it alone.
  const std::size_t axes = road_ && road_->goal_is_across() ? 1 : 2;
  if (goal_in_range_)
    for (std::size_t i = 0; i < axes; ++i)
      xfs_[i] = problem_.slack(std::array{road_ ? "xfs_s" : "xfs_x", road_ ? "xfs_n" : "xfs_y"}[i],
                               End::final, Bounds::at_most(settings_.XF_tol));
}

/// The cost functional J, term by term; a term of weight zero is absent.
void TrajectoryProblem::add_cost(const Model& model) {
  const Settings& s = settings_;
  const Expr tf = problem_.final_time();
  if (s.w_t != 0) problem_.mayer("final_time", s.w_t * tf);

  if (!goal_in_range_ && s.w_g != 0) {
    const Expr to_go = square(final_[0] - goal_place_[0]) + square(final_[1] - goal_place_[1]);
    const Expr at_start =
        square(initial_[0] - goal_place_[0]) + square(initial_[1] - goal_place_[1]);
    problem_.mayer("goal", s.w_g * to_go / (at_start + 0.01));
  }
  if (s.w_ce != 0)
    problem_.lagrange(
        "control_effort",
        s.w_ce * (s.w_sa * square(X_[SA]) + s.w_sr * square(U_[SR]) + s.w_jx * square(U_[JX])));
  if (s.w_Fz != 0) {
    const auto Fz = in_terms_of(model.wheel_loads, model, X_, U_);
    const Expr pair = tanh((s.Fz_a - Fz[RL]) / s.Fz_b) + tanh((s.Fz_a - Fz[RR]) / s.Fz_b);
    problem_.lagrange("wheel_load",
                      s.w_Fz * (s.wheel_load_cost == WheelLoadCost::shifted ? pair + 2 : pair));
  }
  if (s.w_haf != 0)
    problem_.lagrange("heading_area",
                      s.w_haf * square(road_ ? here_[1] - goal_place_[1]
                                             : std::sin(goal_.psi) * (X_[X] - goal_.x) -
                                                   std::cos(goal_.psi) * (X_[Y] - goal_.y)));
  if (s.w_ax != 0 && model.role[AX] == Role::state)
    problem_.lagrange("acceleration", s.w_ax * square(X_[AX]));
  if (s.w_psi != 0 && road_) problem_.lagrange("heading", s.w_psi * road_->turned(X_[PSI]));
  if (s.w_psi != 0 && !road_) {
    problem_.lagrange("heading", s.w_psi * square(X_[PSI] - goal_heading()));
  }

  Expr initial_slacks;
  for (std::size_t i = 0; i < kStates; ++i)
    if (model.role[i] == Role::state) initial_slacks += s.w_s0[i] * x0s_[i];
  const double price = road_ ? road_->slack_price() : 1;
  problem_.mayer("initial_slack", s.w_ic * price * initial_slacks);
  if (goal_in_range_) problem_.mayer("final_slack", s.w_xf * (xfs_[0] + xfs_[1]));
}

/// |X0p - X(0)| <= x0s, two rows a state (the paper's soft constraints on the initial state, signs
/// as section 3 settles them).
void TrajectoryProblem::add_initial_state(const Model& model) {
  for (std::size_t i = 0; i < kStates; ++i) {
    if (model.role[i] != Role::state) continue;
    const std::string name = kStateNames[i];
    const Expr gap = problem_.initial(X_[i]) - X0p_[i];
    problem_.boundary("initial " + name + " from below", gap + x0s_[i], Bounds::at_least(0));
    problem_.boundary("initial " + name + " from above", x0s_[i] - gap, Bounds::at_least(0));
  }
}

void TrajectoryProblem::add_vehicle_limits(const Model& model) {
  const auto limits = in_terms_of(std::array{model.ax_min, model.ax_max}, model, X_, U_);
  if (model.role[AX] == Role::state) {
    problem_.path("ax above ax_min", X_[AX] - limits[0], Bounds::at_least(0));
    problem_.path("ax below ax_max", limits[1] - X_[AX], Bounds::at_least(0));
  }
  const auto Fz = in_terms_of(model.wheel_loads, model, X_, U_);
  for (std::size_t w = 0; w < kWheels; ++w)
    problem_.path(std::string("wheel load ") + kWheelNames[w], Fz[w] - vehicle_.Fz_min,
                  Bounds::at_least(0));
  if (settings_.tyre_force_limit > 0 && settings_.model != ModelKind::kinematic) {
    const auto linear = in_terms_of(std::array{model.Fyf_linear, model.Fyr_linear}, model, X_, U_);
    const Bounds both{-settings_.tyre_force_limit, settings_.tyre_force_limit};
    problem_.path("linear tyre force, front", linear[0], both);
    problem_.path("linear tyre force, rear", linear[1], both);
  }
}

/// Time-varying obstacle constraints with the growing safety margin sm (the paper's Eqn. for
/// obstacle avoidance), at every node after the first.
void TrajectoryProblem::add_obstacles() {
  // Moving avoidance: where they are at the node's absolute time; else at the moment of planning.
  const Expr t = settings_.moving_avoidance ? t_start_ + problem_.time() : t_planning_;
  const Expr dx = X_[X] - rows_.x_at(t), dy = X_[Y] - rows_.y_at(t);
  const Expr sm = settings_.sm_start + (settings_.sm_end - settings_.sm_start) * problem_.tau();
  for (const auto kind : ObstacleRows::kKinds) {
    auto& family = families_[static_cast<std::size_t>(kind)];
    family = problem_.path_family(ObstacleRows::name(kind), rows_.symbols(kind, true),
                                  rows_.outside(kind, dx, dy, X_[PSI], sm, t), Bounds::at_least(0),
                                  Points::after_first);
    if (settings_.obstacle_constraint == ObstacleConstraint::soft)
      problem_.soften(family, {ocp::Norm::l1, settings_.w_obstacle, 0});
  }
}

void TrajectoryProblem::set_obstacles(const std::vector<world::Obstacle>& obstacles,
                                      const std::vector<double>& times) {
  const bool held = times.size() == 1;
  for (const auto kind : ObstacleRows::kKinds) {
    std::vector<std::string> names;
    std::vector<std::vector<double>> numbers;
    for (const auto& o : obstacles) {
      if (ObstacleRows::kind_of(o) != kind) continue;
      names.push_back(o.name);
      auto& row = numbers.emplace_back();
      const auto add = [&](const ObstacleRows::Moment& moment) {
        const auto at = rows_.numbers(o, moment, true);
        row.insert(row.end(), at.begin(), at.end());
      };
      if (!varies(o))
        add({});
      else if (held)
        add({.t = times[0], .held = true});
      else
        for (const double t : times) add({.t = t});
    }
    problem_.set_members(families_[static_cast<std::size_t>(kind)], std::move(names),
                         std::move(numbers));
  }
}

/// The trajectory stays in the region the LiDAR sees (the paper's LiDAR region constraint).
void TrajectoryProblem::add_lidar_region() {
  const double reach = settings_.L_range + settings_.kappa;
  const Expr distance = square(here_[0] - initial_[0]) + square(here_[1] - initial_[1]);
  problem_.path("LiDAR region", reach * reach - distance, Bounds::at_least(0), Points::after_first);
}

/// In range: the goal within xfs. Out of range: the end within kappa of the LiDAR region's edge.
void TrajectoryProblem::add_goal() {
  if (goal_in_range_) {
    for (const std::size_t i : {0, 1}) {
      if (i == 1 && road_ && road_->goal_is_across()) break;
      const Expr gap = final_[i] - goal_place_[i];
      const std::string name =
          std::array{road_ ? "goal s" : "goal x", road_ ? "goal n" : "goal y"}[i];
      problem_.boundary(name + " from below", gap + xfs_[i], Bounds::at_least(0));
      problem_.boundary(name + " from above", xfs_[i] - gap, Bounds::at_least(0));
    }
    return;
  }
  const double inner = settings_.L_range - settings_.kappa;
  const double outer = settings_.L_range + settings_.kappa;
  const Expr distance = square(final_[0] - initial_[0]) + square(final_[1] - initial_[1]);
  problem_.boundary("LiDAR edge, inner", distance - inner * inner, Bounds::at_least(0));
  problem_.boundary("LiDAR edge, outer", outer * outer - distance, Bounds::at_least(0));
}

/// The goal's heading, in the turn that the start's is in.
ocp::Expr TrajectoryProblem::goal_heading() {
  if (!goal_psi_) goal_psi_ = problem_.parameter("goal_psi", goal_.psi);
  return *goal_psi_;
}

/// What else is asked of the vehicle at the goal, softly: close to the goal there may be no time
/// left to meet it.
void TrajectoryProblem::add_arrival() {
  const auto& role = map_.model().role;
  const auto add = [&](const std::string& name, const Expr& value, Bounds bounds, double price) {
    if (!bounds.bounded()) return;
    problem_.soften(problem_.boundary(name, value, bounds), {ocp::Norm::l1, price, 0});
  };
  const double tolerance = goal_.psi_tolerance, price = kHeadingPrice * settings_.w_xf;
  const Expr heading = problem_.final(X_[PSI]);
  if (tolerance < world::Goal::kAbsent && road_) {  // in whatever turn the road leads there
    const double most = std::sin(std::min(tolerance, M_PI / 2));
    add("goal heading", sin(heading - goal_.psi), inside_range(-most, most), price);
  } else if (tolerance < world::Goal::kAbsent) {
    add("goal heading", heading - goal_heading(), inside_range(-tolerance, tolerance), price);
  }
  if (role[UX] == Role::state)
    add("goal speed", problem_.final(X_[UX]), inside_range(goal_.ux_min, goal_.ux_max),
        settings_.w_xf);
  add("goal time", t_start_ + problem_.final_time(), inside_range(goal_.t_min, goal_.t_max),
      settings_.w_xf);
}

void TrajectoryProblem::update(const Request& request) {
  for (std::size_t i = 0; i < kStates; ++i)
    if (map_.model().role[i] != Role::derived) problem_.set_parameter(X0p_[i], request.X0p[i]);
  problem_.set_parameter(t_start_, request.t_start);
  problem_.set_parameter(t_planning_, request.t0);
  if (goal_psi_)
    problem_.set_parameter(*goal_psi_, goal_.psi + whole_turns(request.X0p[PSI] - goal_.psi));
}

void TrajectoryProblem::update(const Request& request, const WayAhead& way) {
  update(request);
  if (road_) road_->set(problem_, way);
}

void TrajectoryProblem::to_problem(double s, ocp::Trajectory& trajectory) const {
  if (!road_) return map_.to_planner(trajectory);
  const auto along = road_->along(s, trajectory);
  map_.to_planner(trajectory);
  for (std::size_t k = 0; k < along.size(); ++k) trajectory.states[k].push_back(along[k]);
}

void TrajectoryProblem::to_plant(const State& X0p, ocp::Trajectory& trajectory) const {
  if (road_)
    for (auto& state : trajectory.states) state.pop_back();
  map_.to_plant(X0p, trajectory);
}

}  // namespace slalom::planner
