#include "slalom/ocp/solve.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "moved.hpp"
#include "phase_guesses.hpp"
#include "simulated_guess.hpp"
#include "slalom/base/timer.hpp"
#include "slalom/ocp/guess.hpp"
#include "solve_once.hpp"
#include "solved.hpp"

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
  settings.guesses = linked_guesses(problem, std::move(settings.guesses));
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

/// Solves of one problem within one limit of time, counted from when this was made, and what they
/// took together.
template <class Answer, class Problem, class Settings>
class Tries {
 public:
  Tries(const Problem& problem, double time_limit) : problem_(problem), limit_s_(time_limit) {}

  /// Another solve; none where no time or iteration is left for one.
  std::optional<Answer> solve(Settings settings) {
    settings.options.time_limit = left_s();
    if (iterations_ > 0 && (settings.options.max_iterations <= 0 || !(left_s() > 0)))
      return std::nullopt;
    Answer answer = solve_once(problem_, settings);
    iterations_ += answer.iterations;
    wall_s_ += answer.wall_s;
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
        if (!simulated(problem_, share, left_s(), again)) continue;
        std::optional<Answer> found = solve(std::move(again));
        if (found && found->solved()) answer = std::move(*found);
        if (!found || answer.solved() || interrupted_) return;
      }
  }

  /// All that with a barrier that falls monotonely, where the adaptive one went wrong ways: slower,
  /// it keeps off the bounds for longer.
  void by_monotone_barrier(const Settings& settings, Answer& answer) {
    if (settings.options.barrier_rule == nlp::BarrierRule::monotone) return;
    Settings again = settings;
    again.options.barrier_rule = nlp::BarrierRule::monotone;
    std::optional<Answer> found = solve(again);
    if (!found || interrupted_) return;
    if (lost_its_way(*found, again)) by_coarse_meshes(again, *found);
    if (found->solved()) answer = std::move(*found);
  }

  bool interrupted() const { return interrupted_; }
  int iterations() const { return iterations_; }
  double wall_s() const { return wall_s_; }

 private:
  double left_s() const { return std::max(0.0, limit_s_ - timer_.wall()); }

  const Problem& problem_;
  const double limit_s_;
  const Timer timer_;
  double wall_s_ = 0;
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
    std::optional<Answer> other = tries.solve(again);
    if (other && !fails_at_once(*other)) {
      settings = std::move(again);
      answer = std::move(*other);
    }
  }
  if (lost_its_way(answer, settings)) tries.by_coarse_meshes(settings, answer);
  if (!tries.interrupted() && without_guess(given) && lost_its_way(answer, settings))
    tries.from_simulations(settings, answer);
  if (!tries.interrupted() && lost_its_way(answer, settings))
    tries.by_monotone_barrier(settings, answer);
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
