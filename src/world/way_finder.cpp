#include "slalom/world/way_finder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>

#include "place_search.hpp"
#include "slalom/vehicle/agility.hpp"
#include "slalom/world/way_signature.hpp"

namespace slalom::world {
namespace {

using vehicle::State;

/// The side of a region at `side`, moved inwards as far as the search wants and the start allows;
/// `inwards` is 1 for the lower side, -1 for the upper.
double side_for(double side, double start, double inset, double inwards) {
  const double inner = side + inwards * inset;
  if (inwards * (start - inner) >= 0) return inner;
  return inwards * (start - side) >= 0 ? side : start - inwards * 0.5;
}

/// Below this speed the front wheels roll where they point, whatever little the state says of their
/// motion [m/s].
constexpr double kSlow = 1;

PlaceSearch::Place first_place(const State& start, const Goal& goal,
                               const vehicle::Parameters& vehicle) {
  const double v = std::max(start[vehicle::UX], 0.0);
  const bool slow = v < kSlow;
  const double sa = start[vehicle::SA];
  const double slip = slow ? sa : std::atan2(start[vehicle::V] + vehicle.la * start[vehicle::R], v);
  PlaceSearch::Place place;
  place.x = static_cast<float>(start[vehicle::X] - goal.x);
  place.y = static_cast<float>(start[vehicle::Y] - goal.y);
  place.heading = static_cast<float>(start[vehicle::PSI] + slip);
  place.v = static_cast<float>(v);
  place.kappa =
      static_cast<float>(slow ? std::sin(sa) / (vehicle.la + vehicle.lb) : start[vehicle::R] / v);
  return place;
}

/// What find_ways() makes of the search it is given, in their order: as it is, slower and closer,
/// and sharpest. A lower speed finds other orders in time.
struct Variant {
  double speed, clearance, lateral_acceleration, slowest;  ///< shares
  int places;                                              ///< multiples
};
constexpr std::array kVariants = {Variant{1, 1, 1, 1, 1}, Variant{0.71, 0.7, 1, 1, 1},
                                  Variant{0.46, 0.4, 1, 1, 1}, Variant{0.29, 0.4, 1, 1, 1},
                                  Variant{0.9, 0.25, 1.25, 2, 1}};
/// Comes after those, if none led to a good way: it may all but stand, to let something pass.
constexpr Variant kLastResort = {0.29, 0.15, 1.25, 0.1, 3};

WaySearch varied(const WaySearch& search, const Variant& by) {
  WaySearch result = search;
  result.v_min *= by.slowest;
  result.v_max = std::max(search.v_max * by.speed, result.v_min);
  result.clearance *= by.clearance;
  result.lateral_acceleration *= by.lateral_acceleration;
  result.max_places *= by.places;
  // A place that hardly moves is in the cell of the one before, but for its time.
  if (by.slowest < 1) result.cell_time = std::min(search.cell_time, search.dt);
  return result;
}

/// Below the top speed, for the tracker to catch up [m/s].
constexpr double kSpeedSpare = 1;

/// A wall of circles that goes along with an obstacle and shuts the side on which a way passes it,
/// from its edge to so far beyond the way; the half of its thickness [m].
constexpr double kWallBeyond = 10, kWallHalf = 2;
constexpr double kWallWithin = 10;  ///< of the way, farther from it obstacles get no wall [m]
constexpr double kWallAfter = 1;    ///< sooner there is no time left to pass otherwise [s]
constexpr int kWallsPerWay = 4;     ///< tried at the most, for each way wanted
constexpr int kWallPlaces = 4;      ///< a wall's search looks at so many times fewer places

/// Where the goal lies along the road [m]; its end, where the goal is a time.
double to_go(const Environment& environment) {
  if (!environment.road) return 0;
  const Goal& goal = environment.goal;
  if (goal.kind() == GoalKind::line) return goal.s;
  return goal.is_place() ? environment.road->project({goal.x, goal.y}).s
                         : environment.road->length();
}

}  // namespace

class WayFinder::Impl {
 public:
  Impl(const Environment& environment, const vehicle::Parameters& vehicle, double cover_excess)
      : goal_(environment.goal),
        region_(environment.region),
        vehicle_(vehicle),
        cover_excess_(cover_excess),
        body_(Footprint(vehicle).covering_discs(cover_excess)),
        road_(environment.road ? std::make_unique<RoadField>(environment.road) : nullptr),
        search_(environment.goal, vehicle, body_, road_.get(), to_go(environment)) {}

  std::optional<Way> find(const State& start, double t_start,
                          const std::vector<Obstacle>& obstacles, const WaySearch& search,
                          const std::optional<Standstill>& standing,
                          const std::function<bool()>& out_of_budget) {
    looked_at_ = 0;
    wall_.clear();
    return search_once({start, t_start, obstacles, out_of_budget}, search, standing);
  }

  void find_ways(const State& start, double t_start, const std::vector<Obstacle>& obstacles,
                 const WaySearch& search, int most, const std::function<bool(const Way&)>& take,
                 const std::function<bool()>& out_of_budget) {
    looked_at_ = 0;
    wall_.clear();
    const Question question = {start, t_start, obstacles, out_of_budget};
    Answers answers{take, most, {}};
    for (const auto& variant : kVariants) {
      if (answers.enough() || question.over()) return;
      add_way(question, varied(search, variant), answers);
    }
    if (!answers.any_good() && !answers.enough() && !question.over())
      add_way(question, varied(search, kLastResort), answers);
    WaySearch walled = search;
    walled.max_places = search.max_places / kWallPlaces;
    int left = kWallsPerWay * most;
    for (std::size_t k = 0; k < answers.found.size(); ++k)
      for (const auto i : to_wall(question, answers.found[k].passings)) {
        if (answers.enough() || question.over() || left-- <= 0) return;
        build_wall(answers.found[k].way, answers.found[k].passings[i], obstacles[i]);
        add_way(question, walled, answers);
      }
  }

  int looked_at() const { return looked_at_; }

 private:
  struct Question {
    const State& start;
    double t_start;
    const std::vector<Obstacle>& obstacles;
    const std::function<bool()>& out_of_budget;

    bool over() const { return out_of_budget && out_of_budget(); }
  };
  struct Found {
    Way way;
    WaySignature passings;
    bool good;
  };
  /// The ways handed over.
  struct Answers {
    const std::function<bool(const Way&)>& take;
    int most;
    std::vector<Found> found;

    bool enough() const { return static_cast<int>(found.size()) >= most; }
    bool any_good() const {
      return std::any_of(found.begin(), found.end(), [](const Found& f) { return f.good; });
    }
  };

  std::optional<Way> search_once(const Question& q, const WaySearch& search,
                                 const std::optional<Standstill>& standing = {}) {
    ellipses_.clear();
    moments_.clear();
    for (const auto& o : q.obstacles) add(o, q, search);
    for (const auto& o : wall_) add(o, q, search);
    const auto place = first_place(q.start, goal_, vehicle_);
    const bool found = search_.run(place, q.t_start, region_for(place, search), ellipses_, moments_,
                                   search, standing, q.out_of_budget);
    looked_at_ += search_.looked_at();
    if (!found) return std::nullopt;
    Way way;
    search_.write(q.t_start, way);
    return way;
  }

  /// Searches, and hands the way over if it passes differently from the good ones before.
  void add_way(const Question& q, const WaySearch& search, Answers& answers) {
    auto way = search_once(q, search);
    if (!way) return;
    auto passings = signature(*way, q.obstacles);
    for (const auto& before : answers.found)
      if (before.good && !differ(before.passings, passings)) return;
    const bool good = answers.take(*way);
    answers.found.push_back({std::move(*way), std::move(passings), good});
  }

  /// The obstacles worth a wall: those that move first, else in the order of passing.
  static std::vector<std::size_t> to_wall(const Question& q, const WaySignature& passings) {
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < passings.size(); ++i) {
      const auto& o = q.obstacles[i];
      if (passings[i].nearest - std::max(o.a, o.b) < kWallWithin &&
          passings[i].when > q.t_start + kWallAfter)
        result.push_back(i);
    }
    std::stable_sort(result.begin(), result.end(), [&](std::size_t i, std::size_t j) {
      const bool moves = q.obstacles[i].moves();
      if (moves != q.obstacles[j].moves()) return moves;
      return passings[i].when < passings[j].when;
    });
    return result;
  }

  void build_wall(const Way& way, const Passing& passing, const Obstacle& o) {
    wall_.clear();
    const auto at = std::lower_bound(way.begin(), way.end() - 1, passing.when,
                                     [](const WayPoint& p, double t) { return p.t < t; });
    const double dx = (at->x - o.x_at(at->t)) / passing.nearest;
    const double dy = (at->y - o.y_at(at->t)) / passing.nearest;
    const double edge = 1 / std::hypot(dx / o.a, dy / o.b);
    for (double r = edge; r < passing.nearest + kWallBeyond; r += kWallHalf) {
      wall_.push_back({{}, o.x + r * dx, o.y + r * dy, kWallHalf, kWallHalf, o.vx, o.vy});
      if (o.trajectory)
        wall_.back().trajectory =
            std::make_shared<MovedTrajectory>(o.trajectory, Point{r * dx, r * dy});
    }
  }

  /// For the centres of the discs that cover the vehicle.
  Region region_for(const PlaceSearch::Place& start, const WaySearch& search) const {
    const auto x = static_cast<double>(start.x), y = static_cast<double>(start.y);
    const double c = std::cos(static_cast<double>(start.heading)),
                 s = std::sin(static_cast<double>(start.heading));
    const auto ahead = [&](double share_x, double share_y, bool least) {
      double end = least ? 1e9 : -1e9;
      for (const Disc& disc : body_) {
        const double at = disc.ahead * (share_x * c + share_y * s);
        end = least ? std::min(end, at) : std::max(end, at);
      }
      return end;
    };
    const double inset = search.inset + body_.front().radius;
    return {side_for(region_.x_min - goal_.x, x + ahead(1, 0, true), inset, 1),
            side_for(region_.x_max - goal_.x, x + ahead(1, 0, false), inset, -1),
            side_for(region_.y_min - goal_.y, y + ahead(0, 1, true), inset, 1),
            side_for(region_.y_max - goal_.y, y + ahead(0, 1, false), inset, -1)};
  }

  /// The obstacle as the search counts it.
  void add(const Obstacle& o, const Question& q, const WaySearch& search) {
    if (o.is_plain()) return add_disc(o, q, search);
    for (const auto& disc : covering_discs(o, cover_excess_)) add_disc(disc, q, search);
  }

  /// The least of the start's discs' distances from the centre of an ellipse, by its norm.
  double start_within(double x, double y, double a, double b, const State& start) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Disc& disc : body_) {
      const double dx = start[vehicle::X] + disc.ahead * std::cos(start[vehicle::PSI]) - x;
      const double dy = start[vehicle::Y] + disc.ahead * std::sin(start[vehicle::PSI]) - y;
      least = std::min(least, std::hypot(dx / a, dy / b));
    }
    return least;
  }

  /// Larger by the body's discs, and so that the start is outside.
  void add_disc(const Obstacle& o, const Question& q, const WaySearch& search) {
    const double x = o.x_at(q.t_start), y = o.y_at(q.t_start);
    const double a = o.a + body_.front().radius, b = o.b + body_.front().radius;
    const double margin = o.margin(q.t_start);
    Ellipse e = {x - goal_.x, y - goal_.y, o.vx, o.vy, a + search.clearance, b + search.clearance};
    bool with_margin = true;
    if (o.present(q.t_start, q.t_start) &&
        start_within(x, y, e.a + margin, e.b + margin, q.start) < 1) {
      const double inside = start_within(x, y, a, b, q.start);
      if (inside == 0) return;
      e.a = a * (inside < 1 ? inside / 2 : 1);
      e.b = b * (inside < 1 ? inside / 2 : 1);
      with_margin = false;
    }
    if (o.trajectory || o.margin_rate > 0) {
      e.moments = static_cast<std::ptrdiff_t>(moments_.size());
      add_moments(o, q.t_start, search, with_margin);
    } else if (with_margin) {
      e.a += margin;
      e.b += margin;
    }
    ellipses_.push_back(e);
  }

  void add_moments(const Obstacle& o, double t_start, const WaySearch& search, bool with_margin) {
    const std::size_t count = PlaceSearch::moments(search);
    for (std::size_t k = 0; k < count; ++k) {
      const double t = t_start + static_cast<double>(k) * search.dt;
      const Pose at = o.pose_at(t);
      moments_.push_back({at.x - goal_.x, at.y - goal_.y, with_margin ? o.margin(t) : 0,
                          o.present(t, t + search.dt)});
    }
  }

  const Goal goal_;
  const Region region_;
  const vehicle::Parameters vehicle_;
  const double cover_excess_;
  const std::vector<Disc> body_;  ///< that cover the vehicle's footprint, of one radius
  const std::unique_ptr<RoadField> road_;
  PlaceSearch search_;
  std::vector<Obstacle> wall_;
  std::vector<Ellipse> ellipses_;
  std::vector<Moment> moments_;  ///< of those that move by a trajectory
  int looked_at_ = 0;
};

WaySearch way_search(const vehicle::Parameters& vehicle) {
  const auto can = vehicle::agility(vehicle);
  WaySearch search;
  search.v_max = std::max(vehicle.ux_max - kSpeedSpare, search.v_min);
  search.braking *= can.braking;
  search.lateral_acceleration *= can.lateral;
  search.curvature *= can.curvature;
  search.curvature_rate *= can.curvature_rate;
  return search;
}

WayFinder::WayFinder(const Environment& environment, const vehicle::Parameters& vehicle,
                     double cover_excess)
    : impl_(std::make_unique<Impl>(environment, vehicle, cover_excess)) {}
WayFinder::~WayFinder() = default;
WayFinder::WayFinder(WayFinder&&) noexcept = default;
WayFinder& WayFinder::operator=(WayFinder&&) noexcept = default;

std::optional<Way> WayFinder::find(const State& start, double t_start,
                                   const std::vector<Obstacle>& obstacles, const WaySearch& search,
                                   const std::function<bool()>& out_of_budget) {
  return impl_->find(start, t_start, obstacles, search, {}, out_of_budget);
}

std::optional<Way> WayFinder::to_stand(const State& start, double t_start,
                                       const std::vector<Obstacle>& obstacles,
                                       const WaySearch& search, const Standstill& standing,
                                       const std::function<bool()>& out_of_budget) {
  return impl_->find(start, t_start, obstacles, search, standing, out_of_budget);
}

void WayFinder::find_ways(const State& start, double t_start,
                          const std::vector<Obstacle>& obstacles, const WaySearch& search, int most,
                          const std::function<bool(const Way&)>& take,
                          const std::function<bool()>& out_of_budget) {
  impl_->find_ways(start, t_start, obstacles, search, most, take, out_of_budget);
}

int WayFinder::looked_at() const {
  return impl_->looked_at();
}

}  // namespace slalom::world
