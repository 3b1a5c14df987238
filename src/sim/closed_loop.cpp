#include "slalom/sim/closed_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "slalom/base/timer.hpp"
#include "slalom/sim/actuator.hpp"
#include "slalom/sim/control_signal.hpp"
#include "slalom/sim/latency.hpp"
#include "slalom/sim/plant.hpp"
#include "slalom/sim/watch.hpp"

namespace slalom::sim {
namespace {

/// Times nearer than this are the same end of an execution horizon [s].
constexpr double kSameTime = 1e-9;

/// The framework of the paper's Fig. 2, section 4 of docs/formulation.md: state prediction, OCP and
/// plant take turns until the goal is reached or the drive fails.
class ClosedLoop {
 public:
  ClosedLoop(const Scenario& scenario, const PlanFunction& plan, const LoopHooks& hooks)
      : scenario_(scenario),
        loop_(scenario.loop),
        plan_(plan),
        hooks_(hooks),
        plant_(plant_vehicle(scenario.vehicle, scenario.plant, scenario.name),
               loop_.plant_tolerance, loop_.sample_step),
        believed_(scenario.vehicle, loop_.plant_tolerance, loop_.sample_step),
        sensors_(scenario.sensing, scenario.plant.cg_shift),
        actuator_(scenario.plant.actuator_delay),
        watch_(scenario, plant_),
        latency_(loop_),
        state_(scenario.start) {}

  Drive run() {
    watch_.begin(0, state_);
    record();
    if (loop_.warm_up && !interrupted()) warm_up();
    for (int index = 1; !ended_; ++index) cycle(index);
    return finish();
  }

 private:
  void warm_up() {
    Cycle cycle = plan_ahead(0, 0);
    drive_.cycles.push_back(std::move(cycle));
    if (hooks_.on_cycle) hooks_.on_cycle(drive_.cycles.back());
  }

  /// Predict, plan, drive [t0, t0 + tex] on the old signal, check, and swap signals. A plan that is
  /// late by the latency rule keeps the old signal running, and the next cycle begins when it is
  /// there. A failure to plan ends the drive when the plan is due: the plant drives meanwhile and
  /// may crash first.
  void cycle(int index) {
    const double t0 = anchor_ + horizons_ * loop_.tex, due = anchor_ + (horizons_ + 1) * loop_.tex;
    if (interrupted()) return end(Outcome::interrupted, "interrupted");
    Cycle cycle = plan_ahead(index, t0);
    charge(cycle, due);
    const double t1 = instant() ? due : cycle.t_swap;
    if (interrupted()) {
      end(Outcome::interrupted, "interrupted while planning");
    } else {
      if (instant()) judge(cycle);
      if (!ended_ && instant()) swap(cycle);
      if (!ended_) drive_until(std::min(t1, loop_.timeout));
      if (!ended_ && !instant()) judge(cycle);
    }
    if (!ended_ && t1 <= loop_.timeout + kSameTime) check_goal();
    if (!ended_ && t1 >= loop_.timeout - kSameTime)
      end(Outcome::timeout, fmt::format("not at the goal after {:.6g} s", loop_.timeout));
    if (!ended_ && !instant()) swap(cycle);
    drive_.cycles.push_back(std::move(cycle));
    if (hooks_.on_cycle) hooks_.on_cycle(drive_.cycles.back());
  }

  bool instant() const { return loop_.latency == LatencyRule::instant; }

  /// Settles when the plan takes effect; `due` is t0 + tex. A cycle that is not late keeps to the
  /// grid of execution horizons, a late one begins another.
  void charge(Cycle& cycle, double due) {
    cycle.charged = latency_.charge(cycle.index, solve_time_);
    if (latency_.scripted()) solve_time_ = cycle.charged;
    const bool cut_off =
        latency_.scripted() && loop_.deadline == Deadline::tex && cycle.charged > loop_.tex;
    if (cut_off) {
      cycle.charged = loop_.tex;
      solve_time_ = loop_.tex;
      cycle.plan.report.solved = cycle.plan.report.best_iterate = false;
      cycle.plan.report.status = planner::PlanStatus::time_limit;
    }
    const double ready = cycle.t0 + cycle.charged;
    cycle.t_swap = instant() ? cycle.t0 : due;
    ++horizons_;
    if (ready <= due) return;
    cycle.t_swap = anchor_ = ready;
    horizons_ = 0;
  }

  /// The plant takes the plan over, if it is one to be driven.
  void swap(Cycle& cycle) {
    if (!to_be_driven(cycle.plan)) return;
    actuator_.command(ControlSignal(cycle.plan), t_);
    drive_.plant.back().control = actuator_.driven(t_).at(t_);
    cycle.used = true;
  }

  /// Predicts the state at t0 + tex from what is measured at t0, on the current signal and with the
  /// vehicle believed in, and plans from there; plans from where the plant is measured to stand
  /// when plans take effect at once.
  Cycle plan_ahead(int index, double t0) {
    Cycle cycle;
    cycle.index = index;
    cycle.t0 = t0;
    cycle.tex = loop_.tex;
    solve_time_ = 0;
    try {
      const auto measured = sensors_.measured(state_at(t0 - scenario_.sensing.delay), index);
      cycle.X0p = instant()
                      ? measured
                      : believed_.predict(measured, actuator_.commanded(), t0, t0 + loop_.tex);
    } catch (const PlantError& error) {
      cycle.X0p.fill(std::nan(""));
      cycle.plan.report.status = planner::PlanStatus::no_prediction;
      cycle.plan.report.detail = error.what();
      return cycle;
    }
    planner::Request request;
    request.X0p = cycle.X0p;
    request.t0 = t0;
    request.t_start = instant() ? t0 : t0 + loop_.tex;
    request.obstacles = sensors_.believed(scenario_.obstacles, index, t0);
    // By a scripted rule the deadline is held against the time charged: see charge().
    request.time_limit = loop_.deadline == Deadline::tex && !latency_.scripted()
                             ? std::min(loop_.tex, loop_.solve_time_limit)
                             : loop_.solve_time_limit;
    if (loop_.on_failure == OnFailure::best_iterate)
      request.best_iterate_tol = loop_.best_iterate_tol;
    request.interrupted = hooks_.interrupted;
    const Timer timer;
    cycle.plan = plan_(request);
    solve_time_ = std::max(timer.wall(), cycle.plan.report.wall_s);
    return cycle;
  }

  /// The plant's state at t, no later than now; before the drive, its start.
  vehicle::State state_at(double t) const {
    if (scenario_.sensing.delay == 0) return state_;
    const auto later = std::upper_bound(drive_.plant.begin(), drive_.plant.end(), t,
                                        [](double at, const PlantSample& s) { return at < s.t; });
    if (later == drive_.plant.begin()) return scenario_.start;
    const auto& sample = *(later - 1);
    return plant_.advance(sample.state, actuator_.driven(sample.t), sample.t, t);
  }

  static bool to_be_driven(const planner::Plan& plan) {
    return (plan.report.solved || plan.report.best_iterate) && ControlSignal::usable(plan);
  }

  /// Ends the drive when planning took too long or failed.
  void judge(const Cycle& cycle) {
    // A solve cut off by its time limit may stop a little short of it.
    const double limit = loop_.solve_time_limit * (cycle.plan.report.solved ? 1 : 0.99);
    if (solve_time_ > limit)
      return end(Outcome::solve_time,
                 fmt::format("the solve of cycle {} took {:.3g} s, over {:.6g} s", cycle.index,
                             solve_time_, loop_.solve_time_limit));
    if (to_be_driven(cycle.plan) || loop_.on_failure != OnFailure::stop) return;
    end(Outcome::not_optimal,
        fmt::format("the NLP of cycle {} was not solved: {}", cycle.index,
                    cycle.plan.report.solved ? "the plan has no usable controls"
                                             : cycle.plan.report.status_text()));
  }

  /// Lets the plant drive until `t_end` or the first event, on the signals that reach it.
  void drive_until(double t_end) {
    do {
      drive_on(actuator_.driven(t_), std::min(t_end, actuator_.next_change(t_)));
    } while (!ended_ && t_ < t_end);
  }

  void drive_on(const ControlSignal& signal, double t_end) {
    for (const double t1 : plant_.instants(signal, t_, t_end)) {
      if (interrupted()) return end(Outcome::interrupted, "interrupted while driving");
      Stretch stretch{
          t_, t1, state_, {}, [&](double t) { return plant_.advance(state_, signal, t_, t); }};
      try {
        stretch.state1 = stretch.at(t1);
        const auto event = watch_.pass(stretch);
        state_ = event ? stretch.at(event->t) : stretch.state1;
        t_ = event ? event->t : t1;
        record();
        if (event) return end_by(*event);
      } catch (const PlantError& error) {
        return end(Outcome::not_optimal, fmt::format("no usable plan was left: {}", error.what()));
      }
    }
  }

  void check_goal() {
    if (!scenario_.goal.contains(state_[vehicle::X], state_[vehicle::Y])) return;
    end(Outcome::goal, fmt::format("entered the goal's square at {:.6g} s, arrived at the check at "
                                   "{:.6g} s",
                                   watch_.goal_time().value_or(t_), t_));
  }

  void end_by(const Event& event) {
    drive_.hit = event.what;
    const auto place = fmt::format("at {:.6g} s at ({:.6g}, {:.6g}), {:.4g} m/s", t_,
                                   state_[vehicle::X], state_[vehicle::Y], state_[vehicle::UX]);
    end(event.outcome, event.outcome == Outcome::crash
                           ? fmt::format("hit {} {}", event.what, place)
                           : fmt::format("the {} wheel's load fell below {:.6g} N {}", event.what,
                                         loop_.Fz_failure, place));
  }

  void end(Outcome outcome, std::string message) {
    drive_.outcome = outcome;
    drive_.message = std::move(message);
    ended_ = true;
  }

  bool interrupted() const { return hooks_.interrupted && hooks_.interrupted(); }

  void record() {
    if (!drive_.plant.empty() && t_ <= drive_.plant.back().t) return;
    drive_.plant.push_back({t_, state_, actuator_.driven(t_).at(t_),
                            plant_.dynamics().wheel_loads(state_), watch_.clearance(t_, state_)});
  }

  Drive finish() {
    drive_.time = t_;
    drive_.goal_time = watch_.goal_time();
    if (drive_.outcome == Outcome::goal && !drive_.goal_time) drive_.goal_time = t_;
    drive_.least_clearance = watch_.least_clearance();
    drive_.least_clearance_t = watch_.least_clearance_t();
    drive_.least_clearance_obstacle = watch_.least_clearance_obstacle();
    drive_.least_wheel_load = watch_.least_wheel_load();
    return std::move(drive_);
  }

  const Scenario& scenario_;
  const LoopSettings& loop_;
  const PlanFunction& plan_;
  const LoopHooks& hooks_;
  Plant plant_;
  Plant believed_;  ///< what prediction takes the plant for
  Sensors sensors_;
  Actuator actuator_;  ///< straight on at constant speed until the first plan takes over
  Watch watch_;
  Latency latency_;
  vehicle::State state_;
  double t_ = 0;
  double anchor_ = 0;  ///< cycles begin at anchor + k tex [s]
  int horizons_ = 0;   ///< k of the next one
  double solve_time_ = 0;
  bool ended_ = false;
  Drive drive_;
};

}  // namespace

Drive drive(const Scenario& scenario, const PlanFunction& plan, const LoopHooks& hooks) {
  check(scenario, scenario.name.empty() ? "scenario" : scenario.name);
  return ClosedLoop(scenario, plan, hooks).run();
}

}  // namespace slalom::sim
