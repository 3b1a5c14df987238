#include "slalom/ocp/many.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "../base/side_by_side.hpp"
#include "slalom/base/error.hpp"
#include "slalom/base/options.hpp"
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
    for (const auto& variation : variations) {
      setters_.push_back(setter_of(problem, variation.name));
      check(problem, variation);
    }
  }
  std::size_t count() const { return variations_.empty() ? 0 : variations_.front().values.size(); }
  void put(std::size_t solve, Problem& problem) const {
    for (std::size_t i = 0; i < setters_.size(); ++i)
      setters_[i](problem, variations_[i].values[solve]);
  }

 private:
  using Setter = std::function<void(Problem&, double)>;

  static Setter setter_of(const Problem& problem, const std::string& name) {
    std::vector<std::string> known;
    for (const auto& parameter : problem.parameters()) {
      if (parameter.name == name)
        return [symbol = parameter.symbol](Problem& p, double v) { p.set_parameter(symbol, v); };
      known.push_back(parameter.name);
    }
    for (const auto& state : problem.states()) {
      if ("initial " + state.name == name)
        return [symbol = state.symbol](Problem& p, double v) {
          p.initial_bounds(symbol, Bounds::equal(v));
        };
      if ("final " + state.name == name)
        return [symbol = state.symbol](Problem& p, double v) {
          p.final_bounds(symbol, Bounds::equal(v));
        };
      known.insert(known.end(), {"initial " + state.name, "final " + state.name});
    }
    const auto nearest = nearest_name(name, known);
    throw InvalidValue(problem.name() + ": many", "'" + name + "'",
                       nearest.empty() ? "a parameter, or 'initial' or 'final' and a state"
                                       : "perhaps '" + nearest + "'");
  }
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
  std::vector<Setter> setters_;
};

}  // namespace

std::vector<Solution> solve_many(const Problem& problem, const SolveSettings& settings,
                                 const std::vector<Variation>& variations, int threads) {
  if (threads < 0)
    throw InvalidValue(problem.name() + ": many: threads", std::to_string(threads),
                       "a number of threads, or 0 for as many as there are processors");
  if (!settings.warm_start.x.empty())
    throw InvalidValue(problem.name() + ": many", "a warm start",
                       "none, or the solution as `previous`");
  const Numbers numbers(problem, variations);
  const auto grid = with_moments(problem, {settings.mesh, settings.scheme});
  const Beginning from = begin(problem, grid, settings.guess, settings.previous);
  const bool straight = settings.guess.tau.empty() && settings.previous == nullptr;

  std::vector<Solution> answers(numbers.count());
  const nlp::Options& options = settings.options;
  SideBySide pieces(answers.size(), threads,
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
      numbers.put(solve, changed);
      try {
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

Problem with_numbers(Problem problem, const std::vector<Variation>& variations, std::size_t solve) {
  Numbers(problem, variations).put(solve, problem);
  return problem;
}

}  // namespace slalom::ocp
