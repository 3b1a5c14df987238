#pragma once

#include <array>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "motion.hpp"
#include "slalom/planner/plan.hpp"
#include "slalom/planner/task.hpp"
#include "slalom/vehicle/agility.hpp"
#include "slalom/vehicle/plant.hpp"
#include "slalom/world/footprint.hpp"

namespace slalom::planner {

/// How a motion ends.
enum class MotionEnd {
  arrives,  ///< it reaches the goal; it is within a square when the loop looks
  stands,   ///< it creeps, clear of every obstacle's path and on the road for good
  open      ///< neither
};

/// A disk outside which anything may stand [m].
struct Seen {
  double x = 0, y = 0, radius = std::numeric_limits<double>::infinity();
};
/// What a verified motion keeps: distance of its footprint from obstacles' edges, beside their
/// margins [m], wheel loads [N], and this distance within what is seen.
struct Need {
  double clearance, wheel_load;
  Seen seen{};
  double edge = 0;  ///< and distance of its footprint from the road's edges [m]
};

/// When the loop looks whether the vehicle is within the goal's square: at `from`, and before and
/// after it each `every` [s].
struct Looks {
  double from, every;
};

/// What judge() found.
struct Verdict {
  Certificate certificate;
  MotionEnd end = MotionEnd::open;
  double arrival = 0;           ///< when it arrives [s]
  std::vector<double> nearest;  ///< least distance to each obstacle's edge beside its margin [m]
  double nearest_edge = std::numeric_limits<double>::infinity();  ///< of the road [m]
  Need need{};                                                    ///< what was asked of it
  bool unseen = false;  ///< it is refused for nothing but leaving what is seen
};

/// Judges motions of the plant: whether, driven as they stand, they keep off all obstacles as
/// predicted, within the region and the vehicle's limits, and end where the vehicle can stay.
/// Between knots the distance to an obstacle is bounded by the sum of both speeds; where the bound
/// does not decide, the plant's own integrator gives the state between (conservative advancement:
/// B. Mirtich, "Impulse-based dynamic simulation of rigid body systems", 1996, section 2.3). Not
/// thread-safe.
class Verifier {
 public:
  /// The plant as it is believed in, with the integrator that the loop has by default.
  static vehicle::Plant believed_plant(const vehicle::Parameters& vehicle);

  /// Both outlive it.
  Verifier(const Task& task, const vehicle::Plant& plant)
      : task_(task),
        plant_(plant),
        footprint_(task.vehicle),
        quickness_(vehicle::quickness(task.vehicle)) {}

  /// `motion` among `obstacles`.
  Verdict judge(const Motion& motion, const std::vector<world::Obstacle>& obstacles,
                const Need& need, const Looks& looks);

  /// The last verdict.
  const Verdict& last() const { return verdict_; }

 private:
  struct Interval;
  struct Fastest;
  /// By how much a state is beyond the vehicle's limits and the wheel loads needed.
  struct Excess {
    std::array<double, vehicle::kWheels> load{};
    double ux = 0, sa = 0, ax = 0;
  };
  Excess excess_of(const vehicle::State& state, const vehicle::WheelLoads& loads) const;
  double within_seen(const vehicle::State& state) const;
  vehicle::WheelLoads note_limits(double t, const vehicle::State& state);
  Fastest fastest(const Interval& interval) const;
  template <class Judge>
  void halve(const Interval& interval, const Judge& judge) const;
  void keep_loads(const Interval& interval, const vehicle::WheelLoads& first,
                  const vehicle::WheelLoads& last);
  void keep_off(const Interval& interval, std::size_t obstacle);
  void keep_on_road(const Interval& interval);
  void find_end(const Motion& motion, const Looks& looks);
  void find_end_by_square(const Motion& motion, const Looks& looks);
  void note_distance(std::size_t obstacle, double distance, double spare);
  /// How a vehicle that was driven to a creep goes on.
  struct Creep {
    vehicle::State from{};
    double forward = 0, sideways = 0;  ///< velocity of its position, as the body sees it [m/s]
    double turn = 0;                   ///< [rad/s]
    double slack = 0;                  ///< acceleration that is left [m/s^2]
    double fastest = 0;  ///< no point of the body loses more of its distance to anything [m/s]

    vehicle::State after(double time) const;
    /// How far it may be from there, for the acceleration that is left [m].
    double astray(double time) const { return slack * time * time / 2; }
  };
  Creep creep_of(const Motion& motion) const;
  void note_first_clearances(const vehicle::State& x);
  void creep_within(const Creep& creep, double end,
                    const std::function<double(const vehicle::State&)>& room,
                    const char* otherwise);
  void creep_off(const Creep& creep, double end, std::size_t obstacle);
  void stand_for_good(const Motion& motion);
  void refuse(double t, std::string why);

  const Task& task_;
  const vehicle::Plant& plant_;
  const world::Footprint footprint_;
  const vehicle::Quickness quickness_;
  const std::vector<world::Obstacle>* obstacles_ = nullptr;
  Need need_{};
  double begin_ = 0;
  Excess first_;                         ///< at the motion's beginning
  std::vector<double> first_clearance_;  ///< from each obstacle there, beside its margin [m]
  double first_edge_ = 0;                ///< distance from the road's edge there [m]
  double first_outside_ = 0;             ///< how far it is outside the region there [m]
  Verdict verdict_;
};

}  // namespace slalom::planner
