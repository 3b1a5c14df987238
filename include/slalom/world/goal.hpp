#pragma once

#include <limits>

#include "slalom/base/options.hpp"
#include "slalom/vehicle/state.hpp"
#include "slalom/world/road.hpp"

namespace slalom::world {

/// What a goal is.
enum class GoalKind {
  square,     ///< within sigma of (x, y) along both axes
  rectangle,  ///< of length along psi and width across it, about (x, y)
  line,       ///< across the road, s [m] along it
  time,       ///< as far along the road as possible by a time [s]
  laps        ///< of a closed road
};

/// Where a drive is to end, and what else is asked of the vehicle there. What is infinite is
/// absent. All is about the front axle's centre.
struct Goal {
  static constexpr double kAbsent = std::numeric_limits<double>::infinity();

  double x = 0, y = 0;  ///< middle [m]; of a line and the end of a road as placed() has it
  double psi = 1.5707963267948966;           ///< direction through it [rad]
  double sigma = 15;                         ///< half-width of the square [m]
  double length = kAbsent, width = kAbsent;  ///< of the rectangle [m]
  double s = kAbsent;                        ///< of a line [m]
  double time = kAbsent;                     ///< [s]
  double laps = kAbsent;
  double psi_tolerance = kAbsent;              ///< of the heading, about psi [rad]
  double ux_min = -kAbsent, ux_max = kAbsent;  ///< [m/s]
  double t_min = -kAbsent, t_max = kAbsent;    ///< within which it counts [s]

  GoalKind kind() const {
    if (laps < kAbsent) return GoalKind::laps;
    if (time < kAbsent) return GoalKind::time;
    if (s < kAbsent) return GoalKind::line;
    return length < kAbsent ? GoalKind::rectangle : GoalKind::square;
  }
  /// Whether it is a place of its own; others are of the road.
  bool is_place() const { return kind() == GoalKind::square || kind() == GoalKind::rectangle; }

  /// Of a place along it, from its middle [m]; 0 of what is none.
  double half_length() const {
    if (!is_place()) return 0;
    return kind() == GoalKind::square ? sigma : length / 2;
  }

  /// How far a vehicle in this state at t [s] is from having reached it; at most 0 where it has. Of
  /// a place in metres, in the norm whose ball the place is; of a line in metres along the road; of
  /// a time, and of what else is asked, in the unit of what is missing most. Goals of the road need
  /// it. On a closed road, the half of a lap that follows a line counts as beyond it.
  double outside(const vehicle::State& state, double t, const Road* road) const;
  bool reached(const vehicle::State& state, double t, const Road* road) const {
    return outside(state, t, road) <= 0;
  }
};

/// The goal with x, y and psi where it lies: those of the line across the road, and for a time or
/// laps of the road's end. A place stays what it is.
Goal placed(Goal goal, const Road* road);

/// `ahead` [m] along the road to the goal, on a closed road by the lap that it is: the half of one
/// that follows a line is beyond it, and a place that lies behind is a lap ahead.
double by_the_lap(const Goal& goal, const Road& road, double ahead);

/// Throws InvalidValue, naming `where`, for a value that is there and outside its range, for a line
/// off the road, a time without a road, laps that are no whole number or of no closed road, and
/// what no state can meet.
void check(const Goal& goal, const Road* road, const std::string& where);

/// The registered options of Goal, with unit, range and meaning.
const OptionTable<Goal>& goal_options();

}  // namespace slalom::world
