#pragma once

#include <array>
#include <optional>
#include <string>

#include "slalom/sim/drive.hpp"

namespace slalom::sim {

/// Of the cycles on the clock, how many have a plan of each rung, and how many have none that is
/// verified.
struct Verification {
  int cycles = 0;
  std::array<int, 4> of_rung{};  ///< by planner::Rung; `none`: there is no plan
  int unverified = 0;
  double first_unverified_t = 0;  ///< when the first of them took effect, or would have [s]
  std::string first_refused;      ///< and why it is not verified

  int of(planner::Rung rung) const { return of_rung.at(static_cast<std::size_t>(rung)); }
};

/// Nothing for a drive of a planner that does not verify, whose plans are all of Rung::none.
std::optional<Verification> verification(const Drive& drive);

}  // namespace slalom::sim
