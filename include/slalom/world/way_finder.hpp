#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "slalom/vehicle/parameters.hpp"
#include "slalom/vehicle/state.hpp"
#include "slalom/world/environment.hpp"

namespace slalom::world {

/// A point of a way: absolute time t [s], front axle's centre (x, y) [m], direction of its motion
/// [rad] from +x counter-clockwise, speed v [m/s], curvature kappa [1/m], left positive, and
/// acceleration a [m/s^2] of the move that leads here (at the start: of the first move).
struct WayPoint {
  double t = 0, x = 0, y = 0, heading = 0, v = 0, kappa = 0, a = 0;
};

/// Points about 0.05 s apart, from the start into the goal; never fewer than one.
using Way = std::vector<WayPoint>;

/// The search of WayFinder, and what the vehicle in it does; the defaults are for the HMMWV.
struct WaySearch {
  double dt = 0.4;                    ///< of a move [s]
  double clearance = 0.8;             ///< kept from the obstacles [m]
  double inset = 0.5;                 ///< kept from the region's sides [m]
  double edge = 0.1;                  ///< kept from the road's edges [m]
  double v_min = 1.5, v_max = 28;     ///< [m/s]
  double lateral_acceleration = 3.2;  ///< most [m/s^2]
  double curvature = 0.15;            ///< most [1/m]
  double curvature_rate = 0.024;      ///< most [1/(m s)]
  double braking = 3.3;               ///< [m/s^2]
  double braking_share = 0;           ///< of the vehicle's ax_min, where that is harder
  double acceleration_share = 0.9;    ///< of the vehicle's ax_max
  double t_max = 60;                  ///< longest way [s]
  double greed = 2;                   ///< how much more the way ahead counts than the way so far
  /// Cells within which places count as one: along the goal's direction and across it [m], heading
  /// [rad], speed [m/s], curvature (as a share of the most at the speed) and time [s].
  double cell_along = 2, cell_across = 1, cell_heading = 0.16, cell_speed = 3, cell_curvature = 0.4,
         cell_time = 0.8;
  int max_places = 150'000;  ///< looked at before the search gives up
};

/// How a vehicle stands: from the search's least speed on it comes `stopping` [m] further, then it
/// creeps at `creep` [m/s], all straight on, and for `horizon` [s] nothing is to come to where it
/// is. Each metre straight on from there brings it nearer to the goal by `onwards` [m] at the
/// least.
struct Standstill {
  double stopping = 0.6, creep = 0.12, horizon = 60;
  double onwards = -std::numeric_limits<double>::infinity();
};

/// The search with the limits of another vehicle, by its agility and top speed.
WaySearch way_search(const vehicle::Parameters& vehicle);

/// Finds ways to the goal among obstacles: hybrid A* (D. Dolgov, S. Thrun, M.
/// Montemerlo and J. Diebel, "Path planning for autonomous vehicles in unknown semi-structured
/// environments", Int. J. Robotics Research 29(5), 2010) over place, heading, speed, curvature and
/// time. A move holds one rate of curvature and one acceleration; of the places in a cell the first
/// alone is gone on from. The rank of a place is its time and the time from there along the
/// shortest path around what stands. The same questions have the same answers, to the bit.
///
/// Keeps its memory: a find() among plain obstacles that is no larger than one before allocates
/// nothing but its answer.
class WayFinder {
 public:
  static constexpr int kAskedEvery = 256;

  /// Ways lead to the goal of `environment` within its region; its obstacles are not used. Discs
  /// that stick out by `cover_excess` [m] stand in for obstacles that are not plain and for the
  /// vehicle's body.
  WayFinder(const Environment& environment, const vehicle::Parameters& vehicle,
            double cover_excess = 0.2);
  ~WayFinder();
  WayFinder(WayFinder&&) noexcept;
  WayFinder& operator=(WayFinder&&) noexcept;

  /// A way from `start` at absolute time t_start [s], that keeps the clearance from `obstacles` --
  /// which are grown by the drive's margin already -- at every tenth of a move, and ends within
  /// half the goal's sigma along its direction and 0.6 sigma across. nullopt when the search finds
  /// none within max_places or before out_of_budget(), asked every kAskedEvery places, says so.
  ///
  /// Obstacles with a trajectory go straight from where they are at the beginning of a move to
  /// where they are at its end, with the margin they have there.
  ///
  /// A start that keeps too little distance may leave. An obstacle that has it within the clearance
  /// counts without clearance; one that contains it counts by an ellipse of the same shape half as
  /// far from its centre as the start. A side of the region nearer than the inset counts by itself,
  /// one passed already lies 0.5 m behind the start. A speed below v_min or above v_max may be kept
  /// and a curvature too great for the speed wound off.
  std::optional<Way> find(const vehicle::State& start, double t_start,
                          const std::vector<Obstacle>& obstacles, const WaySearch& search = {},
                          const std::function<bool()>& out_of_budget = {});

  /// A way, as find() finds one, that ends at the search's least speed where the vehicle can stand.
  /// t_max covers the standing as well, for obstacles that move by a trajectory.
  std::optional<Way> to_stand(const vehicle::State& start, double t_start,
                              const std::vector<Obstacle>& obstacles, const WaySearch& search,
                              const Standstill& standing,
                              const std::function<bool()>& out_of_budget = {});

  /// Hands up to `most` ways to `take`, each as it is found, which says whether the way is good: by
  /// `search`; then slower, closer or sharper; while none is good, closest and with three times the
  /// places; and then with the side on which a way found passes an obstacle shut. A way that passes
  /// every obstacle as a good one does (see differ()) is not handed over.
  void find_ways(const vehicle::State& start, double t_start,
                 const std::vector<Obstacle>& obstacles, const WaySearch& search, int most,
                 const std::function<bool(const Way&)>& take,
                 const std::function<bool()>& out_of_budget = {});

  /// Places that the last find() or find_ways() looked at.
  int looked_at() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace slalom::world
