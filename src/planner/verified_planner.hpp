#pragma once

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "arrival_problem.hpp"
#include "motion.hpp"
#include "planning_method.hpp"
#include "slalom/base/timer.hpp"
#include "slalom/nlp/solver.hpp"
#include "slalom/vehicle/plant.hpp"
#include "slalom/world/way_finder.hpp"
#include "tracker.hpp"
#include "verifier.hpp"

namespace slalom::planner {

/// Plans whole ways to the goal and drives none that is not verified (docs/verified-planner.md). In
/// each cycle the rest of the last plan comes first, driven anew by the plant from the state
/// predicted; then, as long as time is left, new motions: the last one's OCP solved again, ways of
/// a search, tracked as they are and solved from there, and stops. What is driven is the cheapest
/// that is verified, else the rest, else the motion whose first violation is the latest.
class VerifiedPlanner final : public PlanningMethod {
 public:
  explicit VerifiedPlanner(const Task& task);

  Plan plan(const Request& request) override;
  void reset() override { last_.reset(); }

 private:
  /// Times nearer than this are one [s].
  static constexpr double kSameTime = 1e-6;

  struct Option {
    std::string name;
    Motion motion;
    Verdict verdict;
    double cost = 0;
  };
  /// One call of plan().
  struct Cycle {
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
    /// A plan goes on for so many execution horizons after it arrives, and for so long at the least
    /// [s]: the loop looks at the end of each.
    static constexpr double kBeyondHorizons = 2, kBeyond = 1;
    /// Share of its time that a cycle plans; the rest is for reading and choosing.
    static constexpr double kShare = 0.8;
  };

  std::vector<world::Obstacle> known(const Request& request) const;
  void continue_last(Cycle& cycle);
  bool rest_of_last(const Cycle& cycle, Motion& motion) const;
  void improve(Cycle& cycle);
  void guide(Cycle& cycle);
  void stop(Cycle& cycle);
  void solve(Cycle& cycle, const Motion& guess, const std::string& name);
  Motion tracked(const Cycle& cycle, const Motion& reference);
  Motion settled(Motion motion) const;
  bool consider(Cycle& cycle, const std::string& name, Motion motion);
  ArrivalProblem::Obstacles near(const Cycle& cycle, const Motion& guess,
                                 const std::vector<double>& extra) const;
  ArrivalProblem* problem_for(const Cycle& cycle, const ArrivalProblem::Obstacles& obstacles);
  Motion to_the_goal(Motion motion) const;
  double cost_of(const Motion& motion, const Verdict& verdict) const;
  Plan choose(Cycle& cycle);

  const Task task_;
  const vehicle::Plant plant_;
  Tracker tracker_;
  Verifier verifier_;
  world::WayFinder ways_;
  std::unique_ptr<nlp::Solver> solver_;
  std::map<ArrivalProblem::Room, ArrivalProblem> problems_;
  std::optional<Option> last_;                   ///< what is driven
  std::vector<world::Obstacle> last_obstacles_;  ///< among which it was verified
  double last_begin_ = 0;         ///< the moment from which it looked for arrival [s]
  double last_improved_ = 0;      ///< when a better plan was looked for [s]
  double wait_ = 0;               ///< until the next time [s]
  double longest_besides_s_ = 0;  ///< thread time of a solve outside the solver
  double longest_making_s_ = 0;   ///< and of making its problem
};

}  // namespace slalom::planner
