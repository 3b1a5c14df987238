#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "arrival_end.hpp"
#include "corridor_rows.hpp"
#include "motion.hpp"
#include "obstacle_rows.hpp"
#include "slalom/nlp/solver.hpp"
#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/transcription.hpp"
#include "slalom/planner/task.hpp"

namespace slalom::planner {

/// The OCP of section 3 of docs/formulation.md with its end changed: the whole way in one, from X0p
/// exactly to the goal's square, without the LiDAR's edge. Hermite–Simpson, its rows at midpoints
/// too; intervals grow along the way, for what is near is driven first. An obstacle that moves
/// fast, or that the way bends about, could be passed through between two points: rows of close
/// obstacles hold at moments between them too, to which vehicle and obstacle go on at the velocity
/// they have at the point. What moves by a trajectory does so at a point as it does when the guess
/// is there. Transcribed once for a number of obstacles, and solved for any fewer.
class ArrivalProblem {
 public:
  /// Obstacles as stand_ins() leaves them, grown by their margins.
  struct Obstacles {
    std::vector<world::Obstacle> far;    ///< that stand and are not close
    std::vector<world::Obstacle> close;  ///< with rows between the points
  };
  /// How many of each kind there is room for.
  struct Room {
    ObstacleRows::Counts far{}, close{};
    friend bool operator<(const Room& a, const Room& b) {
      return std::pair(a.far, a.close) < std::pair(b.far, b.close);
    }
    /// Whether there is as much of each.
    bool holds(const Room& other) const;
  };

  ArrivalProblem(const Task& task, const Room& room);
  /// The room that these obstacles need, in steps, so that few problems serve all cycles.
  static Room room_for(const Obstacles& obstacles);

  /// Solves from `guess` (whose end is the guess of the final time) for obstacles, no more of them
  /// than there is room for, and within the road's edges by a margin [m]. None when it is not
  /// solved, nor near it. `solver` is used for this alone.
  std::optional<Motion> solve(const Motion& guess, const vehicle::State& X0p,
                              const Obstacles& obstacles, double edge_margin, nlp::Solver& solver,
                              const nlp::Options& options);

  std::size_t rows() const { return transcription_->structure().rows; }
  int iterations() const { return answer_.iterations; }  ///< of the last solve
  double solver_cpu_s() const { return answer_.cpu_s; }  ///< of it [s]

 private:
  using Expr = ocp::Expr;
  void set_obstacles(const Obstacles& obstacles, double t_start, double tf);
  void add_dynamics(const Task& task);
  void add_limits(const vehicle::Model& model, double wheel_load);
  void add_obstacles();
  std::vector<double> row_numbers(const world::Obstacle& o, std::optional<double> share,
                                  double t_start, double tf) const;
  void add_cost(const Task& task);
  void set_corridor(const Motion& guess, const vehicle::State& X0p, double tf, double margin);

  Room room_;
  int intervals_;
  const std::vector<double>& shares_;
  ObstacleRows rows_;
  ocp::Problem problem_;
  std::array<ocp::ConstraintId, 2> far_rows_{}, close_rows_{};  ///< of ObstacleRows::kKinds
  std::optional<CorridorRows> corridor_;
  std::optional<ArrivalEnd> end_;
  std::shared_ptr<const world::Road> road_;
  std::array<Expr, vehicle::kStates> X_, X0p_, rate_;
  std::array<Expr, vehicle::kControls> U_;
  Expr t_start_;
  std::optional<ocp::Transcription> transcription_;
  std::vector<double> tau_;  ///< of the points
  nlp::Answer answer_;
};

}  // namespace slalom::planner
