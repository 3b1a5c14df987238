#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "slalom/expr/function.hpp"
#include "slalom/nlp/problem.hpp"

namespace slalom::ocp {

/// target += coefficient * source, for the entries of a batch that land in the NLP's arrays.
struct Scatter {
  std::uint32_t source, target;
  double coefficient;
};

/// One function evaluated at many points in one pass, with where its inputs come from and where its
/// results go. Arrays are structure-of-arrays as expr::Function has them.
struct Batch {
  expr::Function function;
  std::size_t lanes = 0;
  std::vector<std::uint32_t> gather;      ///< [variable * lanes + lane] -> NLP variable
  std::vector<double> gather_scale;       ///< by variable: user's value = scale * NLP's
  std::vector<double> data;               ///< [datum * lanes + lane]
  std::vector<std::string> outputs;       ///< names, for faults
  std::vector<std::string> variables;     ///< names, for faults
  std::vector<std::uint32_t> lane_point;  ///< point of each lane

  std::vector<Scatter> to_rows, to_terms;  ///< from values; targets are rows, cost terms
  std::vector<Scatter> to_jacobian, to_gradient, to_hessian;

  // Buffers, sized once.
  std::vector<double> x, weights, values, jacobian, hessian;

  void allocate();
  void load(std::span<const double> point);
  /// Evaluates what `parts` needs. weights must be set for the Hessian.
  void run(nlp::Parts parts);
  void set_weights(double sigma, std::span<const double> y);
  /// Output, lane and variable of the first number that is not finite; lane as index.
  struct BadNumber {
    bool found = false;
    std::size_t output = 0, lane = 0;
    std::string variable;
  };
  BadNumber find_bad_number(nlp::Parts parts) const;
};

inline void scatter_into(std::span<const Scatter> list, std::span<const double> from,
                         std::span<double> to) {
  for (const Scatter& s : list) to[s.target] += s.coefficient * from[s.source];
}

}  // namespace slalom::ocp
