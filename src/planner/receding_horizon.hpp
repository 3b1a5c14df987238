#pragma once

#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "guess.hpp"
#include "planning_method.hpp"
#include "slalom/base/timer.hpp"
#include "slalom/nlp/solver.hpp"
#include "slalom/ocp/transcription.hpp"
#include "solving.hpp"
#include "trajectory_problem.hpp"

namespace slalom::planner {

/// The paper's planner: its OCP up to the edge of the LiDAR's range, solved in each cycle from the
/// last plan. As its settings say, a plan that goes through an obstacle or an edge between its
/// nodes is solved again on finer meshes, and a cycle without a plan from guesses on either side;
/// on a road, such a cycle from a guess where obstacles leave room.
class RecedingHorizon final : public PlanningMethod {
 public:
  explicit RecedingHorizon(const Task& task);

  Plan plan(const Request& request) override;
  void reset() override {
    last_.reset();
    on_road_.reset();
  }
  void record(const Recorder& recorder) override;

 private:
  /// One of the OCP's two forms, transcribed once and solved many times.
  struct Form {
    TrajectoryProblem problem;
    ocp::Transcription transcription;

    Form(TrajectoryProblem p, const Settings& settings, int intervals);
    void update(const Request& request, const WayAhead& way);
  };
  /// Whether the goal is in range, and the numbers of obstacles of each kind and of mesh intervals.
  using FormKey = std::tuple<bool, ObstacleRows::Counts, int>;
  /// One solve of a cycle.
  struct Attempt {
    Plan plan;
    ocp::Trajectory trajectory;  ///< the plant's states
    bool carries;                ///< its multipliers are those of the rows of Settings::N
    bool cut_short;              ///< by time or the user
  };
  /// What a cycle's attempts have in common.
  struct Cycle {
    const Request& request;
    const WayAhead way;  ///< without a road, whether the goal is in range alone
    const Timer& timer;
  };

  Form& form(bool in_range, int intervals);
  WayAhead look_ahead(const Request& request);
  void choose(const Request& request);
  void place_obstacles(const Request& request, Form& form) const;
  void prepare();
  Attempt attempt(const Cycle& cycle, int intervals, ocp::Trajectory& guess, bool warm);
  Attempt read(const Cycle& cycle, int intervals, const nlp::Options& options);
  std::string what_blocks(const Plan& plan) const;
  void look_between(const Cycle& cycle, Plan& plan) const;
  bool let_in(const SolveReport& report) const;
  void try_sides(const Cycle& cycle, const ocp::Trajectory& guess, Attempt& best);
  void try_free_way(const Cycle& cycle, Attempt& best);
  void refine(const Cycle& cycle, Attempt& best);
  void keep(const Cycle& cycle, Attempt& attempt);

  const Task task_;  ///< its obstacles grouped
  const Settings& settings_;
  const world::Footprint footprint_;
  std::vector<world::Obstacle> known_;    ///< as believed in this cycle
  std::vector<world::Obstacle> chosen_;   ///< of these, as rows have them
  std::vector<world::Obstacle> of_last_;  ///< of the last plan, whose multipliers are there
  bool as_made_ = false;                  ///< none measured in the last cycle, and none too far
  std::map<FormKey, Form> forms_;
  Guess guess_;
  std::optional<Recorder> recorder_;
  std::unique_ptr<nlp::Solver> solver_;
  nlp::Start start_;  ///< its multipliers are the last plan's
  nlp::Answer answer_;
  SolveTotals totals_;                                ///< of the cycle
  std::optional<LastPlan> last_;                      ///< where the next solve starts
  bool carries_ = false;                              ///< the multipliers of `start_` belong to it
  std::optional<std::pair<double, double>> on_road_;  ///< when the last cycle began where along it
  double longest_reading_s_ = 0;                      ///< thread time of a cycle after its solve
};

}  // namespace slalom::planner
