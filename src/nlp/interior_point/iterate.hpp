#pragma once

#include <vector>

#include "vector_kernels.hpp"

namespace slalom::nlp::ipm {

/// A point of the primal-dual method, or a step. The primal part is one vector w = (x, s), or
/// (x, s, p, n) with elastic rows: variables; a slack for each row, of an equation its constant;
/// elastic parts of the rows. Every entry may have a bound on either side, with multipliers
/// zl, zu >= 0.
struct Iterate {
  std::vector<double> w;       ///< primal
  std::vector<double> y;       ///< multipliers of the rows
  std::vector<double> zl, zu;  ///< of the bounds, one each an entry of w; 0 where there is none

  void resize(std::size_t primal, std::size_t rows) {
    for (auto* list : {&w, &zl, &zu}) list->assign(primal, 0.0);
    y.assign(rows, 0.0);
  }
};

/// Change of each part of an Iterate, and how far it may go.
struct Step : Iterate {
  StepReach reach;
};

}  // namespace slalom::nlp::ipm
