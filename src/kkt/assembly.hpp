#pragma once

#include <cstdint>
#include <vector>

#include "slalom/kkt/system.hpp"

namespace slalom::kkt {

/// Which rows and numbers of a system belong to one front. Ids: variable i is i, the multiplier of
/// equation e is variables + e.
struct FrontPlan {
  std::vector<std::uint32_t> ids;    ///< of its rows: to eliminate, next stage's variables, border
  std::size_t own = 0;               ///< how many of them it may eliminate
  std::size_t equations_so_far = 0;  ///< in this front and those before it

  struct Term {
    std::uint32_t source, a, b;  ///< number and the two ids it stands between
  };
  std::vector<Term> hessian, diagonal, jacobian, flexibility;
};

/// Plans of a chain of fronts, one a stage and one for the border. Throws Error for an entry that
/// couples stages which are no neighbours.
std::vector<FrontPlan> plan_chain(const Pattern& pattern);
/// The whole system as one front.
std::vector<FrontPlan> plan_whole(const Pattern& pattern);

/// Calls add(id a, id b, number) for every number of the plan.
template <class Add>
void for_terms(const FrontPlan& plan, const Values& values, Add add) {
  for (const auto& t : plan.hessian) add(t.a, t.b, values.hessian[t.source]);
  for (const auto& t : plan.diagonal) add(t.a, t.b, values.diagonal[t.source]);
  for (const auto& t : plan.jacobian) add(t.a, t.b, values.jacobian[t.source]);
  for (const auto& t : plan.flexibility) add(t.a, t.b, -values.flexibility[t.source]);
}

}  // namespace slalom::kkt
