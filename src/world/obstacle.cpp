#include "slalom/world/obstacle.hpp"

#include "slalom/world/ellipse.hpp"

namespace slalom::world {

double distance(const Obstacle& obstacle, double x, double y, double t) {
  return signed_distance_to_ellipse(x - obstacle.x_at(t), y - obstacle.y_at(t), obstacle.a,
                                    obstacle.b);
}

}  // namespace slalom::world
