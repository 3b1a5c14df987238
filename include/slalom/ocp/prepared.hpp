#pragma once

#include <memory>

#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/solve.hpp"
#include "slalom/ocp/trajectory.hpp"
#include "slalom/ocp/transcription.hpp"

namespace slalom::ocp {

/// A problem to be solved again and again with other numbers: transcribed once, by one solver that
/// keeps its memory and what it found out about the structure. Not thread-safe; one a thread.
class Prepared {
 public:
  /// Mesh, scheme, options and back end of all solves; the guess, or straight lines, settles the
  /// scales that the problem leaves open. Throws InvalidValue as solve() does.
  Prepared(const Problem& problem, const SolveSettings& settings);
  ~Prepared();
  Prepared(Prepared&&) noexcept;
  Prepared& operator=(Prepared&&) noexcept;

  /// Takes over changed parameters, bounds, guesses and members of families. What is changed beyond
  /// that (constraints switched, more members, ...) is transcribed anew.
  void update(const Problem& problem);
  /// From a guess; from straight lines if it is empty.
  [[nodiscard]] Solution solve(const Trajectory& guess = {});
  /// From a guess with multipliers, their taus those of the guess.
  [[nodiscard]] Solution solve(const Trajectory& guess, const Duals& duals);

  const nlp::Options& options() const;
  void set_options(const nlp::Options& options);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace slalom::ocp
