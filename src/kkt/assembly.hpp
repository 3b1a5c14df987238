#pragma once

#include <cstdint>
#include <vector>

#include "front.hpp"
#include "slalom/kkt/system.hpp"

namespace slalom::kkt {

/// Which numbers of a system land where in one front; rows and columns count from the front's first
/// own row (what earlier fronts passed on stands before it).
struct FrontPlan {
  std::vector<std::uint32_t> ids;  ///< of its own rows: to eliminate, next stage, border
  std::size_t own = 0;             ///< how many of them it may eliminate
  std::size_t next = 0;            ///< variables of the next stage among them

  struct Copy {
    std::uint32_t source, row, col;
  };
  struct Product {
    std::uint32_t weight, first, second, row, col;
  };
  std::vector<Copy> hessian, diagonal, jacobian, row_diagonal;
  std::vector<Product> products;  ///< w * J * J of the condensed inequalities
};

/// Ids: variable i is i, the multiplier of row r is variables + r.
/// Plans of a chain of fronts, one a stage and one for the border. Throws Error for an entry that
/// couples stages which are no neighbours.
std::vector<FrontPlan> plan_chain(const Pattern& pattern);
/// The whole system as one front.
FrontPlan plan_whole(const Pattern& pattern);

/// Adds the numbers into the front, behind `offset` rows passed on from earlier.
void assemble(const FrontPlan& plan, const Values& values, std::size_t offset, Front& front);

}  // namespace slalom::kkt
