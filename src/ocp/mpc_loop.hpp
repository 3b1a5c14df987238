#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plans.hpp"
#include "slalom/ocp/mpc.hpp"
#include "slalom/ocp/prepared.hpp"

namespace slalom::ocp {

/// A receding horizon but for the plant: predicts, plans, swaps plans and keeps the books.
class MpcLoop {
 public:
  /// States at a time, from those at another; empty where there is no getting there.
  using Predict =
      std::function<std::vector<double>(const std::vector<double>& x, double t0, double t1)>;

  MpcLoop(const Problem& problem, MpcSettings settings);

  /// `predict` as run() has it; empty: by the problem's own dynamics.
  MpcStatus step(const std::vector<double>& measured, double t, const Predict& predict = {});
  std::vector<double> controls(double t) const;
  /// The planned states at t; of no plan, those measured last.
  std::vector<double> planned_states(double t) const;
  std::vector<double> corners() const { return plans_.corners(); }

  void end(MpcStatus status, std::string message);
  MpcStatus status() const { return status_; }
  const std::string& message() const { return message_; }
  const Problem& problem() const { return problem_; }
  const MpcSettings& settings() const { return settings_; }
  std::vector<MpcCycle>& cycles() { return cycles_; }
  double plan_end() const { return plan_end_; }
  /// When a shrinking horizon ends at the latest.
  double latest_end() const { return tf_bounds_.upper; }

 private:
  MpcCycle open(const std::vector<double>& measured, double t);
  double tolerances_off(const std::vector<double>& x) const;
  bool over(const MpcCycle& cycle);
  bool ends_within(const MpcCycle& cycle) const;
  bool predict_start(MpcCycle& cycle, const Predict& predict);
  void place(const MpcCycle& cycle);
  void place_times(double t0);
  Solution solve(const MpcCycle& cycle);
  void plan(MpcCycle cycle);
  void keep(MpcCycle cycle);

  Problem problem_;
  MpcSettings settings_;
  Bounds tf_bounds_;
  double length_;  ///< of the first guess
  double first_t0_;
  std::vector<double> first_controls_;
  std::optional<Prepared> prepared_;
  Plans plans_;
  std::vector<MpcCycle> cycles_;
  std::vector<double> measured_;
  int index_ = 0, unsolved_ = 0;  ///< of the last cycle; solves failed in a row
  double plan_end_ = kInfinity;
  MpcStatus status_ = MpcStatus::running;
  std::string message_;
};

}  // namespace slalom::ocp
