#include "slalom/sim/watch.hpp"

#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <utility>

#include "off_road.hpp"

namespace slalom::sim {
namespace {

using vehicle::State;
using vehicle::WheelLoads;

/// Roots are located to this [s].
constexpr double kTimeTolerance = 1e-10;
/// Of a distance with several minima, lows less deep than half of this may be missed [m], and
/// others are found to within kLow [m].
constexpr double kGraze = 1e-4, kLow = 1e-3;
/// After so many looks in a stretch, the others are evenly apart and as many at most: whatever the
/// speeds, a stretch is soon judged.
constexpr int kMostLooks = 1000;
/// Share of a stretch over which one-sided differences are taken.
constexpr double kDifference = 1e-3;

constexpr std::array<const char*, vehicle::kWheels> kWheelsInWords = {"rear left", "rear right",
                                                                      "front left", "front right"};

/// A value and when it is taken, in seconds since the stretch began.
struct Low {
  double t, value;
};

/// Least value of `f` over (0, length), when it has one minimum there; Brent's method.
template <class F>
Low lowest(const F& f, double length) {
  std::uintmax_t iterations = 60;
  const auto [t, value] = boost::math::tools::brent_find_minima(f, 0., length, 26, iterations);
  return {t, value};
}

/// Whether `f`, of one minimum, has it between two times: it falls after the first and rises before
/// the second.
template <class F>
bool dips_between(const F& f, double t0, double f0, double t1, double f1) {
  const double dt = kDifference * (t1 - t0);
  return f(t0 + dt) < f0 && f(t1 - dt) < f1;
}

/// First time in (0, end] at which `f` is no longer positive, given f(0) > 0 >= f(end) and one sign
/// change; Alefeld, Potra and Shi's algorithm 748.
template <class F>
double crossing(const F& f, double f0, double end, double f_end) {
  if (f0 <= 0) return 0;
  if (f_end == 0) return end;
  std::uintmax_t iterations = 100;
  const auto close = [](double low, double high) { return high - low <= kTimeTolerance; };
  return boost::math::tools::toms748_solve(f, 0., end, f0, f_end, close, iterations).second;
}

/// First time at which the convex `f` (one minimum) is no longer positive within [0, length], given
/// its values at both ends and a bound of |f'|.
template <class F>
std::optional<double> first_entry(const F& f, double length, double f0, double f1, double rate) {
  if (f0 < 0) return 0.;
  if (f1 < 0) return crossing(f, f0, length, f1);
  if (f0 + f1 >= rate * length) return std::nullopt;
  const Low low = lowest(f, length);
  if (low.value >= 0) return std::nullopt;
  return crossing(f, f0, low.t, low.value);
}

/// First time in [from, to] at which `f`, which falls no faster than `rate`, is negative, whatever
/// its shape: it is looked at again when it could be, which is conservative advancement (B. V.
/// Mirtich, "Impulse-based dynamic simulation of rigid body systems", 1996, section 2.3).
template <class F>
std::optional<double> first_touch(const F& f, double from, double f_from, double to, double rate) {
  double value = f_from;
  int looks = 0;
  if (value < 0) return from;
  for (double t = from; t < to;) {
    const double least_step = ++looks > kMostLooks ? (to - from) / kMostLooks : 0;
    const double next = std::min(to, t + std::max(std::max(value, kGraze) / rate, least_step));
    const double then = f(next);
    if (then < 0)
      return t + crossing([&](double after) { return f(t + after); }, value, next - t, then);
    t = next;
    value = then;
  }
  return std::nullopt;
}

/// Lowers `low` to the least of `f` between two times, to within kLow, if `rate` allows any there.
template <class F>
void look_between(const F& f, double t0, double f0, double t1, double f1, double rate,
                  double least_step, Low& low) {
  if ((f0 + f1 - rate * (t1 - t0)) / 2 >= low.value - kLow || t1 - t0 <= least_step) return;
  const double t = (t0 + t1) / 2, value = f(t);
  if (value < low.value) low = {t, value};
  look_between(f, t0, f0, t, value, rate, least_step, low);
  look_between(f, t, value, t1, f1, rate, least_step, low);
}

/// Upper bound on the speed [m/s] of any point of the footprint over a stretch; the margins cover
/// accelerations of 50 m/s^2 and 100 rad/s^2 and more over .02 s.
double speed_bound(const vehicle::Dynamics& dynamics, const world::Footprint& footprint,
                   const Stretch& stretch) {
  double speed = 0;
  for (const State* state : {&stretch.state0, &stretch.state1}) {
    const State rate = dynamics.derivative(*state, {});
    speed = std::max(speed, std::hypot(rate[vehicle::X], rate[vehicle::Y]));
  }
  const double turn =
      std::max(std::fabs(stretch.state0[vehicle::R]), std::fabs(stretch.state1[vehicle::R]));
  return 1.1 * speed + 1 + (1.1 * turn + 2) * footprint.reach();
}

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

std::optional<Presence> presence(const world::Obstacle& obstacle, const Stretch& s) {
  if (!obstacle.present(s.t0, s.t1)) return std::nullopt;
  // Narrows down where `there` begins to hold, from `out`, where it does not, to `in`.
  const auto edge = [](double out, double in, const auto& there) {
    for (double t = (out + in) / 2; std::fabs(in - out) > kTimeTolerance && t != in && t != out;
         t = (out + in) / 2)
      (there(t) ? in : out) = t;
    return in;
  };
  Presence part{s.t0, s.t1};
  if (!obstacle.present(s.t0, s.t0))
    part.from = edge(s.t0, s.t1, [&](double t) { return obstacle.present(s.t0, t); });
  if (!obstacle.present(s.t1, s.t1))
    part.to = edge(s.t1, s.t0, [&](double t) { return obstacle.present(t, s.t1); });
  return part;
}

/// Loads change by less than this [N/s], five times what full steering and braking give.
constexpr double kLoadRate = 1e5;

double load(const vehicle::Dynamics& dynamics, const Stretch& s, double t, std::size_t wheel) {
  return dynamics.wheel_loads(s.at(s.t0 + t))[wheel];
}

/// Calls use(wheel, low) with the least load of each wheel over a stretch, for those that can be
/// below `level` [N].
template <class Use>
void for_each_low_load(const vehicle::Dynamics& dynamics, const Stretch& s, double level,
                       const Use& use) {
  const double length = s.t1 - s.t0;
  const WheelLoads start = dynamics.wheel_loads(s.state0), end = dynamics.wheel_loads(s.state1);
  for (std::size_t wheel = 0; wheel < start.size(); ++wheel) {
    const double least = std::min(start[wheel], end[wheel]);
    if (least - kLoadRate * length / 2 >= level) continue;
    Low low = end[wheel] < start[wheel] ? Low{length, end[wheel]} : Low{0, start[wheel]};
    const auto along = [&](double t) { return load(dynamics, s, t, wheel); };
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
  const Stretch& stretch;
  const world::Obstacle& obstacle;
  double speed;  ///< no point of the footprint is faster [m/s]
  double from = 0, to = 0;
  double rate = 0;        ///< what the distance does not change faster than [m/s]
  double d0 = 0, d1 = 0;  ///< at both ends

  double operator()(double after) const {
    const double t = stretch.t0 + after;
    return watch.footprint_.distance(obstacle, stretch.at(t), t);
  }
  /// Whether it has one minimum.
  bool is_convex() const { return watch.footprint_.is_point() && !obstacle.trajectory; }

  /// Finds both ends; false if the obstacle is not there. Where it is so far off that the distance
  /// does not fall to `near`, d0 and d1 are lower bounds.
  bool begin(double near) {
    const auto part = presence(obstacle, stretch);
    if (!part) return false;
    from = part->from - stretch.t0;
    to = part->to - stretch.t0;
    rate = speed + obstacle.fastest(part->from, part->to);
    const double far = near + rate * (to - from);
    const auto end = [&](double t) {
      const State state = t == stretch.t0   ? stretch.state0
                          : t == stretch.t1 ? stretch.state1
                                            : stretch.at(t);
      return distance_within(watch.footprint_, obstacle, t, state, far);
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

Watch::Watch(const Criteria& criteria, const vehicle::Dynamics& dynamics)
    : dynamics_(dynamics),
      goal_(criteria.goal),
      Fz_failure_(criteria.Fz_failure),
      footprint_(criteria.footprint),
      road_(criteria.road) {
  for (const auto& obstacle : criteria.obstacles)
    obstacles_.push_back(obstacle.grown(criteria.margin));
}

double Watch::clearance(double t, const State& state) const {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& obstacle : obstacles_)
    if (obstacle.present(t, t))
      least = std::min(least, distance_within(footprint_, obstacle, t, state, least));
  return least;
}

void Watch::begin(double t, const State& state) {
  const Stretch instant{t, t, state, state, [&](double) { return state; }};
  note_clearance(instant);
  note_wheel_loads(instant);
  note_goal(instant);
  note_edge(state);
  if (road_) s_ = road_->project({state[vehicle::X], state[vehicle::Y]}).s;
}

std::optional<Event> Watch::pass(const Stretch& stretch) {
  std::optional<Event> event = first_crash(stretch);
  const std::optional<Event> lift = first_wheel_lift(stretch);
  if (lift && (!event || lift->t < event->t)) event = lift;
  if (road_)
    if (const auto off = first_off_road(*road_, footprint_, dynamics_, stretch);
        off && (!event || stretch.t0 + *off < event->t))
      event = Event{Outcome::off_road, stretch.t0 + *off, ""};

  Stretch seen = stretch;
  if (event) {
    seen.t1 = event->t;
    seen.state1 = stretch.at(event->t);
  }
  note_clearance(seen);
  note_wheel_loads(seen);
  note_goal(seen);
  note_edge(seen.state1);
  note_progress(seen);
  return event;
}

std::optional<Event> Watch::first_crash(const Stretch& s) const {
  std::optional<Event> first;
  const double speed = speed_bound(dynamics_, footprint_, s);
  for (const auto& obstacle : obstacles_) {
    Approach approach{*this, s, obstacle, speed};
    if (!approach.begin(0)) continue;
    const auto entry = approach.entry();
    if (entry && (!first || s.t0 + *entry < first->t))
      first = Event{Outcome::crash, s.t0 + *entry, obstacle.name};
  }
  return first;
}

std::optional<Event> Watch::first_wheel_lift(const Stretch& s) const {
  std::optional<Event> first;
  for_each_low_load(dynamics_, s, Fz_failure_, [&](std::size_t wheel, const Low& low) {
    const auto spare = [&](double t) { return load(dynamics_, s, t, wheel) - Fz_failure_; };
    const double t = s.t0 + crossing(spare, spare(0), low.t, low.value - Fz_failure_);
    if (!first || t < first->t) first = Event{Outcome::wheel_lift, t, kWheelsInWords[wheel]};
  });
  return first;
}

void Watch::note_clearance(const Stretch& s) {
  const double speed = speed_bound(dynamics_, footprint_, s);
  for (const auto& obstacle : obstacles_) {
    Approach approach{*this, s, obstacle, speed};
    if (!approach.begin(least_clearance_)) continue;
    const Low low = approach.least(least_clearance_);
    if (low.value < least_clearance_) {
      least_clearance_ = low.value;
      least_clearance_t_ = s.t0 + low.t;
      least_clearance_obstacle_ = obstacle.name;
    }
  }
}

void Watch::note_wheel_loads(const Stretch& s) {
  for_each_low_load(dynamics_, s, least_wheel_load_, [&](std::size_t, const Low& low) {
    least_wheel_load_ = std::min(least_wheel_load_, low.value);
  });
}

void Watch::note_goal(const Stretch& s) {
  if (goal_time_) return;
  const auto outside = [&](double t, const State& state) {
    return goal_.outside(state, t, road_.get());
  };
  const auto entry = first_entry([&](double t) { return outside(s.t0 + t, s.at(s.t0 + t)); },
                                 s.t1 - s.t0, outside(s.t0, s.state0), outside(s.t1, s.state1),
                                 speed_bound(dynamics_, footprint_, s));
  if (entry) goal_time_ = s.t0 + *entry;
}

void Watch::note_progress(const Stretch& s) {
  if (!road_) return;
  const double before = progress_, length = road_->length();
  const double now = road_->project({s.state1[vehicle::X], s.state1[vehicle::Y]}, s_).s;
  const double step = road_->closed() ? std::remainder(now - s_, length) : now - s_;
  s_ = now;
  progress_ += step;
  if (!road_->closed()) return;
  while (progress_ >= static_cast<double>(lap_ends_.size() + 1) * length) {
    const double share = (static_cast<double>(lap_ends_.size() + 1) * length - before) / step;
    lap_ends_.push_back(s.t0 + share * (s.t1 - s.t0));
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
