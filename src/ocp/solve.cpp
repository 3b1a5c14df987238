#include "slalom/ocp/solve.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "conflicts.hpp"
#include "lookup.hpp"
#include "moved.hpp"
#include "set_up_watch.hpp"
#include "simulated_guess.hpp"
#include "slalom/base/error.hpp"
#include "slalom/ocp/guess.hpp"
#include "slalom/ocp/moments.hpp"
#include "slalom/ocp/scaling.hpp"
#include "slalom/ocp/transcription.hpp"
#include "solved.hpp"
#include "unwind.hpp"

namespace slalom::ocp {
namespace {

/// Starts beside the first, where that ends at a point that is stationary for the violation.
constexpr std::uint64_t kMoreTries = 5;

/// Intervals of the meshes by which a solve that failed is tried again. On so few there is little
/// to lose one's way in, and an answer is most of the way to one on a finer mesh (Betts 2010,
/// section 4.6, begins on coarse meshes for that reason).
constexpr int kCoarseMeshes[] = {4, 10};
/// Of the way from a control's lower to its upper bound: the held controls of the guesses after
/// these. Where rates grow with the states, the lower half leads further.
constexpr double kHeldControls[] = {0.5, 0.25};
/// A limit below is there to see how a solve begins.
constexpr int kEnoughIterations = 100;

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

Solution solve_within(const SetUpWatch& watch, const Problem& problem,
                      const SolveSettings& settings) {
  const auto grid = with_moments(problem, {settings.mesh, settings.scheme});
  const Beginning beginning = begin(problem, grid, settings.guess, settings.previous);
  const Problem scaled = with_scales(problem, beginning.guess);
  Transcription transcription(scaled, grid.mesh, grid.schemes);
  const bool warm = settings.previous == nullptr && !settings.warm_start.x.empty();
  const nlp::Start start = warm ? from_user(settings.warm_start, transcription.structure())
                                : start_of(transcription, beginning);
  const auto solver = nlp::make_solver(settings.backend);
  Solution solution;
  auto point = run(transcription, *solver, left(watch, settings.options), start,
                   transcription.regular_variables(), solution);
  if (solution.iterations > 0 && unwind(scaled, transcription, point.x))
    solution.point = to_user(point, transcription.structure());
  describe(scaled, grid, Tables(scaled), transcription, point, solution);
  return solution;
}

PhasedSolution solve_within(const SetUpWatch& watch, const PhasedProblem& problem,
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
  nlp::Start start;
  std::vector<char> regular;
  for (std::size_t p = 0; p < phases; ++p) {
    append(start_of(transcription.phase(p), beginnings[p]), start);
    const auto counts = transcription.phase(p).regular_variables();
    regular.insert(regular.end(), counts.begin(), counts.end());
  }
  const auto& row_scale = transcription.structure().row_scale;
  if (previous != nullptr && !previous->link_multipliers.empty())
    for (std::size_t l = 0; l < problem.links().size(); ++l)
      start.y.push_back(previous->link_multipliers.at(l).second /
                        row_scale[transcription.first_link() + l]);
  else if (!settings.warm_start.x.empty())
    start = from_user(settings.warm_start, transcription.structure());
  const auto solver = nlp::make_solver(settings.backend);
  PhasedSolution solution;
  nlp::Start point =
      run(transcription, *solver, left(watch, settings.options), start, regular, solution);
  bool unwound = false;
  auto first = point.x.begin();  // of the phase's variables, which follow those of the phase before
  for (std::size_t p = 0; p < phases && solution.iterations > 0; ++p) {
    std::vector<double> x = transcription.part_of(p, point).x;
    unwound = unwind(scaled.phases()[p], transcription.phase(p), x) || unwound;
    first = std::copy(x.begin(), x.end(), first);
  }
  if (unwound) solution.point = to_user(point, transcription.structure());
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
auto solve_once(const Problem& problem, const Settings& settings) {
  const SetUpWatch watch(settings.options);
  try {
    return solve_within(watch, problem, settings);
  } catch (const SetUpWatch::Stopped& stopped) {
    return stopped_at_set_up(watch, stopped.status, problem, settings);
  }
}

/// Whether nothing but a guess is there to start from.
template <class Settings>
bool starts_cold(const Settings& settings) {
  return settings.previous == nullptr && settings.warm_start.x.empty();
}

/// Whether violation was least, where other starts may find less.
template <class Answer, class Settings>
bool ends_locally(const Answer& answer, const Settings& settings) {
  return answer.status == nlp::Status::infeasible && knows_conflicts(answer) &&
         settings.options.floor == 0 && starts_cold(settings);
}

/// Whether a function is not finite at the first point, which nobody has asked for.
template <class Answer>
bool fails_at_once(const Answer& answer) {
  return answer.status == nlp::Status::invalid_number && answer.iterations == 0;
}

SolveSettings held(const Problem& problem, SolveSettings settings) {
  settings.guess = held_guess(problem);
  return settings;
}
PhasedSettings held(const PhasedProblem& problem, PhasedSettings settings) {
  settings.guesses.resize(problem.phases().size());
  for (std::size_t p = 0; p < problem.phases().size(); ++p)
    if (settings.guesses[p].tau.empty()) settings.guesses[p] = held_guess(problem.phases()[p]);
  return settings;
}
bool without_guess(const SolveSettings& settings) {
  return settings.guess.tau.empty() && starts_cold(settings);
}
bool without_guess(const PhasedSettings& settings) {
  return starts_cold(settings) &&
         (settings.guesses.empty() ||
          std::any_of(settings.guesses.begin(), settings.guesses.end(),
                      [](const Trajectory& guess) { return guess.tau.empty(); }));
}

/// Whether the method has lost its way, of which a coarse mesh has fewer.
template <class Answer, class Settings>
bool lost_its_way(const Answer& answer, const Settings& settings) {
  const bool lost = answer.status == nlp::Status::iteration_limit ||
                    answer.status == nlp::Status::numerical_failure ||
                    ends_locally(answer, settings);
  return lost && settings.options.floor == 0 &&
         settings.options.max_iterations >= kEnoughIterations && starts_cold(settings);
}

std::size_t most_intervals(const Problem&, const SolveSettings& settings) {
  return settings.mesh.intervals();
}
std::size_t most_intervals(const PhasedProblem& problem, const PhasedSettings& settings) {
  if (settings.grids.empty() && !problem.phases().empty()) return SolveSettings().mesh.intervals();
  std::size_t most = 0;
  for (const auto& grid : settings.grids) most = std::max(most, grid.mesh.intervals());
  return most;
}
void set_grid(const Problem&, const PhasedTranscription::Grid& grid, SolveSettings& settings) {
  settings.mesh = grid.mesh;
  settings.scheme = grid.schemes;
}
void set_grid(const PhasedProblem& problem, const PhasedTranscription::Grid& grid,
              PhasedSettings& settings) {
  settings.grids.assign(problem.phases().size(), grid);
}

bool has_numbers_by_point(const Problem& problem) {
  return std::any_of(problem.constraints().begin(), problem.constraints().end(),
                     [](const auto& row) { return row.by_point(); });
}
bool has_numbers_by_point(const PhasedProblem& problem) {
  return std::any_of(problem.phases().begin(), problem.phases().end(),
                     [](const Problem& phase) { return has_numbers_by_point(phase); });
}

/// Solves of one problem within one limit of time, and what they took together.
template <class Answer, class Problem, class Settings>
class Tries {
 public:
  Tries(const Problem& problem, double time_limit) : problem_(problem), left_s_(time_limit) {}

  /// Another solve; none where no time or iteration is left for one.
  std::optional<Answer> solve(Settings settings) {
    settings.options.time_limit = left_s_;
    if (iterations_ > 0 && (settings.options.max_iterations <= 0 || !(left_s_ > 0)))
      return std::nullopt;
    Answer answer = solve_once(problem_, settings);
    iterations_ += answer.iterations;
    wall_s_ += answer.wall_s;
    left_s_ -= answer.wall_s;
    interrupted_ = answer.status == nlp::Status::interrupted;
    return answer;
  }

  /// Again from elsewhere, as long as violation ends where it is least but not zero; within the
  /// iterations of the settings, of which the answer has had its own.
  void from_elsewhere(const Settings& settings, Answer& answer) {
    int left = settings.options.max_iterations - answer.iterations;
    for (std::uint64_t seed = 1; seed <= kMoreTries && ends_locally(answer, settings); ++seed) {
      Settings again = moved(problem_, settings, seed);
      again.options.max_iterations = left;
      std::optional<Answer> other = solve(std::move(again));
      if (!other) return;
      left -= other->iterations;
      if (other->solved()) answer = std::move(*other);
      if (interrupted_) return;
    }
  }

  /// By coarse meshes, whose answer the whole mesh then begins with. Each solve has the iterations
  /// of the settings anew.
  void by_coarse_meshes(const Settings& settings, Answer& answer) {
    if (has_numbers_by_point(problem_)) return;  // which are those of the settings' mesh
    for (const int intervals : kCoarseMeshes) {
      if (most_intervals(problem_, settings) <= static_cast<std::size_t>(intervals)) return;
      Settings coarse = settings;
      set_grid(problem_, {Mesh::uniform(intervals), hermite_simpson()}, coarse);
      std::optional<Answer> rough = solve(coarse);
      if (rough) from_elsewhere(coarse, *rough);
      if (!rough || interrupted_) return;
      if (!rough->solved()) continue;
      Settings fine = settings;
      fine.previous = &*rough;
      std::optional<Answer> found = solve(std::move(fine));
      if (found && found->solved()) answer = std::move(*found);
      if (!found || answer.solved() || interrupted_) return;
    }
  }

  /// From where constant controls lead: a guess that meets the dynamics, of one phase.
  void from_simulations(const Settings& settings, Answer& answer) {
    if constexpr (requires { settings.guess; })
      for (const double share : kHeldControls) {
        Settings again = settings;
        if (!simulated(problem_, share, left_s_, again)) continue;
        std::optional<Answer> found = solve(std::move(again));
        if (found && found->solved()) answer = std::move(*found);
        if (!found || answer.solved() || interrupted_) return;
      }
  }

  bool interrupted() const { return interrupted_; }
  int iterations() const { return iterations_; }
  double wall_s() const { return wall_s_; }

 private:
  const Problem& problem_;
  double left_s_, wall_s_ = 0;
  int iterations_ = 0;
  bool interrupted_ = false;
};

/// Tries again where the method lost its way, and where violation was least but not zero.
template <class Answer, class Problem, class Settings>
Answer solve_with_tries(const Problem& problem, const Settings& given) {
  Settings settings = given;
  Tries<Answer, Problem, Settings> tries(problem, settings.options.time_limit);
  Answer answer = *tries.solve(settings);
  if (fails_at_once(answer) && without_guess(settings)) {
    Settings again = held(problem, settings);
    Answer other = *tries.solve(again);
    if (!fails_at_once(other)) {
      settings = std::move(again);
      answer = std::move(other);
    }
  }
  if (lost_its_way(answer, settings)) tries.by_coarse_meshes(settings, answer);
  if (!tries.interrupted() && without_guess(given) && lost_its_way(answer, settings))
    tries.from_simulations(settings, answer);
  if (!tries.interrupted()) tries.from_elsewhere(settings, answer);
  answer.options = settings.options;
  answer.iterations = tries.iterations();
  answer.wall_s = tries.wall_s();
  return answer;
}

}  // namespace

Solution solve(const Problem& problem, const SolveSettings& settings) {
  return solve_with_tries<Solution>(problem, settings);
}

PhasedSolution solve(const PhasedProblem& problem, const PhasedSettings& settings) {
  auto solution = solve_with_tries<PhasedSolution>(problem, settings);
  for (auto& phase : solution.phases) {
    phase.options = solution.options;
    phase.iterations = solution.iterations;
    phase.wall_s = solution.wall_s;
  }
  return solution;
}

}  // namespace slalom::ocp
