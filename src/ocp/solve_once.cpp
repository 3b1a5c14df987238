#include "solve_once.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "conflicts.hpp"
#include "set_up_watch.hpp"
#include "slalom/base/error.hpp"
#include "slalom/ocp/moments.hpp"
#include "slalom/ocp/scaling.hpp"
#include "slalom/ocp/transcription.hpp"
#include "solved.hpp"
#include "unwind.hpp"

namespace slalom::ocp {
namespace {

void append(const nlp::Start& part, nlp::Start& whole) {
  for (auto list : {&nlp::Start::x, &nlp::Start::y, &nlp::Start::zl, &nlp::Start::zu})
    (whole.*list).insert((whole.*list).end(), (part.*list).begin(), (part.*list).end());
}

/// One entry for each phase, or none for defaults.
template <class List>
void check_count(const PhasedProblem& problem, const char* what, const List& list) {
  if (!list.empty() && list.size() != problem.phases().size())
    throw InvalidValue(problem.name() + ": " + what, std::to_string(list.size()),
                       std::to_string(problem.phases().size()) + ", one for each phase, or none");
}

void tell_end(const SetUpWatch& watch, nlp::Status status, const nlp::Options& options,
              auto& solution) {
  solution.status = status;
  solution.objective = std::numeric_limits<double>::quiet_NaN();
  solution.options = options;
  solution.wall_s = watch.seconds();
}

/// What the set-up has left of the time limit.
nlp::Options left(const SetUpWatch& watch, nlp::Options options) {
  options.time_limit = std::max(0.0, options.time_limit - watch.seconds());
  return options;
}

/// Whether the settings' point is the start: with an answer to carry beside it, if it fits.
template <class Settings>
bool starts_from_point(const Settings& settings, const nlp::Structure& shape) {
  const nlp::Start& point = settings.warm_start;
  if (point.x.empty()) return false;
  return settings.previous == nullptr ||
         (point.x.size() == shape.variables && point.y.size() == shape.rows &&
          point.zl.size() == shape.variables && point.zu.size() == shape.variables);
}

Solution solve_within(SetUpWatch& watch, const Problem& problem, const SolveSettings& settings) {
  const auto grid = with_moments(problem, {settings.mesh, settings.scheme});
  const Beginning beginning = begin(problem, grid, settings.guess, settings.previous);
  const Problem scaled = with_scales(problem, beginning.guess);
  Transcription transcription(scaled, grid.mesh, grid.schemes);
  const nlp::Start start = starts_from_point(settings, transcription.structure())
                               ? from_user(settings.warm_start, transcription.structure())
                               : start_of(transcription, beginning);
  watch.over();
  const auto solver = nlp::make_solver(settings.backend);
  Solution solution;
  auto point = run(transcription, *solver, left(watch, settings.options), start,
                   transcription.regular_variables(), solution);
  if (solution.iterations > 0 && unwind(scaled, transcription, point.x))
    solution.point = to_user(point, transcription.structure());
  describe(scaled, grid, Tables(scaled), transcription, point, solution);
  return solution;
}

/// An answer's multiplier of a link; 0 of one that it has not.
double link_multiplier(const PhasedSolution& answer, const std::string& link) {
  for (const auto& [name, multiplier] : answer.link_multipliers)
    if (name == link) return multiplier;
  return 0;
}

/// Multipliers are carried if they are known in all phases.
nlp::Start start_of(const PhasedProblem& problem, PhasedTranscription& transcription,
                    const std::vector<Beginning>& beginnings, const PhasedSolution* previous) {
  nlp::Start start;
  for (std::size_t p = 0; p < beginnings.size(); ++p)
    append(start_of(transcription.phase(p), beginnings[p]), start);
  if (!std::all_of(beginnings.begin(), beginnings.end(),
                   [](const Beginning& each) { return each.duals.has_value(); }))
    return {std::move(start.x), {}, {}, {}};
  const auto& row_scale = transcription.structure().row_scale;
  for (std::size_t l = 0; l < problem.links().size(); ++l)
    start.y.push_back(link_multiplier(*previous, problem.links()[l].name) /
                      row_scale[transcription.first_link() + l]);
  return start;
}

/// Removes full turns of angles from all phases of a point; whether there were any.
bool unwind_phases(const PhasedProblem& problem, PhasedTranscription& transcription,
                   nlp::Start& point) {
  bool unwound = false;
  auto first = point.x.begin();  // of the phase's variables, which follow those of the phase before
  for (std::size_t p = 0; p < problem.phases().size(); ++p) {
    std::vector<double> x = transcription.part_of(p, point).x;
    unwound = unwind(problem.phases()[p], transcription.phase(p), x) || unwound;
    first = std::copy(x.begin(), x.end(), first);
  }
  return unwound;
}

PhasedSolution solve_within(SetUpWatch& watch, const PhasedProblem& problem,
                            const PhasedSettings& settings) {
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
    grids[p] = with_moments(problem.phases()[p], grids[p]);
    beginnings.push_back(begin(problem.phases()[p], grids[p],
                               settings.guesses.empty() ? Trajectory{} : settings.guesses[p],
                               previous == nullptr ? nullptr : &previous->phases[p]));
    scaled.replace(p, with_scales(problem.phases()[p], beginnings[p].guess));
  }
  PhasedTranscription transcription(scaled, grids);
  const nlp::Start start = starts_from_point(settings, transcription.structure())
                               ? from_user(settings.warm_start, transcription.structure())
                               : start_of(problem, transcription, beginnings, previous);
  std::vector<char> regular;
  for (std::size_t p = 0; p < phases; ++p) {
    const auto counts = transcription.phase(p).regular_variables();
    regular.insert(regular.end(), counts.begin(), counts.end());
  }
  watch.over();
  const auto solver = nlp::make_solver(settings.backend);
  PhasedSolution solution;
  nlp::Start point =
      run(transcription, *solver, left(watch, settings.options), start, regular, solution);
  if (solution.iterations > 0 && unwind_phases(scaled, transcription, point))
    solution.point = to_user(point, transcription.structure());
  describe(scaled, grids, transcription, point, solution);
  if (knows_conflicts(solution)) solution.conflicts = conflicts(scaled, solution);
  return solution;
}

Solution stopped_at_set_up(const SetUpWatch& watch, nlp::Status status, const Problem& problem,
                           const SolveSettings& settings) {
  Solution solution =
      not_begun(problem, {settings.mesh, settings.scheme}, settings.guess, settings.previous);
  tell_end(watch, status, settings.options, solution);
  return solution;
}

PhasedSolution stopped_at_set_up(const SetUpWatch& watch, nlp::Status status,
                                 const PhasedProblem& problem, const PhasedSettings& settings) {
  PhasedSolution solution;
  for (std::size_t p = 0; p < problem.phases().size(); ++p) {
    solution.phases.push_back(
        not_begun(problem.phases()[p],
                  p < settings.grids.size() ? settings.grids[p] : PhasedTranscription::Grid{},
                  p < settings.guesses.size() ? settings.guesses[p] : Trajectory{},
                  settings.previous == nullptr ? nullptr : &settings.previous->phases[p]));
    tell_end(watch, status, settings.options, solution.phases.back());
  }
  tell_end(watch, status, settings.options, solution);
  return solution;
}

template <class Problem, class Settings>
auto solve_watched(const Problem& problem, const Settings& settings) {
  SetUpWatch watch(settings.options);
  try {
    return solve_within(watch, problem, settings);
  } catch (const SetUpWatch::Stopped& stopped) {
    watch.over();
    return stopped_at_set_up(watch, stopped.status, problem, settings);
  }
}

}  // namespace

Solution solve_once(const Problem& problem, const SolveSettings& settings) {
  return solve_watched(problem, settings);
}

PhasedSolution solve_once(const PhasedProblem& problem, const PhasedSettings& settings) {
  return solve_watched(problem, settings);
}

}  // namespace slalom::ocp
