#include "line_planner.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "slalom/base/error.hpp"
#include "slalom/base/timer.hpp"
#include "slalom/ocp/scheme.hpp"
#include "solving.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;

/// Shares of lateral acceleration and braking that plans end by, and that guesses go by.
constexpr double kLateralShare = 0.85, kBrakingShare = 0.7, kCalm = 0.6;
/// The slowest at which plans end [m/s]: where the road does, they end creeping.
constexpr double kCreep = 0.6;
/// Price of going beyond a limit (LineSettings::w_excess) [s/m], well above what limits are worth:
/// a vehicle at its limits finds itself a little beyond them when it plans anew.
constexpr double kExcess = 1;
/// And of being faster at the end than the profile, for each metre a second [s/(m/s)].
constexpr double kEndSpeed = 1;
/// The direction in which plans end, relative to the road's, at the most [rad].
constexpr double kEndCourse = 0.1;
/// What is not solved is tried again farther from all limits, at so many times the barrier floor.
constexpr double kCalmFloor = 20;
/// Plans begin no slower than at so many times the least speed.
constexpr double kRoom = 1.2;
/// Between the points of a guess [m].
constexpr double kStep = 2;
/// A guess accelerates so [m/s^2].
constexpr double kDriving = 1;
/// The last interval of the mesh is so many times the first.
constexpr double kGrowth = 2;

const world::Road& road_of(const Task& task) {
  if (!task.road)
    throw InvalidValue("planner " + task.planner.name, "a task without a road",
                       "a road to drive along", {"road"});
  return *task.road;
}

}  // namespace

LinePlanner::LinePlanner(const Task& task)
    : task_(task),
      settings_(task_.planner),
      profile_(road_of(task_), task_.vehicle, kLateralShare, kBrakingShare),
      calm_(*task_.road, task_.vehicle, kCalm, kCalm),
      line_(*task_.road, task_.vehicle, settings_.L_range,
            {.margin = settings_.road_margin, .w_t = settings_.w_t, .w_excess = kExcess}),
      solver_(nlp::make_solver(to_string(settings_.solver))) {
  check(settings_, "planner " + settings_.name);
  auto& problem = line_.problem();
  const auto& states = line_.states();
  for (std::size_t i = 0; i < states.size(); ++i) {
    x0_[i] = problem.parameter("initial_" + states[i].name(), 0);
    problem.boundary("initial " + states[i].name(), problem.initial(states[i]) - x0_[i],
                     ocp::Bounds::equal(0));
  }
  end_speed_ = problem.parameter("end_speed", task_.vehicle.ux_max);
  const auto end =
      problem.boundary("speed at the end", end_speed_ - problem.final(states[LineProblem::SPEED]),
                       ocp::Bounds::at_least(0));
  problem.soften(end, {ocp::Norm::l1, settings_.w_t * kEndSpeed, 0});
  // And it goes along the road there, about.
  const auto at_end = [&](std::size_t i) { return problem.final(states[i]); };
  constexpr std::size_t first = LineProblem::FIRST_OF_VEHICLE;
  problem.boundary(
      "course at the end",
      at_end(LineProblem::XI) +
          (at_end(first) + task_.vehicle.la * at_end(first + 1)) / at_end(LineProblem::SPEED),
      {-kEndCourse, kEndCourse});
  std::vector<double> lengths;
  for (int k = 0; k < settings_.N; ++k)
    lengths.push_back(std::pow(kGrowth, k / std::max(1., settings_.N - 1.)));
  transcription_.emplace(problem, mesh_of(lengths), ocp::hermite_simpson());
}

/// Where a plan begins. One from rest, or slower than the problem knows, begins a little faster
/// than the least speed that it knows, at which there would be no room to solve it: the next plans
/// correct by how much that makes the vehicle farther.
LineProblem::LineState LinePlanner::first(double start, const State& X0p) const {
  auto x0 = line_.to_line(start, X0p);
  x0[LineProblem::SPEED] = std::max(x0[LineProblem::SPEED], kRoom * line_.slowest());
  return x0;
}

void LinePlanner::update(double start, const LineProblem::LineState& x0) {
  auto& problem = line_.problem();
  for (std::size_t i = 0; i < x0.size(); ++i) problem.set_parameter(x0_[i], x0[i]);
  problem.set_parameter(line_.start(), start);
  problem.set_parameter(end_speed_, std::max(profile_.at(start + line_.length()), kCreep));
  transcription_->update(problem);
}

/// From the state to the middle of the road, as fast as the calm profile allows.
ocp::Trajectory LinePlanner::guess(double start, const LineProblem::LineState& x0) const {
  const Parameters& p = task_.vehicle;
  const double length = line_.length();
  const auto count = static_cast<std::size_t>(std::ceil(length / kStep));
  const double step = length / static_cast<double>(count);
  ocp::Trajectory guess;
  guess.tf = length;
  double v = std::max(x0[LineProblem::SPEED], kCreep);
  for (std::size_t k = 0; k <= count; ++k) {
    const double s = start + step * static_cast<double>(k);
    const double wanted = std::max(calm_.at(s + step), kCreep);
    const double least = v * v + 2 * step * p.ax_min_at(v) * kCalm;
    const double next =
        std::sqrt(std::clamp(wanted * wanted, std::max(least, kCreep * kCreep),
                             std::max(v * v + 2 * step * kDriving, kCreep * kCreep)));
    guess.tau.push_back(static_cast<double>(k) / static_cast<double>(count));
    auto x = line_.cornering(s, v, (next * next - v * v) / (2 * step));
    x[LineProblem::N] =
        x0[LineProblem::N] * std::exp(-step * static_cast<double>(k) / (length / 4));
    guess.states.emplace_back(x.begin(), x.end());
    guess.controls.push_back({0, 0});
    v = next;
  }
  guess.states[0].assign(x0.begin(), x0.end());
  return guess;
}

/// The last plan from here on, and where it ends as the guess goes on.
ocp::Trajectory LinePlanner::shifted(double start, const LineProblem::LineState& x0) const {
  const ocp::Trajectory& old = last_->trajectory;
  ocp::Trajectory result = guess(start, x0);
  const double driven = start - last_->start;
  std::size_t at = 0;
  for (std::size_t k = 1; k < result.tau.size(); ++k) {
    const double s = driven + result.time(k);
    if (s > old.time(old.tau.size() - 1)) {  // it keeps the last offset and speed
      result.states[k] = old.states.back();
      continue;
    }
    while (at + 2 < old.tau.size() && old.time(at + 1) < s) ++at;
    const double gap = old.time(at + 1) - old.time(at);
    const double share = std::clamp((s - old.time(at)) / gap, 0., 1.);
    for (std::size_t i = 0; i < result.states[k].size(); ++i)
      result.states[k][i] = old.states[at][i] + share * (old.states[at + 1][i] - old.states[at][i]);
    for (std::size_t i = 0; i < result.controls[k].size(); ++i)
      result.controls[k][i] =
          old.controls[at][i] + share * (old.controls[at + 1][i] - old.controls[at][i]);
  }
  return result;
}

void LinePlanner::record(const Recorder& recorder) {
  recorder_.reset();
  if (recorder.wanted && recorder.take) recorder_ = recorder;
}

ocp::Transcription& LinePlanner::posed(const State& X0p, const std::optional<double>& s) {
  const double start = s ? *s : task_.road->project({X0p[X], X0p[Y]}).s;
  update(start, first(start, X0p));
  return *transcription_;
}

Plan LinePlanner::plan(const Request& request) {
  const Timer timer;
  const world::Point here{request.X0p[X], request.X0p[Y]};
  // It has driven on since the last plan, whose place is looked for.
  const double driven = std::max(0., request.t_start - t_) * std::max(0., request.X0p[UX]);
  const double start = (s_ ? task_.road->project(here, *s_ + driven) : task_.road->project(here)).s;
  s_ = start;
  t_ = request.t_start;
  totals_ = {};
  const auto x0 = first(start, request.X0p);
  update(start, x0);
  // The road's s goes around with each lap.
  if (last_ && task_.road->closed() && start < last_->start - task_.road->length() / 2)
    last_->start -= task_.road->length();
  const bool warm = last_.has_value() && start >= last_->start - kStep &&
                    start < last_->start + line_.length() / 2;
  const Beginning cold{start, guess(start, x0), false, 1};
  Attempt best =
      attempt(request, timer, warm ? Beginning{start, shifted(start, x0), carries_, 1} : cold);
  if (warm) try_other(request, timer, cold, best);
  try_other(request, timer, {start, cold.guess, false, kCalmFloor}, best);
  keep(start, best);
  totals_.put(best.plan.report);
  best.plan.report.planning_cpu_s = timer.cpu();
  return std::move(best.plan);
}

/// Solves once more where there is no plan yet and still time. One that is to be driven although it
/// is not solved gives way to a solved one alone.
void LinePlanner::try_other(const Request& request, const Timer& timer, const Beginning& beginning,
                            Attempt& best) {
  if (best.plan.report.solved || best.cut_short) return;
  best.carries = false;  // what is tried takes the multipliers' place
  Attempt other = attempt(request, timer, beginning);
  if (other.plan.report.solved || !best.driven()) best = std::move(other);
}

/// Solves once.
LinePlanner::Attempt LinePlanner::attempt(const Request& request, const Timer& timer,
                                          const Beginning& beginning) {
  start_.x = transcription_->point(beginning.guess);
  nlp::Options options = solver_options(settings_, request);
  options.floor *= beginning.floor_times;
  options.warm_start = beginning.multipliers;
  options.time_limit = std::max(0., request.time_limit - timer.cpu());
  solver_->solve(*transcription_, start_, options, answer_);
  totals_.add(answer_);
  std::optional<Recording> recording;
  if (recorder_) recording = recorded(request, false, options, start_, answer_);
  Attempt attempt = read(request, beginning.start, options);
  if (recording && recorder_->wanted(attempt.plan.report)) {
    recording->s = beginning.start;
    recording->phi = attempt.plan.report.phi;
    recorder_->take(*recording);
  }
  return attempt;
}

LinePlanner::Attempt LinePlanner::read(const Request& request, double start,
                                       const nlp::Options& options) {
  Attempt attempt;
  attempt.cut_short = cut_short(answer_.status);
  attempt.trajectory = transcription_->trajectory(answer_.point.x);
  auto motion = line_.to_world(attempt.trajectory, start, request.t_start, request.X0p[PSI]);
  Plan& plan = attempt.plan;
  plan.t_start = request.t_start;
  for (const double t : motion.t) plan.t.push_back(t - request.t_start);
  plan.tf = plan.t.back();
  plan.states = std::move(motion.states);
  plan.controls = std::move(motion.controls);
  plan.report = report_of(answer_, *transcription_, request, options);
  return attempt;
}

/// The next solve starts from a plan to be driven, and goes on from one that was cut short.
void LinePlanner::keep(double start, Attempt& attempt) {
  if (!attempt.driven() && !attempt.cut_short) return;
  last_ = Last{start, std::move(attempt.trajectory)};
  carries_ = attempt.carries;
  if (!carries_) return;
  std::swap(start_.y, answer_.point.y);
  std::swap(start_.zl, answer_.point.zl);
  std::swap(start_.zu, answer_.point.zu);
}

}  // namespace slalom::planner
