#include "slalom/planner/planner.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "guess.hpp"
#include "obstacle_choice.hpp"
#include "planning_method.hpp"
#include "slalom/base/timer.hpp"
#include "slalom/nlp/check.hpp"
#include "slalom/nlp/solver.hpp"
#include "slalom/ocp/transcription.hpp"
#include "trajectory_problem.hpp"
#include "verified_planner.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;

/// The task with its obstacles grouped as its settings say, once these are found to be sound.
Task with_groups(Task task) {
  check(task.planner, "planner " + task.planner.name);
  task.obstacles = group_obstacles(task.planner, task.obstacles);
  return task;
}

nlp::Options solver_options(const Settings& settings, const Request& request) {
  nlp::Options options;
  options.floor = settings.floor;
  options.tol = settings.tol;
  options.max_iterations = settings.max_iterations;
  if (request.interrupted) {
    options.stop = [](void* data) { return (*static_cast<const std::function<bool()>*>(data))(); };
    options.stop_data = const_cast<std::function<bool()>*>(&request.interrupted);
  }
  return options;
}

/// Ended from outside, on its way to an answer.
bool cut_short(nlp::Status status) {
  return status == nlp::Status::time_limit || status == nlp::Status::interrupted;
}

/// One of the OCP's two forms, transcribed once and solved many times.
struct Form {
  TrajectoryProblem problem;
  ocp::Transcription transcription;

  Form(TrajectoryProblem p, const Settings& settings)
      : problem(std::move(p)),
        transcription(problem.problem(), ocp::Mesh::uniform(settings.N), scheme_of(settings)) {}

  void update(const Request& request) {
    problem.update(request);
    transcription.update(problem.problem());
  }
};

/// The paper's planner.
class RecedingHorizon final : public PlanningMethod {
 public:
  explicit RecedingHorizon(const Task& task)
      : task_(with_groups(task)),
        settings_(task_.planner),
        chosen_(choose_obstacles(settings_, {}, task_.obstacles)),
        guess_(task_),
        solver_(nlp::make_solver(to_string(settings_.solver))) {
    prepare();
  }

  Plan plan(const Request& request) override {
    const Timer timer;
    const bool in_range = goal_in_range(task_, request.X0p);
    choose(request);
    form(in_range).update(request);
    ocp::Transcription& transcription = form(in_range).transcription;
    nlp::Options options = solver_options(settings_, request);
    start_.x = start_point(request, in_range);
    options.warm_start = last_ && last_->in_range == in_range && same_obstacles_;
    options.time_limit = std::max(0.0, request.time_limit - timer.cpu() - longest_reading_s_);
    solver_->solve(transcription, start_, options, answer_);
    const double solved_at = timer.cpu();
    std::optional<Recording> recording;
    if (recorder_) recording = record_solve(request, in_range, options);
    Plan plan = read(request, in_range, options);
    if (recording && recorder_->wanted(plan.report)) {
      recording->phi = plan.report.phi;
      recorder_->take(*recording);
    }
    plan.report.planning_cpu_s = timer.cpu();
    longest_reading_s_ = std::max(longest_reading_s_, plan.report.planning_cpu_s - solved_at);
    return plan;
  }

  void reset() override { last_.reset(); }
  void record(const Recorder& recorder) override {
    recorder_.reset();
    if (recorder.wanted && recorder.take) recorder_ = recorder;
  }

 private:
  /// The form for the goal in or out of range and for as many obstacles as are chosen, transcribed
  /// when it is first wanted.
  Form& form(bool in_range) {
    const auto key = std::pair(in_range, chosen_.size());
    const auto found = forms_.find(key);
    if (found != forms_.end()) return found->second;
    Task chosen = task_;
    chosen.obstacles = chosen_;
    return forms_.try_emplace(key, TrajectoryProblem(chosen, in_range), settings_).first->second;
  }

  /// Chooses this cycle's obstacles. Multipliers carry over only where the last solve had the same.
  void choose(const Request& request) {
    const bool measured = !request.obstacles.empty();
    if (settings_.obstacle_choice == ObstacleChoice::all && !measured && as_made_) return;
    as_made_ = !measured;
    auto now = choose_obstacles(
        settings_, request,
        measured ? group_obstacles(settings_, request.obstacles) : task_.obstacles);
    same_obstacles_ = same_names(now, chosen_);
    chosen_ = std::move(now);
    for (const bool in_range : {false, true}) {
      const auto found = forms_.find(std::pair(in_range, chosen_.size()));
      if (found != forms_.end()) found->second.problem.set_obstacles(chosen_);
    }
  }

  /// The guess, as a point of the NLP.
  std::vector<double> start_point(const Request& request, bool in_range) {
    ocp::Trajectory& guess = guess_(request, in_range, last_ ? &*last_ : nullptr);
    form(in_range).problem.map().to_planner(guess);
    return form(in_range).transcription.point(guess);
  }

  /// One solve without an iteration of either form, so that all memory is there before the first
  /// cycle and when the goal comes into range.
  void prepare() {
    for (const bool in_range : {true, false}) {
      ocp::Transcription& transcription = form(in_range).transcription;
      start_.x = start_point({}, in_range);
      nlp::Options options = solver_options(settings_, {});
      options.max_iterations = 0;
      solver_->solve(transcription, start_, options, answer_);
    }
  }

  /// The last solve, but for what judging it brings.
  Recording record_solve(const Request& request, bool in_range, const nlp::Options& options) const {
    Recording r{
        request.X0p,   request.t0,     request.t_start, in_range,           current_kernels(),
        options,       start_,         answer_.status,  answer_.iterations, 0,
        answer_.cpu_s, answer_.wall_s, answer_.point,   request.obstacles};
    r.options.stop = nullptr;
    r.options.stop_data = nullptr;
    return r;
  }

  /// The answer as a plan, judged. The next solve starts from one to be driven, and goes on from
  /// one that was cut short.
  Plan read(const Request& request, bool in_range, const nlp::Options& options) {
    ocp::Transcription& transcription = form(in_range).transcription;
    Plan plan;
    plan.goal_in_range = in_range;
    auto trajectory = transcription.trajectory(answer_.point.x);
    form(in_range).problem.map().to_plant(request.X0p, trajectory);
    plan.t_start = request.t_start;
    plan.tf = trajectory.tf;
    plan.obstacle_time_held = settings_.moving_avoidance ? -1 : request.t0;
    const std::size_t points = trajectory.tau.size();
    plan.t.reserve(points);
    plan.states.resize(points);
    plan.controls.resize(points);
    for (std::size_t k = 0; k < points; ++k) {
      plan.t.push_back(trajectory.tau[k] * trajectory.tf);
      std::copy_n(trajectory.states[k].begin(), kStates, plan.states[k].begin());
      std::copy_n(trajectory.controls[k].begin(), kControls, plan.controls[k].begin());
    }
    plan.report = report(request, transcription, options);
    if (plan.report.solved || plan.report.best_iterate || cut_short(answer_.status)) {
      last_ = LastPlan{plan.t_start, request.X0p, std::move(trajectory), in_range};
      std::swap(start_.y, answer_.point.y);
      std::swap(start_.zl, answer_.point.zl);
      std::swap(start_.zu, answer_.point.zu);
    }
    return plan;
  }

  SolveReport report(const Request& request, ocp::Transcription& transcription,
                     const nlp::Options& options) const {
    const auto residuals = nlp::check(transcription, answer_.point, options);
    SolveReport report;
    const bool claimed = answer_.status == nlp::Status::solved;
    report.solved = claimed && residuals.solved(options);
    report.status =
        claimed && !report.solved ? PlanStatus::not_confirmed : plan_status(answer_.status);
    report.best_iterate = !report.solved && residuals.violation <= request.best_iterate_tol;
    report.backend = answer_.backend;
    report.iterations = answer_.iterations;
    report.cpu_s = answer_.cpu_s;
    report.wall_s = answer_.wall_s;
    report.cost = residuals.objective;
    report.cost_terms = transcription.cost_terms(answer_.point.x);
    report.phi = residuals.phi;
    report.worst_violation = residuals.violation;
    report.worst_constraint = residuals.worst_constraint;
    report.stationarity = residuals.stationarity;
    report.complementarity = residuals.complementarity;
    return report;
  }

  const Task task_;  ///< its obstacles grouped
  const Settings& settings_;
  std::vector<world::Obstacle> chosen_;                 ///< of these, in this cycle
  bool same_obstacles_ = true;                          ///< as in the last solve
  bool as_made_ = true;                                 ///< none measured in the last cycle
  std::map<std::pair<bool, std::size_t>, Form> forms_;  ///< goal in range, number of obstacles
  Guess guess_;
  std::optional<Recorder> recorder_;
  std::unique_ptr<nlp::Solver> solver_;
  nlp::Start start_;  ///< its multipliers are the last plan's
  nlp::Answer answer_;
  std::optional<LastPlan> last_;  ///< where the next solve starts
  double longest_reading_s_ = 0;  ///< thread time of a cycle after its solve
};

}  // namespace

Planner::Planner(const Task& task) {
  if (task.planner.method == Method::verified)
    method_ = std::make_unique<VerifiedPlanner>(task);
  else
    method_ = std::make_unique<RecedingHorizon>(task);
}
Planner::~Planner() = default;
Planner::Planner(Planner&&) noexcept = default;
Planner& Planner::operator=(Planner&&) noexcept = default;

Plan Planner::plan(const Request& request) {
  return method_->plan(request);
}
void Planner::reset() {
  method_->reset();
}
void Planner::record(const Recorder& recorder) {
  method_->record(recorder);
}

}  // namespace slalom::planner
