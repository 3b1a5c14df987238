#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "slalom/kkt/system.hpp"

namespace slalom::kkt {

inline constexpr std::size_t kNoFront = std::numeric_limits<std::size_t>::max();

/// Which rows and numbers of a system belong to one front. Ids: variable i is i, the multiplier of
/// equation e is variables + e.
struct FrontPlan {
  std::vector<std::uint32_t> ids;  ///< of its rows: to eliminate, then those it touches later on
  std::size_t own = 0;             ///< how many of them it may eliminate
  std::size_t parent = kNoFront;   ///< takes over what is left; behind it in the list
  /// In a chain: equations with an entry in this front or one before it, for Values::minimum_only.
  std::size_t equations_so_far = kNoFront;

  struct Term {
    std::uint32_t source, a, b;  ///< number and the two ids it stands between
  };
  std::vector<Term> hessian, diagonal, jacobian, flexibility;
};

/// A chain of fronts, one for each stage and one for the border. A front knows the rows of later
/// stages that it or a front before it has entries of.
std::vector<FrontPlan> plan_chain(const Pattern& pattern);
/// A forest of fronts in an order that keeps the factors sparse, blind to the stages.
std::vector<FrontPlan> plan_forest(const Pattern& pattern);

/// Gives each entry to the front, of `front_of` its two ids, that comes first. Entries of fixed
/// variables are left out.
void distribute(const Pattern& pattern, const std::vector<std::size_t>& front_of,
                std::vector<FrontPlan>& plans);

/// Calls add(id a, id b, number) for every number of the plan.
template <class Add>
void for_terms(const FrontPlan& plan, const Values& values, Add add) {
  for (const auto& t : plan.hessian) add(t.a, t.b, values.hessian[t.source]);
  for (const auto& t : plan.diagonal) add(t.a, t.b, values.diagonal[t.source]);
  for (const auto& t : plan.jacobian) add(t.a, t.b, values.jacobian[t.source]);
  for (const auto& t : plan.flexibility) add(t.a, t.b, -values.flexibility[t.source]);
}

}  // namespace slalom::kkt
