// The stops that a cycle considers when nothing leads to the goal, and what it drives where none is
// good.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "references.hpp"
#include "road_reference.hpp"
#include "slalom/vehicle/agility.hpp"
#include "verified_planner.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;

/// How stops brake [m/s^2], of the HMMWV.
constexpr std::array kStops = {3.4, 2.0, 1.0};
/// A late stop begins so long before it would have to by its braking alone [s], or half-way there.
constexpr double kEarlier = 1;
constexpr std::array kLate = {1., 0.5};
/// Where the vehicle moves over on the road while it brakes as hard as it can: shares of the room
/// to the right edge (-) and to the left one.
constexpr std::array kAside = {-1., 1., -0.5, 0.5};
/// Of stops that a search finds: what they keep off obstacles beyond what is needed [m] and the
/// share of its limits that the vehicle uses, one after the other; at last they keep what the rest
/// of a plan keeps, and this [m]. Places looked at on one path, and how many are driven.
struct StopKept {
  double clearance, limits;
};
constexpr std::array kStopKept = {StopKept{0.05, 0.75}, StopKept{0.05, 0.95}};
constexpr double kKeptSpare = 0.02;
constexpr int kStopPlaces = 4000, kStopWays = 4;
/// The speed at which a search for a place to stand ends [m/s], how long a way to there may take
/// [s], how often it is looked for anew, and what an obstacle grows by beside what it lacks [m].
constexpr double kStandSpeed = 1.5, kLongestToStand = 20;
constexpr int kStandTries = 4;
constexpr double kStandSpare = 0.05;
/// A wheel load of this share of what the rest of a plan keeps is a wheel that all but lifts.
constexpr double kHarmfulLoad = 0.5;

}  // namespace

/// How a way to a place to stand is driven: what it keeps off obstacles beyond what is needed and
/// off the region's sides [m], its lateral acceleration as a multiple of what other ways use, its
/// share of the vehicle's braking, and how far the place leads on (world::Standstill).
struct VerifiedPlanner::StandKept {
  double clearance, inset, lateral, braking, onwards;
};

/// Comes to a creep at no acceleration and no steering rate, and creeps on until then at the least.
Motion VerifiedPlanner::settled(Motion motion, double until) const {
  if (motion.size() < 3)  // it creeps already
    while (motion.size() > 1) motion.drop_last();
  motion = tracker_.released(std::move(motion));
  // A triangle of jerk that takes the acceleration away.
  const double ax = motion.states.back()[AX];
  const double length = std::max(0.1, std::fabs(ax) / 2);
  motion = tracker_.driven_to({0, -2 * ax / length}, std::move(motion), length / 2);
  motion = tracker_.driven_to({}, std::move(motion), length / 2);
  return tracker_.driven_on(std::move(motion), until);
}

/// Drives a stop's lead and brakes along its path. Whether that is good.
bool VerifiedPlanner::stop_along(Cycle& cycle, const Stop& stop, double deceleration,
                                 const Course& course) {
  const State& X0p = cycle.request.X0p;
  const double t0 = cycle.t_start();
  const bool at_once = stop.lead.size() < 2;
  const State& from = at_once ? X0p : stop.lead.states.back();
  const double t = at_once ? t0 : stop.lead.end();
  Motion reference = stop.lead;
  if (!at_once) reference.drop_last();
  reference.append(
      braking_reference(stop.path, from, t, deceleration, task_.vehicle, task_.road != nullptr));
  try {
    Motion motion =
        settled(tracker_.follow(reference, X0p, t0, reference.end()), t0 + cycle.beyond());
    return consider(cycle, judged(cycle, stop.name, std::move(motion)), course);
  } catch (const PlantError&) {
    return false;
  }
}

/// A stop along a motion that is refused, as late as what is wrong with it allows.
bool VerifiedPlanner::stop_late(Cycle& cycle, const Proposal& proposal) {
  const Motion& motion = proposal.motion;
  const double t0 = cycle.t_start(), wrong = proposal.verdict.certificate.refused_at;
  if (motion.size() < 4 || wrong > motion.end()) return false;
  const Course course = std::make_shared<const Motion>(motion);
  const double deceleration = kStops[0] * agility(task_.vehicle).braking;
  for (const double share : kLate) {
    // While it brakes it comes half as far as at its speed.
    const double braking = motion.state_at(wrong)[UX] / (2 * deceleration) + kEarlier;
    const double at = t0 + share * (wrong - t0 - braking);
    if (at <= t0 + cycle.tex()) continue;
    if (stop_along(cycle, {proposal.name + ", then a stop", part_before(motion, at), motion},
                   deceleration, course))
      return true;
  }
  return false;
}

/// Considers a motion to the goal, and where it is refused, a stop along it.
void VerifiedPlanner::follow(Cycle& cycle, const Proposal& proposal) {
  if (!consider(cycle, proposal) && !cycle.arrives() && task_.planner.fallback)
    stop_late(cycle, proposal);
}

/// The course from here, and a stop before what is wrong with it.
void VerifiedPlanner::follow_course(Cycle& cycle) {
  const double t0 = cycle.t_start();
  if (!last_.course || t0 < last_.course->begin() - kSameTime ||
      t0 >= last_.course->end() - kSameTime)
    return;
  const Course course = last_.course;
  const Motion reference = part_from(*course, std::max(t0, course->begin()), plant_);
  const Proposal whole = judged(
      cycle, "course", tracker_.follow(reference, cycle.request.X0p, t0, reference.end()), true);
  if (whole.verdict.unseen && whole.verdict.end == MotionEnd::arrives)
    cycle.course_arrival = whole.verdict.arrival;
  follow(cycle, whole);
}

/// Stops along the rest, late or at once; along the road, or straight on and after swerves where
/// there is none: the first that is good. Whether one is.
bool VerifiedPlanner::stop(Cycle& cycle) {
  const State& X0p = cycle.request.X0p;
  const double t0 = cycle.t_start();
  std::vector<Stop> stops;
  if (cycle.rest && cycle.rest->motion().size() > 3) {
    if (stop_late(cycle, cycle.rest->proposal)) return true;
    stops.push_back({"stop along the rest", {}, cycle.rest->motion()});
  }
  const double can = agility(task_.vehicle).braking;
  if (task_.road) {
    // As far as the gentlest stop goes, and on.
    const double enough = X0p[UX] / (can * kStops.back()) + 1;
    stops.push_back({"stop along the road",
                     {},
                     road_reference(*task_.road, X0p, t0, enough, 0, task_.vehicle)});
  }
  if (!task_.road) {  // on one, stops aside and those that a search finds do better
    stops.push_back({"stop straight on", {}, straight_reference(X0p, t0, 1)});
    stops.push_back(
        {"stop after a swerve to the left", {}, swerve_reference(X0p, t0, 1, task_.vehicle)});
    stops.push_back(
        {"stop after a swerve to the right", {}, swerve_reference(X0p, t0, -1, task_.vehicle)});
  }
  for (const Stop& stop : stops)
    for (const double deceleration : kStops)
      if (stop_along(cycle, stop, can * deceleration, {})) return true;
  return false;
}

/// Stops beside the way or later.
void VerifiedPlanner::stop_elsewhere(Cycle& cycle) {
  if (task_.road ? stop_aside(cycle) || stop_in_time(cycle) : stop_found(cycle)) return;
  escape(cycle);
}

/// Stops that a search finds where there is no road: with more room and more gently first, and at
/// places from which the way goes on, for the vehicle cannot turn where it stands. Whether one is
/// good.
bool VerifiedPlanner::stop_found(Cycle& cycle) {
  if (!stand_finder_) stand_finder_.emplace(task_, task_.vehicle, task_.planner.cover_excess);
  constexpr double onwards = 0.85, anywhere = world::Standstill{}.onwards;
  constexpr std::array kStandKept = {
      StandKept{0.4, 0.5, 0.9, 0.9, onwards}, StandKept{0.15, 0.3, 1, 0.95, onwards},
      StandKept{0.05, 0.1, 1.25, 0.97, onwards}, StandKept{0.15, 0.3, 1, 0.95, anywhere},
      StandKept{0.05, 0.1, 1.25, 0.97, anywhere}};
  for (const StandKept& kept : kStandKept) {
    if (cycle.over()) return false;
    if (stop_found_by(cycle, kept)) return true;
  }
  return false;
}

/// Searches for a place to stand and drives there. An obstacle to which that is too near grows by
/// what it lacks, and the search goes again. Whether one is good.
bool VerifiedPlanner::stop_found_by(Cycle& cycle, const StandKept& kept) {
  const auto [creep, spare, settling] = standing_of(task_.vehicle, false);
  const world::Standstill standstill{kStandSpeed / settling, creep, task_.planner.standing_horizon,
                                     kept.onwards};
  world::WaySearch search = world::way_search(task_.vehicle);
  search.v_min = kStandSpeed;
  search.clearance = kept.clearance;
  search.inset = kept.inset;
  search.lateral_acceleration *= kept.lateral;
  search.braking_share = kept.braking;
  search.t_max = kLongestToStand + standstill.horizon;
  // It may wait, and a move in which it brakes ends in another cell than one in which it does not.
  search.cell_time = search.dt;
  search.cell_speed = 0.9 * search.braking * search.dt;
  search.max_places = task_.planner.search_places;
  const double need = this->need(cycle).clearance;
  auto obstacles = cycle.obstacles;
  for (auto& o : obstacles) o = o.grown(need);
  for (int tries = 0; tries < kStandTries; ++tries) {
    const auto way = stand_finder_->to_stand(cycle.request.X0p, cycle.t_start(), obstacles, search,
                                             standstill, [&] { return cycle.over(); });
    if (!way) return false;
    Motion lead = reference_of(*way, task_.vehicle);
    Motion path = straight_reference(lead.states.back(), lead.end(), 1);
    const std::size_t refused = cycle.refused.size();
    if (stop_along(cycle, {"stop in time", std::move(lead), std::move(path)},
                   kStops[0] * agility(task_.vehicle).braking, {}))
      return true;
    if (cycle.refused.size() == refused) return false;  // it cannot be driven
    const std::vector<double>& nearest = cycle.refused.back().proposal.verdict.nearest;
    bool grown = false;
    for (std::size_t k = 0; k < obstacles.size(); ++k) {
      const double lacks = need - nearest[k];
      if (!(lacks > 0)) continue;
      obstacles[k] = obstacles[k].grown(lacks + kStandSpare);
      grown = true;
    }
    if (!grown) return false;
  }
  return false;
}

/// Moves over on the road and brakes hard: where something cuts in, there may be room beside it and
/// none before it.
bool VerifiedPlanner::stop_aside(Cycle& cycle) {
  const State& X0p = cycle.request.X0p;
  const double deceleration = kStops[0] * agility(task_.vehicle).braking;
  for (const double aside : kAside) {
    const Stop stop{aside < 0 ? "stop to the right" : "stop to the left",
                    {},
                    road_reference(*task_.road, X0p, cycle.t_start(), X0p[UX] / deceleration + 1, 0,
                                   task_.vehicle, aside)};
    if (stop_along(cycle, stop, deceleration, {})) return true;
  }
  return false;
}

/// Stops that a search finds along the road, some way on where nothing comes, and where there are
/// none, what goes well longest.
bool VerifiedPlanner::stop_in_time(Cycle& cycle) {
  const Need need = this->need(cycle);
  auto obstacles = cycle.obstacles;
  for (auto& o : obstacles) o = o.grown(need.clearance);
  world::RoadWaySearch search;
  search.edge = need.edge;
  search.beyond = cycle.beyond();
  search.creep = standing_of(task_.vehicle, true).creep;
  search.standing_horizon = task_.planner.standing_horizon;
  search.max_places = kStopPlaces;
  const double lesser = lesser_need(cycle).clearance - need.clearance + kKeptSpare;
  std::vector<StopKept> kept(kStopKept.begin(), kStopKept.end());
  if (lesser < kStopKept.back().clearance) kept.push_back({lesser, kStopKept.back().limits});
  for (const auto& [clearance, limits] : kept) {
    search.clearance = clearance;
    search.limits = limits;
    int left = kStopWays;
    for (const world::RoadWay& found : road_ways_->to_stand(
             cycle.request.X0p, cycle.t_start(), obstacles, search, [&] { return cycle.over(); })) {
      if (left-- == 0 || cycle.over()) break;
      if (stop_on(cycle, found)) return true;
    }
  }
  return false;
}

/// Tracks a way that comes to stand, or goes on as long as it can. Whether it is good.
bool VerifiedPlanner::stop_on(Cycle& cycle, const world::RoadWay& found) {
  const Motion reference = reference_of(found.way, task_.vehicle);
  try {
    Motion motion = tracker_.follow(reference, cycle.request.X0p, cycle.t_start(), reference.end());
    if (found.complete) motion = settled(std::move(motion), cycle.t_start() + cycle.beyond());
    const std::string name = found.complete ? "stop in time" : "as long as it goes well";
    return consider(cycle, judged(cycle, name, std::move(motion)));
  } catch (const PlantError&) {
    return false;
  }
}

/// What is nearer to an obstacle does harm [m]: a body that touches it, and a point that is nearer
/// than what stands for the body.
double VerifiedPlanner::harmful_clearance() const {
  return task_.vehicle.footprint == FootprintKind::point ? task_.planner.kept_clearance : 0;
}

/// When a motion that is refused does harm: it is too near to an obstacle or off the road, or a
/// wheel is near to lifting.
double VerifiedPlanner::harm_of(const Cycle& cycle, const Motion& motion) {
  const Need bare{harmful_clearance(), kHarmfulLoad * task_.planner.kept_wheel_load};
  const auto certificate =
      verifier_.judge(motion, cycle.obstacles, bare, cycle.looks()).certificate;
  return certificate.verified ? std::numeric_limits<double>::infinity() : certificate.refused_at;
}

/// What the rest of a plan keeps.
Need VerifiedPlanner::lesser_need(const Cycle& cycle) const {
  const Settings& s = task_.planner;
  return {s.kept_clearance, s.kept_wheel_load, need(cycle).seen};
}

/// Of those refused, the best of a body that keeps what the rest of a plan keeps, if there is one.
/// A point keeps what a plan keeps, or none of it is verified.
const VerifiedPlanner::Option* VerifiedPlanner::kept_at_least(Cycle& cycle) {
  if (task_.vehicle.footprint == FootprintKind::point) return nullptr;
  const Need lesser = lesser_need(cycle);
  Option* best = nullptr;
  for (Option& option : cycle.refused) {
    Verdict verdict = verifier_.judge(option.motion(), cycle.obstacles, lesser, cycle.looks());
    if (!verdict.certificate.verified) continue;
    option.cost = cost_of(option.motion(), verdict);
    option.proposal.verdict = std::move(verdict);
    if (best == nullptr || option.cost < best->cost) best = &option;
  }
  return best;
}

/// Of those refused, the one that does harm last, and of those the one that goes on longest.
const VerifiedPlanner::Option* VerifiedPlanner::least_bad(const Cycle& cycle) {
  const Option* least = nullptr;
  std::pair<double, double> latest;
  for (const Option& option : cycle.refused) {
    const double harm = option.harm ? *option.harm : harm_of(cycle, option.motion());
    const std::pair when(harm, option.certificate().refused_at);
    if (least != nullptr && !(when > latest)) continue;
    least = &option;
    latest = when;
  }
  return least;
}

}  // namespace slalom::planner
