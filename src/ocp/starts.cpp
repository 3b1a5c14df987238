#include "slalom/ocp/starts.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>

#include "between_points.hpp"
#include "moved.hpp"
#include "slalom/base/error.hpp"
#include "slalom/ocp/guess.hpp"
#include "slalom/ocp/scaling.hpp"
#include "solved.hpp"

namespace slalom::ocp {
namespace {

constexpr int kPoints = 41;
constexpr double kShortest = 3, kLongest = 40;  ///< a free duration, in those of the guess
constexpr double kRoom = 1e-2;                  ///< of the room between two bounds: kept off both

/// Numbers that are the same on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  /// About normal, of variance 1.
  double normal() {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += uniform();
    return sum;
  }

 private:
  std::mt19937_64 engine_;
};

/// A smooth function of tau, of size about 1.
class Wave {
 public:
  explicit Wave(Random& random) {
    for (double& each : factor_) each = random.normal();
  }
  double operator()(double tau) const {
    return factor_[0] / 2 + factor_[1] * (tau - 0.5) + factor_[2] * std::sin(M_PI * tau) +
           factor_[3] * std::sin(2 * M_PI * tau);
  }

 private:
  double factor_[4];
};

double within(double value, Bounds bounds) {
  const double room = bounds.upper - bounds.lower;
  const double off = std::isfinite(room) ? kRoom * room : 0;
  return std::clamp(value, bounds.lower + off, bounds.upper - off);
}

/// By how much durations are stretched.
double stretch(Random& random) {
  return kShortest * std::pow(kLongest / kShortest, random.uniform());
}

/// Times counted from `origin` stretched by `factor`, within their bounds.
void stretch_times(const Problem& problem, double origin, double factor, Trajectory& guess) {
  const double t0 = within(origin + factor * (guess.t0 - origin), problem.t0().bounds);
  const double tf = within(origin + factor * (guess.tf - origin), problem.tf().bounds);
  if (tf < t0) return;
  guess.t0 = t0;
  guess.tf = tf;
}

Trajectory moved(const Problem& problem, const Trajectory& guess, double origin, double factor,
                 Random& random) {
  const Problem scaled = with_scales(problem, guess);
  Trajectory result = guess;
  result.tau.clear();
  for (int k = 0; k < kPoints; ++k) result.tau.push_back(k / (kPoints - 1.0));
  const auto move = [&](const auto& variables, const std::vector<std::vector<double>>& from,
                        std::vector<std::vector<double>>& to) {
    to.assign(result.tau.size(), std::vector<double>(variables.size()));
    for (std::size_t i = 0; i < variables.size(); ++i) {
      const Wave wave(random);
      for (std::size_t k = 0; k < to.size(); ++k)
        to[k][i] = within(between_points(guess.tau, from, i, result.tau[k]) +
                              variables[i].unit() * wave(result.tau[k]),
                          variables[i].bounds);
    }
  };
  move(scaled.states(), guess.states, result.states);
  move(scaled.controls(), guess.controls, result.controls);
  for (std::size_t i = 0; i < result.static_parameters.size(); ++i) {
    const auto& each = scaled.static_parameters()[i];
    result.static_parameters[i] =
        within(result.static_parameters[i] + each.unit() * random.normal() / 2, each.bounds);
  }
  stretch_times(problem, origin, factor, result);
  return result;
}

}  // namespace

SolveSettings moved(const Problem& problem, const SolveSettings& settings, std::uint64_t seed) {
  SolveSettings result = settings;
  const PhasedTranscription::Grid grid{settings.mesh, settings.scheme};
  result.guess =
      moved_guess(problem, begin(problem, grid, settings.guess, settings.previous).guess, seed);
  result.warm_start = {};
  result.previous = nullptr;
  return result;
}

PhasedSettings moved(const PhasedProblem& problem, const PhasedSettings& settings,
                     std::uint64_t seed) {
  PhasedSettings result = settings;
  Random random(seed);
  const double factor = stretch(random);
  result.guesses.clear();
  for (std::size_t p = 0; p < problem.phases().size(); ++p) {
    const auto grid = settings.grids.empty() ? PhasedTranscription::Grid{} : settings.grids.at(p);
    const Trajectory from =
        begin(problem.phases()[p], grid,
              settings.guesses.empty() ? Trajectory{} : settings.guesses.at(p),
              settings.previous == nullptr ? nullptr : &settings.previous->phases.at(p))
            .guess;
    const double origin = p == 0 ? from.t0 : result.guesses.front().t0;
    result.guesses.push_back(moved(problem.phases()[p], from, origin, factor, random));
  }
  result.warm_start = {};
  result.previous = nullptr;
  return result;
}

namespace {

template <class Answer, class Problem, class Settings>
std::vector<Answer> several(const Problem& problem, const Settings& settings, int starts,
                            std::uint64_t seed) {
  if (starts < 1)
    throw InvalidValue(problem.name() + ": starts", std::to_string(starts), "at least 1");
  std::vector<Answer> answers;
  answers.push_back(solve(problem, settings));
  for (int k = 1; k < starts && answers.back().status != nlp::Status::interrupted; ++k)
    answers.push_back(
        solve(problem, moved(problem, settings, seed + static_cast<std::uint64_t>(k) - 1)));
  return answers;
}

template <class Answer>
std::size_t best(const std::vector<Answer>& answers) {
  std::size_t place = 0;
  for (std::size_t k = 1; k < answers.size(); ++k)
    if (answers[k].solved() &&
        (!answers[place].solved() || answers[k].objective < answers[place].objective))
      place = k;
  return place;
}

}  // namespace

Trajectory moved_guess(const Problem& problem, const Trajectory& guess, std::uint64_t seed) {
  Random random(seed);
  const double factor = stretch(random);
  return moved(problem, guess, guess.t0, factor, random);
}

std::vector<Solution> solve_from_several(const Problem& problem, const SolveSettings& settings,
                                         int starts, std::uint64_t seed) {
  return several<Solution>(problem, settings, starts, seed);
}
std::vector<PhasedSolution> solve_from_several(const PhasedProblem& problem,
                                               const PhasedSettings& settings, int starts,
                                               std::uint64_t seed) {
  return several<PhasedSolution>(problem, settings, starts, seed);
}

std::size_t best_of(const std::vector<Solution>& answers) {
  return best(answers);
}
std::size_t best_of(const std::vector<PhasedSolution>& answers) {
  return best(answers);
}

}  // namespace slalom::ocp
