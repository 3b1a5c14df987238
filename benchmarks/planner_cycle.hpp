#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "guess.hpp"
#include "slalom/nlp/solver.hpp"
#include "slalom/ocp/transcription.hpp"
#include "slalom/planner/planner.hpp"
#include "slalom/sim/scenario.hpp"
#include "trajectory_problem.hpp"

namespace slalom::bench {

/// One of the planner's two problems, transcribed.
struct Form {
  planner::TrajectoryProblem problem;
  ocp::Transcription transcription;

  Form(const sim::Scenario& scenario, bool goal_in_range);
  void update(const planner::Request& request);
};

/// The last solved plan: what the next start is made from.
struct Last {
  planner::LastPlan plan;
  nlp::Start multipliers;  ///< y, zl, zu in the NLP's units; no x
};

/// What the planner does in a cycle before it solves, with the start in the open: a peer must get
/// the same.
class PlannerCycle {
 public:
  explicit PlannerCycle(sim::Scenario scenario);

  const sim::Scenario& scenario() const { return scenario_; }
  bool goal_in_range(const vehicle::State& X0p) const;
  /// Made at first use.
  Form& form(bool in_range);
  /// Primal start and, for the same form as the last plan's, multipliers as they were. `last` may
  /// be null: then from straight on. Reuses the memory of `start`.
  void start(const planner::Request& request, const Last* last, nlp::Start& start);

 private:
  const sim::Scenario scenario_;
  planner::Guess guess_;
  std::array<std::unique_ptr<Form>, 2> forms_;
};

/// The built-in `environment` with planner P_D at execution horizon `tex` [s]; N and the number of
/// obstacles are the environment's unless given. Further obstacles stand beside the road.
sim::Scenario load(const std::string& environment, double tex, std::optional<int> N = {},
                   std::optional<std::size_t> obstacles = {});

/// Between -1 and 1, from the seed alone: the same on every machine.
double spread(std::uint64_t seed, std::uint64_t index);
/// The index-th draw of a state within `width` of another.
vehicle::State moved(vehicle::State state, const vehicle::State& width, std::uint64_t seed,
                     std::uint64_t index);
/// Half-widths of what is added to a perturbed cycle's X0p; SI.
inline constexpr vehicle::State kCycleSpread = {0.3, 0.3, 0.1, 0.02, 0.02, 0.01, 0.5, 0.2};

}  // namespace slalom::bench
