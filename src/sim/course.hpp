#pragma once

#include <optional>
#include <vector>

#include "slalom/sim/watch.hpp"
#include "slalom/vehicle/model.hpp"
#include "slalom/world/footprint.hpp"

namespace slalom::sim {

/// One end of a stretch: a state and what several questions ask of it. The end of a stretch is the
/// beginning of the next.
struct Instant {
  Instant(double time, const vehicle::State& at, const vehicle::Dynamics& dynamics);

  double t;
  vehicle::State state;
  double speed;  ///< [m/s]
  vehicle::WheelLoads loads;
};

/// A stretch as it is searched: many searches look at the same times, of which the plant is asked
/// once.
class Course {
 public:
  /// `stretch` and `dynamics` outlive it.
  Course(const Stretch& stretch, const vehicle::Dynamics& dynamics, const Instant& begin,
         const Instant& end);
  /// Ends sooner from now on.
  void end_at(double t);

  const Instant& begin() const { return begin_; }
  const Instant& end() const { return end_; }
  double length() const { return end_.t - begin_.t; }
  vehicle::State at(double t);
  vehicle::WheelLoads loads(double t);

  /// Upper bound on the speed [m/s] of any point of the footprint; the margins cover accelerations
  /// of 50 m/s^2 and 100 rad/s^2 and more over .02 s.
  double fastest(const world::Footprint& footprint) const;

 private:
  struct Known {
    double t;
    vehicle::State state;
    std::optional<vehicle::WheelLoads> loads;
  };
  Known& known(double t);

  const Stretch& stretch_;
  const vehicle::Dynamics& dynamics_;
  Instant begin_, end_;
  std::vector<Known> known_;
};

}  // namespace slalom::sim
