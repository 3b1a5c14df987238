#include "mpc_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "slalom/base/error.hpp"

namespace slalom::ocp {
namespace {

using Vector = std::vector<double>;

/// Times nearer than this are the same [time unit].
constexpr double kSameTime = 1e-9;

std::size_t state_named(const Problem& problem, const std::string& name, const char* what) {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < problem.states().size(); ++i) {
    if (problem.states()[i].name == name) return i;
    known.push_back(problem.states()[i].name);
  }
  const std::string nearest = nearest_name(name, known);
  throw InvalidValue(problem.name() + ": mpc: " + what, "no state '" + name + "'",
                     nearest.empty() ? "a state of this problem" : "perhaps '" + nearest + "'");
}

void check(const Problem& problem, const MpcSettings& settings) {
  const std::string where = problem.name() + ": mpc";
  mpc_options().check(settings, where);
  const auto& t0 = problem.t0().bounds;
  if (t0.lower != t0.upper)
    throw InvalidValue(where, fmt::format("t0 free from {} to {}", t0.lower, t0.upper),
                       "a t0 that each cycle can set");
  for (const auto& goal : settings.goal) {
    state_named(problem, goal.state, "goal");
    if (!std::isfinite(goal.value) || !(goal.tolerance >= 0 && std::isfinite(goal.tolerance)))
      throw InvalidValue(where + ": goal " + goal.state,
                         fmt::format("{} with tolerance {}", goal.value, goal.tolerance),
                         "a finite value and a finite tolerance >= 0");
  }
  for (const auto& [state, tolerance] : settings.start_tolerance) {
    state_named(problem, state, "start_tolerance");
    if (!(tolerance >= 0))
      throw InvalidValue(fmt::format("{}: start_tolerance of {}", where, state),
                         fmt::format("{}", tolerance), "a number >= 0");
  }
  const std::size_t controls = settings.first_controls.size();
  if (controls != 0 && controls != problem.controls().size())
    throw InvalidValue(where + ": first_controls", fmt::format("{}", controls),
                       fmt::format("{}, one for each control, or none", problem.controls().size()));
}

}  // namespace

MpcLoop::MpcLoop(const Problem& problem, MpcSettings settings)
    : problem_(problem),
      settings_(std::move(settings)),
      tf_bounds_(problem.tf().bounds),
      length_(problem.tf().guess - problem.t0().guess),
      first_t0_(problem.t0().guess),
      first_controls_(settings_.first_controls) {
  check(problem_, settings_);
  if (first_controls_.empty()) first_controls_.assign(problem_.controls().size(), 0.0);
}

void MpcLoop::end(MpcStatus status, std::string message) {
  status_ = status;
  message_ = std::move(message);
}

Vector MpcLoop::controls(double t) const {
  const Plan* plan = plans_.at(t);
  return plan == nullptr ? first_controls_ : plan->between->controls(t);
}

Vector MpcLoop::planned_states(double t) const {
  const Plan* plan = plans_.at(t);
  return plan == nullptr ? measured_ : plan->between->states(t);
}

MpcStatus MpcLoop::step(const Vector& measured, double t, const Predict& predict) {
  if (status_ != MpcStatus::running)
    throw Error(problem_.name() + ": mpc: a step after the end: " + message_);
  MpcCycle cycle = open(measured, t);
  if (over(cycle)) return status_;
  plan_end_ = ends_within(cycle) ? plans_.last()->solution.trajectory.tf : kInfinity;
  if (plan_end_ < kInfinity || !predict_start(cycle, predict)) return status_;
  place(cycle);
  plan(std::move(cycle));
  return status_;
}

MpcCycle MpcLoop::open(const Vector& measured, double t) {
  const std::string where = problem_.name() + ": mpc: measured states";
  if (measured.size() != problem_.states().size())
    throw InvalidValue(where, fmt::format("{}", measured.size()),
                       fmt::format("{}", problem_.states().size()));
  for (std::size_t i = 0; i < measured.size(); ++i)
    if (!std::isfinite(measured[i]))
      throw InvalidValue(where, fmt::format("{} = {}", problem_.states()[i].name, measured[i]),
                         "a finite number");
  if (!std::isfinite(t)) throw InvalidValue(where, fmt::format("time {}", t), "a finite number");
  if (!cycles_.empty() && cycles_.back().arrived.empty()) cycles_.back().arrived = measured;
  measured_ = measured;
  // A plan is due in this cycle though rounding, or the caller's clock, has it begin a little
  // early.
  plans_.pass(t + settings_.tex / 2);
  MpcCycle cycle;
  cycle.index = index_ + 1;
  cycle.t = t;
  cycle.measured = measured;
  cycle.t_plan = settings_.planning == Planning::predicted ? t + settings_.tex : t;
  cycle.t_swap = settings_.planning == Planning::instant ? t : t + settings_.tex;
  return cycle;
}

/// Distance to the goal in tolerances, of the state that is farthest; infinite without a goal.
double MpcLoop::tolerances_off(const Vector& x) const {
  if (settings_.goal.empty()) return kInfinity;
  double most = 0;
  for (const auto& goal : settings_.goal) {
    const double off = std::fabs(x[state_named(problem_, goal.state, "goal")] - goal.value);
    most = std::max(most, off > 0 ? off / goal.tolerance : 0);
  }
  return most;
}

/// Ends the loop if there is nothing more to plan.
bool MpcLoop::over(const MpcCycle& cycle) {
  const double off = tolerances_off(cycle.measured);
  if (off <= 1) {
    end(MpcStatus::goal, fmt::format("at the goal at t = {:.6g}", cycle.t));
  } else if (plan_end_ <= cycle.t + kSameTime) {
    end(off <= settings_.expand_goal ? MpcStatus::expanded_goal : MpcStatus::goal_missed,
        fmt::format("the plan ended at t = {:.6g}, {:.3g} tolerances from the goal", plan_end_,
                    off));
  } else if (settings_.horizon == Horizon::shrinking &&
             (settings_.goal.empty() || plans_.last() == nullptr) &&
             cycle.t_plan >= tf_bounds_.upper - kSameTime) {
    end(MpcStatus::horizon_over, fmt::format("tf is {:.6g} at most", tf_bounds_.upper));
  } else if (cycle.index > settings_.max_cycles) {
    end(MpcStatus::cycle_limit, fmt::format("{} cycles were planned", settings_.max_cycles));
  }
  return status_ != MpcStatus::running;
}

/// Near the goal a free or shrinking horizon gets shorter than a cycle: what then is left of the
/// last plan is driven to its end, and the goal, expanded, judged there (NLOptControl's way).
bool MpcLoop::ends_within(const MpcCycle& cycle) const {
  const Plan* last = plans_.last();
  const bool no_time_left =
      settings_.horizon == Horizon::shrinking && cycle.t_plan >= tf_bounds_.upper - kSameTime;
  return !settings_.goal.empty() && last != nullptr && (unsolved_ == 0 || no_time_left) &&
         last->solution.trajectory.tf <= cycle.t + settings_.tex + kSameTime;
}

/// Sets the state that is planned from. One beyond its bounds is put on them: no plan could begin
/// outside.
bool MpcLoop::predict_start(MpcCycle& cycle, const Predict& predict) {
  Vector x = cycle.measured;
  if (settings_.planning == Planning::predicted && predict) {
    x = predict(cycle.measured, cycle.t, cycle.t_plan);
  } else if (settings_.planning == Planning::predicted) {
    const Controls signal{[this](double t, std::span<const double>) { return controls(t); },
                          plans_.corners()};
    const auto run =
        simulate(problem_, cycle.measured, signal, {cycle.t, cycle.t_plan, 1, settings_.tolerance});
    x = run.complete ? run.trajectory.states.back() : Vector{};
  }
  if (x.empty() || !std::all_of(x.begin(), x.end(), [](double v) { return std::isfinite(v); })) {
    end(MpcStatus::lost,
        fmt::format("cycle {} cannot predict the states at t = {:.6g}", cycle.index, cycle.t_plan));
    return false;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Bounds& bounds = problem_.states()[i].bounds;
    x[i] = std::clamp(x[i], bounds.lower, bounds.upper);
  }
  cycle.x0 = std::move(x);
  return true;
}

/// Puts the state that is planned from, and the times, into the problem.
void MpcLoop::place(const MpcCycle& cycle) {
  for (std::size_t i = 0; i < cycle.x0.size() && !settings_.free_start; ++i) {
    const auto& state = problem_.states()[i];
    const auto found = settings_.start_tolerance.find(state.name);
    const double off = found == settings_.start_tolerance.end() ? 0 : found->second;
    problem_.initial_bounds(state.symbol, {std::max(cycle.x0[i] - off, state.bounds.lower),
                                           std::min(cycle.x0[i] + off, state.bounds.upper)});
  }
  place_times(cycle.t_plan);
  if (settings_.update) settings_.update(problem_, cycle);
}

void MpcLoop::place_times(double t0) {
  problem_.initial_time(Bounds::equal(t0), t0);
  Bounds ends = tf_bounds_;
  if (settings_.horizon == Horizon::moving)
    ends = {ends.lower + (t0 - first_t0_), ends.upper + (t0 - first_t0_)};
  ends.lower = std::max(ends.lower, t0);
  const Plan* last = plans_.last();
  const double guess = last == nullptr ? t0 + length_ : last->solution.trajectory.tf;
  problem_.final_time(ends, std::clamp(guess, ends.lower, ends.upper));
}

Solution MpcLoop::solve(const MpcCycle& cycle) {
  const Plan* last = plans_.last();
  if (last == nullptr) {
    Trajectory guess = settings_.solve.guess;
    if (!guess.tau.empty()) {  // given for the first t0
      guess.tf += cycle.t_plan - guess.t0;
      guess.t0 = cycle.t_plan;
    }
    return prepared_->solve(guess);
  }
  const double t0 = cycle.t_plan, tf = problem_.tf().guess;
  const Trajectory guess = last->shifted(t0, tf);
  return settings_.warm_start && tf > t0 ? prepared_->solve(guess, last->shifted_duals(t0, tf))
                                         : prepared_->solve(guess);
}

/// Solves, and lets the plan follow if it is one; else the last plan goes on, or the loop ends.
void MpcLoop::plan(MpcCycle cycle) {
  if (!prepared_) {
    prepared_.emplace(problem_, settings_.solve);
    if (settings_.warm_up) {
      MpcCycle warm_up = cycle;
      warm_up.index = 0;
      warm_up.solution = solve(cycle);
      if (warm_up.solution.solved()) plans_.follow({problem_, warm_up.solution, kInfinity});
      keep(std::move(warm_up));
    }
  } else {
    prepared_->update(problem_);
  }
  index_ = cycle.index;
  cycle.solution = solve(cycle);
  cycle.used = cycle.solution.solved();
  unsolved_ = cycle.used ? 0 : unsolved_ + 1;
  if (cycle.used) plans_.follow({problem_, cycle.solution, cycle.t_swap});
  keep(std::move(cycle));
  const MpcCycle& done = cycles_.back();
  const bool go_on = settings_.on_unsolved == OnUnsolved::last_plan &&
                     unsolved_ <= settings_.max_unsolved && plans_.at(done.t_swap) != nullptr;
  if (!done.used && !go_on)
    end(MpcStatus::not_solved, fmt::format("cycle {} was not solved: {}, worst at {}", done.index,
                                           nlp::to_string(done.solution.status),
                                           done.solution.residuals.worst_constraint));
  if (status_ != MpcStatus::running || !settings_.check) return;
  if (std::string reason = settings_.check(done); !reason.empty())
    end(MpcStatus::stopped, std::move(reason));
}

void MpcLoop::keep(MpcCycle cycle) {
  if (!settings_.keep_cycles) cycles_.clear();
  cycles_.push_back(std::move(cycle));
}

}  // namespace slalom::ocp
