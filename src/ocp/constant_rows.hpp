#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "slalom/nlp/problem.hpp"

namespace slalom::ocp {

/// Takes the bounds off equations that no free variable meets and that hold, such as the link of
/// two fixed times: they ask for nothing, and counted as equations there would be too many. One
/// that does not hold stays, for the solver to name.
class ConstantRows {
 public:
  explicit ConstantRows(const nlp::Structure& shape);
  /// `rows` gives the rows' values at a point.
  void relax(const std::function<std::vector<double>(const std::vector<double>& x)>& rows,
             nlp::Limits& limits) const;

 private:
  std::vector<std::uint32_t> columns_;  ///< row by row
  std::vector<std::size_t> begin_;      ///< of each row's in `columns_`, and the end of the last
};

}  // namespace slalom::ocp
