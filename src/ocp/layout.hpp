#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "slalom/nlp/problem.hpp"
#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/scheme.hpp"

namespace slalom::ocp {

inline constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// Where each quantity stands in the NLP's vector of variables: states, controls, slacks, globals,
/// excesses of soft rows; of a state or control the points follow each other, so that a formula
/// runs over them as over one vector.
struct Layout {
  std::size_t nx = 0, nu = 0;
  std::vector<double> tau;  ///< of each point, in order of time
  std::vector<std::size_t> point_stage;
  std::vector<std::size_t>
      state_points;                     ///< the points that have states: not all in compressed form
  std::vector<std::size_t> state_slot;  ///< of each point: its place among these, or kNone
  std::vector<std::size_t> node_point;  ///< point of each mesh node
  std::vector<std::size_t> slack;       ///< variable of each slack
  std::size_t t0 = 0, tf = 0, static_parameters = 0, integrals = 0;  ///< the first of each
  std::vector<std::size_t> lifted_initial, lifted_final;  ///< by state; kNone where not used
  std::vector<std::uint32_t> variable_stage;
  std::size_t variables = 0;

  std::size_t points() const { return tau.size(); }
  std::size_t intervals() const { return node_point.size() - 1; }
  bool has_state(std::size_t point) const { return state_slot[point] != kNone; }
  std::size_t state(std::size_t point, std::size_t i) const {
    return i * state_points.size() + state_slot[point];
  }
  std::size_t control(std::size_t point, std::size_t i) const {
    return nx * state_points.size() + i * points() + point;
  }
  /// A variable more, at the end of all.
  std::size_t append(std::size_t stage) {
    variable_stage.push_back(static_cast<std::uint32_t>(stage));
    return variables++;
  }
  /// "node 3", or "point 1 of interval 3" for an interior one.
  std::string point_name(std::size_t point) const;
};

/// Which end values need a lifted copy.
struct Lifts {
  std::vector<char> initial, final;
};

Layout make_layout(const Problem& problem, const Mesh& mesh, const Schemes& schemes,
                   const Lifts& lifts);

/// Bounds and scales of all variables (in the NLP's scaled units), as `problem` has them now.
void fill_variable_limits(const Problem& problem, const Layout& layout,
                          const std::vector<double>& scale, nlp::Limits& limits);
std::vector<double> variable_scales(const Problem& problem, const Layout& layout);
std::string variable_name(const Problem& problem, const Layout& layout, std::size_t index);

}  // namespace slalom::ocp
