#include "region_rows.hpp"

#include <cmath>
#include <string>
#include <utility>

namespace slalom::planner {

using namespace vehicle;
using ocp::Bounds;
using ocp::Expr;

std::array<Bounds, 2> region_bounds(const world::Region& region,
                                    const world::Footprint& footprint) {
  if (!footprint.is_point()) return {};
  return {Bounds{region.x_min, region.x_max}, Bounds{region.y_min, region.y_max}};
}

void add_region_rows(ocp::Problem& problem, const world::Region& region,
                     const world::Footprint& footprint, const std::array<Expr, kStates>& states,
                     ocp::Points points) {
  const std::array names = {" front left", " rear left", " rear right", " front right"};
  const Expr c = cos(states[PSI]), s = sin(states[PSI]);
  for (std::size_t k = 0; k < footprint.corners().size(); ++k) {
    const auto [ahead, aside] = footprint.corners()[k];
    const auto add = [&](const std::string& name, const Expr& room, double side) {
      if (std::isfinite(side)) problem.path(name + names[k], room, Bounds::at_least(0), points);
    };
    const Expr x = states[X] + ahead * c - aside * s, y = states[Y] + ahead * s + aside * c;
    add("region x_min", x - region.x_min, region.x_min);
    add("region x_max", region.x_max - x, region.x_max);
    add("region y_min", y - region.y_min, region.y_min);
    add("region y_max", region.y_max - y, region.y_max);
  }
}

}  // namespace slalom::planner
