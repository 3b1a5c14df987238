#include "slalom/planner/planner.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "slalom/nlp/check.hpp"
#include "slalom/nlp/solver.hpp"
#include "slalom/ocp/transcription.hpp"
#include "trajectory_problem.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;

const ocp::Scheme& scheme_of(const Settings& settings) {
  return settings.scheme == SchemeChoice::trapezoidal ? ocp::trapezoidal() : ocp::hermite_simpson();
}

nlp::Options solver_options(const Settings& settings, const Request& request) {
  nlp::Options options;
  options.floor = settings.floor;
  options.tol = settings.tol;
  options.max_iterations = settings.max_iterations;
  options.time_limit = request.time_limit;
  if (request.interrupted) {
    options.stop = [](void* data) { return (*static_cast<const std::function<bool()>*>(data))(); };
    options.stop_data = const_cast<std::function<bool()>*>(&request.interrupted);
  }
  return options;
}

/// Straight on from X0p at its heading and speed, controls zero (section 3, "Guess").
ocp::Trajectory straight_on(const Request& request, const Settings& settings, const Goal& goal) {
  const State& X0p = request.X0p;
  const double distance = std::hypot(X0p[X] - goal.x, X0p[Y] - goal.y);
  const double tf = std::clamp(std::min(settings.L_range, distance) / std::max(X0p[UX], 5.0),
                               1.01 * settings.tf_min, 0.99 * settings.tf_max);
  std::vector<double> end(kStates, 0.0);
  end[X] = X0p[X] + tf * X0p[UX] * std::cos(X0p[PSI]);
  end[Y] = X0p[Y] + tf * X0p[UX] * std::sin(X0p[PSI]);
  end[PSI] = X0p[PSI];
  end[UX] = X0p[UX];
  return {0, tf, {0, 1}, {{X0p.begin(), X0p.end()}, end}, {{0, 0}, {0, 0}}, {}, {}};
}

/// One of the OCP's two forms, transcribed once and solved many times.
struct Form {
  TrajectoryProblem problem;
  ocp::Transcription transcription;

  Form(TrajectoryProblem p, const Settings& settings)
      : problem(std::move(p)),
        transcription(problem.problem(), ocp::Mesh::uniform(settings.N), scheme_of(settings)) {}
};

}  // namespace

class Planner::Impl {
 public:
  Impl(const Settings& settings, const Parameters& vehicle, const Goal& goal, const Region& region,
       std::vector<Obstacle> obstacles)
      : settings_(settings),
        vehicle_(vehicle),
        goal_(goal),
        region_(region),
        obstacles_(std::move(obstacles)) {
    check(settings_, "planner " + settings_.name);
    solver_ = nlp::make_solver(to_string(settings_.solver));
  }

  Plan plan(const Request& request) {
    const bool in_range =
        std::hypot(request.X0p[X] - goal_.x, request.X0p[Y] - goal_.y) < settings_.L_range;
    Form& form = form_for(request, in_range);
    nlp::Options options = solver_options(settings_, request);
    const nlp::Start start = make_start(request, form.transcription, in_range, options);
    nlp::Answer answer = solver_->solve(form.transcription, start, options);
    Plan plan = read(request, form.transcription, answer, options);
    plan.goal_in_range = in_range;
    if (plan.report.solved)
      last_ = Last{plan, request.X0p, form.transcription.trajectory(answer.point.x).slacks,
                   std::move(answer.point), in_range};
    return plan;
  }

  void reset() { last_.reset(); }

 private:
  /// The last solved plan, from which the next solve starts.
  struct Last {
    Plan plan;
    State X0p;
    std::vector<double> slacks;
    nlp::Start point;
    bool in_range;
  };

  Form& form_for(const Request& request, bool in_range) {
    auto& form = forms_[in_range ? 1 : 0];
    if (form) {
      form->problem.update(request);
      form->transcription.update(form->problem.problem());
    } else {
      TrajectoryProblem problem(settings_, vehicle_, goal_, region_, obstacles_, in_range);
      problem.update(request);
      form.emplace(std::move(problem), settings_);
    }
    return *form;
  }

  nlp::Start make_start(const Request& request, const ocp::Transcription& transcription,
                        bool in_range, nlp::Options& options) const {
    ocp::Trajectory guess = last_ ? shifted(request) : straight_on(request, settings_, goal_);
    place_slacks(request, in_range, guess);
    nlp::Start start;
    start.x = transcription.point(guess);
    if (last_ && last_->in_range == in_range) {
      start.y = last_->point.y;
      start.zl = last_->point.zl;
      start.zu = last_->point.zu;
      options.warm_start = true;
    }
    return start;
  }

  /// The last plan from the new start on, its last point held, its end time kept.
  ocp::Trajectory shifted(const Request& request) const {
    const Plan& plan = last_->plan;
    const double shift = request.t0 + request.tex - plan.t_start;
    ocp::Trajectory guess;
    guess.tf = std::clamp(std::max(plan.tf - shift, 0.2), 1.01 * settings_.tf_min,
                          0.99 * settings_.tf_max);
    const std::size_t samples = 1 + static_cast<std::size_t>(settings_.N) * 2;
    for (std::size_t k = 0; k < samples; ++k) {
      const double tau = static_cast<double>(k) / static_cast<double>(samples - 1);
      guess.tau.push_back(tau);
      sample(plan, shift + tau * guess.tf, guess);
    }
    return guess;
  }

  static void sample(const Plan& plan, double t, ocp::Trajectory& guess) {
    const auto above = std::upper_bound(plan.t.begin(), plan.t.end(), t);
    const auto k = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
        above - plan.t.begin(), 1, static_cast<std::ptrdiff_t>(plan.t.size()) - 1));
    const double share = std::clamp((t - plan.t[k - 1]) / (plan.t[k] - plan.t[k - 1]), 0.0, 1.0);
    const auto mix = [&](const auto& a, const auto& b) {
      std::vector<double> row(a.size());
      for (std::size_t i = 0; i < a.size(); ++i) row[i] = a[i] + share * (b[i] - a[i]);
      return row;
    };
    guess.states.push_back(mix(plan.states[k - 1], plan.states[k]));
    guess.controls.push_back(mix(plan.controls[k - 1], plan.controls[k]));
  }

  /// X(0) and the slacks inside their rows. After a solved plan X(0) keeps its offset from X0p and
  /// the slacks their values, so that these rows start where the barrier left them.
  void place_slacks(const Request& request, bool in_range, ocp::Trajectory& guess) const {
    for (std::size_t i = 0; i < kStates; ++i) {
      const double tol = settings_.X0_tol[i];
      const double offset = last_ ? last_->plan.states.front()[i] - last_->X0p[i] : 0;
      guess.states.front()[i] = request.X0p[i] + offset;
      guess.slacks.push_back(last_ ? last_->slacks[i]
                                   : inside(tol, settings_.w_ic * settings_.w_s0[i]));
    }
    if (!in_range) return;
    const auto& end = guess.states.back();
    for (const double gap : {std::fabs(end[X] - goal_.x), std::fabs(end[Y] - goal_.y)})
      guess.slacks.push_back(gap < settings_.XF_tol
                                 ? gap + inside(settings_.XF_tol - gap, settings_.w_xf)
                                 : settings_.XF_tol * 0.99);
  }

  /// Where the barrier alone would hold a slack of this weight: 2 mu / w off its two rows, and at
  /// most half of its room.
  double inside(double room, double weight) const {
    const double mu = settings_.floor > 0 ? settings_.floor : 0.1;
    return std::min(weight > 0 ? 2 * mu / weight : room, room / 2);
  }

  Plan read(const Request& request, ocp::Transcription& transcription, const nlp::Answer& answer,
            const nlp::Options& options) const {
    Plan plan;
    const auto trajectory = transcription.trajectory(answer.point.x);
    plan.t_start = request.t0 + request.tex;
    plan.tf = trajectory.tf;
    plan.obstacle_time_held = settings_.moving_avoidance ? -1 : request.t0;
    for (std::size_t k = 0; k < trajectory.tau.size(); ++k) {
      plan.t.push_back(trajectory.tau[k] * trajectory.tf);
      std::copy_n(trajectory.states[k].begin(), kStates, plan.states.emplace_back().begin());
      std::copy_n(trajectory.controls[k].begin(), kControls, plan.controls.emplace_back().begin());
    }
    const auto residuals = nlp::check(transcription, answer.point, options);
    SolveReport& report = plan.report;
    const bool claimed = answer.status == nlp::Status::solved;
    report.solved = claimed && residuals.solved(options);
    report.status = claimed && !report.solved ? "not_confirmed" : nlp::to_string(answer.status);
    report.backend = answer.backend;
    report.iterations = answer.iterations;
    report.cpu_s = answer.cpu_s;
    report.wall_s = answer.wall_s;
    report.cost = residuals.objective;
    report.cost_terms = transcription.cost_terms(answer.point.x);
    report.phi = residuals.phi;
    report.worst_violation = residuals.violation;
    report.worst_constraint = residuals.worst_constraint;
    report.stationarity = residuals.stationarity;
    report.complementarity = residuals.complementarity;
    return plan;
  }

  const Settings settings_;
  const Parameters vehicle_;
  const Goal goal_;
  const Region region_;
  const std::vector<Obstacle> obstacles_;
  std::unique_ptr<nlp::Solver> solver_;
  std::array<std::optional<Form>, 2> forms_;  ///< goal out of range, in range
  std::optional<Last> last_;
};

Planner::Planner(const Settings& settings, const Parameters& vehicle, const Goal& goal,
                 const Region& region, std::vector<Obstacle> obstacles)
    : impl_(std::make_unique<Impl>(settings, vehicle, goal, region, std::move(obstacles))) {}
Planner::~Planner() = default;
Planner::Planner(Planner&&) noexcept = default;
Planner& Planner::operator=(Planner&&) noexcept = default;

Plan Planner::plan(const Request& request) {
  return impl_->plan(request);
}
void Planner::reset() {
  impl_->reset();
}

}  // namespace slalom::planner
