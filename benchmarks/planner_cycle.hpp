#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

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
  bool in_range = false;
  double t_start = 0;      ///< absolute time of its node 0 [s]
  vehicle::State X0p{};    ///< it was planned from
  ocp::Trajectory plan;    ///< on the mesh's nodes, with its slacks
  nlp::Start multipliers;  ///< y, zl, zu in the NLP's units; no x
};

/// What a planning cycle does before it solves, as section 3 of docs/formulation.md has it
/// ("Guess"), with the start in the open: a peer must get the same.
class PlannerCycle {
 public:
  explicit PlannerCycle(sim::Scenario scenario);

  const sim::Scenario& scenario() const { return scenario_; }
  bool goal_in_range(const vehicle::State& X0p) const;
  /// Made at first use.
  Form& form(bool in_range);
  /// Primal start and, for the same form as the last plan's, multipliers as they were. `last` may
  /// be null: then from straight on.
  nlp::Start start(const Form& form, bool in_range, const planner::Request& request,
                   const Last* last) const;

 private:
  ocp::Trajectory straight_on(const planner::Request& request) const;
  ocp::Trajectory shifted(const planner::Request& request, const Last& last) const;
  void place_slacks(const planner::Request& request, bool in_range, const Last* last,
                    ocp::Trajectory& guess) const;
  double inside(double room, double weight) const;

  const sim::Scenario scenario_;
  std::array<std::unique_ptr<Form>, 2> forms_;
};

/// The built-in `environment` with planner P_D at execution horizon `tex` [s]; N and the number of
/// obstacles are the environment's unless given. Further obstacles stand beside the road.
sim::Scenario load(const std::string& environment, double tex, std::optional<int> N = {},
                   std::optional<std::size_t> obstacles = {});

/// Between -1 and 1, from the seed alone: the same on every machine.
double spread(std::uint64_t seed, std::uint64_t index);

}  // namespace slalom::bench
