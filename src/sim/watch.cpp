#include "slalom/sim/watch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "../base/same_bits.hpp"
#include "course.hpp"
#include "off_road.hpp"
#include "searches.hpp"

namespace slalom::sim {
namespace {

using vehicle::State;
using vehicle::WheelLoads;
using namespace searches;

constexpr std::array<const char*, vehicle::kWheels> kWheelsInWords = {"rear left", "rear right",
                                                                      "front left", "front right"};

/// Distance of a footprint and an obstacle; where it is more than `far`, a lower bound of it.
double distance_within(const world::Footprint& footprint, const world::Obstacle& obstacle, double t,
                       const State& state, double far) {
  if (!footprint.is_point() || !obstacle.is_plain()) {
    const world::Pose pose = obstacle.pose_at(t);
    const double bound = std::hypot(state[vehicle::X] - pose.x, state[vehicle::Y] - pose.y) -
                         footprint.reach() - std::max(obstacle.a, obstacle.b) - obstacle.rounding;
    if (bound > far) return bound;
  }
  return footprint.distance(obstacle, state, t);
}

/// The part of a stretch in which an obstacle is there.
struct Presence {
  double from, to;  ///< [s]
};

std::optional<Presence> presence(const world::Obstacle& obstacle, double t0, double t1) {
  if (!obstacle.present(t0, t1)) return std::nullopt;
  // Narrows down where `there` begins to hold, from `out`, where it does not, to `in`.
  const auto edge = [](double out, double in, const auto& there) {
    for (double t = (out + in) / 2; std::fabs(in - out) > kTimeTolerance && t != in && t != out;
         t = (out + in) / 2)
      (there(t) ? in : out) = t;
    return in;
  };
  Presence part{t0, t1};
  if (!obstacle.present(t0, t0))
    part.from = edge(t0, t1, [&](double t) { return obstacle.present(t0, t); });
  if (!obstacle.present(t1, t1))
    part.to = edge(t1, t0, [&](double t) { return obstacle.present(t, t1); });
  return part;
}

/// Loads change by less than this [N/s], five times what full steering and braking give.
constexpr double kLoadRate = 1e5;

/// Calls use(wheel, low) with the least load of each wheel over a stretch, for those that can be
/// below `level` [N].
template <class Use>
void for_each_low_load(Course& course, double level, const Use& use) {
  const double length = course.length();
  const WheelLoads &start = course.begin().loads, &end = course.end().loads;
  for (std::size_t wheel = 0; wheel < start.size(); ++wheel) {
    const double least = std::min(start[wheel], end[wheel]);
    if (least - kLoadRate * length / 2 >= level) continue;
    Low low = end[wheel] < start[wheel] ? Low{length, end[wheel]} : Low{0, start[wheel]};
    const auto along = [&](double after) { return course.loads(course.begin().t + after)[wheel]; };
    if (length > 0 && dips_between(along, 0, start[wheel], length, end[wheel])) {
      const Low inside = lowest(along, length);
      if (inside.value < low.value) low = inside;
    }
    if (low.value < level) use(wheel, low);
  }
}

}  // namespace

Stretch Stretch::driven(const vehicle::Plant& plant, const vehicle::ControlSignal& signal,
                        const State& state, double t0, double t1, const std::optional<State>& end) {
  Stretch stretch{t0, t1, state, {}, [&plant, &signal, state, t0](double t) {
                    return plant.advance(state, signal, t0, t);
                  }};
  stretch.state1 = end ? *end : stretch.at(t1);
  return stretch;
}

/// Distance of the footprint and one obstacle while that is there, by seconds since the stretch
/// began.
struct Watch::Approach {
  const Watch& watch;
  Course& course;
  const Watched& watched;
  double speed;  ///< no point of the footprint is faster [m/s]
  double from = 0, to = 0;
  double rate = 0;        ///< what the distance does not change faster than [m/s]
  double d0 = 0, d1 = 0;  ///< at both ends

  double operator()(double after) const {
    const double t = course.begin().t + after;
    return watch.footprint_.distance(watched.obstacle, course.at(t), t);
  }
  /// Whether it has one minimum.
  bool is_convex() const { return watch.footprint_.is_point() && !watched.obstacle.trajectory; }

  /// Finds both ends; false if the obstacle is not there. Where it is so far off that the distance
  /// does not fall to `near`, d0 and d1 are lower bounds.
  bool begin(double near) {
    const Instant &first = course.begin(), &last = course.end();
    const auto part = presence(watched.obstacle, first.t, last.t);
    if (!part) return false;
    from = part->from - first.t;
    to = part->to - first.t;
    rate = speed + watched.fastest(part->from, part->to);
    const double far = near + rate * (to - from);
    const auto end = [&](double t) {
      const State state = t == first.t ? first.state : t == last.t ? last.state : course.at(t);
      return distance_within(watch.footprint_, watched.obstacle, t, state, far);
    };
    d0 = end(part->from);
    d1 = end(part->to);
    return true;
  }

  std::optional<double> entry() const {
    if (is_convex()) return first_entry(*this, to, d0, d1, rate);
    if (d0 >= 0 && d1 >= 0 && d0 + d1 >= rate * (to - from)) return std::nullopt;
    return first_touch(*this, from, d0, to, rate);
  }

  /// The least distance, where it is below `level`; else anything that is not.
  Low least(double level) const {
    Low low = d1 < d0 ? Low{to, d1} : Low{from, d0};
    if (to <= from || (d0 + d1 - rate * (to - from)) / 2 >= level) return low;
    if (is_convex() && !dips_between(*this, from, d0, to, d1)) return low;
    const Low inside = lowest([&](double after) { return (*this)(from + after); }, to - from);
    if (inside.value < low.value) low = {from + inside.t, inside.value};
    if (is_convex()) return low;
    Low lower{low.t, std::min(low.value, level)};
    look_between(*this, from, d0, to, d1, rate, (to - from) / kMostLooks, lower);
    return lower.value < low.value && lower.value < level ? lower : low;
  }
};

Watch::Watched::Watched(world::Obstacle grown)
    : obstacle(std::move(grown)),
      speed(obstacle.trajectory ? 0 : obstacle.fastest(0, 0)),
      reach(obstacle.reach()) {}

double Watch::Watched::fastest(double t0, double t1) const {
  return obstacle.trajectory ? obstacle.fastest(t0, t1) : speed;
}

double Watch::Watched::least_distance(double t, const State& state) const {
  if (obstacle.trajectory) return -std::numeric_limits<double>::infinity();
  constexpr double kRounding = 1e-6, kRelative = 1e-9;
  const double dx = state[vehicle::X] - obstacle.x_at(t), dy = state[vehicle::Y] - obstacle.y_at(t);
  const double centre = std::sqrt(dx * dx + dy * dy);
  return centre - reach - (kRounding + kRelative * (centre + reach));
}

Watch::Watch(const Criteria& criteria, const vehicle::Dynamics& dynamics)
    : dynamics_(dynamics),
      goal_(criteria.goal),
      Fz_failure_(criteria.Fz_failure),
      footprint_(criteria.footprint),
      road_(criteria.road) {
  for (const auto& obstacle : criteria.obstacles)
    watched_.emplace_back(obstacle.grown(criteria.margin));
}

Watch::~Watch() = default;

double Watch::clearance(double t, const State& state) const {
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](const Watched& o) {
    if (!o.obstacle.present(t, t) || o.least_distance(t, state) - footprint_.reach() > least)
      return;
    least = std::min(least, distance_within(footprint_, o.obstacle, t, state, least));
  };
  if (nearest_ < watched_.size()) look(watched_[nearest_]);  // few of the others can be nearer
  for (const auto& o : watched_) look(o);
  return least;
}

WheelLoads Watch::wheel_loads(const State& state) const {
  return last_ && same_bits(last_->state, state) ? last_->loads : dynamics_.wheel_loads(state);
}

void Watch::begin(double t, const State& state) {
  const Stretch instant{t, t, state, state, [&](double) { return state; }};
  last_ = std::make_unique<Instant>(t, state, dynamics_);
  Course course(instant, dynamics_, *last_, *last_);
  find_near(course);
  note(course);
  note_edge(state);
  if (road_) s_ = road_->project({state[vehicle::X], state[vehicle::Y]}).s;
}

std::optional<Event> Watch::pass(const Stretch& stretch) {
  const bool goes_on = last_ && same_bits(last_->state, stretch.state0);
  Instant start = goes_on ? *last_ : Instant(stretch.t0, stretch.state0, dynamics_);
  start.t = stretch.t0;
  Course course(stretch, dynamics_, start, Instant(stretch.t1, stretch.state1, dynamics_));
  find_near(course);

  std::optional<Event> event = first_crash(course);
  const std::optional<Event> lift = first_wheel_lift(course);
  if (lift && (!event || lift->t < event->t)) event = lift;
  if (road_)
    if (const auto off = first_off_road(*road_, footprint_, dynamics_, stretch);
        off && (!event || stretch.t0 + *off < event->t))
      event = Event{Outcome::off_road, stretch.t0 + *off, ""};

  if (event) {
    course.end_at(event->t);
    find_near(course);
  }
  note(course);
  note_edge(course.end().state);
  note_progress(course);
  last_ = std::make_unique<Instant>(course.end());
  return event;
}

/// Obstacles that are too far off at both ends to be met or to lower the least clearance are passed
/// over.
void Watch::find_near(const Course& course) {
  const Instant &first = course.begin(), &last = course.end();
  const double speed = course.fastest(footprint_), near = std::max(least_clearance_, 0.0);
  double least = std::numeric_limits<double>::infinity();
  near_.clear();
  for (std::size_t k = 0; k < watched_.size(); ++k) {
    const Watched& o = watched_[k];
    const double d0 = o.least_distance(first.t, first.state) - footprint_.reach();
    const double d1 = o.least_distance(last.t, last.state) - footprint_.reach();
    const double far = near + (speed + o.speed) * course.length();
    if (!(d0 > far && d1 > far)) near_.push_back(k);
    if (d1 >= least) continue;
    least = d1;
    nearest_ = k;
  }
}

std::optional<Event> Watch::first_crash(Course& course) const {
  std::optional<Event> first;
  const double speed = course.fastest(footprint_), t0 = course.begin().t;
  for (const std::size_t k : near_) {
    Approach approach{*this, course, watched_[k], speed};
    if (!approach.begin(0)) continue;
    const auto entry = approach.entry();
    if (entry && (!first || t0 + *entry < first->t))
      first = Event{Outcome::crash, t0 + *entry, watched_[k].obstacle.name};
  }
  return first;
}

std::optional<Event> Watch::first_wheel_lift(Course& course) const {
  std::optional<Event> first;
  const double t0 = course.begin().t;
  for_each_low_load(course, Fz_failure_, [&](std::size_t wheel, const Low& low) {
    const auto spare = [&](double t) { return course.loads(t0 + t)[wheel] - Fz_failure_; };
    const double t = t0 + crossing(spare, spare(0), low.t, low.value - Fz_failure_);
    if (!first || t < first->t) first = Event{Outcome::wheel_lift, t, kWheelsInWords[wheel]};
  });
  return first;
}

void Watch::note(Course& course) {
  note_clearance(course);
  note_wheel_loads(course);
  note_goal(course);
}

void Watch::note_clearance(Course& course) {
  const double speed = course.fastest(footprint_);
  for (const std::size_t k : near_) {
    Approach approach{*this, course, watched_[k], speed};
    if (!approach.begin(least_clearance_)) continue;
    const Low low = approach.least(least_clearance_);
    if (low.value < least_clearance_) {
      least_clearance_ = low.value;
      least_clearance_t_ = course.begin().t + low.t;
      least_clearance_obstacle_ = watched_[k].obstacle.name;
    }
  }
}

void Watch::note_wheel_loads(Course& course) {
  for_each_low_load(course, least_wheel_load_, [&](std::size_t, const Low& low) {
    least_wheel_load_ = std::min(least_wheel_load_, low.value);
  });
}

void Watch::note_goal(Course& course) {
  if (goal_time_) return;
  const Instant &first = course.begin(), &last = course.end();
  const auto outside = [&](double t, const State& state) {
    return goal_.outside(state, t, road_.get());
  };
  const auto entry = first_entry(
      [&](double after) { return outside(first.t + after, course.at(first.t + after)); },
      course.length(), outside(first.t, first.state), outside(last.t, last.state),
      course.fastest(footprint_));
  if (entry) goal_time_ = first.t + *entry;
}

void Watch::note_progress(const Course& course) {
  if (!road_) return;
  const double before = progress_, length = road_->length();
  const State& state = course.end().state;
  const double now = road_->project({state[vehicle::X], state[vehicle::Y]}, s_).s;
  const double step = road_->closed() ? std::remainder(now - s_, length) : now - s_;
  s_ = now;
  progress_ += step;
  if (!road_->closed()) return;
  while (progress_ >= static_cast<double>(lap_ends_.size() + 1) * length) {
    const double share = (static_cast<double>(lap_ends_.size() + 1) * length - before) / step;
    lap_ends_.push_back(course.begin().t + share * course.length());
  }
  if (goal_.kind() == world::GoalKind::laps && !goal_time_ &&
      static_cast<double>(lap_ends_.size()) >= goal_.laps)
    goal_time_ = lap_ends_[static_cast<std::size_t>(goal_.laps) - 1];
}

void Watch::note_edge(const State& state) {
  if (road_)
    least_edge_distance_ = std::min(least_edge_distance_, footprint_.edge_distance(*road_, state));
}

}  // namespace slalom::sim
