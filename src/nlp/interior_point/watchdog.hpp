#pragma once

#include "descent.hpp"

namespace slalom::nlp::ipm {

/// The watchdog (Waechter & Biegler 2006, section 3.2; Chamberlain et al., Math. Program. Study 16,
/// 1982): after many shortened steps the full step is taken unsearched, a few times; if that leads
/// to a point acceptable from where it began, it pays, else the search goes on from there. After
/// two attempts in vain the search is stuck: it crawls, and restoration gets on faster. And the
/// soft restoration (their section 3.3's first resort as Ipopt has it): where no step is
/// acceptable, the longest is taken if it brings the primal-dual equations' error down.
class Watchdog {
 public:
  explicit Watchdog(const SlackForm& form) { from_.resize(form.primal(), form.rows()); }
  /// With a start close to a solution, as a warm one is, it leaps from the first step on: nearly
  /// feasible and lower than the solution, such a point would let the filter pass short steps only.
  void restart(bool close = false);

  enum class Outcome { moved, stuck };
  /// One iteration along the step found.
  Outcome advance(Descent& descent);

 private:
  Outcome search(Descent& descent);
  bool soften(Descent& descent);
  Outcome leap(Descent& descent);
  Outcome go_back(Descent& descent);
  void end_leaps();

  int shortened_ = 0;  ///< steps in a row
  int leaps_ = 0;      ///< of the attempt under way; 0: none
  int failed_ = 0;     ///< attempts in a row, with none but shortened steps between them
  int most_leaps_ = 0;
  int softened_ = 0;  ///< soft steps since the filter last accepted one
  double mu_ = 0, slope_ = 0, alpha_ = 0;
  Merit merit_;
  Iterate from_;  ///< where it began
};

}  // namespace slalom::nlp::ipm
