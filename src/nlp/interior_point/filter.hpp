#pragma once

#include <utility>
#include <vector>

namespace slalom::nlp::ipm {

/// How good a point is: violation of the rows (1-norm) and barrier function.
struct Merit {
  double violation = 0, barrier = 0;
};

/// Room for rounding when two values of the barrier function are compared.
double rounding(double barrier);

/// The filter: pairs of violation and barrier function that a new iterate must improve on
/// (Waechter & Biegler 2006, section 2.3).
class Filter {
 public:
  Filter();
  /// For a new problem: no violation above `most_violation` is taken.
  void reset(double most_violation);
  /// For a new barrier parameter.
  void clear() { entries_.clear(); }
  bool accepts(const Merit& point) const;
  void add(const Merit& point);

 private:
  double most_violation_ = 0;
  std::vector<Merit> entries_;
};

}  // namespace slalom::nlp::ipm
