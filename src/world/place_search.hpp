#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "cell_set.hpp"
#include "goal_field.hpp"
#include "road_field.hpp"
#include "slalom/vehicle/parameters.hpp"
#include "slalom/world/footprint.hpp"
#include "slalom/world/way_finder.hpp"

namespace slalom::world {

/// The search of WayFinder in coordinates relative to the goal, and in time from the start on.
class PlaceSearch {
 public:
  /// A node: where a move led, after how many, with which acceleration, and from where. Along a
  /// road it is `s` [m] from the road's start; of a closed road s goes on rising beyond its length.
  struct Place {
    float x = 0, y = 0, heading = 0, v = 0, kappa = 0, a = 0, s = 0;
    std::int32_t moves = 0, parent = -1;
  };

  /// Of the vehicle what keeps off obstacles are the centres of the discs of `body`.
  /// A road's field, or none, outlives it; to the goal it is `to_go` [m] from the road's start.
  PlaceSearch(const Goal& goal, const vehicle::Parameters& vehicle, const std::vector<Disc>& body,
              const RoadField* road, double to_go);

  /// How many moments an obstacle has that moves by a trajectory: one for each move, and the end.
  static std::size_t moments(const WaySearch& search);
  /// Whether a way was found to the goal, or where `standing` is given to where the vehicle stands
  /// for good; region and obstacles as the search is to keep out of them. Between the moments of an
  /// obstacle it goes straight.
  bool run(const Place& start, double t_start, const Region& region,
           const std::vector<Ellipse>& obstacles, const std::vector<Moment>& moments,
           const WaySearch& search, const std::optional<Standstill>& standing,
           const std::function<bool()>& out_of_budget);

  int looked_at() const { return looked_at_; }
  /// Of the last search: the way found, its times and places absolute.
  void write(double t_start, Way& way);

 private:
  static constexpr int kParts = 10;  ///< of a move, each checked: a metre at 25 m/s

  /// A place to go on from; `rank` is the time it would bring us to the goal at, at best.
  struct Open {
    double rank;
    std::int32_t place;
    /// Of two alike the older first.
    bool operator<(const Open& other) const {
      return rank > other.rank || (rank == other.rank && place > other.place);
    }
  };
  /// An obstacle as a move's parts meet it: at its beginning, axes inverted.
  struct Near {
    double x, y, vx, vy, per_a, per_b;
  };
  /// What a move's way depends on.
  struct Motion {
    double x, y, c, s, heading, v, kappa;
  };

  double most_curvature(double v) const;
  double braking_at(double v) const;
  void add(Place place);
  void go_on(std::int32_t from);
  void find_near(const Place& from);
  bool move(Motion& at, double a, double kappa_rate, double v_least, double v_most) const;
  void advance(Motion& at, double a, double kappa_rate, double h, double v_least,
               double v_most) const;
  bool is_free(const Motion& at, double after) const;
  bool is_clear(double x, double y, double after) const;
  bool is_end(const Place& place) const;
  bool arrived(const Place& place) const;
  bool stands(const Place& place) const;
  bool stands_clear(const Place& place, const Motion& at, const Ellipse& obstacle) const;
  double rank(const Place& place) const;
  bool meets_conditions(const Place& place) const;
  bool in_time(double t) const;
  bool on_road(double x, double y) const;
  double way_left(const Place& place) const;
  double along(const Place& place) const;
  void place_start(const Place& start);

  const Goal goal_;
  const vehicle::Parameters vehicle_;
  const Frame frame_;
  std::vector<double> ahead_;  ///< of the body's discs, from the front axle's centre on [m]
  double body_reach_ = 0;      ///< how far their centres are from it [m]
  const RoadField* road_;
  const double to_go_;
  double goal_s_ = 0;       ///< where the goal lies, in the terms of Place::s [m]
  double disc_radius_ = 0;  ///< of the body's [m]
  double edge_ = 0;         ///< kept by the discs' centres from the road's edges [m]
  double t_start_ = 0;      ///< [s]
  WaySearch p_;
  std::optional<Standstill> standing_;  ///< looked for, not the goal
  Region region_;
  std::vector<Ellipse> obstacles_;
  std::vector<Moment> moments_;
  GoalField field_;
  std::vector<Place> places_;
  std::vector<Open> open_;  ///< a heap
  CellSet cells_;
  std::vector<Near> near_;
  std::vector<std::int32_t> chain_;
  std::int32_t found_ = -1;
  int looked_at_ = 0;
};

}  // namespace slalom::world
