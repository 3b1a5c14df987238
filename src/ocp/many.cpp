#include "slalom/ocp/many.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <utility>

#include "../base/side_by_side.hpp"
#include "numbers.hpp"
#include "slalom/base/error.hpp"
#include "slalom/ocp/moments.hpp"
#include "slalom/ocp/prepared.hpp"
#include "solved.hpp"

namespace slalom::ocp {
namespace {

/// Where the numbers of variations go in a problem.
class Numbers {
 public:
  Numbers(const Problem& problem, const std::vector<Variation>& variations)
      : variations_(variations) {
    const auto all = numbers(problem);
    const auto names = names_of(all);
    for (const auto& variation : variations) {
      numbers_.push_back(all[number_named(problem.name() + ": many", variation.name, names)]);
      check(problem, variation);
    }
    Problem probe = problem;
    if (count() > 0) put(0, probe);  // throws for what may not be set
  }
  std::size_t count() const { return variations_.empty() ? 0 : variations_.front().values.size(); }
  void put(std::size_t solve, Problem& problem) const {
    for (std::size_t i = 0; i < numbers_.size(); ++i)
      set_number(numbers_[i], variations_[i].values[solve], problem);
  }

 private:
  void check(const Problem& problem, const Variation& variation) const {
    const auto where = problem.name() + ": many: " + variation.name;
    if (variation.values.size() != count())
      throw InvalidValue(where, fmt::format("{} numbers", variation.values.size()),
                         fmt::format("{}, as many as of {}", count(), variations_.front().name));
    for (std::size_t i = 0; i < variation.values.size(); ++i)
      if (!std::isfinite(variation.values[i]))
        throw InvalidValue(fmt::format("{}[{}]", where, i), fmt::format("{}", variation.values[i]),
                           "a finite number");
  }

  const std::vector<Variation>& variations_;
  std::vector<Number> numbers_;
};

/// All have one transcription, whose mesh has nodes at shares of the horizon.
void check_times(const Problem& problem, const Problem& changed) {
  if (problem.runs_forward() && !changed.runs_forward())
    throw InvalidValue(problem.name(),
                       fmt::format("t0 of {:.6g} and a least tf of {:.6g}",
                                   changed.t0().bounds.upper, changed.tf().bounds.lower),
                       "t0 at most the least tf, as in the problem; \"lower tf\" may vary too");
  if (changed.moments() != problem.moments())
    throw InvalidValue(problem.name(),
                       "a row, a cost term or a breakpoint at another share of the horizon",
                       "moments as shares of the horizon, for the mesh does not move");
}

}  // namespace

std::vector<Solution> solve_many(const Problem& problem, const SolveSettings& settings,
                                 const std::vector<Variation>& variations, int threads) {
  if (!settings.warm_start.x.empty())
    throw InvalidValue(problem.name() + ": many", "a warm start",
                       "none, or the solution as `previous`");
  const Numbers varied(problem, variations);
  const auto grid = with_moments(problem, {settings.mesh, settings.scheme});
  const Beginning from = begin(problem, grid, settings.guess, settings.previous);
  const bool straight = settings.guess.tau.empty() && settings.previous == nullptr;

  std::vector<Solution> answers(varied.count());
  const nlp::Options& options = settings.options;
  SideBySide pieces(problem.name() + ": many", answers.size(), threads,
                    [&] { return options.stop != nullptr && options.stop(options.stop_data); });
  SolveSettings each = settings;
  each.options.stop = [](void* all) { return static_cast<SideBySide*>(all)->ending(); };
  each.options.stop_data = &pieces;
  pieces.run([&]() -> SideBySide::Worker {
    auto prepared = std::make_shared<Prepared>(problem, each);
    return [&, prepared, changed = problem](std::size_t solve) mutable {
      if (pieces.ending()) {
        answers[solve].status = nlp::Status::interrupted;
        return;
      }
      varied.put(solve, changed);
      try {
        check_times(problem, changed);
        prepared->update(changed);
      } catch (const InvalidValue& error) {
        throw InvalidValue(fmt::format("solve {} of many: {}", solve, error.where()), error.found(),
                           error.expected());
      }
      Solution& answer = answers[solve];
      answer = from.duals ? prepared->solve(from.guess, *from.duals)
                          : prepared->solve(straight ? Trajectory{} : from.guess);
      answer.options.stop = options.stop;
      answer.options.stop_data = options.stop_data;
    };
  });
  return answers;
}

}  // namespace slalom::ocp
