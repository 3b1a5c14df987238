#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lane_runs.hpp"
#include "slalom/expr/evaluator.hpp"
#include "slalom/expr/function.hpp"
#include "slalom/nlp/problem.hpp"

namespace slalom::ocp {

/// One function evaluated at many points in one pass, with where its inputs come from and where its
/// results go. Arrays are structure-of-arrays as expr::Evaluator has them.
struct Batch {
  expr::Function function;
  std::size_t lanes = 0;
  std::vector<std::uint32_t> gather;   ///< [variable * lanes + lane] -> NLP variable
  std::vector<double> gather_scale;    ///< by variable: user's value = scale * NLP's
  std::vector<std::string> outputs;    ///< names, for faults
  std::vector<std::string> variables;  ///< names, for faults
  std::vector<std::uint32_t> lane_point, lane_member;

  LaneRuns to_rows, to_terms;  ///< from values; targets are rows, cost terms
  LaneRuns to_jacobian, to_gradient, to_hessian;

  std::optional<expr::Evaluator> evaluator;

  void finish();  ///< once all but the runs above is set
  std::span<double> data() { return evaluator->data(); }
  std::span<const double> data() const { return evaluator->data(); }
  /// Points the function's variables to their numbers in `point`.
  void load(std::span<const double> point);
  void set_weights(double sigma, std::span<const double> y);
  /// Evaluates what `parts` needs. Weights must be set for the Hessian.
  void run(nlp::Parts parts);

  /// Output, lane and variable of the first number that is not finite.
  struct BadNumber {
    bool found = false;
    std::size_t output = 0, lane = 0;
    std::string variable;
  };
  BadNumber find_bad_number(nlp::Parts parts) const;

 private:
  struct Source {
    enum class Kind { run, same, copied } kind;
    std::uint32_t first;
  };
  std::size_t find_period() const;

  std::vector<Source> sources_;
  std::size_t period_ = 0;  ///< after so many lanes all variables stand where they did
  LaneRuns copies_;         ///< into gathered_
  /// Variables that do not stand in a row, or are scaled: one period of each; all lanes.
  std::vector<double> gathered_, copied_;
};

}  // namespace slalom::ocp
