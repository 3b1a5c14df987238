#include "path_speeds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "slalom/vehicle/agility.hpp"

namespace slalom::world {
namespace {

using vehicle::Parameters;
using vehicle::State;

/// Shares of the greatest push and of the hardest braking that moves take.
constexpr std::array kShares = {1., 0.5, 0.2, 0., -0.25, -0.5, -1.};
/// Of what the vehicle can so much is used: of pushing, of braking, and of the jerk; feedback needs
/// the rest.
constexpr double kPush = 0.9, kBrake = 0.93, kJerk = 0.8;
/// Above this share of the lateral acceleration at which it slides or lifts a wheel ways are
/// dearer.
constexpr double kSoft = 0.55;
/// So much faster than it creeps the vehicle stands [m/s].
constexpr double kStands = 0.08;
/// After it arrives it brakes by this share of what it can.
constexpr double kBeyond = 0.7;
/// For each second at twice the speed that is driveable a way costs so much [s].
constexpr double kTooFast = 10;
/// What ways cost beside time: for (1 m/s^2)^2 over a second, for each m/s^2 by which acceleration
/// changes, and for a second at twice the soft lateral acceleration [s].
constexpr double kEffort = 0.002, kChange = 0.004, kLateral = 1;
/// A stop's effort costs more: gentle ones come first.
constexpr double kStopEffort = 0.05;
/// With longer moves in longer ways the search keeps its size [s].
constexpr double kLong = 6, kLonger = 12;
/// Of cells along the path [m] and in speed [m/s], for moves of .2 s.
constexpr double kCellAlong = 0.5, kCellSpeed = 0.5;
/// What an obstacle or an edge may come nearer by than at the start, where it is too near [m].
constexpr double kNearer = 0.03;
/// What a tracked way is off: along the goal and across it [m], and in time [s], at the most that
/// share of it.
constexpr double kAlong = 0.5, kAcross = 0.15, kTime = 0.15, kOff = 0.25;
/// Limits of speed are exceeded by this between places; and the way ahead counts so much more than
/// the way so far.
constexpr double kLimitSlack = 1.03, kGreed = 1.3;
/// The fastest motion is known for so long [s].
constexpr double kFastest = 60;
/// Longer than twice as long as at its speed, or than it has to wait, a way is not looked for [s].
constexpr double kDetour = 10;
/// As far as possible: so many metres are worth a second.
constexpr double kProgressSpeed = 10;
/// Of an angle and of a range of speeds this share is used.
constexpr double kWithin = 0.75;

/// A goal less what a tracked way may be off. A range of time is left one look wide at the least.
Goal less(Goal goal, double look) {
  if (goal.kind() == GoalKind::rectangle) {
    goal.length -= 2 * std::min(kAlong, kOff * goal.length);
    goal.width -= 2 * std::min(kAcross, kOff * goal.width);
  }
  if (goal.kind() == GoalKind::square) goal.sigma -= std::min(kAlong, kOff * goal.sigma);
  if (goal.kind() == GoalKind::line) goal.s += kAlong;
  goal.psi_tolerance *= kWithin;
  const double speeds = goal.ux_max - goal.ux_min;
  const double slower = std::isinf(speeds) ? 0.1 : (1 - kWithin) / 2 * speeds;
  goal.ux_min += slower;
  goal.ux_max -= slower;
  const double times = goal.t_max - goal.t_min;
  const double later = std::clamp((times - look) / 2, 0., kTime);
  goal.t_min += later - 1e-9;
  goal.t_max -= later - 1e-9;
  return goal;
}

}  // namespace

PathSpeeds::PathSpeeds(const Environment& environment, const Parameters& vehicle)
    : environment_(environment),
      vehicle_(vehicle),
      footprint_(vehicle),
      within_(less(environment.goal, kLook)),
      most_lateral_(vehicle::most_lateral(vehicle)) {
  find_fastest();
}

/// From rest on straight, as fast as moves push.
void PathSpeeds::find_fastest() {
  double v = 0, s = 0;
  for (double t = 0; t < kFastest; t += kLook) {
    fastest_v_.push_back(v);
    fastest_s_.push_back(s);
    const double a = std::max(0., kPush * vehicle_.ax_max_at(v));
    const double faster = std::min(v + a * kLook, vehicle_.ux_max - 1);
    s += kLook * (v + faster) / 2;
    v = faster;
  }
}

/// In which a way is driven at the least, from a speed [s].
double PathSpeeds::fastest_time(double v, double way) const {
  if (way <= 0) return 0;
  const auto from = std::lower_bound(fastest_v_.begin(), fastest_v_.end(), v);
  if (from == fastest_v_.end()) return way / std::max(v, 1e-3);
  const auto first = from - fastest_v_.begin();
  const double there = fastest_s_[static_cast<std::size_t>(first)] + way;
  const auto to = std::lower_bound(fastest_s_.begin() + first, fastest_s_.end(), there);
  if (to == fastest_s_.end()) return kFastest + (there - fastest_s_.back()) / fastest_v_.back();
  const auto last = to - fastest_s_.begin();
  const double over = *to - there, per = std::max(fastest_v_[static_cast<std::size_t>(last)], 0.1);
  return kLook * static_cast<double>(last - first) - over / per;
}

/// How far one comes in a time at the most [m].
double PathSpeeds::farthest(double v, double time) const {
  const auto from = std::lower_bound(fastest_v_.begin(), fastest_v_.end(), v);
  if (from == fastest_v_.end()) return v * time;
  const auto first = static_cast<double>(from - fastest_v_.begin());
  const double end = std::min(first + time / kLook, static_cast<double>(fastest_s_.size() - 1));
  const auto last = static_cast<std::size_t>(end);
  return fastest_s_[last] +
         fastest_v_[last] * (time - kLook * (static_cast<double>(last) - first)) -
         fastest_s_[static_cast<std::size_t>(first)];
}

/// For how long a way may take at the most [s].
double PathSpeeds::longest(const Question& question) const {
  const double v = question.start[vehicle::UX];
  if (question.aim == Aim::stand)
    return std::min(question.search.t_max, 2 * v / -vehicle_.ax_min_at(v) + 4);
  const Goal& goal = environment_.goal;
  if (goal.kind() == GoalKind::time) return goal.time - question.t_start + kLook;
  const double earliest = goal.t_min - question.t_start, latest = goal.t_max - question.t_start;
  const double enough = std::max(2 * question.to_go / std::max(v, 3.), earliest) + kDetour;
  return std::min({question.search.t_max, latest, enough});
}

void PathSpeeds::begin(const RoadPath& path, const Question& question) {
  path_ = &path;
  question_ = &question;
  const double time = std::max(longest(question), 0.);
  looks_per_move_ = time < kLong ? 2 : time < kLonger ? 3 : 4;
  most_looks_ = static_cast<std::int32_t>(std::ceil(time / kLook));
  free_.assign(
      path.size() * static_cast<std::size_t>(most_looks_ + looks_beyond() + looks_per_move_ + 1),
      Known::nothing);
  first_edge_ = footprint_.edge_distance(*environment_.road, question.start) - kNearer;
  keeps_.clear();
  for (const auto& o : question.obstacles) {
    const double t = question.t_start;
    double keep = question.search.clearance;
    if (o.present(t, t))
      keep = std::min(keep, footprint_.distance(o, question.start, t) - o.margin(t) - kNearer);
    keeps_.push_back(keep);
  }
  find_limits();
  places_.clear();
  open_.clear();
  cells_.clear();
  latest_ = -1;
}

/// Speeds by which a place is driven, and from which the vehicle comes to those of the next ones;
/// up to where the path is off the road or leads into what stands.
void PathSpeeds::find_limits() {
  const RoadPath& path = *path_;
  std::size_t end = 1;
  while (end < path.size() && on_road(end) && stays_clear(end)) ++end;
  usable_ = RoadPath::kStep * static_cast<double>(end - 1);
  limit_.assign(path.size(), 0);
  left_.assign(path.size(), 0);
  // It may go on beyond the end of what is known, but not of the road.
  const double share = question_->search.limits;
  double next = end == path.size() ? vehicle_.ux_max : question_->search.creep;
  for (std::size_t k = end; k-- > 0;) {
    const double bend = std::max(std::fabs(path[k].kappa), 1e-6);
    const double steering = std::max(std::fabs(path[k].steering), 1e-6);
    const double here = std::min({vehicle_.ux_max, std::sqrt(share * most_lateral_ / bend),
                                  share * vehicle_.sr_max() / steering});
    const double brake = -kBrake * vehicle_.ax_min_at(next);
    limit_[k] = next = std::min(std::max(here, question_->search.creep),
                                std::sqrt(next * next + 2 * brake * RoadPath::kStep));
    const double s = RoadPath::kStep * static_cast<double>(k);
    if (k + 1 < end)
      left_[k] =
          left_[k + 1] +
          (s < question_->to_go ? RoadPath::kStep / std::max(next, question_->search.creep) : 0);
  }
}

std::optional<RoadWay> PathSpeeds::run(const RoadPath& path, const Question& question) {
  begin(path, question);
  const bool to_place = question.aim == Aim::arrive && environment_.goal.kind() != GoalKind::time;
  if (to_place && usable_ < question.to_go) return std::nullopt;
  const State& x = question.start;
  add({.v = std::max(x[vehicle::UX], 0.), .a = x[vehicle::AX]});
  for (int looked = 0; !open_.empty() && looked < question.search.max_places; ++looked) {
    if (looked % RoadWays::kAskedEvery == 0 && question.out_of_budget && question.out_of_budget())
      break;
    std::pop_heap(open_.begin(), open_.end());
    const auto at = open_.back().place;
    open_.pop_back();
    const Place& place = places_[static_cast<std::size_t>(at)];
    const Place& latest = places_[static_cast<std::size_t>(std::max(latest_, 0))];
    if (latest_ < 0 || place.looks > latest.looks ||
        (place.looks == latest.looks && place.cost < latest.cost))
      latest_ = at;
    const bool there =
        question.aim == Aim::stand
            ? place.v <= question.search.creep + kStands && stands_for_good(place)
            : place.looks > 0 && place.parent >= 0 &&
                  within_.outside(state_of(path.at(place.s), place.v), time_at(place.looks),
                                  environment_.road.get()) <= 0;
    if (there) return way_of(at, true);
    if (place.looks < most_looks_) go_on(at);  // the last move may end later
  }
  if (question.aim == Aim::arrive || latest_ <= 0) return std::nullopt;
  return way_of(latest_, false);
}

/// The time that it takes to the goal at the least, about [s].
double PathSpeeds::left_to_goal(const Place& place) const {
  const double reach = fastest_time(place.v, question_->to_go - place.s);
  const double slower = (place.v - environment_.goal.ux_max) / -vehicle_.ax_min_at(place.v);
  return std::max({reach, slower, left_[path_->index(place.s)]});
}

double PathSpeeds::rank_of(const Place& place) const {
  const double t = time_at(place.looks);
  const Goal& goal = environment_.goal;
  if (question_->aim == Aim::stand)
    return place.cost + kLook * place.looks + place.v / -vehicle_.ax_min_at(place.v);
  if (goal.kind() == GoalKind::time) {
    // No farther than the path can be driven.
    const double left = std::max(0., goal.time - t);
    const double reach = std::min(place.s + farthest(place.v, left), usable_);
    return place.cost - reach / kProgressSpeed;
  }
  const double arrival = t + left_to_goal(place);
  if (arrival >= goal.t_min) return place.cost + t + kGreed * (arrival - t);
  // How long before or after its time it is there at the speed that it has; what comes too early
  // has to wait, and what would be through by then to slow down.
  const double v = std::max(place.v, 0.3);
  const double comes = std::max(arrival, t + std::max(0., question_->to_go - place.s) / v);
  const double goes = t + (question_->to_leave - place.s) / v;
  const double off = std::max({0., comes - goal.t_min, goal.t_min - goes});
  return place.cost + goal.t_min + 0.2 * off;
}

void PathSpeeds::add(const Place& place) {
  const double longer = looks_per_move_ / 2.;
  const auto cell = [](double value, double size) {
    return static_cast<std::uint64_t>(std::lround(value / size)) & 0xFFFFU;
  };
  const std::uint64_t key = std::uint64_t{1} << 63 | cell(place.s, longer * kCellAlong) << 32 |
                            cell(place.v, longer * kCellSpeed) << 16 |
                            static_cast<std::uint64_t>(place.looks);
  if (!cells_.insert(key)) return;
  places_.push_back(place);
  open_.push_back({rank_of(place), static_cast<std::int32_t>(places_.size() - 1)});
  std::push_heap(open_.begin(), open_.end());
}

void PathSpeeds::go_on(std::int32_t index) {
  const Place from = places_[static_cast<std::size_t>(index)];
  const double push = kPush * vehicle_.ax_max_at(from.v), brake = hardest(from.v);
  const double change = kJerk * vehicle_.jx_max * kLook * looks_per_move_;
  double before = std::numeric_limits<double>::infinity();
  for (const double share : kShares) {
    const double wanted = share > 0 ? share * push : -share * brake;
    const double a = std::max(std::clamp(wanted, from.a - change, from.a + change), settle(from.v));
    if (a == before) continue;
    before = a;
    Place to = from;
    to.parent = index;
    bool arrived = false;
    if (move(to, a, arrived)) add(to);
  }
}

/// The hardest braking at a speed [m/s^2]; and what jerk leaves of it near to standing.
double PathSpeeds::hardest(double v) const {
  return kBrake * vehicle_.ax_min_at(v);
}
double PathSpeeds::settle(double v) const {
  const double rate = kJerk * vehicle_.jx_max / -vehicle_.ax_min_at(0);
  return std::min(0., -rate * (v - question_->search.creep));
}

/// Drives a place on at an acceleration, to the end of a move or into the goal. Whether it may.
bool PathSpeeds::move(Place& place, double a, bool& arrived) {
  const bool stops = question_->aim == Aim::stand;
  const double from = place.v, before = place.a;
  for (int look = 0; look < looks_per_move_ && !arrived; ++look) {
    advance(place, a, from);
    const double v = place.v;
    const std::size_t at = path_->index(place.s);
    if (place.s > usable_ || !drives(at, v, a, place.looks, place.cost) ||
        !is_free(place.s, place.looks))
      return false;
    arrived = !stops && within_.outside(state_of(path_->at(place.s), v), time_at(place.looks),
                                        environment_.road.get()) <= 0;
  }
  place.cost += kChange * std::fabs(a - before) +
                (stops ? kStopEffort : kEffort) * a * a * kLook * looks_per_move_;
  place.towards = a;
  if (place.v <= question_->search.creep) place.a = 0;
  return !arrived || goes_on(place);
}

/// Drives a place on for one look of a move that began at a speed: at an acceleration as soon as
/// jerk allows, no slower than it creeps and no faster than it may, unless it began so.
void PathSpeeds::advance(Place& place, double a, double from) const {
  const double least = std::min(question_->search.creep, from);
  const double most = std::max(vehicle_.ux_max - 1, from);
  const double change = kJerk * vehicle_.jx_max * kLook;
  const double next = std::clamp(a, place.a - change, place.a + change);
  const double v = std::clamp(place.v + (place.a + next) / 2 * kLook, least, most);
  place.s += kLook * (place.v + v) / 2;
  place.v = v;
  place.a = next;
  ++place.looks;
}

/// Whether the vehicle can drive a place of the path at a speed and acceleration, and what that
/// costs.
bool PathSpeeds::drives(std::size_t at, double v, double a, std::int32_t look, double& cost) const {
  const PathPlace& place = (*path_)[at];
  const double lateral = v * v * std::fabs(place.kappa) / most_lateral_;
  if (lateral > kSoft) cost += kLateral * kLook * (lateral / kSoft - 1);
  if (look * kLook <= kToComeBack) {
    cost += kTooFast * kLook * std::max(0., v / limit_[at] - 1);
    return true;
  }
  if (v > std::max(kLimitSlack * limit_[at], question_->search.creep + kStands)) return false;
  if (std::fabs(place.heading - place.psi) > vehicle_.sa_max()) return false;
  // The tyres' forces along and across share a circle.
  const double along = std::min(0., a) / vehicle_.ax_min_at(v);
  return std::hypot(question_->search.limits * along, lateral) <= question_->search.limits;
}

/// Brakes on for one look.
void PathSpeeds::brake(Place& place) const {
  place.towards = std::max(kBeyond * hardest(place.v), settle(place.v));
  advance(place, place.towards, place.v);
}

std::int32_t PathSpeeds::looks_beyond() const {
  return static_cast<std::int32_t>(std::ceil(question_->search.beyond / kLook));
}

/// Whether the vehicle may brake on from where it arrives.
bool PathSpeeds::goes_on(Place place) {
  for (std::int32_t look = looks_beyond(); look > 0; --look) {
    brake(place);
    if (place.s > usable_ || !is_free(place.s, place.looks)) return false;
  }
  return true;
}

RoadWay PathSpeeds::way_of(std::int32_t last, bool complete) const {
  std::vector<Place> chain;
  for (auto k = last; k >= 0; k = places_[static_cast<std::size_t>(k)].parent)
    chain.push_back(places_[static_cast<std::size_t>(k)]);
  std::reverse(chain.begin(), chain.end());
  RoadWay found;
  found.complete = complete;
  found.cost = rank_of(chain.back());
  found.end = time_at(chain.back().looks);
  for (std::int32_t look = looks_beyond(); look > 0; --look) {
    chain.push_back(chain.back());
    brake(chain.back());
  }
  const auto put = [&](double t, double s, double v, double a) {
    const PathPlace at = path_->at(s);
    found.way.push_back({t, at.x, at.y, at.heading, v, at.kappa, a});
  };
  put(question_->t_start, 0, chain[0].v, chain[0].a);
  for (std::size_t k = 1; k < chain.size(); ++k) {
    const Place &from = chain[k - 1], &to = chain[k];
    for (Place here = from; here.looks < to.looks;) {
      const Place before = here;
      advance(here, to.towards, from.v);
      const double a = (here.v - before.v) / kLook, half = kLook / 2;
      put(time_at(before.looks) + half, before.s + half * (before.v + a * half / 2),
          before.v + a * half, a);
      put(time_at(here.looks), here.s, here.v, here.a);
    }
  }
  return found;
}

}  // namespace slalom::world
