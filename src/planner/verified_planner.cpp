#include "verified_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "obstacle_view.hpp"
#include "references.hpp"
#include "road_way.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;

/// The state predicted is that of the last plan up to this [its unit].
constexpr double kSameState = 1e-7;
/// Errors of belief are remembered for so long [s].
constexpr double kRemembered = 5;
/// Where nothing is good, the search for ways to the goal has this share of the time that is left
/// before stops elsewhere are tried, for those take longer than a short cycle.
constexpr double kBeforeMoreStops = 0.6;
/// Of a motion's states every so many are looked for along the road.
constexpr std::size_t kFollowed = 20;
/// Standing costs so much more than arriving, and each metre to the goal this; not the time at
/// which the vehicle stands, for the later it brakes the better.
constexpr double kStandingCost = 1e6, kMetreCost = 10;

double gap(const State& a, const State& b) {
  double most = 0;
  for (std::size_t i = 0; i < kStates; ++i) most = std::max(most, std::fabs(a[i] - b[i]));
  return most;
}

}  // namespace

VerifiedPlanner::VerifiedPlanner(const Task& task)
    : task_(task),
      plant_(Verifier::believed_plant(task_.vehicle)),
      tracker_(task_.vehicle, plant_, task_.road != nullptr),
      verifier_(task_, plant_),
      proposals_(task_, tracker_, verifier_) {
  check(task_.planner, "planner " + task_.planner.name);
  if (task_.road) road_ways_.emplace(task_, task_.vehicle);
}

void VerifiedPlanner::reset() {
  last_ = before_ = {};
  errors_.clear();
  proposals_.forget();
  (void)proposals_.take_iterations();  // of what was given up
  last_improved_ = wait_ = expected_work_ = along_ = 0;
}

void VerifiedPlanner::record(const Recorder& recorder) {
  recorder_.reset();
  if (recorder.wanted && recorder.take_plan) recorder_ = recorder;
}

/// Hands the plan to the recorder if it is wanted. The rest of a plan that goes on as it was is
/// that plan's, which had its turn.
void VerifiedPlanner::record_plan(const Cycle& cycle, const Plan& plan,
                                  const Option& option) const {
  if (!recorder_ || !recorder_->wanted(plan.report)) return;
  if (plan.rung == Rung::rest && cycle.rest_unchanged) return;
  const Need& need = option.proposal.verdict.need;
  const Motion& motion = option.motion();
  recorder_->take_plan({plan.rung, cycle.request.t0, cycle.tex(), need.clearance, need.wheel_load,
                        need.seen.x, need.seen.y, need.seen.radius, cycle.obstacles, motion.t,
                        motion.states, motion.controls, option.certificate(), need.edge});
}

/// A state that the vehicle may be in: noise may say that a vehicle at rest goes backwards.
Request VerifiedPlanner::possible(Request request) const {
  request.X0p[UX] = std::max(request.X0p[UX], task_.vehicle.ux_min);
  return request;
}

Plan VerifiedPlanner::plan(const Request& as_told) {
  const Request request = possible(as_told);
  if (request.last_was_late) last_ = before_;
  if (counts_laps())
    along_ = task_.road->unwrapped(task_.road->project({request.X0p[X], request.X0p[Y]}).s, along_);
  Cycle cycle{.request = request,
              .obstacles = known_obstacles(task_, request),
              .verification = task_.planner.verification};
  if (task_.planner.fallback) {
    continue_last(cycle);
    follow_course(cycle);
    if (cycle.good.empty() && !(cycle.rest && cycle.trusts(*cycle.rest)) && !stop(cycle)) {
      look_further(cycle, kBeforeMoreStops);
      if (cycle.good.empty()) stop_elsewhere(cycle);
    }
  }
  look_further(cycle, 1);
  return choose(cycle);
}

/// The disc that is seen when the vehicle plans.
Seen VerifiedPlanner::seen(const Request& request) const {
  const world::Point place = planning_place(request);
  return {place.x, place.y, task_.planner.L_range};
}

/// What a new plan keeps: what it loses by errors as they were lately leaves enough for its rest.
Need VerifiedPlanner::need(const Cycle& cycle) const {
  const Settings& s = task_.planner;
  double error = 0;
  for (const auto& [when, size] : errors_) error = std::max(error, size);
  Need need{std::max(s.verified_clearance, s.kept_clearance + error), s.verified_wheel_load};
  if (s.known == Known::range && s.unseen == Unseen::standing) need.seen = seen(cycle.request);
  need.edge = s.edge_clearance;
  return need;
}

/// By a goal's time what has crossed the seam is farther and not a lap back.
bool VerifiedPlanner::counts_laps() const {
  return task_.goal.kind() == world::GoalKind::time && task_.road->closed();
}

/// What a motion leaves of the way to the goal at t [m]; where laps count, with those since the
/// drive began.
double VerifiedPlanner::left_after(const Motion& motion, double t) const {
  const world::Road* road = task_.road.get();
  const State end = t < motion.end() ? motion.state_at(t) : motion.states.back();
  if (!counts_laps()) return way_left(task_, end);
  std::vector<world::Point> places;
  for (std::size_t k = 0; k < motion.size() && motion.t[k] < t; k += kFollowed)
    places.push_back({motion.states[k][X], motion.states[k][Y]});
  places.push_back({end[X], end[Y]});
  const double begin = road->unwrapped(road->project(places[0]).s, along_);
  return road->length() - planner::follow(*road, begin, places).back();
}

double VerifiedPlanner::cost_of(const Motion& motion, const Verdict& verdict) const {
  const Settings& s = task_.planner;
  const bool arrives = verdict.end == MotionEnd::arrives;
  if (!arrives) return kStandingCost + kMetreCost * left_after(motion, motion.end());
  double end = verdict.arrival;
  // As far as possible: what is left counts as time.
  if (task_.goal.kind() == world::GoalKind::time) end += left_after(motion, end) / kProgressSpeed;
  double cost = s.w_t * end;
  for (std::size_t k = 0; k + 1 < motion.size() && motion.t[k] < verdict.arrival; ++k)
    cost +=
        s.w_ce * (motion.t[k + 1] - motion.t[k]) *
        (s.w_sa * std::pow(motion.states[k][SA], 2) + s.w_sr * std::pow(motion.controls[k][SR], 2) +
         s.w_jx * std::pow(motion.controls[k][JX], 2));
  return cost;
}

/// Keeps a motion that was judged among the cycle's options. Whether it is good.
bool VerifiedPlanner::consider(Cycle& cycle, Proposal proposal, const Course& course) {
  Option option{std::move(proposal), 0, course};
  const Certificate& certificate = option.certificate();
  const bool good = cycle.trusts(option) && option.motion().size() > 1;
  if (good) option.cost = cost_of(option.motion(), option.proposal.verdict);
  cycle.looked_at.push_back(
      {option.proposal.name, option.cost, certificate, path_of(option.motion())});
  if (good)
    cycle.good.push_back(std::move(option));
  else if (option.motion().size() > 1)
    cycle.refused.push_back(std::move(option));
  return good;
}

Proposal VerifiedPlanner::judged(const Cycle& cycle, const std::string& name, Motion motion,
                                 bool solved) {
  Proposal proposal{name, std::move(motion), {}, solved};
  proposal.verdict = verifier_.judge(proposal.motion, cycle.obstacles, need(cycle), cycle.looks());
  return proposal;
}

/// Whether the last verdict is one of this cycle's: among the same obstacles, of an arrival that is
/// still to come and at which the loop will look, which it does at other moments when a plan was
/// late.
bool VerifiedPlanner::still_holds(const Cycle& cycle) const {
  const Verdict& verdict = last_.option->proposal.verdict;
  const Looks now = cycle.looks(), then = last_.looks;
  return same(cycle.obstacles, last_.obstacles) && now.every == then.every &&
         std::fabs(std::remainder(now.from - then.from, now.every)) < kSameTime &&
         (verdict.end != MotionEnd::arrives || verdict.arrival > cycle.t_start());
}

/// The rest of the last plan from the state predicted. Where state and obstacles are those that it
/// was verified for, so it still is; else the plant drives it anew.
void VerifiedPlanner::continue_last(Cycle& cycle) {
  if (!last_.option) return;
  Motion motion;
  try {
    motion = rest_of_last(cycle);
  } catch (const PlantError&) {  // it cannot be driven from here
    cycle.rest_unchanged = false;
  }
  cycle.rest_unchanged = cycle.rest_unchanged && still_holds(cycle);
  cycle.rest = Option{{to_string(Rung::rest), std::move(motion), last_.option->proposal.verdict,
                       last_.option->proposal.solved && cycle.rest_unchanged},
                      last_.option->cost,
                      last_.course};
  Proposal& rest = cycle.rest->proposal;
  if (!cycle.rest_unchanged) {
    rest.verdict = verifier_.judge(rest.motion, cycle.obstacles, lesser_need(cycle), cycle.looks());
    if (rest.motion.size() > 1) cycle.rest->cost = cost_of(rest.motion, rest.verdict);
  }
  cycle.looked_at.push_back(
      {to_string(Rung::rest), cycle.rest->cost, rest.verdict.certificate, {}});
  if (!cycle.trusts(*cycle.rest) && rest.motion.size() > 1) cycle.refused.push_back(*cycle.rest);
}

/// The last plan from where it is to go on; it is tracked where the state is another, and lasts at
/// least until the next cycle's plan. What stands at its end is brought to stand there anew.
Motion VerifiedPlanner::rest_of_last(Cycle& cycle) {
  const double t0 = cycle.t_start();
  const State& X0p = cycle.request.X0p;
  const Motion& old = last_.option->motion();
  Motion rest;
  cycle.rest_unchanged = false;
  if (t0 > old.end() - Tracker::kStep) {
    rest.add(t0, X0p, {});
  } else {
    rest = part_from(old, std::max(t0, old.begin()), plant_);
    cycle.rest_unchanged = t0 >= old.begin() - kSameTime && gap(rest.states[0], X0p) < kSameState;
    note_error(cycle, apart(rest.states[0], X0p));
    if (cycle.rest_unchanged) {
      rest.states[0] = X0p;
    } else {  // The plan as it was made, for what tracks a tracked motion strays.
      rest = part_from(*last_.made, std::max(t0, last_.made->begin()), plant_);
      rest = tracker_.follow(rest, X0p, t0, rest.end());
    }
  }
  const bool lasts = rest.end() >= t0 + cycle.tex();
  if (lasts && cycle.rest_unchanged) return rest;
  cycle.rest_unchanged = false;
  const double until = lasts ? rest.end() : t0 + cycle.beyond();
  if (last_.option->proposal.verdict.end == MotionEnd::stands)
    return settled(std::move(rest), until);
  return lasts ? rest : tracker_.driven_on(tracker_.released(std::move(rest)), until);
}

/// Notes how far the vehicle and the obstacles are from where they were believed to be.
void VerifiedPlanner::note_error(const Cycle& cycle, double state_error) {
  const double t0 = cycle.t_start();
  double moved = 0;
  std::size_t next = 0;  // most lists are in the same order
  for (const auto& now : cycle.obstacles)
    for (std::size_t tried = 0, of = last_.obstacles.size(); tried < of; ++tried) {
      const auto& then = last_.obstacles[(next + tried) % of];
      if (then.name != now.name) continue;
      moved =
          std::max(moved, std::hypot(now.x_at(t0) - then.x_at(t0), now.y_at(t0) - then.y_at(t0)));
      next = (next + tried + 1) % of;
      break;
    }
  while (!errors_.empty() && errors_.front().first < t0 - kRemembered) errors_.pop_front();
  if (state_error + moved > kSameState) errors_.emplace_back(t0, state_error + moved);
}

/// What is driven, by the ladder.
const VerifiedPlanner::Option* VerifiedPlanner::chosen(Cycle& cycle, Rung& rung) {
  const Option* best = nullptr;
  for (const auto& option : cycle.good)
    if (!best || option.cost < best->cost) best = &option;
  const Option* rest = cycle.rest && cycle.trusts(*cycle.rest) ? &*cycle.rest : nullptr;
  const double hysteresis = task_.planner.w_t * task_.planner.hysteresis;
  if (best && (!rest || best->cost < rest->cost - hysteresis)) {
    wait_ = task_.planner.improvement_period;
    rung = Rung::new_plan;
    return best;
  }
  rung = rest ? Rung::rest : Rung::least_bad;
  if (rest) return rest;
  if (!task_.planner.fallback) return nullptr;
  if (const Option* kept = kept_at_least(cycle)) {
    rung = Rung::new_plan;
    return kept;
  }
  return least_bad(cycle);
}

Plan VerifiedPlanner::choose(Cycle& cycle) {
  Plan plan;
  plan.t_start = cycle.t_start();
  plan.report.backend = "verified";
  const Option* option = chosen(cycle, plan.rung);
  if (cycle.rest && plan.rung != Rung::rest)  // the first that was looked at
    cycle.looked_at.front().path = path_of(cycle.rest->motion());
  plan.candidates = std::move(cycle.looked_at);
  if (!option) {
    plan.rung = Rung::none;
    plan.report.status = PlanStatus::infeasible;
    return plan;
  }
  const Motion& motion = option->motion();
  for (std::size_t k = 0; k < motion.size(); ++k) plan.t.push_back(motion.t[k] - plan.t_start);
  plan.states = motion.states;
  plan.controls = motion.controls;
  plan.tf = plan.t.back();
  plan.goal_in_range = option->proposal.verdict.end == MotionEnd::arrives;
  plan.certificate = option->certificate();
  plan.report.solved = plan.certificate.verified;
  plan.report.best_iterate = !plan.report.solved;
  plan.report.status = plan.report.solved ? PlanStatus::solved : PlanStatus::unverified;
  plan.report.detail = plan.certificate.refused;
  plan.report.iterations = cycle.iterations;
  plan.report.cost = option->cost;
  const bool goes_on = plan.rung == Rung::rest;
  Last next{*option, goes_on ? last_.made : std::make_shared<const Motion>(motion),
            goes_on ? last_.course : option->course, cycle.obstacles, cycle.looks()};
  before_ = std::exchange(last_, std::move(next));
  plan.report.cpu_s = plan.report.planning_cpu_s = cycle.cpu_s();
  plan.report.wall_s = cycle.timer.wall();
  record_plan(cycle, plan, *last_.option);
  return plan;
}

}  // namespace slalom::planner
