#pragma once

#include <memory>
#include <vector>

#include "slalom/ocp/interpolant.hpp"
#include "slalom/ocp/solve.hpp"
#include "slalom/ocp/transcription.hpp"

namespace slalom::ocp {

/// A plan that is to be driven from a time on.
struct Plan {
  double t_swap = 0;
  Solution solution;
  std::shared_ptr<const Interpolant> between;

  Plan(const Problem& problem, Solution solved, double swap);
  /// The plan at the same times as a guess for t0 ... tf, at its own taus; its end is held.
  Trajectory shifted(double t0, double tf) const;
  /// Its multipliers at the same times.
  Duals shifted_duals(double t0, double tf) const;
};

/// The plan in effect and the one that follows.
class Plans {
 public:
  void follow(Plan plan);
  /// What is in effect at t; null before the first.
  const Plan* at(double t) const;
  /// The one planned last; null before the first.
  const Plan* last() const { return next_ ? next_.get() : current_.get(); }
  /// Forgets the plan that is no longer in effect at t.
  void pass(double t);
  /// Times at which controls may jump or bend.
  std::vector<double> corners() const;

 private:
  std::unique_ptr<Plan> current_, next_;
};

}  // namespace slalom::ocp
