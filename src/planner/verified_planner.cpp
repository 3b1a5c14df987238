#include "verified_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "references.hpp"
#include "slalom/base/timer.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;

/// The plant's integrator as the loop has it by default.
constexpr double kPlantTolerance = 1e-9, kSampleStep = 0.02;
/// The state predicted is that of the last plan up to this [its unit].
constexpr double kSameState = 1e-7;
/// This near to its arrival a plan is not improved on [s].
constexpr double kNearlyThere = 1;
/// The longest wait until a better plan is looked for again, in improvement periods.
constexpr double kLongestWaits = 8;
/// Standing costs so much more than arriving, and each metre to the goal this.
constexpr double kStandingCost = 1e6, kMetreCost = 10;

bool same(const std::vector<world::Obstacle>& a, const std::vector<world::Obstacle>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& p, const auto& q) {
    return p.x == q.x && p.y == q.y && p.a == q.a && p.b == q.b && p.vx == q.vx && p.vy == q.vy;
  });
}

double gap(const State& a, const State& b) {
  double most = 0;
  for (std::size_t i = 0; i < kStates; ++i) most = std::max(most, std::fabs(a[i] - b[i]));
  return most;
}

}  // namespace

VerifiedPlanner::VerifiedPlanner(const Task& task)
    : task_(task),
      plant_(task_.vehicle, kPlantTolerance, kSampleStep),
      tracker_(task_.vehicle, plant_),
      verifier_(task_, plant_),
      ways_(task_, task_.vehicle),
      solver_(nlp::make_solver(to_string(task_.planner.solver))) {
  check(task_.planner, "planner " + task_.planner.name);
}

Plan VerifiedPlanner::plan(const Request& request) {
  Cycle cycle{request, known(request), {}, {}, {}, {}, {}, 0};
  continue_last(cycle);
  improve(cycle);
  return choose(cycle);
}

std::vector<world::Obstacle> VerifiedPlanner::known(const Request& request) const {
  std::vector<world::Obstacle> obstacles =
      request.obstacles.empty() ? task_.obstacles : request.obstacles;
  if (task_.planner.known == Known::range)
    std::erase_if(obstacles, [&](const auto& o) {
      return world::distance(o, request.X0p[X], request.X0p[Y], request.t0) > task_.planner.L_range;
    });
  return obstacles;
}

double VerifiedPlanner::cost_of(const Motion& motion, const Verdict& verdict) const {
  const Settings& s = task_.planner;
  const bool stands = verdict.end == MotionEnd::stands;
  const double end = stands ? motion.end() : verdict.arrival;
  double cost = s.w_t * end;
  for (std::size_t k = 0; k + 1 < motion.size() && motion.t[k] < end; ++k)
    cost +=
        s.w_ce * (motion.t[k + 1] - motion.t[k]) *
        (s.w_sa * std::pow(motion.states[k][SA], 2) + s.w_sr * std::pow(motion.controls[k][SR], 2) +
         s.w_jx * std::pow(motion.controls[k][JX], 2));
  const State& last = motion.states.back();
  if (stands)
    cost += kStandingCost + kMetreCost * std::hypot(last[X] - task_.goal.x, last[Y] - task_.goal.y);
  return cost;
}

/// Judges a motion and keeps it among the cycle's options if it is verified.
bool VerifiedPlanner::consider(Cycle& cycle, const std::string& name, Motion motion) {
  Option option{name, std::move(motion), {}, 0};
  option.verdict = verifier_.judge(option.motion, cycle.obstacles, cycle.tex());
  const Certificate& certificate = option.verdict.certificate;
  if (certificate.verified) option.cost = cost_of(option.motion, option.verdict);
  cycle.looked_at.push_back({name, option.cost, certificate});
  if (certificate.verified) {
    cycle.verified.push_back(std::move(option));
    return true;
  }
  if (option.motion.size() > 1 &&
      (!cycle.least_bad ||
       certificate.refused_at > cycle.least_bad->verdict.certificate.refused_at))
    cycle.least_bad = std::move(option);
  return false;
}

/// The rest of the last plan from the state predicted. Where state and obstacles are those that it
/// was verified for, so it still is; else the plant drives it anew.
void VerifiedPlanner::continue_last(Cycle& cycle) {
  if (!last_) return;
  const double t0 = cycle.t_start();
  Motion motion;
  bool unchanged = false;
  try {
    unchanged = rest_of_last(cycle, motion);
  } catch (const PlantError&) {  // what there is of it is judged
  }
  // The loop looks for arrival at other moments when a plan was late.
  unchanged = unchanged && std::fabs(std::remainder(t0 - last_begin_, cycle.tex())) < kSameTime;
  cycle.rest = Option{"rest", std::move(motion), last_->verdict, last_->cost};
  if (!(unchanged && same(cycle.obstacles, last_obstacles_))) {
    cycle.rest->verdict = verifier_.judge(cycle.rest->motion, cycle.obstacles, cycle.tex());
    cycle.rest->cost = cost_of(cycle.rest->motion, cycle.rest->verdict);
  }
  const Certificate& certificate = cycle.rest->verdict.certificate;
  cycle.looked_at.push_back({"rest", cycle.rest->cost, certificate});
  if (!certificate.verified) cycle.least_bad = cycle.rest;
}

/// Puts the rest of the last plan into `motion`; whether it is that plan's own motion.
bool VerifiedPlanner::rest_of_last(const Cycle& cycle, Motion& motion) const {
  const double t0 = cycle.t_start();
  const Motion& old = last_->motion;
  if (t0 >= old.end() - kSameTime) {  // beyond its end, straight on
    motion.add(t0, cycle.request.X0p, {});
    const double t1 = t0 + cycle.beyond();
    motion.add(t1, plant_.advance(cycle.request.X0p, {}, {}, t0, t1), {});
    return false;
  }
  const auto next = static_cast<std::size_t>(
      std::upper_bound(old.t.begin(), old.t.end(), t0 + kSameTime) - old.t.begin());
  motion.add(t0, cycle.request.X0p, old.control_at(t0));
  const State expected = next > 0 ? plant_.advance(old.states[next - 1], old.controls[next - 1],
                                                   motion.controls[0], old.t[next - 1], t0)
                                  : old.states[0];
  const bool unchanged = next > 0 && gap(expected, cycle.request.X0p) < kSameState;
  for (std::size_t k = next; k < old.size(); ++k)
    motion.add(old.t[k],
               unchanged ? old.states[k]
                         : plant_.advance(motion.states.back(), motion.controls.back(),
                                          old.controls[k], motion.end(), old.t[k]),
               old.controls[k]);
  return unchanged;
}

void VerifiedPlanner::improve(Cycle& cycle) {
  const bool arrives = cycle.rest_is(MotionEnd::arrives);
  if (arrives && (cycle.t_start() - last_improved_ < wait_ - kSameTime ||
                  cycle.rest->verdict.arrival - cycle.t_start() < kNearlyThere))
    return;
  last_improved_ = cycle.t_start();
  // Until a plan is better, each search is waited for longer than the one before.
  wait_ = arrives ? std::min(2 * wait_, kLongestWaits * task_.planner.improvement_period)
                  : task_.planner.improvement_period;
  if (cycle.rest && cycle.rest->verdict.end == MotionEnd::arrives && !cycle.over())
    solve(cycle, cycle.rest->motion, "rest, solved");
  guide(cycle);
  if (!cycle.arrives()) stop(cycle);
}

Plan VerifiedPlanner::choose(Cycle& cycle) {
  const Option* best = nullptr;
  for (const auto& option : cycle.verified)
    if (!best || option.cost < best->cost) best = &option;
  const bool rest = cycle.rest && cycle.rest->verdict.certificate.verified;
  Plan plan;
  plan.t_start = cycle.t_start();
  plan.report.backend = "verified";
  plan.candidates = std::move(cycle.looked_at);
  const double hysteresis = task_.planner.w_t * task_.planner.hysteresis;
  const Option* chosen = nullptr;
  if (best && (!rest || best->cost < cycle.rest->cost - hysteresis)) {
    chosen = best;
    plan.rung = Rung::new_plan;
    wait_ = task_.planner.improvement_period;
  } else if (rest) {
    chosen = &*cycle.rest;
    plan.rung = Rung::rest;
  } else if (cycle.least_bad) {
    chosen = &*cycle.least_bad;
    plan.rung = Rung::least_bad;
  }
  if (!chosen) {
    plan.report.status = PlanStatus::infeasible;
    return plan;
  }
  const Motion& motion = chosen->motion;
  for (std::size_t k = 0; k < motion.size(); ++k) plan.t.push_back(motion.t[k] - plan.t_start);
  plan.states = motion.states;
  plan.controls = motion.controls;
  plan.tf = plan.t.back();
  plan.goal_in_range = chosen->verdict.end == MotionEnd::arrives;
  plan.certificate = chosen->verdict.certificate;
  plan.report.solved = plan.certificate.verified;
  plan.report.best_iterate = !plan.report.solved;
  plan.report.status = plan.report.solved ? PlanStatus::solved : PlanStatus::unverified;
  plan.report.detail = plan.certificate.refused;
  plan.report.iterations = cycle.iterations;
  plan.report.cost = chosen->cost;
  last_ = *chosen;
  last_begin_ = cycle.t_start();
  last_obstacles_ = cycle.obstacles;
  plan.report.cpu_s = plan.report.planning_cpu_s = cycle.timer.cpu();
  plan.report.wall_s = cycle.timer.wall();
  return plan;
}

}  // namespace slalom::planner
