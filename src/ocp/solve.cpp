#include "slalom/ocp/solve.hpp"

#include <algorithm>

#include "slalom/base/error.hpp"
#include "slalom/base/options.hpp"
#include "slalom/ocp/transcription.hpp"

namespace slalom::ocp {
namespace {

std::size_t index_of(const std::string& name, const std::vector<std::string>& known,
                     const char* what) {
  const auto it = std::find(known.begin(), known.end(), name);
  if (it != known.end()) return static_cast<std::size_t>(it - known.begin());
  std::string list;
  for (const auto& each : known) list += (list.empty() ? "" : ", ") + each;
  const std::string nearest = nearest_name(name, known);
  throw InvalidValue("solution", std::string("no ") + what + " '" + name + "'",
                     !nearest.empty() ? "perhaps '" + nearest + "'"
                     : list.empty()   ? std::string("a problem with one")
                                      : "one of " + list);
}

std::vector<double> column(const std::vector<std::vector<double>>& rows, std::size_t i) {
  std::vector<double> result;
  result.reserve(rows.size());
  for (const auto& row : rows) result.push_back(row[i]);
  return result;
}

template <class List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  for (const auto& item : list) names.push_back(item.name);
  return names;
}

}  // namespace

std::vector<double> Solution::time() const {
  std::vector<double> result;
  for (std::size_t k = 0; k < trajectory.tau.size(); ++k) result.push_back(trajectory.time(k));
  return result;
}
std::vector<double> Solution::state(const std::string& name) const {
  return column(trajectory.states, index_of(name, state_names, "state"));
}
std::vector<double> Solution::control(const std::string& name) const {
  return column(trajectory.controls, index_of(name, control_names, "control"));
}
double Solution::static_parameter(const std::string& name) const {
  return trajectory.static_parameters[index_of(name, static_parameter_names, "static parameter")];
}
double Solution::slack(const std::string& name) const {
  return trajectory.slacks[index_of(name, slack_names, "slack")];
}
double Solution::cost_term(const std::string& name) const {
  std::vector<std::string> names;
  for (const auto& term : cost_terms) names.push_back(term.first);
  return cost_terms[index_of(name, names, "cost term")].second;
}
std::vector<double> Solution::costate(const std::string& state_name) const {
  return column(costates, index_of(state_name, state_names, "state"));
}

Solution solve(const Problem& problem, const SolveSettings& settings) {
  Transcription transcription(problem, settings.mesh, settings.scheme);
  nlp::Options options = settings.options;
  nlp::Start start = settings.warm_start;
  options.warm_start = !start.x.empty();
  if (start.x.empty())
    start.x = transcription.point(settings.guess.tau.empty() ? transcription.straight_guess()
                                                             : settings.guess);
  nlp::Answer answer = nlp::make_solver(settings.backend)->solve(transcription, start, options);

  Solution solution;
  solution.status = answer.status;
  solution.fault = answer.fault;
  solution.objective = answer.objective;
  solution.cost_terms = transcription.cost_terms(answer.point.x);
  solution.trajectory = transcription.trajectory(answer.point.x);
  solution.costates = transcription.costates(answer.point.x, answer.point.y);
  solution.residuals = nlp::check(transcription, answer.point, options);
  solution.options = options;
  solution.point = std::move(answer.point);
  solution.iterations = answer.iterations;
  solution.wall_s = answer.wall_s;
  solution.state_names = names_of(problem.states());
  solution.control_names = names_of(problem.controls());
  solution.static_parameter_names = names_of(problem.static_parameters());
  solution.slack_names = names_of(problem.slacks());
  return solution;
}

}  // namespace slalom::ocp
