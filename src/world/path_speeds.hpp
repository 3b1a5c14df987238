#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "cell_set.hpp"
#include "road_path.hpp"
#include "slalom/world/environment.hpp"
#include "slalom/world/footprint.hpp"
#include "slalom/world/road_ways.hpp"

namespace slalom::world {

/// The search for speeds along a path: A* (P. Hart, N. Nilsson and B. Raphael, IEEE Trans. Systems
/// Science and Cybernetics 4(2), 1968) over place, speed and time. A move comes to one acceleration
/// by the jerk that the vehicle can, and holds it for a step of time; of the places in a cell the
/// first alone is gone on from.
class PathSpeeds {
 public:
  /// What is looked for.
  enum class Aim { arrive, stand };
  struct Question {
    Aim aim;
    vehicle::State start;
    double t_start;
    const std::vector<Obstacle>& obstacles;
    RoadWaySearch search;
    double to_go;     ///< along the path to where the goal begins [m]
    double to_leave;  ///< and to where it ends [m]
    const std::function<bool()>& out_of_budget;
  };

  PathSpeeds(const Environment& environment, const vehicle::Parameters& vehicle);

  /// The best way along the path; none where there is no move at all.
  std::optional<RoadWay> run(const RoadPath& path, const Question& question);

 private:
  /// After so many looks: how far along the path [m], speed, acceleration, the one that the move
  /// here came to, and what it cost beside time [s].
  struct Place {
    double s = 0, v = 0, a = 0, towards = 0, cost = 0;
    std::int32_t looks = 0, parent = -1;
  };
  /// What is known of a place at a look.
  enum class Known : std::uint8_t { nothing, free, near, taken };
  struct Open {
    double rank;
    std::int32_t place;
    bool operator<(const Open& other) const {
      return rank > other.rank || (rank == other.rank && place > other.place);
    }
  };

  void find_fastest();
  double fastest_time(double v, double way) const;
  double farthest(double v, double time) const;
  void begin(const RoadPath& path, const Question& question);
  void find_limits();
  double longest(const Question& question) const;
  double time_at(std::int32_t looks) const { return question_->t_start + kLook * looks; }
  double rank_of(const Place& place) const;
  double left_to_goal(const Place& place) const;
  void add(const Place& place);
  void go_on(std::int32_t from);
  bool move(Place& place, double a, bool& arrived);
  void advance(Place& place, double a, double from) const;
  bool drives(std::size_t at, double v, double a, std::int32_t look, double& cost) const;
  bool is_free(double along, std::int32_t look);
  double spare_at(const PathPlace& place, double t) const;
  bool stays_clear(std::size_t at) const;
  bool on_road(std::size_t at) const;
  bool stands_for_good(const Place& place) const;
  void brake(Place& place) const;
  std::int32_t looks_beyond() const;
  bool goes_on(Place place);
  double hardest(double v) const;
  double settle(double v) const;
  static vehicle::State state_of(const PathPlace& place, double v);
  RoadWay way_of(std::int32_t last, bool complete) const;

  /// What a start does that is too fast for its path goes on so long [s].
  static constexpr double kToComeBack = 0.6;
  static constexpr double kLook = 0.1;  ///< between the moments that are looked at [s]

  const Environment& environment_;
  const vehicle::Parameters vehicle_;
  const Footprint footprint_;
  const Goal within_;          ///< the goal, less what a tracked way may be off
  const double most_lateral_;  ///< [m/s^2]
  const RoadPath* path_ = nullptr;
  const Question* question_ = nullptr;
  std::vector<double> fastest_v_, fastest_s_;  ///< of the fastest motion from rest, kLook apart
  std::int32_t looks_per_move_ = 2, most_looks_ = 0;
  double first_edge_ = 0;      ///< of the start [m]
  std::vector<double> keeps_;  ///< from each obstacle [m]
  /// Of each place of the path: the speed from which what comes can be driven [m/s], and the time
  /// to the goal at such speeds [s].
  std::vector<double> limit_, left_;
  double usable_ = 0;        ///< how long the path is driveable, whatever the speed [m]
  std::vector<Known> free_;  ///< of each place of the path at each look
  std::vector<Place> places_;
  std::vector<Open> open_;
  CellSet cells_;
  std::int32_t latest_ = -1;
};

}  // namespace slalom::world
