#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "slalom/vehicle/parameters.hpp"
#include "slalom/vehicle/state.hpp"
#include "slalom/world/environment.hpp"
#include "slalom/world/way_finder.hpp"

namespace slalom::world {

/// What ways along a road keep, and how long they are looked for.
struct RoadWaySearch {
  double clearance = 0.1;        ///< from the obstacles, beside their margins [m]
  double edge = 0.1;             ///< from the road's edges [m]
  double limits = 0.85;          ///< share of steering rate and lateral acceleration that it uses
  double beyond = 1;             ///< for which a way brakes on after it arrives [s]
  double creep = 0.12;           ///< speed at which a vehicle stands [m/s]
  double t_max = 30;             ///< longest way [s]
  double standing_horizon = 60;  ///< for which a stop is clear of obstacles [s]
  int max_places = 12'000;       ///< of one path that are looked at
};

/// A way along the road.
struct RoadWay {
  Way way;
  double end = 0;         ///< when it arrives, or stands; what follows brakes on [s]
  bool complete = false;  ///< it arrives, or stands for good; else it goes well as long as possible
  double cost = 0;        ///< by which ways are compared [s]
};

/// Finds ways along a road: paths that move over to an offset from its line and keep that, and on
/// each of them speeds that pass among the obstacles in time (path-velocity decomposition: K. Kant
/// and S. W. Zucker, "Toward efficient trajectory planning", Int. J. Robotics Research 5(3), 1986;
/// offsets as quintics of the way: M. Werling, J. Ziegler, S. Kammel and S. Thrun, "Optimal
/// trajectory generation for dynamic street scenarios in a Frenet frame", ICRA 2010). Of the
/// footprint itself, not of discs. The same questions have the same answers, to the bit.
class RoadWays {
 public:
  static constexpr int kAskedEvery = 256;  ///< places

  /// `environment` has a road; its obstacles are not used.
  RoadWays(const Environment& environment, const vehicle::Parameters& vehicle);
  ~RoadWays();
  RoadWays(RoadWays&&) noexcept;
  RoadWays& operator=(RoadWays&&) noexcept;

  /// Ways from `start` at absolute time t_start [s] that arrive at the goal, the best first. An
  /// obstacle that the start is nearer to than the search keeps is kept that far from. So is an
  /// edge, for a few metres within which the way comes back to what is kept.
  std::vector<RoadWay> to_goal(const vehicle::State& start, double t_start,
                               const std::vector<Obstacle>& obstacles, const RoadWaySearch& search,
                               const std::function<bool()>& out_of_budget = {});

  /// Ways that come to stand where no obstacle comes, the best first; those that are not complete
  /// after them, the one that goes well longest first.
  std::vector<RoadWay> to_stand(const vehicle::State& start, double t_start,
                                const std::vector<Obstacle>& obstacles, const RoadWaySearch& search,
                                const std::function<bool()>& out_of_budget = {});

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace slalom::world
