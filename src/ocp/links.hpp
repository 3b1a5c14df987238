#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "slalom/expr/evaluator.hpp"
#include "slalom/expr/function.hpp"
#include "slalom/ocp/phases.hpp"

namespace slalom::ocp {

/// Where a phase's part of each list begins.
struct Offsets {
  std::size_t variables = 0, rows = 0, stages = 0, jacobian = 0, hessian = 0;
};

/// All links, and the cost terms after them, as one function of the ends' variables.
class Links {
 public:
  Links(const PhasedProblem& problem, const std::vector<std::unique_ptr<Transcription>>& parts,
        const std::vector<Offsets>& offsets);

  /// 1 over the largest slope of each output by a scaled variable, where these are at their units.
  std::vector<double> row_scales();

  const expr::Function& function() const { return function_; }
  std::size_t variable(std::size_t i) const { return variables_[i]; }
  double scale(std::size_t i) const { return scales_[i]; }

  /// `weights` of the outputs are for second derivatives alone.
  void evaluate(std::span<const double> x, std::span<const double> weights, nlp::Parts parts);
  const expr::Evaluator& results() const { return *evaluator_; }
  std::vector<Expr> formulas(const std::vector<Expr>& variables) const;
  /// The first output with a second derivative that is not finite where evaluate() was last called;
  /// the number of outputs if there is none.
  std::size_t with_bad_curvature() const;

 private:
  std::vector<Expr> values_, symbols_;
  expr::Function function_;
  std::optional<expr::Evaluator> evaluator_;
  std::vector<std::size_t> variables_;
  std::vector<double> scales_, inputs_;
};

}  // namespace slalom::ocp
