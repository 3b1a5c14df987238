#pragma once

#include <array>
#include <vector>

#include "motion.hpp"
#include "references.hpp"
#include "slalom/expr/function.hpp"
#include "slalom/vehicle/parameters.hpp"
#include "slalom/vehicle/plant.hpp"

namespace slalom::planner {

/// Drives the plant along a reference that it need not be able to follow: a time-varying linear
/// quadratic regulator about the reference (B. Anderson and J. Moore, Optimal Control: Linear
/// Quadratic Methods, 1990, section 2.4), whose controls are clipped to the vehicle's limits. What
/// comes out is the plant's own motion, whatever the reference is. Memory is kept from call to
/// call. Not thread-safe.
class Tracker {
 public:
  /// `plant`, of the vehicle with these parameters, outlives it. On a road a body follows its
  /// reference more closely in time, and settles as standing_of() says.
  Tracker(const vehicle::Parameters& vehicle, const vehicle::Plant& plant, bool on_road = false);

  /// The plant's motion from X0 at t0 to t_end [s], with knots kStep apart at most. It ends early
  /// where the plant cannot be integrated further; where there is no time to go, it is X0 without
  /// control.
  Motion follow(const Motion& reference, const vehicle::State& X0, double t0, double t_end);

  /// A motion of the plant whose controls go to 0 at its end. Throws PlantError.
  Motion released(Motion motion) const;

  /// A motion of the plant, and on from its end for so long [s] while its control goes to this one.
  /// Throws PlantError.
  Motion driven_to(const vehicle::Control& control, Motion motion, double duration) const;

  /// A motion of the plant, and on from its end until then without control. Throws PlantError.
  Motion driven_on(Motion motion, double until) const;

  static constexpr double kStep = 0.05;  ///< [s]

 private:
  using Square = std::array<std::array<double, vehicle::kStates>, vehicle::kStates>;
  using Gain = std::array<vehicle::State, vehicle::kControls>;
  using Inputs = std::array<vehicle::Control, vehicle::kStates>;

  void linearise(std::size_t steps, double h);
  void find_gains(std::size_t steps);
  void steady_gains(std::size_t steps);
  vehicle::Control steered(std::size_t knot, const vehicle::State& off, const vehicle::State& at,
                           double h) const;
  double driven_acceleration(double ux, double ax) const;

  vehicle::Parameters vehicle_;
  Standing standing_;
  bool body_;  ///< the footprint is no point, and there is a road
  const vehicle::Plant& plant_;
  const expr::Function& derivative_;  ///< the plant's
  // One for each knot: the reference, its linearisation over a step, and the gains.
  std::vector<vehicle::State> state_;
  std::vector<vehicle::Control> control_;
  std::vector<Square> A_;
  std::vector<Inputs> B_;
  std::vector<vehicle::State> defect_;  ///< by which the reference is no motion of the plant
  std::vector<Gain> gain_;
  std::vector<double> inputs_, derivatives_, jacobian_;
};

}  // namespace slalom::planner
