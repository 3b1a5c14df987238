#include "solving.hpp"

#include "slalom/nlp/check.hpp"

namespace slalom::planner {

void stop_when(const std::function<bool()>& interrupted, nlp::Options& options) {
  if (!interrupted) return;
  options.stop = [](void* data) { return (*static_cast<const std::function<bool()>*>(data))(); };
  options.stop_data = const_cast<std::function<bool()>*>(&interrupted);
}

nlp::Options solver_options(const Settings& settings, const Request& request) {
  nlp::Options options;
  options.floor = settings.floor;
  options.tol = settings.tol;
  options.max_iterations = settings.max_iterations;
  stop_when(request.interrupted, options);
  return options;
}

bool cut_short(nlp::Status status) {
  return status == nlp::Status::time_limit || status == nlp::Status::interrupted;
}

SolveReport report_of(const nlp::Answer& answer, ocp::Transcription& transcription,
                      const Request& request, const nlp::Options& options) {
  const auto residuals = nlp::check(transcription, answer.point, options);
  SolveReport report;
  const bool claimed = answer.status == nlp::Status::solved;
  report.solved = claimed && residuals.solved(options);
  report.status =
      claimed && !report.solved ? PlanStatus::not_confirmed : plan_status(answer.status);
  report.best_iterate = !report.solved && residuals.violation <= request.best_iterate_tol;
  report.backend = answer.backend;
  report.iterations = answer.iterations;
  report.cpu_s = answer.cpu_s;
  report.wall_s = answer.wall_s;
  report.cost = residuals.objective;
  report.cost_terms = transcription.last_cost_terms();  // where the check evaluated
  report.phi = residuals.phi;
  report.worst_violation = residuals.violation;
  report.worst_constraint = residuals.worst_constraint;
  report.stationarity = residuals.stationarity;
  report.complementarity = residuals.complementarity;
  return report;
}

void SolveTotals::add(const nlp::Answer& answer) {
  cpu_s += answer.cpu_s;
  wall_s += answer.wall_s;
  iterations += answer.iterations;
}

void SolveTotals::put(SolveReport& report) const {
  report.cpu_s = cpu_s;
  report.wall_s = wall_s;
  report.iterations = iterations;
}

Recording recorded(const Request& request, bool in_range, const nlp::Options& options,
                   const nlp::Start& start, const nlp::Answer& answer) {
  Recording r{request.X0p,  request.t0,    request.t_start, in_range,          current_kernels(),
              options,      start,         answer.status,   answer.iterations, 0,
              answer.cpu_s, answer.wall_s, answer.point,    request.obstacles};
  r.options.stop = nullptr;
  r.options.stop_data = nullptr;
  return r;
}

ocp::Mesh mesh_of(const std::vector<double>& lengths) {
  std::vector<double> tau{0};
  for (const double length : lengths) tau.push_back(tau.back() + length);
  const double whole = tau.back();
  for (double& t : tau) t /= whole;
  return ocp::Mesh(tau);
}

}  // namespace slalom::planner
