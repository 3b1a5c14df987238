#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "slalom/ocp/problem.hpp"
#include "slalom/vehicle/model.hpp"

namespace slalom::planner {

/// The model's expressions with the problem's own symbols in place of the model's.
template <std::size_t N>
std::array<ocp::Expr, N> in_terms_of(const std::array<ocp::Expr, N>& values,
                                     const vehicle::Model& model,
                                     const std::array<ocp::Expr, vehicle::kStates>& states,
                                     const std::array<ocp::Expr, vehicle::kControls>& controls) {
  std::vector<ocp::Expr> from(model.state.begin(), model.state.end());
  from.insert(from.end(), model.control.begin(), model.control.end());
  std::vector<ocp::Expr> to(states.begin(), states.end());
  to.insert(to.end(), controls.begin(), controls.end());
  const auto replaced = expr::substitute({values.begin(), values.end()}, from, to);
  std::array<ocp::Expr, N> result;
  std::copy(replaced.begin(), replaced.end(), result.begin());
  return result;
}

}  // namespace slalom::planner
