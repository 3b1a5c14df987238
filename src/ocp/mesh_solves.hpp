#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "damping.hpp"
#include "slalom/ocp/phases.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {

/// The solves of a refinement of one phase.
class Single {
 public:
  using Answer = Solution;
  using Grids = std::vector<PhasedTranscription::Grid>;
  Single(const Problem& problem, SolveSettings settings);

  const std::string& name() const { return problem_.name(); }
  nlp::Options& options() { return settings_.options; }
  Grids grids() const { return {{settings_.mesh, settings_.scheme}}; }
  Solution solve() const;
  /// Without the last mesh's multipliers.
  Solution solve_anew() const;
  /// From a guess for each phase alone.
  Solution solve_from(std::vector<Trajectory> guesses) const;
  static std::vector<const Solution*> phases(const Solution& solution) { return {&solution}; }
  static std::vector<nlp::Options*> options_of(Solution& solution) { return {&solution.options}; }
  /// Of cost terms that are no phase's.
  static double costs_beside(const Solution&) { return 0; }
  /// Of the solves from now on; a weight of 0 ends it.
  void damp(const Solution& earlier, const Chosen& chosen, double weight);
  double damping_cost() const { return damping_cost_; }
  const Problem& problem(std::size_t) const { return problem_; }
  std::string phase_name(std::size_t) const { return ""; }
  /// The next mesh, which starts from `previous` alone.
  void next(Grids grids, const Solution& previous);

 private:
  const Problem& now() const { return damped_ ? *damped_ : problem_; }
  Solution stated(Solution solution) const;

  const Problem& problem_;
  SolveSettings settings_;
  std::optional<Problem> damped_;
  mutable double damping_cost_ = 0;
};

/// Those of several phases.
class Several {
 public:
  using Answer = PhasedSolution;
  using Grids = std::vector<PhasedTranscription::Grid>;
  Several(const PhasedProblem& problem, PhasedSettings settings);

  const std::string& name() const { return problem_.name(); }
  nlp::Options& options() { return settings_.options; }
  const Grids& grids() const { return settings_.grids; }
  PhasedSolution solve() const;
  PhasedSolution solve_anew() const;
  PhasedSolution solve_from(std::vector<Trajectory> guesses) const;
  static std::vector<const Solution*> phases(const PhasedSolution& solution);
  static std::vector<nlp::Options*> options_of(PhasedSolution& solution);
  static double costs_beside(const PhasedSolution& solution);
  void damp(const PhasedSolution& earlier, const Chosen& chosen, double weight);
  double damping_cost() const { return damping_cost_; }
  const Problem& problem(std::size_t phase) const { return problem_.phases()[phase]; }
  const std::string& phase_name(std::size_t phase) const { return problem_.phases()[phase].name(); }
  void next(Grids grids, const PhasedSolution& previous);

 private:
  const PhasedProblem& now() const { return damped_ ? *damped_ : problem_; }
  PhasedSolution stated(PhasedSolution solution) const;

  const PhasedProblem& problem_;
  PhasedSettings settings_;
  std::optional<PhasedProblem> damped_;
  mutable double damping_cost_ = 0;
};

}  // namespace slalom::ocp
