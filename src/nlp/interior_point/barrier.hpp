#pragma once

#include <array>
#include <cstddef>

#include "slalom/nlp/solver.hpp"
#include "survey.hpp"

namespace slalom::nlp::ipm {

/// Chooses the barrier parameter.
///
/// monotone: mu falls when the barrier problem of the last one is solved well enough (Waechter &
/// Biegler 2006, eq. 7). adaptive: mu follows the mean product of slack and multiplier (Nocedal,
/// Waechter & Waltz, SIAM J. Optim. 19(4), 2009, section 3) for as long as the error falls, and is
/// held as by the monotone rule until it does again (their section 4).
class Barrier {
 public:
  /// `least`: the floor, or far enough below the tolerance.
  void begin(BarrierRule rule, double mu, double least);
  double mu() const { return mu_; }
  bool at_least() const { return mu_ <= least_; }
  bool nearly_at_least() const { return mu_ <= 10 * least_; }
  /// Whether mu follows the iterates: then it is set by one of the next two.
  bool free() const { return free_; }
  /// From the mean product now and after the step towards mu = 0 (Mehrotra 1992).
  void follow_predictor(double mean, double mean_after);
  /// From how unequal the products are (LOQO's rule).
  void follow_spread(const Survey& survey);
  /// True when mu changed: the filter starts anew.
  bool update(const Survey& survey);

 private:
  bool update_monotone(const Survey& survey);
  bool update_free(const Survey& survey);
  bool set(double mu);

  double mu_ = 0, least_ = 0;
  bool free_ = false, adaptive_ = false;
  std::array<double, 4> errors_{};
  std::size_t noted_ = 0;
};

}  // namespace slalom::nlp::ipm
