#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "slalom/kkt/row_blocks.hpp"
#include "slalom/kkt/system.hpp"

namespace slalom::kkt {

/// H + sum over inequality rows r of w_r J_r' J_r. This eliminates the rows before the system is
/// factorised, in time linear in their number, and no matrix grows with them.
class CondensedHessian {
 public:
  /// `hessian`: one triangle of H. `rows`: the Jacobian by row blocks; those whose first row is an
  /// inequality are condensed.
  CondensedHessian(std::span<const std::uint32_t> hessian_row,
                   std::span<const std::uint32_t> hessian_col, const RowBlocks& rows,
                   std::span<const char> inequality);

  /// Places of the sum's entries: those of H first, in its order.
  const std::vector<Pattern::Place>& places() const { return places_; }
  /// `weights`: one for each row, >= 0. `out`: one for each place.
  void sum(std::span<const double> hessian, std::span<const double> jacobian,
           std::span<const double> weights, std::span<double> out) const;

  /// weights[row + i] * jacobian[first + i] * jacobian[second + i], added to place target + i
  /// (step 1), all to target (step 0), or to places[target + i] of the index list (step -1).
  struct Product {
    std::uint32_t row, count, first, second, target;
    std::int32_t step;
  };

 private:
  std::vector<Pattern::Place> places_;
  std::vector<Product> products_;
  std::vector<std::uint32_t> index_;
};

}  // namespace slalom::kkt
