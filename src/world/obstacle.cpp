#include "slalom/world/obstacle.hpp"

#include "slalom/world/ellipse.hpp"

namespace slalom::world {

const OptionTable<Obstacle>& obstacle_options() {
  static const auto table = [] {
    const auto any = OptionRange::any();
    OptionTable<Obstacle> t;
    t.text("name", &Obstacle::name,
           "Name in messages and on the command line; O1, O2, ... if left out.")
        .real("x", &Obstacle::x, any, "m", "East position of the centre at t = 0.")
        .real("y", &Obstacle::y, any, "m", "North position of the centre at t = 0.")
        .real("a", &Obstacle::a, OptionRange::positive(), "m", "Semi-axis along x.")
        .real("b", &Obstacle::b, OptionRange::positive(), "m", "Semi-axis along y.")
        .real("vx", &Obstacle::vx, any, "m/s", "Constant speed eastward.")
        .real("vy", &Obstacle::vy, any, "m/s", "Constant speed northward.");
    return t;
  }();
  return table;
}

double distance(const Obstacle& obstacle, double x, double y, double t) {
  return signed_distance_to_ellipse(x - obstacle.x_at(t), y - obstacle.y_at(t), obstacle.a,
                                    obstacle.b);
}

}  // namespace slalom::world
