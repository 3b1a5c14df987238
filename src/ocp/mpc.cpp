#include "slalom/ocp/mpc.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "mpc_loop.hpp"
#include "slalom/base/error.hpp"

namespace slalom::ocp {
namespace {

using Vector = std::vector<double>;

std::vector<std::string> names_of(const auto& list) {
  std::vector<std::string> names;
  for (const auto& item : list) names.push_back(item.name);
  return names;
}

/// Where `name` stands in `known`; throws InvalidValue, naming the nearest, for nowhere.
std::size_t place_of(const std::string& where, const std::string& name,
                     const std::vector<std::string>& known, const char* expected) {
  const auto it = std::find(known.begin(), known.end(), name);
  if (it != known.end()) return static_cast<std::size_t>(it - known.begin());
  const std::string nearest = nearest_name(name, known);
  throw InvalidValue(where, "'" + name + "'",
                     nearest.empty() ? std::string(expected) : "perhaps '" + nearest + "'");
}

/// A plant inside: what it is, what it takes of the plans, and what is measured of it.
class Plant {
 public:
  Plant(const MpcLoop& loop) : loop_(loop) {  // NOLINT(google-explicit-constructor)
    const Problem& problem = loop.problem();
    const MpcSettings& settings = loop.settings();
    system_ = settings.plant ? *settings.plant : system_of(problem);
    auto planned = names_of(problem.controls());
    controls_ = planned.size();
    const auto states = names_of(problem.states());
    planned.insert(planned.end(), states.begin(), states.end());
    for (const auto& input : system_.controls)
      inputs_.push_back(
          place_of(system_.name + ": input", input, planned, "a control or state of the problem"));
    if (settings.measure) return;
    for (const auto& state : states)
      measured_.push_back(place_of(system_.name + ": state to measure", state, system_.states,
                                   "a function `measure`, for the plant has no such state"));
  }

  const System& system() const { return system_; }

  Vector measure(const Vector& x) const {
    if (loop_.settings().measure) return loop_.settings().measure(x);
    Vector result;
    for (const std::size_t i : measured_) result.push_back(x[i]);
    return result;
  }

  Simulation drive(const Vector& x, double t0, double t1) const {
    const Controls signal{[this](double t, std::span<const double>) { return inputs(t); },
                          loop_.corners()};
    return simulate(system_, x, signal,
                    {t0, t1, loop_.settings().samples, loop_.settings().tolerance});
  }

 private:
  Vector inputs(double t) const {
    const Vector controls = loop_.controls(t);
    const bool states_too =
        std::any_of(inputs_.begin(), inputs_.end(), [&](std::size_t i) { return i >= controls_; });
    const Vector states = states_too ? loop_.planned_states(t) : Vector{};
    Vector result;
    for (const std::size_t i : inputs_)
      result.push_back(i < controls_ ? controls[i] : states[i - controls_]);
    return result;
  }

  const MpcLoop& loop_;
  System system_;
  std::size_t controls_ = 0;
  std::vector<std::size_t> inputs_, measured_;
};

void append(const Trajectory& course, MpcResult& result) {
  for (std::size_t k = 0; k < course.tau.size(); ++k) {
    if (!result.t.empty() && course.time(k) <= result.t.back()) {  // where the controls swap
      result.controls.back() = course.controls[k];
      continue;
    }
    result.t.push_back(course.time(k));
    result.states.push_back(course.states[k]);
    result.controls.push_back(course.controls[k]);
  }
}

}  // namespace

const char* to_string(MpcStatus status) {
  switch (status) {
    case MpcStatus::running:
      return "running";
    case MpcStatus::goal:
      return "goal";
    case MpcStatus::expanded_goal:
      return "expanded_goal";
    case MpcStatus::goal_missed:
      return "goal_missed";
    case MpcStatus::horizon_over:
      return "horizon_over";
    case MpcStatus::cycle_limit:
      return "cycle_limit";
    case MpcStatus::not_solved:
      return "not_solved";
    case MpcStatus::stopped:
      return "stopped";
    case MpcStatus::lost:
      return "lost";
  }
  return "unknown";
}

const OptionTable<MpcSettings>& mpc_options() {
  using S = MpcSettings;
  static const auto table =
      OptionTable<S>()
          .real("tex", &S::tex, OptionRange::positive(), "s",
                "Execution horizon: time from cycle to cycle.", "NLOptControl")
          .integer("max_cycles", &S::max_cycles, {.lo = 1, .hi = 1e9}, "1",
                   "Cycles that are planned at most.", "NLOptControl")
          .choice("planning", &S::planning, {"predicted", "measured", "instant"},
                  "From where a cycle plans: the state predicted for its end, where the plan takes "
                  "effect; the state at its start, for a plan that takes effect at its end; or "
                  "that, at once.")
          .choice("horizon", &S::horizon, {"moving", "shrinking"},
                  "The bounds of tf move along, or stand still.")
          .choice("on_unsolved", &S::on_unsolved, {"last_plan", "stop"},
                  "What is driven when a solve failed.")
          .integer("max_unsolved", &S::max_unsolved, {.lo = 0, .hi = 1e9}, "1",
                   "Solves that may fail in a row while the last plan is driven.", "NLOptControl")
          .boolean("warm_start", &S::warm_start, "Multipliers too are shifted from plan to plan.")
          .boolean("warm_up", &S::warm_up, "One solve more before the first, from the same state.")
          .real("expand_goal", &S::expand_goal, {.lo = 1}, "1",
                "Factor of the goal's tolerances once the plan has ended.", "NLOptControl")
          .real("tolerance", &S::tolerance, {.lo = 0, .hi = 1, .lo_open = true, .hi_open = true},
                "1", "Of the integrator, of prediction and plant.")
          .integer("samples", &S::samples, {.lo = 1, .hi = 1e6}, "1",
                   "Of the plant's record, in each cycle.")
          .boolean("keep_cycles", &S::keep_cycles, "All cycles are kept; else the last alone.")
          .boolean("free_start", &S::free_start,
                   "The initial bounds are left to `update`: x0 enters the problem otherwise.")
          .boolean("plant_known", &S::plant_known, "run() predicts by the plant itself.");
  return table;
}

class Mpc::Impl {
 public:
  Impl(const Problem& problem, MpcSettings settings) : loop_(problem, std::move(settings)) {}

  MpcResult run(const Vector& x0, double t0) {
    if (loop_.status() != MpcStatus::running)
      throw Error(loop_.problem().name() + ": mpc: a run after the end (" + loop_.message() +
                  "); another run needs another Mpc");
    const Plant plant(loop_);
    MpcResult result;
    result.plant_states = plant.system().states;
    result.plant_controls = plant.system().controls;
    const auto drive = [&](Vector& x, double from, double to) {
      const Simulation course = plant.drive(x, from, to);
      append(course.trajectory, result);
      x = course.trajectory.states.back();
      if (!course.complete) loop_.end(MpcStatus::lost, course.message);
    };
    MpcLoop::Predict predict;
    Vector x = x0;
    if (loop_.settings().plant_known)
      predict = [&](const Vector&, double from, double to) {
        const Simulation course = plant.drive(x, from, to);
        return course.complete ? plant.measure(course.trajectory.states.back()) : Vector{};
      };
    const double tex = loop_.settings().tex;
    double t = t0;
    for (int k = 1; loop_.status() == MpcStatus::running; ++k) {
      if (loop_.step(plant.measure(x), t, predict) != MpcStatus::running) break;
      const double end = std::min(t0 + k * tex, std::max(loop_.plan_end(), t));
      drive(x, t, end);
      t = end;
    }
    if (loop_.status() == MpcStatus::horizon_over && t < loop_.latest_end()) {
      drive(x, t, loop_.latest_end());  // the last plan, to its end
    }
    if (result.t.empty()) append(plant.drive(x, t, t).trajectory, result);
    result.status = loop_.status();
    result.message = loop_.message();
    result.cycles = std::move(loop_.cycles());
    return result;
  }

  MpcLoop& loop() { return loop_; }

 private:
  MpcLoop loop_;
};

Mpc::Mpc(const Problem& problem, MpcSettings settings)
    : impl_(std::make_unique<Impl>(problem, std::move(settings))) {}
Mpc::~Mpc() = default;
Mpc::Mpc(Mpc&&) noexcept = default;
Mpc& Mpc::operator=(Mpc&&) noexcept = default;

MpcStatus Mpc::step(const std::vector<double>& measured, double time) {
  return impl_->loop().step(measured, time);
}
double Mpc::plan_end() const {
  return impl_->loop().plan_end();
}
const std::vector<MpcCycle>& Mpc::cycles() const {
  return impl_->loop().cycles();
}
std::vector<double> Mpc::controls(double time) const {
  return impl_->loop().controls(time);
}
MpcStatus Mpc::status() const {
  return impl_->loop().status();
}
const std::string& Mpc::message() const {
  return impl_->loop().message();
}
MpcResult Mpc::run(const std::vector<double>& x0, double t0) {
  return impl_->run(x0, t0);
}

}  // namespace slalom::ocp
