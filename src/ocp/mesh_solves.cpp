#include "mesh_solves.hpp"

#include <cmath>
#include <utility>

#include "solved.hpp"

namespace slalom::ocp {

Single::Single(const Problem& problem, SolveSettings settings)
    : problem_(problem), settings_(std::move(settings)) {}

Solution Single::solve() const {
  return stated(ocp::solve(now(), settings_));
}

Solution Single::solve_anew() const {
  return solve_from({resampled(problem_, *settings_.previous, {settings_.mesh, settings_.scheme})});
}

Solution Single::solve_from(std::vector<Trajectory> guesses) const {
  SolveSettings settings = settings_;
  settings.guess = std::move(guesses[0]);
  settings.warm_start = {};
  settings.previous = nullptr;
  return stated(ocp::solve(now(), settings));
}

void Single::damp(const Solution& earlier, const Chosen& chosen, double weight) {
  damped_.reset();
  if (weight > 0) add_damping(damped_.emplace(problem_), earlier, chosen[0], weight);
}

void Single::next(Grids grids, const Solution& previous) {
  settings_.mesh = std::move(grids[0].mesh);
  settings_.scheme = std::move(grids[0].schemes);
  settings_.warm_start = {};  // of the first mesh
  settings_.previous = &previous;
}

Solution Single::stated(Solution solution) const {
  damping_cost_ = without_damping(solution);
  return solution;
}

Several::Several(const PhasedProblem& problem, PhasedSettings settings)
    : problem_(problem), settings_(std::move(settings)) {
  if (settings_.grids.empty()) settings_.grids.resize(problem.phases().size());
}

PhasedSolution Several::solve() const {
  return stated(ocp::solve(now(), settings_));
}

PhasedSolution Several::solve_anew() const {
  std::vector<Trajectory> guesses;
  for (std::size_t p = 0; p < settings_.grids.size(); ++p)
    guesses.push_back(resampled(problem(p), settings_.previous->phases[p], settings_.grids[p]));
  return solve_from(std::move(guesses));
}

PhasedSolution Several::solve_from(std::vector<Trajectory> guesses) const {
  PhasedSettings settings = settings_;
  settings.guesses = std::move(guesses);
  settings.warm_start = {};
  settings.previous = nullptr;
  return stated(ocp::solve(now(), settings));
}

std::vector<const Solution*> Several::phases(const PhasedSolution& solution) {
  std::vector<const Solution*> list;
  for (const auto& phase : solution.phases) list.push_back(&phase);
  return list;
}

std::vector<nlp::Options*> Several::options_of(PhasedSolution& solution) {
  std::vector<nlp::Options*> list{&solution.options};
  for (auto& phase : solution.phases) list.push_back(&phase.options);
  return list;
}

double Several::costs_beside(const PhasedSolution& solution) {
  double sum = 0;
  for (const auto& term : solution.cost_terms) sum += std::fabs(term.second);
  return sum;
}

void Several::damp(const PhasedSolution& earlier, const Chosen& chosen, double weight) {
  damped_.reset();
  if (!(weight > 0)) return;
  damped_.emplace(problem_);
  for (std::size_t p = 0; p < chosen.size(); ++p) {
    Problem phase = problem(p);
    add_damping(phase, earlier.phases[p], chosen[p], weight);
    damped_->replace(p, std::move(phase));
  }
}

void Several::next(Grids grids, const PhasedSolution& previous) {
  settings_.grids = std::move(grids);
  settings_.warm_start = {};
  settings_.previous = &previous;
}

PhasedSolution Several::stated(PhasedSolution solution) const {
  damping_cost_ = 0;
  for (Solution& phase : solution.phases) damping_cost_ += without_damping(phase);
  solution.objective -= damping_cost_;
  return solution;
}

}  // namespace slalom::ocp
