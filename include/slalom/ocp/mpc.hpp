#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "slalom/base/options.hpp"
#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/simulate.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {

/// The state from which a cycle at time t plans.
enum class Planning {
  predicted,  ///< from the state predicted for t + tex, where the plan takes effect
  measured,   ///< from the state at t; the plan takes effect at t + tex, tex after its start
  instant,    ///< from the state at t, where the plan takes effect: solving takes no time
};

/// Where the plans end.
enum class Horizon {
  moving,     ///< the bounds of tf move along with t0, whether tf is fixed or free
  shrinking,  ///< the bounds of tf stay fixed
};

/// What is driven after a failed solve.
enum class OnUnsolved {
  last_plan,  ///< the last plan that was solved, for at most `max_unsolved` cycles in a row
  stop,       ///< nothing: only solved plans are driven
};

/// Whether a receding horizon still runs, or how it ended.
enum class MpcStatus {
  running,
  goal,           ///< the goal is reached
  expanded_goal,  ///< the plan ended within a cycle, at the goal only within expanded tolerances
  goal_missed,    ///< the plan ended within a cycle, outside the expanded tolerances
  horizon_over,   ///< shrinking: no time is left to plan for
  cycle_limit,    ///< `max_cycles` were planned
  not_solved,     ///< a solve failed, and there is no plan to drive instead
  stopped,        ///< the check asked for it
  lost,           ///< the plant or the prediction could not be integrated
};
const char* to_string(MpcStatus status);

/// A state and its goal: |state - value| <= tolerance.
struct StateGoal {
  std::string state;
  double value = 0;
  double tolerance = 0;
};

/// One cycle.
struct MpcCycle {
  int index = 0;                 ///< 1 is the first; 0 the warm-up solve, if any
  double t = 0;                  ///< when it began
  double t_plan = 0;             ///< t0 of the plan
  double t_swap = 0;             ///< when the plan takes effect
  std::vector<double> measured;  ///< states at t
  std::vector<double> x0;  ///< states planned from: predicted or measured, within their bounds
  Solution solution;
  bool used = false;            ///< solved, so that it takes effect
  std::vector<double> arrived;  ///< states at t + tex, when the next cycle began; they differ from
                                ///< x0 by the prediction's error
};

struct MpcSettings {
  SolveSettings solve = {};  ///< mesh, scheme, options and back end; the first guess
  double tex = 0.5;          ///< execution horizon: time from cycle to cycle
  int max_cycles = 100;
  Planning planning = Planning::predicted;
  Horizon horizon = Horizon::moving;
  OnUnsolved on_unsolved = OnUnsolved::last_plan;
  int max_unsolved = 3;
  bool warm_start = true;   ///< multipliers are shifted from plan to plan, too
  bool warm_up = false;     ///< one additional solve before the first, from the same state
  double expand_goal = 2;   ///< factor of the goal's tolerances for MpcStatus::expanded_goal
  double tolerance = 1e-9;  ///< of the integrator, as SimulateSettings::tolerance
  int samples = 10;         ///< of the plant's record in each cycle
  bool keep_cycles = true;  ///< all cycles are kept; otherwise only the last
  std::vector<StateGoal> goal = {};  ///< all must hold at once, at a cycle's start; none: no goal
  std::vector<double> first_controls = {};  ///< until the first plan takes effect; empty: 0
  /// For each state, how far the plan's initial state may be from x0; 0 for states left out.
  std::map<std::string, double> start_tolerance = {};
  /// For problems that use x0 in another way (as parameters, by `update`): Mpc then does not change
  /// the initial bounds.
  bool free_start = false;

  /// The plant of run(); empty: the problem's own dynamics. Its inputs have the names of the
  /// problem's controls, or of states, which it then takes from the plan.
  std::optional<System> plant = {};
  /// Computes the problem's states from the plant's; empty: they are matched by name.
  std::function<std::vector<double>(std::span<const double> plant)> measure = {};
  /// run() predicts with the plant itself instead of the problem's model.
  bool plant_known = false;

  /// Called before each solve, with the data of the cycle that are known then; may change the
  /// problem.
  std::function<void(Problem& problem, const MpcCycle& cycle)> update = {};
  /// Called after each solve; returns a reason to stop, or nothing.
  std::function<std::string(const MpcCycle& cycle)> check = {};
};

/// The registered options of MpcSettings.
const OptionTable<MpcSettings>& mpc_options();

/// The result of run().
struct MpcResult {
  MpcStatus status = MpcStatus::running;
  std::string message;  ///< one sentence on how it ended
  std::vector<MpcCycle> cycles;
  std::vector<std::string> plant_states, plant_controls;  ///< names
  std::vector<double> t;                                  ///< of the samples of the plant
  std::vector<std::vector<double>> states, controls;      ///< [sample][one of the plant's]
};

/// Receding-horizon control: solves the problem again each tex, from the plant's present or
/// predicted state, and drives the plans one after the other (Febbo, Jayakumar, Stein & Ersal,
/// NLOptControl, arXiv 2003.00142, 2020; section 4 of docs/formulation.md is such a loop). Times
/// are absolute: each solve sets t0, and the bounds of tf by `horizon`. The guess of a solve is the
/// last plan at the same times, with its end held.
class Mpc {
 public:
  /// Throws InvalidValue for settings out of range, names that the problem lacks, and a problem
  /// whose t0 is free.
  Mpc(const Problem& problem, MpcSettings settings);
  ~Mpc();
  Mpc(Mpc&&) noexcept;
  Mpc& operator=(Mpc&&) noexcept;

  /// One cycle for a plant of your own, which begins at `time` with the problem's measured states.
  /// Call it each tex. If there is nothing more to plan, for example at the goal, it ends the loop
  /// instead; after that it throws Error. If the plan in effect ends within this cycle, no other
  /// plan follows: drive it to its end, plan_end(), and then call step.
  MpcStatus step(const std::vector<double>& measured, double time);
  /// The problem's controls to apply at `time`: those of the plan in effect, and after its end its
  /// last controls.
  std::vector<double> controls(double time) const;
  /// When the plan in effect ends and the goal will be judged; infinite if the next cycle's plan
  /// takes over before that.
  double plan_end() const;
  MpcStatus status() const;
  const std::string& message() const;  ///< one sentence on how it ended
  const std::vector<MpcCycle>& cycles() const;

  /// The whole loop from the plant's state x0 at time t0, until it ends. Throws Error after the
  /// end: another run needs another Mpc.
  [[nodiscard]] MpcResult run(const std::vector<double>& x0, double t0 = 0);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace slalom::ocp
