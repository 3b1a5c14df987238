#include "guess.hpp"

#include <algorithm>
#include <cmath>

#include "local_frame.hpp"
#include "road_reference.hpp"

namespace slalom::planner {

using namespace vehicle;

namespace {

/// A start slower than this speeds up in the guess [m/s], at this share of what the vehicle can.
constexpr double kSlow = 3, kShare = 0.7;
/// Along a road, shares of lateral acceleration and braking, and the least speed [m/s] of a guess.
constexpr double kLateralShare = 0.6, kBrakingShare = 0.6, kLeastSpeed = 2;

std::optional<SpeedProfile> profile_of(const Task& task) {
  if (!task.road) return std::nullopt;
  return drivable_speeds(*task.road, task.vehicle, kLateralShare, kBrakingShare);
}

}  // namespace

Guess::Guess(const Task& task)
    : settings_(task.planner),
      vehicle_(task.vehicle),
      goal_(task.goal),
      road_(task.road),
      offset_(road_ ? goal_offset(task) : std::nullopt),
      profile_(profile_of(task)) {}

ocp::Trajectory& Guess::operator()(const Request& request, const WayAhead& way,
                                   const LastPlan* last) {
  if (last != nullptr)
    shift(request, *last);
  else
    road_ ? along_road(request, way) : straight_on(request);
  guess_.slacks.clear();
  place_initial_slacks(request, last);
  if (way.in_range) place_final_slacks(way);
  return guess_;
}

/// How far a plan goes [m]: to the goal, or where that is out of range or passed, as far as it
/// sees.
double Guess::length_of(const WayAhead& way) const {
  return way.in_range ? std::max(std::min(settings_.L_range, way.aim - way.s), 1.)
                      : settings_.L_range;
}

/// The slowest that the road's bends allow before a plan ends [m/s].
double Guess::slowest_ahead(const WayAhead& way) const {
  const double length = length_of(way);
  double slowest = profile_->at(way.s + length);
  for (double s = 0; s < length; ++s) slowest = std::min(slowest, profile_->at(way.s + s));
  return std::max(slowest, kLeastSpeed);
}

/// Along the road at the offset that X0p has, evenly faster or slower until the end.
void Guess::along_road(const Request& request, const WayAhead& way) {
  State X0p = request.X0p;
  const double length = length_of(way);
  const double u = std::max(X0p[UX], 0.), slowest = slowest_ahead(way);
  const double able = u < kSlow ? kShare * vehicle_.ax_max_at(kSlow) : 0;
  const double end = std::min(std::sqrt(u * u + 2 * able * length), slowest);
  const double tf = std::clamp(2 * length / std::max(u + end, able > 0 ? 0.1 : 10.),
                               1.01 * settings_.tf_min, 0.99 * settings_.tf_max);
  const Motion motion = road_reference(*road_, {way.s, way.n}, X0p, 0, tf,
                                       (u * u - end * end) / (2 * length), vehicle_);
  guess_ = {0, tf, {}, {}, {}, {}, {}};
  for (std::size_t k = 0; k < motion.size(); ++k) {
    guess_.tau.push_back(static_cast<double>(k) / static_cast<double>(motion.size() - 1));
    guess_.states.emplace_back(motion.states[k].begin(), motion.states[k].end());
    guess_.controls.push_back({0, 0});
  }
  guess_.states.front().assign(X0p.begin(), X0p.end());
}

void Guess::straight_on(const Request& request) {
  const State& X0p = request.X0p;
  if (X0p[UX] < kSlow) return speeding_up(request);
  const double distance = std::hypot(X0p[X] - goal_.x, X0p[Y] - goal_.y);
  const double tf = std::clamp(std::min(settings_.L_range, distance) / std::max(X0p[UX], 5.0),
                               1.01 * settings_.tf_min, 0.99 * settings_.tf_max);
  std::vector<double> end(kStates, 0.0);
  end[X] = X0p[X] + tf * X0p[UX] * std::cos(X0p[PSI]);
  end[Y] = X0p[Y] + tf * X0p[UX] * std::sin(X0p[PSI]);
  end[PSI] = X0p[PSI];
  end[UX] = X0p[UX];
  guess_ = {0, tf, {0, 1}, {{X0p.begin(), X0p.end()}, end}, {{0, 0}, {0, 0}}, {}, {}};
}

/// From a crawl or from rest: straight on too, at an acceleration with which a plan gets anywhere.
/// At rest the slope of a slip angle is 1/EP, and a guess that stands still starts where tyre
/// forces are all or nothing.
void Guess::speeding_up(const Request& request) {
  const State& X0p = request.X0p;
  const double a = kShare * vehicle_.ax_max_at(kSlow);
  const double distance =
      std::min(settings_.L_range, std::hypot(X0p[X] - goal_.x, X0p[Y] - goal_.y));
  const double u = std::max(X0p[UX], 0.0);
  const double tf = std::clamp((std::sqrt(u * u + 2 * a * distance) - u) / a,
                               1.01 * settings_.tf_min, 0.99 * settings_.tf_max);
  const std::size_t samples = 1 + static_cast<std::size_t>(settings_.N) * 2;
  guess_ = {0, tf, {}, {}, {}, {}, {}};
  for (std::size_t k = 0; k < samples; ++k) {
    const double tau = static_cast<double>(k) / static_cast<double>(samples - 1), t = tau * tf;
    std::vector<double> x(X0p.begin(), X0p.end());
    const double s = u * t + a * t * t / 2;
    x[X] += s * std::cos(X0p[PSI]);
    x[Y] += s * std::sin(X0p[PSI]);
    x[V] = x[R] = x[SA] = 0;
    x[UX] = std::min(u + a * t, vehicle_.ux_max);
    x[AX] = a;
    guess_.tau.push_back(tau);
    guess_.states.push_back(std::move(x));
    guess_.controls.push_back({0, 0});
  }
}

/// The last plan from the new start on, its last point held, its end time kept.
void Guess::shift(const Request& request, const LastPlan& last) {
  const ocp::Trajectory& plan = last.trajectory;
  const double shift = request.t_start - last.t_start;
  guess_.tf =
      std::clamp(std::max(plan.tf - shift, 0.2), 1.01 * settings_.tf_min, 0.99 * settings_.tf_max);
  const std::size_t samples = 1 + static_cast<std::size_t>(settings_.N) * 2;
  guess_.tau.resize(samples);
  guess_.states.resize(samples);
  guess_.controls.resize(samples);
  std::size_t after = 1;  // the plan's first point beyond the sample, but for the last
  for (std::size_t k = 0; k < samples; ++k) {
    const double tau = static_cast<double>(k) / static_cast<double>(samples - 1);
    const double t = shift + tau * guess_.tf;
    while (after + 1 < plan.tau.size() && plan.time(after) <= t) ++after;
    const double t0 = plan.time(after - 1), t1 = plan.time(after);
    const double share = std::clamp((t - t0) / (t1 - t0), 0.0, 1.0);
    const auto mix = [share](const auto& a, const auto& b, std::vector<double>& row) {
      row.resize(a.size());
      for (std::size_t i = 0; i < a.size(); ++i) row[i] = a[i] + share * (b[i] - a[i]);
    };
    guess_.tau[k] = tau;
    mix(plan.states[after - 1], plan.states[after], guess_.states[k]);
    mix(plan.controls[after - 1], plan.controls[after], guess_.controls[k]);
  }
  // Headings are within a turn at the start of each plan, so that a plan may begin a turn off the
  // last one.
  const double turns = whole_turns(request.X0p[PSI] - guess_.states.front()[PSI]);
  if (turns != 0)
    for (auto& state : guess_.states) state[PSI] += turns;
}

/// X(0) and its slacks inside their rows. After a plan X(0) keeps its offset from X0p and the
/// slacks their values, so that these rows start where the barrier left them.
void Guess::place_initial_slacks(const Request& request, const LastPlan* last) {
  for (std::size_t i = 0; i < kStates; ++i) {
    const double offset = last != nullptr ? last->trajectory.states.front()[i] - last->X0p[i] : 0;
    guess_.states.front()[i] = request.X0p[i] + offset;
    guess_.slacks.push_back(last != nullptr
                                ? last->trajectory.slacks[i]
                                : inside(settings_.X0_tol[i], settings_.w_ic * settings_.w_s0[i]));
  }
}

void Guess::place_final_slacks(const WayAhead& way) {
  const auto& end = guess_.states.back();
  std::vector<double> gaps{end[X] - goal_.x, end[Y] - goal_.y};
  if (road_) {
    std::vector<world::Point> places;
    for (const auto& state : guess_.states) places.push_back({state[X], state[Y]});
    const double s = follow(*road_, way.s, places).back();
    gaps = {s - way.aim};
    if (offset_) gaps.push_back(road_->project(places.back(), s).n - *offset_);
  }
  for (double gap : gaps) {
    gap = std::fabs(gap);
    guess_.slacks.push_back(gap < settings_.XF_tol
                                ? gap + inside(settings_.XF_tol - gap, settings_.w_xf)
                                : settings_.XF_tol * 0.99);
  }
}

/// Where the barrier alone would hold a slack of this weight: 2 mu / w off its two rows, and at
/// most half of its room.
double Guess::inside(double room, double weight) const {
  const double mu = settings_.floor > 0 ? settings_.floor : 0.1;
  return std::min(weight > 0 ? 2 * mu / weight : room, room / 2);
}

}  // namespace slalom::planner
