#include "verified_planner.hpp"

#include <algorithm>
#include <array>
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
/// Times nearer than this are one [s].
constexpr double kSameTime = 1e-6;
/// The state predicted is that of the last plan up to this [its unit].
constexpr double kSameState = 1e-7;
/// This near to its arrival a plan is not improved on [s].
constexpr double kNearlyThere = 1;
/// A plan goes on for so many execution horizons after it arrives, and for so long at the least
/// [s]: the loop looks at the end of each.
constexpr double kBeyondHorizons = 2, kBeyond = 1;
/// Share of its time that a cycle plans; the rest is for reading and choosing.
constexpr double kShare = 0.8;
/// Obstacles farther from a guess than this [m] are left out of its OCP.
constexpr double kFar = 18;
/// Standing ones nearer than this to the edge of their margin have rows between the points [m].
constexpr double kClose = 1.5;
/// An obstacle that a tracked motion came too near to grows by the shortfall and this [m], so many
/// times.
constexpr double kRegrow = 0.08;
constexpr int kRounds = 5;
/// A way found while another leads to the goal is looked at if it is sooner by this [s].
constexpr double kSooner = 0.3;
/// How stops brake [m/s^2].
constexpr std::array kStops = {3.4, 2.0, 1.0};
/// Standing costs so much more than arriving, and each metre to the goal this.
constexpr double kStandingCost = 1e6, kMetreCost = 10;

/// A search: its speed limit [m/s], what it keeps off beyond verified_clearance [m], and its
/// lateral acceleration [m/s^2]. A lower speed finds other orders in time.
struct Variant {
  double v_max, clearance, lateral, v_min = 1.5;
  int places = 1;  ///< in multiples of the setting's
};
constexpr std::array kVariants = {Variant{28, 0.65, 3.2},      Variant{20, 0.45, 3.2},
                                  Variant{13, 0.25, 3.2},      Variant{8, 0.25, 3.2},
                                  Variant{25, 0.15, 4.0, 3.0}, Variant{8, 0.1, 4.0, 1.5, 3}};
/// These come last: only if none of those before led to a verified arrival.
constexpr std::size_t kLastResorts = 4;

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

std::vector<world::Obstacle> grown(std::vector<world::Obstacle> obstacles, double margin) {
  for (auto& o : obstacles) o = o.grown(margin);
  return obstacles;
}

}  // namespace

/// One call of plan().
struct VerifiedPlanner::Cycle {
  const Request& request;
  std::vector<world::Obstacle> obstacles;
  Timer timer;
  std::optional<Option> rest;       ///< of the last plan, verified or not
  std::vector<Option> verified;     ///< new ones
  std::optional<Option> least_bad;  ///< of those refused, the one that goes on longest
  std::vector<Candidate> looked_at;
  int iterations = 0;

  double t_start() const { return request.t_start; }
  double tex() const { return std::max(request.t_start - request.t0, 1e-3); }
  double beyond() const { return std::max(kBeyond, kBeyondHorizons * tex()); }
  double left() const {
    return request.warm_up ? std::numeric_limits<double>::infinity()
                           : kShare * request.time_limit - timer.cpu();
  }
  bool over() const { return left() <= 0 || (request.interrupted && request.interrupted()); }
  bool rest_is(MotionEnd end) const {
    return rest && rest->verdict.certificate.verified && rest->verdict.end == end;
  }
  bool arrives() const {
    return rest_is(MotionEnd::arrives) ||
           std::any_of(verified.begin(), verified.end(),
                       [](const auto& o) { return o.verdict.end == MotionEnd::arrives; });
  }
};

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
  const Motion& old = last_->motion;
  Motion motion;
  bool unchanged = false;
  if (t0 < old.end() - kSameTime) {
    const auto next = static_cast<std::size_t>(
        std::upper_bound(old.t.begin(), old.t.end(), t0 + kSameTime) - old.t.begin());
    motion.add(t0, cycle.request.X0p, old.control_at(t0));
    if (next > 0) {
      const State expected = plant_.advance(old.states[next - 1], old.controls[next - 1],
                                            motion.controls[0], old.t[next - 1], t0);
      unchanged = gap(expected, cycle.request.X0p) < kSameState;
    }
    try {
      for (std::size_t k = next; k < old.size(); ++k)
        motion.add(old.t[k],
                   unchanged ? old.states[k]
                             : plant_.advance(motion.states.back(), motion.controls.back(),
                                              old.controls[k], motion.end(), old.t[k]),
                   old.controls[k]);
    } catch (const PlantError&) {
    }
  } else {
    motion.add(t0, cycle.request.X0p, {});
    motion.add(t0 + cycle.beyond(),
               plant_.advance(cycle.request.X0p, {}, {}, t0, t0 + cycle.beyond()), {});
  }
  cycle.rest = Option{"rest", std::move(motion), last_->verdict, last_->cost};
  if (!(unchanged && same(cycle.obstacles, last_obstacles_))) {
    cycle.rest->verdict = verifier_.judge(cycle.rest->motion, cycle.obstacles, cycle.tex());
    cycle.rest->cost = cost_of(cycle.rest->motion, cycle.rest->verdict);
  }
  const Certificate& certificate = cycle.rest->verdict.certificate;
  cycle.looked_at.push_back({"rest", cycle.rest->cost, certificate});
  if (!certificate.verified) cycle.least_bad = cycle.rest;
}

void VerifiedPlanner::improve(Cycle& cycle) {
  const bool arrives = cycle.rest_is(MotionEnd::arrives);
  if (arrives && (cycle.t_start() - last_improved_ < task_.planner.improvement_period - kSameTime ||
                  cycle.rest->verdict.arrival - cycle.t_start() < kNearlyThere))
    return;
  last_improved_ = cycle.t_start();
  if (cycle.rest && cycle.rest->verdict.end == MotionEnd::arrives && !cycle.over())
    solve(cycle, cycle.rest->motion, "rest, solved");
  guide(cycle);
  if (!cycle.arrives()) stop(cycle);
}

/// Ways of the search, tracked as they are and solved from there.
void VerifiedPlanner::guide(Cycle& cycle) {
  const bool urgent = !cycle.rest_is(MotionEnd::arrives);
  const auto obstacles = grown(cycle.obstacles, task_.planner.verified_clearance);
  for (std::size_t k = 0; k < (urgent ? kVariants.size() : 1) && !cycle.over(); ++k) {
    if (k >= kLastResorts && cycle.arrives()) return;
    const Variant& variant = kVariants[k];
    world::WaySearch search;
    search.v_max = variant.v_max;
    search.v_min = variant.v_min;
    search.clearance = variant.clearance;
    search.lateral_acceleration = variant.lateral;
    search.max_places =
        urgent ? variant.places * task_.planner.search_places : task_.planner.improvement_places;
    const auto way = ways_.find(cycle.request.X0p, cycle.t_start(), obstacles, search,
                                [&] { return cycle.over(); });
    if (!way) continue;
    if (!urgent && way->back().t > cycle.rest->verdict.arrival - kSooner) return;
    const std::string name = "way " + std::to_string(k + 1);
    const Motion reference =
        braked_on(reference_of(*way, task_.vehicle), task_.vehicle, cycle.beyond());
    Motion tracked =
        tracker_.follow(reference, cycle.request.X0p, cycle.t_start(), reference.end());
    Motion guess = tracked;
    consider(cycle, name, std::move(tracked));
    while (guess.size() > 2 && guess.end() > way->back().t + kSameTime) {
      guess.t.pop_back();
      guess.states.pop_back();
      guess.controls.pop_back();
    }
    solve(cycle, guess, name + ", solved");
  }
}

/// The obstacles that the OCP keeps off: those that come near the guess, grown by their margins.
ArrivalProblem::Obstacles VerifiedPlanner::near(const Cycle& cycle, const Motion& guess,
                                                const std::vector<double>& extra) const {
  ArrivalProblem::Obstacles result;
  const double margin = task_.planner.verified_clearance + task_.planner.arrival_margin;
  for (std::size_t k = 0; k < cycle.obstacles.size(); ++k) {
    const auto& o = cycle.obstacles[k];
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < guess.size(); ++i)
      least =
          std::min(least, world::distance(o, guess.states[i][X], guess.states[i][Y], guess.t[i]));
    if (o.moves() ? least < kFar + margin : least < kClose + margin)
      result.close.push_back(o.grown(margin + extra[k]));
    else if (least < kFar + margin)
      result.far.push_back(o.grown(margin + extra[k]));
  }
  return result;
}

/// The problem with room for these obstacles, made when it is first wanted.
ArrivalProblem& VerifiedPlanner::problem_for(const ArrivalProblem::Obstacles& obstacles) {
  const auto room = ArrivalProblem::room_for(obstacles);
  const auto found = problems_.find(room);
  return (found != problems_.end() ? found : problems_.try_emplace(room, task_, room).first)
      ->second;
}

/// Solves from a guess, tracks the answer, and where that came too near to an obstacle, solves
/// again with it grown.
void VerifiedPlanner::solve(Cycle& cycle, const Motion& guess, const std::string& name) {
  constexpr double shortest = 0.4;
  std::vector<double> extra(cycle.obstacles.size(), 0);
  Motion from = guess;
  while (from.size() > 2 &&
         task_.goal.contains(from.states[from.size() - 2][X], from.states[from.size() - 2][Y]) &&
         task_.goal.outside(from.states[from.size() - 2][X], from.states[from.size() - 2][Y]) <
             -task_.goal.sigma / 2) {
    from.t.pop_back();
    from.states.pop_back();
    from.controls.pop_back();
  }
  for (int round = 0; round < kRounds && !cycle.over(); ++round) {
    if (from.end() - from.begin() < shortest) return;
    const auto obstacles = near(cycle, from, extra);
    nlp::Options options;
    options.floor = task_.planner.arrival_floor;
    options.tol = task_.planner.tol;
    options.max_iterations = task_.planner.arrival_max_iterations;
    options.time_limit = cycle.left();
    ArrivalProblem& problem = problem_for(obstacles);
    auto answer = problem.solve(from, cycle.request.X0p, obstacles, *solver_, options);
    cycle.iterations += problem.iterations();
    if (!answer) return;
    const Motion reference = braked_on(*answer, task_.vehicle, cycle.beyond());
    if (consider(cycle, name,
                 tracker_.follow(reference, cycle.request.X0p, cycle.t_start(), reference.end())))
      return;
    const Verdict verdict = verifier_.last();
    bool regrown = false;
    for (std::size_t k = 0; k < extra.size(); ++k) {
      const double short_of = task_.planner.verified_clearance - verdict.nearest[k];
      if (short_of <= 0) continue;
      extra[k] += short_of + kRegrow;
      regrown = true;
    }
    if (!regrown) return;
    from = std::move(*answer);
  }
}

/// Comes to a creep at no acceleration and no steering rate.
Motion VerifiedPlanner::settled(Motion motion) const {
  if (motion.size() < 3) return motion;
  const std::size_t k = motion.size() - 1;
  motion.controls[k] = {};
  motion.states[k] = plant_.advance(motion.states[k - 1], motion.controls[k - 1], {},
                                    motion.t[k - 1], motion.t[k]);
  // A triangle of jerk that takes the acceleration away.
  const double ax = motion.states[k][AX], t = motion.t[k];
  const double length = std::max(0.1, std::fabs(ax) / 2);
  const Control peak{0, -2 * ax / length};
  const State middle = plant_.advance(motion.states[k], {}, peak, t, t + length / 2);
  motion.add(t + length / 2, middle, peak);
  motion.add(t + length, plant_.advance(middle, peak, {}, t + length / 2, t + length), {});
  return motion;
}

/// Stops along the rest, straight on, and after swerves.
void VerifiedPlanner::stop(Cycle& cycle) {
  const State& X0p = cycle.request.X0p;
  const double t0 = cycle.t_start();
  std::vector<std::pair<std::string, Motion>> paths;
  if (cycle.rest && cycle.rest->motion.size() > 3)
    paths.emplace_back("stop along the rest", cycle.rest->motion);
  paths.emplace_back("stop straight on", straight_reference(X0p, t0, 1));
  paths.emplace_back("stop after a swerve to the left",
                     swerve_reference(X0p, t0, 1, task_.vehicle));
  paths.emplace_back("stop after a swerve to the right",
                     swerve_reference(X0p, t0, -1, task_.vehicle));
  for (const auto& [name, path] : paths)
    for (const double deceleration : kStops) {
      if (!cycle.verified.empty() && cycle.over()) return;
      const Motion reference = braking_reference(path, X0p, t0, deceleration, task_.vehicle);
      try {
        if (consider(cycle, name, settled(tracker_.follow(reference, X0p, t0, reference.end()))))
          break;
      } catch (const PlantError&) {
      }
    }
}

Plan VerifiedPlanner::choose(Cycle& cycle) {
  const Option* best = nullptr;
  for (const auto& option : cycle.verified)
    if (!best || option.cost < best->cost) best = &option;
  const bool rest = cycle.rest && cycle.rest->verdict.certificate.verified;
  Plan plan;
  plan.t_start = cycle.t_start();
  plan.report.backend = "verified";
  const double hysteresis = task_.planner.w_t * task_.planner.hysteresis;
  const Option* chosen = nullptr;
  if (best && (!rest || best->cost < cycle.rest->cost - hysteresis)) {
    chosen = best;
    plan.rung = Rung::new_plan;
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
  last_obstacles_ = cycle.obstacles;
  plan.candidates = std::move(cycle.looked_at);
  plan.report.cpu_s = plan.report.planning_cpu_s = cycle.timer.cpu();
  plan.report.wall_s = cycle.timer.wall();
  return plan;
}

}  // namespace slalom::planner
