#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "slalom/expr/expr.hpp"

namespace slalom::expr {

/// A structurally non-zero entry of a derivative.
struct Entry {
  std::size_t row, col;
  friend bool operator==(const Entry&, const Entry&) = default;
};

/// Which results one evaluation fills.
struct Wanted {
  bool values = true;
  bool jacobian = false;
  bool hessian = false;  ///< of weights' * outputs
};

/// A vector function compiled from expressions, evaluated for many lanes (stages) in one pass.
/// Inputs are variables (differentiated) followed by data (not differentiated).
///
/// Arrays are structure-of-arrays: element i of lane l stands at [i * lanes + l].
class Function {
 public:
  Function();  ///< of nothing: no variables, no outputs
  /// Throws Error when an output depends on a symbol that is in neither list, or one is in both.
  Function(std::vector<Expr> variables, std::vector<Expr> data, const std::vector<Expr>& outputs);

  std::size_t variables() const;
  std::size_t data() const;
  std::size_t outputs() const;
  /// Sorted by row, then column; columns index the variables.
  const std::vector<Entry>& jacobian_pattern() const;
  /// Lower triangle (row >= col) of the Hessian of a weighted sum of the outputs.
  const std::vector<Entry>& hessian_pattern() const;

  /// x: variables x lanes; p: data x lanes; weights: outputs x lanes, used for the Hessian alone;
  /// values: outputs x lanes; jacobian, hessian: pattern size x lanes. Spans that are not wanted
  /// may be empty. For many evaluations at the same number of lanes use an Evaluator.
  void evaluate(std::size_t lanes, std::span<const double> x, std::span<const double> p,
                std::span<const double> weights, Wanted wanted, std::span<double> values,
                std::span<double> jacobian, std::span<double> hessian) const;

  /// One lane, values only.
  void operator()(std::span<const double> x, std::span<const double> p,
                  std::span<double> values) const;

  /// The outputs as expressions, with `variables` and `data` in place of the inputs. Throws Error
  /// unless there are as many as inputs.
  std::vector<Expr> operator()(const std::vector<Expr>& variables,
                               const std::vector<Expr>& data) const;

  /// Number of instructions an evaluation of `wanted` takes for each lane.
  std::size_t instructions(Wanted wanted) const;

 private:
  friend class Evaluator;
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace slalom::expr
