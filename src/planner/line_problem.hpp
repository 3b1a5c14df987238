#pragma once

#include <array>
#include <functional>
#include <vector>

#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/trajectory.hpp"
#include "slalom/vehicle/parameters.hpp"
#include "slalom/vehicle/state.hpp"
#include "slalom/world/road.hpp"

namespace slalom::planner {

/// What a problem along a line minimises beside time, and keeps.
struct LineSettings {
  double margin = 0;        ///< that the body keeps from the road's edges [m]
  double w_t = 1;           ///< of all of it [1/s]
  double w_control = 0.01;  ///< cost of a control at its limit [s/s]
  /// Of going beyond the limits of wheel loads [kN], rear slip [.1 rad] and the road's edges [m],
  /// in each metre of the road, times w_t [s/m]; 0: they are hard.
  double w_excess = 0;
};

/// The fastest motion along a road, as an optimal-control problem whose independent variable is the
/// length along the road's line from where it begins [m]. States: the offset n of the front axle's
/// centre to the left of the line [m], the heading xi relative to the line's [rad], and those of
/// the vehicle but for its place and heading. The line's length s at its beginning is a parameter.
///
/// s' = V_t / (1 - n kappa), n' = V_n, xi' = r - kappa s', where V_t and V_n are the front axle's
/// velocity along and across the line (G. Perantoni and D. J. N. Limebeer, "Optimal control for a
/// Formula One car with variable parameters", Vehicle System Dynamics 52(5), 2014, Eqns. 1 to 3).
/// Every corner of the body stays within the road's widths where it is; the line between is taken
/// as a parabola.
class LineProblem {
 public:
  enum Index : std::size_t { N, XI, FIRST_OF_VEHICLE, SPEED = FIRST_OF_VEHICLE + 3 };
  /// The vehicle's states from FIRST_OF_VEHICLE on.
  static constexpr std::array kOfVehicle = {vehicle::V, vehicle::R, vehicle::SA, vehicle::UX,
                                            vehicle::AX};
  static constexpr std::size_t kLineStates = FIRST_OF_VEHICLE + kOfVehicle.size();
  using LineState = std::array<double, kLineStates>;

  /// Over `length` of the road [m]. The road outlives it. Throws InvalidValue for a road that
  /// leaves less than the vehicle's width between its margins.
  LineProblem(const world::Road& road, const vehicle::Parameters& vehicle, double length,
              const LineSettings& settings);

  ocp::Problem& problem() { return problem_; }
  const ocp::Problem& problem() const { return problem_; }
  double length() const { return length_; }
  /// The least speed of its states [m/s].
  double slowest() const { return slowest_; }
  /// The states' symbols.
  const std::array<ocp::Expr, kLineStates>& states() const { return x_; }
  const ocp::Expr& start() const { return start_; }

  /// What the road is at places along the line [m]: its curvature [1/m], then the width to the left
  /// less the margin [m], its slope along the line, and the same to the right.
  std::vector<std::array<double, 5>> along(const std::vector<double>& s) const;

  /// Steady cornering along the line at s [m], without slip of the rear axle: at a speed [m/s] and
  /// an acceleration [m/s^2].
  LineState cornering(double s, double speed, double acceleration) const;
  /// How fast a vehicle comes along the line at s [m/s].
  double progress(double s, const LineState& x) const;
  /// A vehicle's state relative to the line at s, and back. Its heading turns by no whole turns
  /// against `near` [rad].
  LineState to_line(double s, const vehicle::State& state) const;
  vehicle::State to_world(double s, const LineState& x, double near) const;

  /// An answer or a guess in time, from `t0` [s] on, and in the world's frame.
  struct Motion {
    std::vector<double> s, t;  ///< along the line [m], absolute time [s]
    std::vector<vehicle::State> states;
    std::vector<vehicle::Control> controls;
  };
  /// Points are nodes and the middles between, through whose parabolas Simpson's rule integrates.
  Motion to_world(const ocp::Trajectory& found, double start, double t0, double psi) const;

 private:
  void tabulate(double until);
  void add_motion();
  void add_limit(const std::string& name, const ocp::Expr& room);
  void add_limits();
  void add_edges();

  const world::Road& road_;
  const vehicle::Parameters vehicle_;
  const double length_, slowest_;
  const LineSettings settings_;
  ocp::Problem problem_;
  ocp::Expr start_, s_, kappa_, s_dot_;
  std::array<ocp::Expr, kLineStates> x_;
  std::array<ocp::Expr, vehicle::kStates> X_;
  std::array<ocp::Expr, vehicle::kControls> U_;
  std::array<ocp::Expr, 2> left_, right_;  ///< widths at s, and their slopes along the line
  double widest_ = 0;
};

/// Speeds [m/s] from which a vehicle in the middle of the road can drive on, or stop at the end of
/// a road that is not closed: by the lateral acceleration that
/// tyres and wheel loads allow, and shares of what it brakes and accelerates with.
class SpeedProfile {
 public:
  /// Shares of lateral acceleration and of braking.
  SpeedProfile(const world::Road& road, const vehicle::Parameters& vehicle, double lateral_share,
               double braking_share);
  /// Of a road that goes on straight beyond its ends, and no faster than a limit at s [m/s].
  SpeedProfile(const world::Road& road, const vehicle::Parameters& vehicle, double lateral_share,
               double braking_share, const std::function<double(double)>& limit);
  /// At s, around and around where the road is closed; as at its end beyond one that is not.
  double at(double s) const;
  double slowest() const;  ///< anywhere

 private:
  bool closed_;
  double step_;
  std::vector<double> speed_;
};

}  // namespace slalom::planner
