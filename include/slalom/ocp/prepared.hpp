#pragma once

#include <memory>

#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/solve.hpp"
#include "slalom/ocp/trajectory.hpp"
#include "slalom/ocp/transcription.hpp"

namespace slalom::ocp {

/// A problem to be solved again and again with other numbers. It is transcribed once and solved by
/// one solver, which keeps its memory and its knowledge of the structure. Not thread-safe; use one
/// for each thread. The options' callback ends a transcription too; the next solves are then
/// `interrupted`, with the guess at the points, until an update. The options' time limit is of each
/// solve, without the transcription.
class Prepared {
 public:
  /// `settings` has mesh, scheme, options and back end of all solves. Its guess, or straight lines,
  /// determines the scales that the problem does not give. Throws InvalidValue as solve() does.
  Prepared(const Problem& problem, const SolveSettings& settings);
  ~Prepared();
  Prepared(Prepared&&) noexcept;
  Prepared& operator=(Prepared&&) noexcept;

  /// Takes over changed parameters, bounds, guesses and members of families. If more has changed
  /// (constraints switched, more members, ...), the problem is transcribed again.
  void update(const Problem& problem);
  /// From a guess; from straight lines if it is empty.
  [[nodiscard]] Solution solve(const Trajectory& guess = {});
  /// From a guess with multipliers, whose taus are of the guess's t0 ... tf.
  [[nodiscard]] Solution solve(const Trajectory& guess, const Duals& duals);

  const nlp::Options& options() const;
  void set_options(const nlp::Options& options);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace slalom::ocp
