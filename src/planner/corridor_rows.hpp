#pragma once

#include <vector>

#include "slalom/ocp/problem.hpp"
#include "slalom/vehicle/state.hpp"
#include "slalom/world/footprint.hpp"
#include "slalom/world/road.hpp"

namespace slalom::planner {

/// What of the vehicle an edge touches first, as discs of half its width: at both ends, rear first,
/// for a straight edge, and in the middle, for one that bends towards the road. A point is one disc
/// of no radius.
std::vector<world::Disc> edge_discs(const world::Footprint& footprint);

/// Rows of an OCP that keep discs of the vehicle within a road's edges. At each point of the mesh
/// an edge is the circle that touches it, with its curvature, where it is nearest to the guess: of
/// the vector d from there to the disc's centre, n . d - k |d|^2 / 2 >= r - k r^2 / 2 for a disc of
/// radius r, where n points inwards and k is the edge's curvature, positive where the road lies on
/// the side of the circle's centre. That is the distance to the circle, to second order in it. An
/// answer d off the guess along the road is wrong by the edge's change of curvature times |d|^3 /
/// 6: the front axle therefore stays as near to the guess, along the road, as its curvature allows.
class CorridorRows {
 public:
  /// The family's symbols.
  struct Symbols {
    ocp::Expr x, y, nx, ny, bend, spare, ahead;
  };
  /// Adds the families to a problem, with X, Y and PSI of its states.
  CorridorRows(ocp::Problem& problem, const ocp::Expr& X, const ocp::Expr& Y, const ocp::Expr& psi,
               const world::Footprint& footprint);

  /// Sets the rows for a guess's states at the points of the mesh, at `after` seconds from the
  /// first one on; discs keep `margin` [m] from the edges, or what the first one has, which grows
  /// from there.
  void set(ocp::Problem& problem, const world::Road& road, const std::vector<vehicle::State>& at,
           const std::vector<double>& after, double margin) const;

 private:
  void set_along(ocp::Problem& problem, const world::Road& road,
                 const std::vector<vehicle::State>& at) const;

  std::vector<world::Disc> discs_;
  ocp::ConstraintId rows_, along_;
};

}  // namespace slalom::planner
