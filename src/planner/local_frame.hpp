#pragma once

#include <cmath>
#include <numbers>

#include "slalom/planner/planner.hpp"

namespace slalom::planner {

/// The whole turns that are nearest to an angle [rad].
inline double whole_turns(double angle) {
  constexpr double turn = 2 * std::numbers::pi;
  return std::round(angle / turn) * turn;
}

/// The frame that a planner plans in. Places far from the origin (map coordinates, millions of
/// metres) would leave few digits for metres, and headings that differ by whole turns are one. So
/// the origin is moved to a point near the goal whose coordinates are multiples of kGrid, which
/// changes no bit of places that are near the origin anyway, and the heading at the start lies in
/// [-pi, pi]. Vehicle and time stay.
class LocalFrame {
 public:
  static constexpr double kGrid = 4096;  ///< [m]

  explicit LocalFrame(const world::Goal& goal);

  Task to_local(Task task) const;
  /// Also notes by how many turns this request's heading was turned, for to_global(). Without
  /// `turn` that is as it was for the request before.
  Request to_local(Request request, bool turn);
  void to_global(Plan& plan) const;

  /// A heading less the whole turns that are nearest to it [rad]: in [-pi, pi].
  static double without_turns(double psi);

 private:
  void move(std::vector<world::Obstacle>& obstacles) const;

  double x_ = 0, y_ = 0;  ///< of the local origin
  double turned_ = 0;     ///< what the last request's heading is beyond the local one [rad]
};

}  // namespace slalom::planner
