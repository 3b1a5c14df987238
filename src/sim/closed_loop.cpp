#include "slalom/sim/closed_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "planning.hpp"
#include "slalom/sim/actuator.hpp"
#include "slalom/sim/watch.hpp"
#include "timing.hpp"

namespace slalom::sim {
namespace {

/// Times nearer than this are the same end of an execution horizon [s].
constexpr double kSameTime = 1e-9;

/// How a drive ends.
struct End {
  Outcome outcome;
  std::string message;  ///< one sentence
  std::string hit = {};
};

/// The framework of the paper's Fig. 2, section 4 of docs/formulation.md: state prediction, OCP and
/// plant take turns until the goal is reached or the drive fails. What may end the drive returns
/// how it does.
class ClosedLoop {
 public:
  ClosedLoop(const Scenario& scenario, const PlanFunction& plan, const LoopHooks& hooks)
      : scenario_(scenario),
        loop_(scenario.loop),
        on_cycle_(hooks.on_cycle),
        timing_(loop_, scenario.planner.method),
        planning_(scenario, timing_, plan, hooks.interrupted),
        plant_(plant_vehicle(scenario.vehicle, scenario.plant, scenario.name),
               loop_.plant_tolerance, loop_.sample_step),
        actuator_(scenario.plant.actuator_delay),
        watch_({scenario.obstacles, loop_.sm_crash, scenario.goal, loop_.Fz_failure,
                world::Footprint(scenario.vehicle), scenario.road},
               plant_.dynamics()),
        state_(scenario.start) {}

  Drive run() {
    watch_.begin(0, state_);
    record();
    if (auto warm_up = planning_.warm_up()) keep(std::move(*warm_up));
    std::optional<End> end;
    for (int index = 1; !end; ++index) end = turn(index);
    return finish(std::move(*end));
  }

 private:
  /// Sense, predict, plan, drive, check and swap signals. A plan that is late by the latency rule
  /// keeps the old signal running, and the next cycle begins when it is there.
  std::optional<End> turn(int index) {
    if (interrupted()) return End{Outcome::interrupted, "interrupted"};
    Cycle cycle = planning_.cycle(
        index, timing_.next_cycle(), [this](double t) { return state_at(t); }, actuator_,
        !drive_.cycles.empty() && drive_.cycles.back().late);
    timing_.settle(cycle);
    auto end =
        interrupted() ? End{Outcome::interrupted, "interrupted while planning"} : carry_out(cycle);
    keep(std::move(cycle));
    return end;
  }

  /// Drives until the next cycle. A failure to plan ends the drive when the plan is due: a plant
  /// that does not wait for it drives meanwhile, and may crash first.
  std::optional<End> carry_out(Cycle& cycle) {
    const double t_end = std::min(timing_.next_cycle(), scenario_.goal.time);
    if (timing_.plant_waits()) {
      if (auto end = judge(cycle)) return end;
      swap(cycle);
      if (auto end = drive_until(t_end)) return end;
      return check_arrival(t_end);
    }
    if (auto end = drive_until(t_end)) return end;
    if (auto end = judge(cycle)) return end;
    if (auto end = check_arrival(t_end)) return end;
    swap(cycle);
    return std::nullopt;
  }

  /// Ends the drive when planning took too long or failed.
  std::optional<End> judge(const Cycle& cycle) const {
    const auto& report = cycle.plan.report;
    // A solve cut off by its time limit may stop a little short of it.
    const double limit = loop_.solve_time_limit * (report.solved ? 1 : 0.99);
    if (cycle.solve_time > limit)
      return End{Outcome::solve_time,
                 fmt::format("the solve of cycle {} took {:.3g} s, over {:.6g} s", cycle.index,
                             cycle.solve_time, loop_.solve_time_limit)};
    if (cycle.late || to_be_driven(cycle.plan) || loop_.on_failure != OnFailure::stop)
      return std::nullopt;
    return End{Outcome::not_optimal,
               fmt::format("the NLP of cycle {} was not solved: {}{}", cycle.index,
                           report.solved ? "the plan has no usable controls" : report.status_text(),
                           report.blocks.empty() ? "" : "; " + report.blocks)};
  }

  /// The plant takes the plan over, if it is one to be driven.
  void swap(Cycle& cycle) {
    if (cycle.late || !to_be_driven(cycle.plan)) return;
    // A plan for when it acts is commanded that much earlier.
    actuator_.command(control_signal(cycle.plan).delayed(-planning_.known_actuator_delay()), t_);
    drive_.plant.back().control = actuator_.driven(t_).at(t_);
    cycle.used = true;
  }

  static bool to_be_driven(const planner::Plan& plan) {
    return (plan.report.solved || plan.report.best_iterate) && usable(plan);
  }

  /// Lets the plant drive until `t_end`, the timeout or the first event, on the signals that reach
  /// it.
  std::optional<End> drive_until(double t_end) {
    t_end = std::min(t_end, loop_.timeout);
    std::optional<End> end;
    do {
      end = drive_on(actuator_.driven(t_), std::min(t_end, actuator_.next_change(t_)));
    } while (!end && t_ < t_end);
    return end;
  }

  std::optional<End> drive_on(const vehicle::ControlSignal& signal, double t_end) {
    for (const double t1 : plant_.instants(signal, t_, t_end)) {
      if (interrupted()) return End{Outcome::interrupted, "interrupted while driving"};
      try {
        const auto stretch = Stretch::driven(plant_, signal, state_, t_, t1, foreseen(signal, t1));
        const auto event = watch_.pass(stretch);
        state_ = event ? stretch.at(event->t) : stretch.state1;
        t_ = event ? event->t : t1;
        record();
        if (event) return end_by(*event);
      } catch (const vehicle::PlantError& error) {
        return End{Outcome::not_optimal, fmt::format("no usable plan was left: {}", error.what())};
      }
    }
    return std::nullopt;
  }

  /// Where the plant gets by t1, if that was predicted.
  std::optional<vehicle::State> foreseen(const vehicle::ControlSignal& signal, double t1) {
    if (!is_as_believed(scenario_.plant)) return std::nullopt;
    return planning_.foreseen(state_, signal, t_, t1);
  }

  End end_by(const Event& event) const {
    const auto place = fmt::format("at {:.6g} s at ({:.6g}, {:.6g}), {:.4g} m/s", t_,
                                   state_[vehicle::X], state_[vehicle::Y], state_[vehicle::UX]);
    if (event.outcome == Outcome::off_road) return {event.outcome, "left the road " + place};
    return {event.outcome,
            event.outcome == Outcome::crash
                ? fmt::format("hit {} {}", event.what, place)
                : fmt::format("the {} wheel's load fell below {:.6g} N {}", event.what,
                              loop_.Fz_failure, place),
            event.what};
  }

  /// At the end of a cycle: whether the goal is reached, or its time is up.
  std::optional<End> check_arrival(double t_end) const {
    if (t_end <= loop_.timeout + kSameTime && arrived()) return arrival();
    const world::Goal& goal = scenario_.goal;
    if (goal.kind() == world::GoalKind::time && t_end >= goal.time - kSameTime)
      return End{Outcome::timeout,
                 fmt::format("not as the goal asks at {:.6g} s: {:.4g} m/s, {:.4g} deg", goal.time,
                             state_[vehicle::UX], state_[vehicle::PSI] * 180 / std::numbers::pi)};
    if (t_end < loop_.timeout - kSameTime) return std::nullopt;
    return End{Outcome::timeout, fmt::format("not at the goal after {:.6g} s", loop_.timeout)};
  }

  /// The goal's square is looked at now; any other goal is reached at any moment.
  bool arrived() const {
    return scenario_.arrived(state_, t_) ||
           (scenario_.goal.kind() != world::GoalKind::square && watch_.goal_time());
  }

  End arrival() const {
    const double since = watch_.goal_time().value_or(t_);
    if (scenario_.goal.kind() == world::GoalKind::time)
      return {Outcome::goal,
              fmt::format("{:.6g} m along the road by {:.6g} s", watch_.progress(), t_)};
    return {Outcome::goal, fmt::format("{} at {:.6g} s, arrived at the check at {:.6g} s",
                                       scenario_.goal.kind() == world::GoalKind::square
                                           ? "entered the goal's square"
                                           : "reached the goal",
                                       since, t_)};
  }

  bool interrupted() const { return planning_.interrupted(); }

  /// The plant's state at t, no later than now; before the drive, its start.
  vehicle::State state_at(double t) const {
    if (scenario_.sensing.delay == 0) return state_;
    const auto later = std::upper_bound(drive_.plant.begin(), drive_.plant.end(), t,
                                        [](double at, const PlantSample& s) { return at < s.t; });
    if (later == drive_.plant.begin()) return scenario_.start;
    const auto& sample = *(later - 1);
    return plant_.advance(sample.state, actuator_.driven(sample.t), sample.t, t);
  }

  void record() {
    if (!drive_.plant.empty() && t_ <= drive_.plant.back().t) return;
    drive_.plant.push_back({t_, state_, actuator_.driven(t_).at(t_), watch_.wheel_loads(state_),
                            watch_.clearance(t_, state_)});
  }

  void keep(Cycle cycle) {
    drive_.cycles.push_back(std::move(cycle));
    if (on_cycle_) on_cycle_(drive_.cycles.back());
  }

  Drive finish(End end) {
    drive_.outcome = end.outcome;
    drive_.message = std::move(end.message);
    drive_.hit = std::move(end.hit);
    drive_.time = t_;
    drive_.goal_time = watch_.goal_time();
    if (drive_.outcome == Outcome::goal && !drive_.goal_time) drive_.goal_time = t_;
    drive_.least_clearance = watch_.least_clearance();
    drive_.least_clearance_t = watch_.least_clearance_t();
    drive_.least_clearance_obstacle = watch_.least_clearance_obstacle();
    drive_.least_wheel_load = watch_.least_wheel_load();
    drive_.least_edge_distance = watch_.least_edge_distance();
    drive_.progress = watch_.progress();
    drive_.lap_ends = watch_.lap_ends();
    return std::move(drive_);
  }

  const Scenario& scenario_;
  const LoopSettings& loop_;
  const std::function<void(const Cycle&)>& on_cycle_;
  Timing timing_;
  Planning planning_;
  vehicle::Plant plant_;
  Actuator actuator_;  ///< straight on at constant speed until the first plan takes over
  Watch watch_;
  vehicle::State state_;
  double t_ = 0;
  Drive drive_;
};

}  // namespace

Drive drive(const Scenario& scenario, const PlanFunction& plan, const LoopHooks& hooks) {
  check(scenario);
  return ClosedLoop(scenario, plan, hooks).run();
}

}  // namespace slalom::sim
