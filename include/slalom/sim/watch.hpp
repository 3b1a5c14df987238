#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "slalom/sim/drive.hpp"
#include "slalom/vehicle/plant.hpp"
#include "slalom/world/footprint.hpp"
#include "slalom/world/goal.hpp"
#include "slalom/world/obstacle.hpp"
#include "slalom/world/road.hpp"

namespace slalom::sim {

/// One stretch of a drive between two neighbouring samples.
struct Stretch {
  double t0 = 0, t1 = 0;                     ///< absolute times of its ends [s]
  vehicle::State state0{}, state1{};         ///< states there
  std::function<vehicle::State(double)> at;  ///< state at any time in between

  /// What `plant` drives on `signal` from `state` at t0 to t1; both outlive it. Throws PlantError,
  /// and so may `at`. `end`: the state at t1, where it is known.
  static Stretch driven(const vehicle::Plant& plant, const vehicle::ControlSignal& signal,
                        const vehicle::State& state, double t0, double t1,
                        const std::optional<vehicle::State>& end = std::nullopt);
};

/// What a drive, or a plan that is rolled out, is watched for.
struct Criteria {
  std::vector<world::Obstacle> obstacles;
  double margin = 0;  ///< by which they grow [m]
  world::Goal goal;
  double Fz_failure = 0;  ///< a wheel that bears less lifts [N]
  world::Footprint footprint{vehicle::Parameters{}};
  std::shared_ptr<const world::Road> road = {};  ///< to stay on
};

/// What ends a drive while the plant moves.
struct Event {
  Outcome outcome = Outcome::crash;  ///< crash, wheel_lift or off_road
  double t = 0;                      ///< located in time to 1e-9 s [s]
  std::string what;                  ///< name of the obstacle or wheel
};

struct Instant;
class Course;

/// Watches a drive stretch by stretch for the events of section 4 of docs/formulation.md, and keeps
/// its extremes. Obstacles, grown, and the goal's square are convex, and over one stretch (at most
/// .02 s) the plant's path is straight but for millimetres: the distance of a point to those that
/// move at constant velocity has one minimum a stretch, which is searched for wherever the speeds
/// allow it to matter. Distances of a body, and to obstacles that move by a trajectory, may have
/// several: they are looked at as often as the speeds allow a contact, or a lower one, between. A
/// graze between two samples is therefore not missed, but for one of a body or with a trajectory
/// that is less than .05 mm deep, or, at absurd speeds, shorter than 20 us; least distances of
/// these are known to 1 mm. An obstacle that is absent is not there; one that appears upon the
/// vehicle is a crash at that moment.
class Watch {
 public:
  /// `dynamics`, of the vehicle that drives, outlive it.
  Watch(const Criteria& criteria, const vehicle::Dynamics& dynamics);
  ~Watch();

  /// Takes in the start of the drive.
  void begin(double t, const vehicle::State& state);
  /// Takes in one stretch; the first event in it, if any. Extremes and the goal's crossing count up
  /// to that event only.
  std::optional<Event> pass(const Stretch& stretch);

  /// Signed distance [m] from the footprint to the edge of the nearest obstacle, grown by the
  /// margin, at time t [s]; infinity without obstacles.
  double clearance(double t, const vehicle::State& state) const;
  /// Vertical wheel loads [N], rl, rr, fl, fr, in a state, most often the last.
  vehicle::WheelLoads wheel_loads(const vehicle::State& state) const;

  /// When the goal's square was first entered [s].
  std::optional<double> goal_time() const { return goal_time_; }
  double least_clearance() const { return least_clearance_; }      ///< [m]
  double least_clearance_t() const { return least_clearance_t_; }  ///< [s]
  const std::string& least_clearance_obstacle() const { return least_clearance_obstacle_; }
  double least_wheel_load() const { return least_wheel_load_; }  ///< [N]
  /// Of the footprint from the road's edge at the ends of stretches [m]; infinity without a road.
  double least_edge_distance() const { return least_edge_distance_; }
  double progress() const { return progress_; }  ///< along the road since the start [m]
  /// When each lap of a closed road was done [s], linear within a stretch.
  const std::vector<double>& lap_ends() const { return lap_ends_; }

 private:
  struct Approach;
  struct Watched {
    explicit Watched(world::Obstacle grown);
    double fastest(double t0, double t1) const;  ///< [m/s]
    /// What the front axle's centre is no nearer to it than [m], soon found and so somewhat less
    /// than could be said; nothing of one with a trajectory.
    double least_distance(double t, const vehicle::State& state) const;

    world::Obstacle obstacle;  ///< grown by the margin
    double speed, reach;       ///< constant [m/s], 0 of one with a trajectory; [m]
  };

  void find_near(const Course& course);
  std::optional<Event> first_crash(Course& course) const;
  std::optional<Event> first_wheel_lift(Course& course) const;
  void note(Course& course);
  void note_clearance(Course& course);
  void note_wheel_loads(Course& course);
  void note_goal(Course& course);
  void note_edge(const vehicle::State& state);
  void note_progress(const Course& course);

  const vehicle::Dynamics& dynamics_;
  std::vector<Watched> watched_;
  std::unique_ptr<Instant> last_;  ///< the end of the last stretch
  std::vector<std::size_t> near_;  ///< of `watched_`, those that matter for the stretch
  std::size_t nearest_ = 0;        ///< and one that is near its end
  world::Goal goal_;
  double Fz_failure_;
  world::Footprint footprint_;
  std::shared_ptr<const world::Road> road_;
  double s_ = 0, progress_ = 0;
  std::vector<double> lap_ends_;
  double least_edge_distance_ = std::numeric_limits<double>::infinity();
  std::optional<double> goal_time_;
  double least_clearance_ = std::numeric_limits<double>::infinity();
  double least_clearance_t_ = 0;
  std::string least_clearance_obstacle_;
  double least_wheel_load_ = std::numeric_limits<double>::infinity();
};

}  // namespace slalom::sim
