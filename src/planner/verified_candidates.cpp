// The candidates of a cycle: ways of the search, tracked and solved, and stops.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "references.hpp"
#include "verified_planner.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;

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

std::vector<world::Obstacle> grown(std::vector<world::Obstacle> obstacles, double margin) {
  for (auto& o : obstacles) o = o.grown(margin);
  return obstacles;
}

}  // namespace

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
                                [&] { return cycle.over() || cycle.left() < longest_besides_s_; });
    if (!way) continue;
    if (!urgent && way->back().t > cycle.rest->verdict.arrival - kSooner) return;
    const std::string name = "way " + std::to_string(k + 1);
    const Motion reference =
        braked_on(reference_of(*way, task_.vehicle), task_.vehicle, cycle.beyond());
    Motion guess = tracked(cycle, reference);
    consider(cycle, name, guess);
    while (guess.size() > 2 && guess.end() > way->back().t + kSameTime) guess.drop_last();
    solve(cycle, guess, name + ", solved");
  }
}

/// What the plant makes of a reference, from the state predicted to the reference's end.
Motion VerifiedPlanner::tracked(const Cycle& cycle, const Motion& reference) {
  return tracker_.follow(reference, cycle.request.X0p, cycle.t_start(), reference.end());
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

/// The problem with room for these obstacles, made when it is first wanted and there is time to.
/// While there is none, one with more room will do.
ArrivalProblem* VerifiedPlanner::problem_for(const Cycle& cycle,
                                             const ArrivalProblem::Obstacles& obstacles) {
  const auto room = ArrivalProblem::room_for(obstacles);
  const auto found = problems_.find(room);
  if (found != problems_.end()) return &found->second;
  if (cycle.left() > longest_making_s_) {
    const Timer timer;
    ArrivalProblem& made = problems_.try_emplace(room, task_, room).first->second;
    longest_making_s_ = std::max(longest_making_s_, timer.cpu());
    return &made;
  }
  for (auto& [other, problem] : problems_)
    if (other.far >= room.far && other.close >= room.close) return &problem;
  return nullptr;
}

/// A motion, but for what lies deep within the goal's square at its end.
Motion VerifiedPlanner::to_the_goal(Motion motion) const {
  const auto deep = [&](const State& x) {
    return task_.goal.outside(x[X], x[Y]) < -task_.goal.sigma / 2;
  };
  while (motion.size() > 2 && deep(motion.states[motion.size() - 2])) motion.drop_last();
  return motion;
}

/// Solves from a guess, tracks the answer, and where that came too near to an obstacle, solves
/// again with it grown.
void VerifiedPlanner::solve(Cycle& cycle, const Motion& guess, const std::string& name) {
  constexpr double shortest = 0.4;
  std::vector<double> extra(cycle.obstacles.size(), 0);
  Motion from = to_the_goal(guess);
  for (int round = 0; round < kRounds && cycle.left() > longest_besides_s_; ++round) {
    if (from.end() - from.begin() < shortest || cycle.over()) return;
    const auto obstacles = near(cycle, from, extra);
    nlp::Options options;
    options.floor = task_.planner.arrival_floor;
    options.tol = task_.planner.tol;
    options.max_iterations = task_.planner.arrival_max_iterations;
    ArrivalProblem* problem = problem_for(cycle, obstacles);
    if (!problem) return;
    options.time_limit = cycle.left() - longest_besides_s_;
    if (options.time_limit <= 0) return;
    const Timer timer;
    auto answer = problem->solve(from, cycle.request.X0p, obstacles, *solver_, options);
    cycle.iterations += problem->iterations();
    if (!answer) return;
    const Motion reference = braked_on(*answer, task_.vehicle, cycle.beyond());
    const bool verified = consider(cycle, name, tracked(cycle, reference));
    longest_besides_s_ = std::max(longest_besides_s_, timer.cpu() - problem->solver_cpu_s());
    if (verified) return;
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
        if (consider(cycle, name, settled(tracked(cycle, reference)))) break;
      } catch (const PlantError&) {
      }
    }
}

}  // namespace slalom::planner
