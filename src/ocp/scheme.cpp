#include "slalom/ocp/scheme.hpp"

#include <fmt/format.h>

#include <utility>

#include "slalom/base/error.hpp"

namespace slalom::ocp {

Mesh Mesh::uniform(int intervals) {
  if (intervals < 1)
    throw InvalidValue("mesh", fmt::format("{} intervals", intervals), "at least 1");
  std::vector<double> breakpoints(static_cast<std::size_t>(intervals) + 1);
  for (std::size_t k = 0; k < breakpoints.size(); ++k)
    breakpoints[k] = static_cast<double>(k) / intervals;
  return Mesh(std::move(breakpoints));
}

Mesh::Mesh(std::vector<double> breakpoints) : breakpoints_(std::move(breakpoints)) {
  if (breakpoints_.size() < 2)
    throw InvalidValue("mesh", fmt::format("{} breakpoints", breakpoints_.size()), "at least 2");
  if (breakpoints_.front() != 0 || breakpoints_.back() != 1)
    throw InvalidValue(
        "mesh", fmt::format("breakpoints from {} to {}", breakpoints_.front(), breakpoints_.back()),
        "from 0 to 1");
  for (std::size_t k = 1; k < breakpoints_.size(); ++k)
    if (!(breakpoints_[k] > breakpoints_[k - 1]))
      throw InvalidValue(
          "mesh",
          fmt::format("breakpoint {} = {} after {}", k, breakpoints_[k], breakpoints_[k - 1]),
          "strictly increasing breakpoints");
}

const Scheme& trapezoidal() {
  static const Scheme scheme{"trapezoidal", 2, {0, 1}, {{-1, 1}}, {{0.5, 0.5}}, {0.5, 0.5}};
  return scheme;
}

const Scheme& hermite_simpson() {
  // Defect 0 ties the midpoint: x_m - (x_0 + x_1)/2 - h/8 (f_0 - f_1); defect 1 is Simpson's rule.
  static const Scheme scheme{"hermite_simpson",
                             4,
                             {0, 0.5, 1},
                             {{-0.5, 1, -0.5}, {-1, 0, 1}},
                             {{0.125, 0, -0.125}, {1.0 / 6, 4.0 / 6, 1.0 / 6}},
                             {1.0 / 6, 4.0 / 6, 1.0 / 6}};
  return scheme;
}

}  // namespace slalom::ocp
