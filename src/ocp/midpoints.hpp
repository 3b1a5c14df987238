#pragma once

#include <vector>

#include "compiler.hpp"

namespace slalom::ocp {

/// Functions at the midpoints of compressed Hermite-Simpson intervals, as functions of the states
/// and controls at both ends: x_m = (x_0 + x_1)/2 + h/8 (f_0 - f_1) (Kelly, SIAM Rev. 59(4), 2017,
/// eq. 4.4).
class Midpoints {
 public:
  Midpoints(const Problem& problem, const Layout& layout);

  std::vector<Output> outputs(const std::vector<Output>& at_point) const;
  /// The lanes of `points`, all of them midpoints.
  Lanes lanes(std::vector<std::size_t> points, std::size_t family) const;

 private:
  /// Symbols for an end's states and controls, and for its tau.
  struct Side {
    std::vector<Expr> states, controls;
    Expr tau;
  };
  std::vector<Expr> rates(const Side& side) const;

  const Problem& problem_;
  const Layout& layout_;
  Side begin_, end_;
  std::vector<Expr> states_, midpoint_;
};

}  // namespace slalom::ocp
