#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "model_map.hpp"
#include "obstacle_rows.hpp"
#include "road_terms.hpp"
#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/scheme.hpp"
#include "slalom/ocp/transcription.hpp"
#include "slalom/planner/planner.hpp"
#include "slalom/planner/task.hpp"
#include "slalom/vehicle/model.hpp"

namespace slalom::planner {

/// The collocation scheme that the settings name.
const ocp::Scheme& scheme_of(const Settings& settings);

/// The absolute time [s] at which the trajectory of x is at each point of the mesh, for obstacles
/// that vary to be placed; or the one at which they are held (Settings::moving_avoidance).
std::vector<double> obstacle_times(const Settings& settings, const Request& request,
                                   const ocp::Transcription& transcription,
                                   std::span<const double> x);

/// The trajectory-planning OCP of section 3 of docs/formulation.md (the paper's section II-B), in
/// one of its two forms: goal within the LiDAR range, or beyond it. What a form does not have is
/// absent from it, not switched to zero. On a road its places are those of RoadTerms.
class TrajectoryProblem {
 public:
  /// Among obstacles as stand_ins() leaves them; the task's are not used.
  TrajectoryProblem(const Task& task, const std::vector<world::Obstacle>& obstacles,
                    bool goal_in_range);

  /// Puts others, of the same counts, in the place of those the problem has. What varies has the
  /// numbers of obstacle_times(); of one time for all it is held as it is then.
  void set_obstacles(const std::vector<world::Obstacle>& obstacles,
                     const std::vector<double>& times);
  /// Sets what changes from cycle to cycle: X0p, and the absolute times of planning and of node 0.
  void update(const Request& request);
  /// And where the cycle begins on the road, where there is one.
  void update(const Request& request, const WayAhead& way);

  const ocp::Problem& problem() const { return problem_; }
  const ModelMap& map() const { return map_; }
  /// A trajectory of the plant's states, which begins at s along the road [m], with the problem's
  /// own instead; and back.
  void to_problem(double s, ocp::Trajectory& trajectory) const;
  void to_plant(const vehicle::State& X0p, ocp::Trajectory& trajectory) const;

 private:
  using Expr = ocp::Expr;

  void add_variables(const vehicle::Model& model, const world::Region& region);
  void add_dynamics(const vehicle::Model& model, const Task& task);
  void add_cost(const vehicle::Model& model);
  void add_initial_state(const vehicle::Model& model);
  void add_vehicle_limits(const vehicle::Model& model);
  void add_obstacles();
  void add_lidar_region();
  void add_goal();
  void add_arrival();
  Expr goal_heading();

  const Settings settings_;
  const vehicle::Parameters vehicle_;
  const world::Goal goal_;
  const bool goal_in_range_;
  const ModelMap map_;
  ObstacleRows rows_;

  ocp::Problem problem_;
  std::optional<RoadTerms> road_;
  std::array<ocp::ConstraintId, 2> families_{};  ///< of ObstacleRows::kKinds
  /// Places of the front axle and the goal: x and y, or along and across the road's line.
  RoadTerms::Place here_, initial_, final_, goal_place_;
  std::array<Expr, vehicle::kStates> X_;    ///< states, and what the model derives from them
  std::array<Expr, vehicle::kControls> U_;  ///< controls; zero where the model has none
  std::array<Expr, vehicle::kStates> X0p_;  ///< predicted state (run-time parameters)
  std::array<Expr, vehicle::kStates> x0s_;  ///< slacks on the initial state
  std::array<Expr, 2> xfs_;                 ///< slacks on the final position
  Expr t_planning_, t_start_;               ///< absolute times of planning and of node 0
  std::optional<Expr> goal_psi_;            ///< the goal's heading, where it is asked for
};

}  // namespace slalom::planner
