#pragma once

#include <memory>
#include <optional>

#include "line_problem.hpp"
#include "planning_method.hpp"
#include "slalom/base/timer.hpp"
#include "slalom/nlp/solver.hpp"
#include "slalom/ocp/transcription.hpp"
#include "solving.hpp"

namespace slalom::planner {

/// Plans the fastest motion along the road over the next L_range metres of it, from which the
/// vehicle can drive on: at its end it is no faster than a SpeedProfile. Knows no obstacles.
class LinePlanner final : public PlanningMethod {
 public:
  explicit LinePlanner(const Task& task);

  Plan plan(const Request& request) override;
  void reset() override {
    last_.reset();
    s_.reset();
  }
  void record(const Recorder& recorder) override;

  /// The problem of a cycle that begins in this state, as a solver sees it: for replays. `s` is
  /// where that is on the road [m]; without, the nearest place of it.
  ocp::Transcription& posed(const vehicle::State& X0p, const std::optional<double>& s);

 private:
  /// A plan from which the next solve starts.
  struct Last {
    double start;                ///< of the line [m]
    ocp::Trajectory trajectory;  ///< along it
  };

  /// One solve of a cycle: from which guess, with the last plan's multipliers or without, and at
  /// how many times the barrier floor.
  struct Beginning {
    double start;
    ocp::Trajectory guess;
    bool multipliers;
    double floor_times;
  };
  /// What came of it.
  struct Attempt {
    Plan plan;
    ocp::Trajectory trajectory;  ///< along the line
    bool cut_short = false;      ///< by time or an interrupt
    bool carries = true;         ///< its multipliers are at hand

    bool driven() const { return plan.report.solved || plan.report.best_iterate; }
  };

  LineProblem::LineState first(double start, const vehicle::State& X0p) const;
  void update(double start, const LineProblem::LineState& x0);
  ocp::Trajectory guess(double start, const LineProblem::LineState& x0) const;
  ocp::Trajectory shifted(double start, const LineProblem::LineState& x0) const;
  void try_other(const Request& request, const Timer& timer, const Beginning& beginning,
                 Attempt& best);
  Attempt attempt(const Request& request, const Timer& timer, const Beginning& beginning);
  Attempt read(const Request& request, double start, const nlp::Options& options);
  void keep(double start, Attempt& attempt);

  const Task task_;
  const Settings& settings_;
  const SpeedProfile profile_;  ///< that plans end by
  const SpeedProfile calm_;     ///< that guesses go by
  LineProblem line_;
  std::array<ocp::Expr, LineProblem::kLineStates> x0_;
  ocp::Expr end_speed_;
  std::optional<ocp::Transcription> transcription_;
  std::unique_ptr<nlp::Solver> solver_;
  nlp::Start start_;
  nlp::Answer answer_;
  SolveTotals totals_;       ///< of the cycle
  std::optional<double> s_;  ///< of the last cycle [m]
  double t_ = 0;             ///< and when its plan began [s]
  std::optional<Last> last_;
  bool carries_ = false;  ///< start_ has its multipliers
  std::optional<Recorder> recorder_;
};

}  // namespace slalom::planner
