#include "slalom/world/road.hpp"

#include <array>

#include "scenario.hpp"

namespace slalom::python {
namespace {

Matrix points_of(const std::vector<world::Point>& points) {
  return table(points, 2, [](const world::Point& p) { return std::array<double, 2>{p.x, p.y}; });
}

}  // namespace

void bind_road(nb::module_& module) {
  using world::Road;
  nb::class_<Road>(module, "Road", doc::world_Road)
      .def_prop_ro(
          "points",
          [](const Road& r) {
            return table(r.points(), 4, [](const world::RoadPoint& p) {
              return std::array<double, 4>{p.x, p.y, p.right, p.left};
            });
          },
          nb::rv_policy::move,
          "Points of the reference line [m]: x, y, and how far the road reaches to the right and "
          "to "
          "the left.")
      .def_prop_ro(
          "lanes",
          [](const Road& r) {
            nb::list lanes;
            for (const auto& lane : r.lanes())
              lanes.append(nb::cast(points_of(lane), nb::rv_policy::move));
            return lanes;
          },
          nb::sig("def lanes(self) -> list[numpy.typing.NDArray[numpy.float64]]"),
          "Lines that are drawn between lanes, each of points (x, y) [m].")
      .def_prop_ro("closed", &Road::closed, "Whether its last point joins its first.")
      .def_prop_ro("length", &Road::length, doc::world_Road_length)
      .def(
          "edge",
          [](const Road& r, bool left, double step) { return points_of(r.edge(left, step)); },
          "left"_a, "step"_a = 1.0, nb::rv_policy::move, doc::world_Road_edge)
      .def(
          "at",
          [](const Road& r, double s) {
            const auto place = r.at(s);
            return std::array<double, 5>{place.x, place.y, place.psi, place.right, place.left};
          },
          "s"_a,
          "The road at s [m] along its line: x, y [m], direction psi [rad], widths to the right "
          "and "
          "to the left [m].");
}

}  // namespace slalom::python
