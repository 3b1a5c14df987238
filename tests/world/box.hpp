#pragma once

#include <memory>

#include "slalom/world/obstacle.hpp"

namespace slalom::world::test {

/// A box that stands about (x, y), its length in the direction psi.
inline Obstacle box(double x, double y, double length, double width, double psi) {
  Obstacle o{"box", x, y};
  o.outline = std::make_shared<Polygon>(Polygon::rectangle(length, width));
  o.a = o.b = o.outline->reach();
  o.psi = psi;
  return o;
}

}  // namespace slalom::world::test
