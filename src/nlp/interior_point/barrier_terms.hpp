#pragma once

#include <vector>

namespace slalom::nlp::ipm {

/// What the bounds of w bring to the Newton system at a point and a barrier parameter.
struct BarrierTerms {
  double mu = 0;
  std::vector<double> sigma;  ///< by entry of w: sum of z / slack
  std::vector<double> slope;  ///< gradient of -mu sum of the logarithms of all slacks
};

}  // namespace slalom::nlp::ipm
