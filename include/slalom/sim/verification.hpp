#pragma once

#include <array>
#include <optional>
#include <string>

#include "slalom/sim/drive.hpp"
#include "slalom/sim/scenario.hpp"

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

/// A crash into an obstacle while a verified plan was driven. The certificate holds for a vehicle
/// and obstacles that are as believed: by the triangle's inequality, a crash needs
/// off_plan + off_belief >= kept.
struct VerifiedCrash {
  int cycle = 0;    ///< whose plan was driven
  double kept = 0;  ///< what its certificate proves beyond sm_crash from all obstacles [m]
  /// No point of the footprint was farther from where that plan has it [m].
  double off_plan = 0;
  /// No point of the obstacle was farther from where it was believed [m]; nothing where the planner
  /// did not know of it.
  std::optional<double> off_belief;
};

/// Nothing for another end, and for a crash by a plan that was not verified.
std::optional<VerifiedCrash> verified_crash(const Scenario& scenario, const Drive& drive);

}  // namespace slalom::sim
