#pragma once

#include "point.hpp"

namespace slalom::nlp::ipm {

/// The best point a solve has seen: the least barrier function among those that meet the rows to
/// tolerance, else the least violation. What a solve that is cut short answers with. Of multipliers
/// it keeps those of the rows; those of bounds are mu / slack.
class BestIterate {
 public:
  void begin(const SlackForm& form, double tolerance);
  /// `violation`: largest, in the user's units; `logs`: of the slacks. Barrier functions are
  /// compared at `mu`, for they fall with it.
  void offer(const Iterate& at, double violation, double objective, double logs, double mu);
  bool empty() const { return !known_; }
  bool feasible() const { return known_ && violation_ <= tolerance_; }
  /// Sets `point` to it, with mu / slack for the multipliers of bounds.
  void restore(const SlackForm& form, double mu, Point& point) const;

 private:
  std::vector<double> w_, y_;
  bool known_ = false;
  double tolerance_ = 0, violation_ = 0, objective_ = 0, logs_ = 0;
};

}  // namespace slalom::nlp::ipm
