#include "slalom/ocp/solve.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "objective_scale.hpp"
#include "slalom/base/error.hpp"
#include "slalom/base/options.hpp"
#include "slalom/ocp/guess.hpp"
#include "slalom/ocp/interpolant.hpp"
#include "slalom/ocp/scaling.hpp"
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
const Multipliers& Solution::multiplier(const std::string& name) const {
  return multipliers[index_of(name, names_of(multipliers), "multiplier")];
}
const Excesses& Solution::excess(const std::string& name) const {
  return excesses[index_of(name, names_of(excesses), "soft constraint")];
}
double Solution::cost_term(const std::string& name) const {
  std::vector<std::string> names;
  for (const auto& term : cost_terms) names.push_back(term.first);
  return cost_terms[index_of(name, names, "cost term")].second;
}
std::vector<double> Solution::costate(const std::string& state_name) const {
  return column(costates, index_of(state_name, state_names, "state"));
}

namespace {

/// What a point says of one phase.
void describe(const Problem& problem, const PhasedTranscription::Grid& grid,
              Transcription& transcription, const nlp::Start& point, Solution& solution) {
  solution.mesh = grid.mesh;
  for (const auto& state : problem.states()) solution.state_units.push_back(state.unit());
  solution.scheme = grid.schemes;
  solution.cost_terms = transcription.cost_terms(point.x);
  solution.trajectory = transcription.trajectory(point.x);
  solution.costates = transcription.costates(point.x, point.y);
  solution.collocated_costates = transcription.collocated_costates(point.y);
  solution.multipliers = transcription.multipliers(point);
  solution.excesses = transcription.excesses(point.x);
  solution.state_names = names_of(problem.states());
  solution.control_names = names_of(problem.controls());
  solution.static_parameter_names = names_of(problem.static_parameters());
  solution.slack_names = names_of(problem.slacks());
}

/// A point of the NLP in the user's units, and back.
nlp::Start to_user(nlp::Start point, const nlp::Structure& shape) {
  for (std::size_t i = 0; i < point.x.size(); ++i) point.x[i] *= shape.variable_scale[i];
  for (auto* z : {&point.zl, &point.zu})
    for (std::size_t i = 0; i < z->size(); ++i) (*z)[i] /= shape.variable_scale[i];
  for (std::size_t r = 0; r < point.y.size(); ++r) point.y[r] *= shape.row_scale[r];
  return point;
}
nlp::Start from_user(nlp::Start point, const nlp::Structure& shape) {
  nlp::check_sizes(point, shape, true);
  for (std::size_t i = 0; i < point.x.size(); ++i) point.x[i] /= shape.variable_scale[i];
  for (auto* z : {&point.zl, &point.zu})
    for (std::size_t i = 0; i < z->size(); ++i) (*z)[i] *= shape.variable_scale[i];
  for (std::size_t r = 0; r < point.y.size(); ++r) point.y[r] /= shape.row_scale[r];
  return point;
}

/// Solves and checks from a start in the NLP's units, with multipliers or without; `solution` is of
/// one phase or of several. The NLP's answer, in its own units, is returned.
template <class Result>
nlp::Start run(nlp::Problem& problem, const std::string& backend, nlp::Options options,
               const nlp::Start& start, const std::vector<char>& regular, Result& solution) {
  options.warm_start = !start.y.empty();
  nlp::Answer answer = solve_scaled(problem, *nlp::make_solver(backend), start, options, regular);
  solution.status = answer.status;
  solution.fault = answer.fault;
  solution.objective = answer.objective;
  solution.residuals = nlp::check(problem, answer.point, options);
  solution.options = options;
  solution.backend = answer.backend;
  solution.iterations = answer.iterations;
  solution.wall_s = answer.wall_s;
  solution.point = to_user(answer.point, problem.structure());
  return std::move(answer.point);
}

/// What one phase starts from.
struct Beginning {
  Trajectory guess;
  std::optional<Duals> duals;
};

Beginning begin(const Problem& problem, const PhasedTranscription::Grid& grid,
                const Trajectory& guess, const Solution* previous) {
  if (previous != nullptr) {
    const Interpolant polynomials(problem, previous->trajectory, previous->mesh, previous->scheme);
    return {polynomials.resampled(grid.mesh, grid.schemes),
            Duals{previous->trajectory.tau, previous->collocated_costates, previous->multipliers}};
  }
  if (guess.tau.empty()) return {straight_guess(problem), {}};
  check_guess(guess, problem);
  return {guess, {}};
}

nlp::Start start_of(Transcription& transcription, const Beginning& beginning) {
  if (beginning.duals) return transcription.carried(beginning.guess, *beginning.duals);
  return {transcription.point(beginning.guess), {}, {}, {}};
}

void append(const nlp::Start& part, nlp::Start& whole) {
  for (auto list : {&nlp::Start::x, &nlp::Start::y, &nlp::Start::zl, &nlp::Start::zu})
    (whole.*list).insert((whole.*list).end(), (part.*list).begin(), (part.*list).end());
}

/// One entry a phase, or none for defaults.
template <class List>
void check_count(const PhasedProblem& problem, const char* what, const List& list) {
  if (!list.empty() && list.size() != problem.phases().size())
    throw InvalidValue(problem.name() + ": " + what, std::to_string(list.size()),
                       std::to_string(problem.phases().size()) + ", one a phase, or none");
}

}  // namespace

Solution solve(const Problem& problem, const SolveSettings& settings) {
  const PhasedTranscription::Grid grid{settings.mesh, settings.scheme};
  const Beginning beginning = begin(problem, grid, settings.guess, settings.previous);
  const Problem scaled = with_scales(problem, beginning.guess);
  Transcription transcription(scaled, settings.mesh, settings.scheme);
  const bool warm = settings.previous == nullptr && !settings.warm_start.x.empty();
  const nlp::Start start = warm ? from_user(settings.warm_start, transcription.structure())
                                : start_of(transcription, beginning);
  Solution solution;
  const auto point = run(transcription, settings.backend, settings.options, start,
                         transcription.regular_variables(), solution);
  describe(scaled, grid, transcription, point, solution);
  return solution;
}

PhasedSolution solve(const PhasedProblem& problem, const PhasedSettings& settings) {
  const std::size_t phases = problem.phases().size();
  auto grids = settings.grids;
  if (grids.empty()) grids.resize(phases);
  check_count(problem, "guesses", settings.guesses);
  const PhasedSolution* previous = settings.previous;
  if (previous != nullptr)
    check_count(problem, "phases of the previous solution", previous->phases);
  std::vector<Beginning> beginnings;
  PhasedProblem scaled = problem;
  for (std::size_t p = 0; p < phases && p < grids.size(); ++p) {
    beginnings.push_back(begin(problem.phases()[p], grids[p],
                               settings.guesses.empty() ? Trajectory{} : settings.guesses[p],
                               previous == nullptr ? nullptr : &previous->phases[p]));
    scaled.replace(p, with_scales(problem.phases()[p], beginnings[p].guess));
  }
  PhasedTranscription transcription(scaled, grids);
  nlp::Start start;
  std::vector<char> regular;
  for (std::size_t p = 0; p < phases; ++p) {
    append(start_of(transcription.phase(p), beginnings[p]), start);
    const auto counts = transcription.phase(p).regular_variables();
    regular.insert(regular.end(), counts.begin(), counts.end());
  }
  const auto& row_scale = transcription.structure().row_scale;
  if (previous != nullptr)
    for (std::size_t l = 0; l < problem.links().size(); ++l)
      start.y.push_back(previous->link_multipliers.at(l).second /
                        row_scale[transcription.first_link() + l]);
  else if (!settings.warm_start.x.empty())
    start = from_user(settings.warm_start, transcription.structure());
  PhasedSolution solution;
  const auto point =
      run(transcription, settings.backend, settings.options, start, regular, solution);
  for (std::size_t p = 0; p < phases; ++p) {
    Solution& part = solution.phases.emplace_back();
    describe(scaled.phases()[p], grids[p], transcription.phase(p), transcription.part_of(p, point),
             part);
    part.status = solution.status;
    part.residuals = solution.residuals;
    part.options = solution.options;
    part.backend = solution.backend;
    part.iterations = solution.iterations;
    part.wall_s = solution.wall_s;
    for (const auto& term : part.cost_terms) part.objective += term.second;
  }
  for (std::size_t l = 0; l < problem.links().size(); ++l) {
    const std::size_t row = transcription.first_link() + l;
    solution.link_multipliers.emplace_back(problem.links()[l].name, point.y[row] * row_scale[row]);
  }
  return solution;
}

}  // namespace slalom::ocp
