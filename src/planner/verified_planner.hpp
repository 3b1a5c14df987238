#pragma once

#include <algorithm>
#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "motion.hpp"
#include "planning_method.hpp"
#include "proposals.hpp"
#include "slalom/base/timer.hpp"
#include "slalom/vehicle/plant.hpp"
#include "slalom/world/road_ways.hpp"
#include "tracker.hpp"
#include "verifier.hpp"

namespace slalom::planner {

/// Plans whole ways to the goal and drives none that is not verified (docs/verified-planner.md). In
/// each cycle the rest of the last plan comes first, driven anew by the plant from the state
/// predicted; then, as long as time is left, what Proposals finds, which may take several cycles;
/// and where nothing leads to the goal, stops. What is driven is the cheapest that is verified,
/// else the rest, else the motion that does harm last, and whose first violation is the latest.
class VerifiedPlanner final : public PlanningMethod {
 public:
  explicit VerifiedPlanner(const Task& task);

  Plan plan(const Request& request) override;
  void reset() override;
  void record(const Recorder& recorder) override;

 private:
  /// A motion to the goal that cannot be driven to its end yet; none where it can.
  using Course = std::shared_ptr<const Motion>;
  struct Option {
    Proposal proposal;
    double cost = 0;
    Course course;                 ///< whose beginning it drives
    std::optional<double> harm{};  ///< when it does, where that was found [s]

    const Motion& motion() const { return proposal.motion; }
    const Certificate& certificate() const { return proposal.verdict.certificate; }
  };
  /// A way to stop: what is driven first, and the path along which the vehicle then brakes.
  struct Stop {
    std::string name;
    Motion lead;
    Motion path;
  };
  /// One call of plan().
  struct Cycle {
    const Request& request;
    std::vector<world::Obstacle> obstacles;
    const bool verification;
    Timer timer{};
    std::optional<Option> rest{};  ///< of the last plan, good or not
    bool rest_unchanged = false;   ///< it is that plan's own motion among the same obstacles
    std::vector<Option> good{};    ///< new ones
    std::vector<Option> refused{};
    std::vector<Candidate> looked_at{};
    std::optional<double> course_arrival{};  ///< of a course that is good as far as is seen [s]
    int iterations = 0;
    double beside_s = 0;  ///< thread time of the turns of Proposals

    double t_start() const { return request.t_start; }
    double tex() const {
      return request.tex > 0 ? request.tex : std::max(request.t_start - request.t0, 1e-3);
    }
    Looks looks() const { return {request.t0, tex()}; }
    double beyond() const { return std::max(kBeyond, kBeyondHorizons * tex()); }
    double cpu_s() const { return timer.cpu() + beside_s; }
    /// Thread time left [s], and time by the clock.
    double left() const {
      return request.warm_up ? std::numeric_limits<double>::infinity()
                             : kShare * request.time_limit - cpu_s();
    }
    double clock_left() const {
      return request.warm_up ? std::numeric_limits<double>::infinity()
                             : kShare * request.clock_limit - timer.wall();
    }
    bool over() const {
      return left() <= 0 || clock_left() <= 0 || (request.interrupted && request.interrupted());
    }
    /// Thread time for a better plan than one that leads to the goal [s].
    double for_better(double wanted) const { return std::min(wanted, kBetterShare * tex()); }
    /// Verified; or, where verification is left out, as good as that.
    bool trusts(const Option& option) const {
      return option.certificate().verified || (!verification && option.motion().size() > 1);
    }
    /// Something at hand leads to the goal: the rest, or a course that is good as far as is seen.
    bool leads() const { return rest_is(MotionEnd::arrives) || course_arrival; }
    double arrival() const {
      return rest_is(MotionEnd::arrives) ? rest->proposal.verdict.arrival : *course_arrival;
    }
    bool rest_is(MotionEnd end) const {
      return rest && trusts(*rest) && rest->proposal.verdict.end == end;
    }
    bool arrives() const {
      return rest_is(MotionEnd::arrives) ||
             std::any_of(good.begin(), good.end(), [](const auto& o) {
               return o.proposal.verdict.end == MotionEnd::arrives;
             });
    }
    /// A plan goes on for so many execution horizons after it arrives, and for so long at the least
    /// [s]: the loop looks at the end of each.
    static constexpr double kBeyondHorizons = 2, kBeyond = 1;
    /// Share of its time that a cycle plans; the rest is for reading and choosing.
    static constexpr double kShare = 0.8;
    /// Share of it in which a better plan is looked for, at the most.
    static constexpr double kBetterShare = 0.3;
  };

  Request possible(Request request) const;
  Seen seen(const Request& request) const;
  Need need(const Cycle& cycle) const;
  void note_error(const Cycle& cycle, double state_error);
  void continue_last(Cycle& cycle);
  Motion rest_of_last(Cycle& cycle);
  bool still_holds(const Cycle& cycle) const;
  void look_further(Cycle& cycle, double share);
  bool due(const Cycle& cycle) const;
  void ask(Cycle& cycle);
  bool adopt_found(Cycle& cycle, bool one_at_least);
  void adopt(Cycle& cycle, const Proposal& proposal);
  bool stop(Cycle& cycle);
  void stop_elsewhere(Cycle& cycle);
  bool stop_found(Cycle& cycle);
  struct StandKept;
  bool stop_found_by(Cycle& cycle, const StandKept& kept);
  bool stop_aside(Cycle& cycle);
  bool stop_in_time(Cycle& cycle);
  bool stop_on(Cycle& cycle, const world::RoadWay& found);
  struct Escape;
  void escape(Cycle& cycle);
  bool try_escapes(Escape& escape, std::size_t held);
  bool step_on(Escape& escape, double steer, double push) const;
  Motion settled(Motion motion, double until) const;
  bool consider(Cycle& cycle, Proposal proposal, const Course& course = {});
  Proposal judged(const Cycle& cycle, const std::string& name, Motion motion, bool solved = false);
  double harmful_clearance() const;
  double harm_of(const Cycle& cycle, const Motion& motion);
  Need lesser_need(const Cycle& cycle) const;
  const Option* kept_at_least(Cycle& cycle);
  const Option* least_bad(const Cycle& cycle);
  void follow_course(Cycle& cycle);
  void follow(Cycle& cycle, const Proposal& proposal);
  bool stop_late(Cycle& cycle, const Proposal& proposal);
  bool stop_along(Cycle& cycle, const Stop& stop, double deceleration, const Course& course);
  bool counts_laps() const;
  double left_after(const Motion& motion, double t) const;
  double cost_of(const Motion& motion, const Verdict& verdict) const;
  const Option* chosen(Cycle& cycle, Rung& rung);
  Plan choose(Cycle& cycle);
  void record_plan(const Cycle& cycle, const Plan& plan, const Option& option) const;

  const Task task_;
  const vehicle::Plant plant_;
  Tracker tracker_;
  Verifier verifier_;
  Proposals proposals_;
  std::optional<world::RoadWays> road_ways_;      ///< for stops
  std::optional<world::WayFinder> stand_finder_;  ///< for stops without a road, once one was needed
  std::optional<Recorder> recorder_;
  /// A plan and what belongs to it.
  struct Last {
    std::optional<Option> option;            ///< what is driven
    std::shared_ptr<const Motion> made;      ///< the same as it was when it was new
    Course course;                           ///< of which it drives the beginning
    std::vector<world::Obstacle> obstacles;  ///< among which it was verified
    Looks looks{};                           ///< by which it arrives
  };
  Last last_, before_;  ///< the last plan, and the one before, which goes on where that was late
  std::deque<std::pair<double, double>> errors_;  ///< of belief: when [s], and how great [m]
  double last_improved_ = 0;                      ///< when a better plan was looked for [s]
  double wait_ = 0;                               ///< until the next time [s]
  double work_before_ = 0;    ///< of the turns before what is under way [places]
  double along_ = 0;          ///< where the last plan began along a closed road, with its laps [m]
  double expected_work_ = 0;  ///< that the last thing looked for took [places]
  double longest_adoption_s_ = 0;     ///< thread time of adopting what was found
  bool asked_while_leading_ = false;  ///< what is under way is to improve on what leads to the goal
};

}  // namespace slalom::planner
