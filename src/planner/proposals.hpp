#pragma once

#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrival_problem.hpp"
#include "motion.hpp"
#include "slalom/nlp/solver.hpp"
#include "slalom/vehicle/plant.hpp"
#include "slalom/world/road_ways.hpp"
#include "slalom/world/way_finder.hpp"
#include "tracker.hpp"
#include "turns.hpp"
#include "verifier.hpp"

namespace slalom::planner {

/// A motion of the plant that could be driven.
struct Proposal {
  std::string name;  ///< what it comes from
  Motion motion;
  Verdict verdict;
  bool solved = false;  ///< it tracks an answer of the OCP
};

/// Looks for motions to the goal, in turns that may be spread over cycles: the OCP of the whole way
/// solved from the rest of the last plan, and ways of a search, tracked as they are and solved from
/// there. On a road ways along it come first, and no others where one of them arrives.
class Proposals {
 public:
  /// Work is counted in places that a search looks at; so many take a second, about.
  static constexpr double kPlacesPerSecond = 400'000;

  /// What is looked for.
  struct Question {
    vehicle::State from{};  ///< where motions begin
    double t_from = 0;      ///< and when [s]
    Looks looks{};
    double beyond = 0;  ///< for which motions go on after they arrive [s]
    std::vector<world::Obstacle> obstacles;
    Need need;
    std::optional<Motion> rest;  ///< of the last plan from t_from on, where it is to be solved
    double arrival = std::numeric_limits<double>::infinity();  ///< that is known already [s]
    int places = 0, ways = 0;                                  ///< looked at, at the most
  };

  /// The task, tracker and verifier outlive it. It uses them in its turns alone.
  Proposals(const Task& task, Tracker& tracker, Verifier& verifier);

  /// Gives up what is looked for, and what was found.
  void forget();
  /// Asks anew: what was looked for before is given up, and what was found.
  void ask(Question question);
  const Question& question() const { return question_; }
  Turns& turns() { return turns_; }
  /// Whether some were found that are not taken.
  bool found() const { return !found_.empty(); }
  /// The first of them.
  Proposal take();
  int take_iterations() { return std::exchange(iterations_, 0); }

 private:
  void look();
  bool follow_road();
  void follow_ways();
  bool follow(const world::Way& way, const std::string& name);
  bool propose(const std::string& name, Motion motion, bool solved);
  bool solve(const Motion& guess, const std::string& name);
  bool regrow(std::vector<double>& extra, double& edge_margin) const;
  std::optional<Motion> answer_from(const Motion& guess, const std::vector<double>& extra,
                                    double edge_margin);
  Motion tracked(const Motion& reference);
  Motion coasting(const Motion& answer);
  ArrivalProblem::Obstacles near(const Motion& guess, const std::vector<double>& extra) const;
  ArrivalProblem* problem_for(const ArrivalProblem::Obstacles& obstacles);
  Motion to_the_goal(Motion motion) const;

  const Task& task_;
  Tracker& tracker_;
  Verifier& verifier_;
  const world::Footprint footprint_;
  world::WayFinder ways_;
  std::optional<world::RoadWays> road_ways_;
  std::unique_ptr<nlp::Solver> solver_;
  std::map<ArrivalProblem::Room, ArrivalProblem> problems_;
  Question question_;
  std::deque<Proposal> found_;
  int iterations_ = 0;
  double longest_besides_s_ = 0;  ///< thread time of a solve outside the solver
  double longest_making_s_ = 0;   ///< and of making its problem
  Turns turns_;                   ///< last: its thread ends before what it uses
};

}  // namespace slalom::planner
