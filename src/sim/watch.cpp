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
/// Share of a stretch over which one-sided differences of wheel loads are taken.
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

/// Upper bound on the speed [m/s] of the front axle's centre over a stretch; the margin covers
/// accelerations of 50 m/s^2 and more over .02 s.
double speed_bound(const vehicle::Dynamics& dynamics, const Stretch& stretch) {
  double speed = 0;
  for (const State* state : {&stretch.state0, &stretch.state1}) {
    const State rate = dynamics.derivative(*state, {});
    speed = std::max(speed, std::hypot(rate[vehicle::X], rate[vehicle::Y]));
  }
  return 1.1 * speed + 1;
}

double clearance_of(const world::Obstacle& grown, double t, const State& state) {
  return world::distance(grown, state[vehicle::X], state[vehicle::Y], t);
}

/// Loads change by less than this [N/s], five times what full steering and braking give.
constexpr double kLoadRate = 1e5;

double load(const vehicle::Dynamics& dynamics, const Stretch& s, double t, std::size_t wheel) {
  return dynamics.wheel_loads(s.at(s.t0 + t))[wheel];
}

/// Calls use(wheel, low) with the least load of each wheel over a stretch, for those that can be
/// below `level` [N]. A minimum between the ends shows as a fall after the first and a rise before
/// the second.
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
    const double dt = kDifference * length;
    if (length > 0 && along(dt) < start[wheel] && along(length - dt) < end[wheel]) {
      const Low inside = lowest(along, length);
      if (inside.value < low.value) low = inside;
    }
    if (low.value < level) use(wheel, low);
  }
}

}  // namespace

Stretch Stretch::driven(const vehicle::Plant& plant, const vehicle::ControlSignal& signal,
                        const State& state, double t0, double t1) {
  Stretch stretch{t0, t1, state, {}, [&plant, &signal, state, t0](double t) {
                    return plant.advance(state, signal, t0, t);
                  }};
  stretch.state1 = stretch.at(t1);
  return stretch;
}

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
  for (const auto& obstacle : obstacles_) least = std::min(least, clearance_of(obstacle, t, state));
  return least;
}

void Watch::begin(double t, const State& state) {
  const Stretch instant{t, t, state, state, [&](double) { return state; }};
  note_clearance(instant);
  note_wheel_loads(instant);
  note_goal(instant);
  note_edge(state);
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
  return event;
}

std::optional<Event> Watch::first_crash(const Stretch& s) const {
  std::optional<Event> first;
  const double speed = speed_bound(dynamics_, s);
  for (const auto& obstacle : obstacles_) {
    const auto distance = [&](double t) {
      return clearance_of(obstacle, s.t0 + t, s.at(s.t0 + t));
    };
    const auto entry = first_entry(distance, s.t1 - s.t0, clearance_of(obstacle, s.t0, s.state0),
                                   clearance_of(obstacle, s.t1, s.state1),
                                   speed + std::hypot(obstacle.vx, obstacle.vy));
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
  const double length = s.t1 - s.t0, speed = speed_bound(dynamics_, s);
  for (const auto& obstacle : obstacles_) {
    const double d0 = clearance_of(obstacle, s.t0, s.state0);
    const double d1 = clearance_of(obstacle, s.t1, s.state1);
    Low low = d1 < d0 ? Low{length, d1} : Low{0, d0};
    const double rate = speed + std::hypot(obstacle.vx, obstacle.vy);
    if (length > 0 && (d0 + d1 - rate * length) / 2 < least_clearance_) {
      const Low inside = lowest(
          [&](double t) { return clearance_of(obstacle, s.t0 + t, s.at(s.t0 + t)); }, length);
      if (inside.value < low.value) low = inside;
    }
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
  const auto entry =
      first_entry([&](double t) { return outside(s.t0 + t, s.at(s.t0 + t)); }, s.t1 - s.t0,
                  outside(s.t0, s.state0), outside(s.t1, s.state1), speed_bound(dynamics_, s));
  if (entry) goal_time_ = s.t0 + *entry;
}

void Watch::note_edge(const State& state) {
  if (road_)
    least_edge_distance_ = std::min(least_edge_distance_, footprint_.edge_distance(*road_, state));
}

}  // namespace slalom::sim
