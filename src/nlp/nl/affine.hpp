#pragma once

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "slalom/expr/expr.hpp"

namespace slalom::nlp {

/// constant + sum of coefficient * variable + sum of coefficient * nonlinear expression.
struct AffineParts {
  double constant = 0;
  std::vector<std::pair<std::uint32_t, double>> linear;  ///< variable, coefficient; each once
  std::vector<std::pair<const expr::Node*, double>> nonlinear;
};

using VariableIndex = std::unordered_map<const expr::Node*, std::uint32_t>;

/// Takes `output` apart down to where it stops being a sum of multiples; `index` numbers the
/// symbols. One pass against the order of evaluation, so that shared sums cost nothing extra.
AffineParts affine_parts(const expr::Expr& output, const VariableIndex& index);

}  // namespace slalom::nlp
