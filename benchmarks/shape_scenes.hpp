#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "slalom/world/polygon.hpp"
#include "slalom/world/pose.hpp"

namespace slalom::bench {

/// A rectangle [m] that goes straight on and may turn.
struct Body {
  double length, width;
  world::Pose pose;  ///< at t = 0

  world::Pose at(double t) const {
    world::Pose p = pose;
    p.x += p.vx * t;
    p.y += p.vy * t;
    p.psi += p.omega * t;
    return p;
  }
  /// In its own frame, from the front left one counter-clockwise.
  std::vector<world::Point> corners() const {
    return world::Polygon::rectangle(length, width).corners();
  }
  std::vector<world::Point> corners_at(double t) const {
    std::vector<world::Point> out;
    for (const auto& p : corners()) out.push_back(at(t).to_world(p));
    return out;
  }
};

/// From (0, 0), heading along x at `speed`, to `goal` with any speed, the front axle within y_min
/// and y_max; `way` are places of a way that passes the bodies, between start and goal.
struct ShapeScene {
  std::string name;
  std::vector<Body> bodies;
  double speed = 8, y_min = -6, y_max = 6;  ///< [m/s], [m]
  world::Point goal;
  std::vector<world::Point> way;

  bool turns() const {
    for (const Body& b : bodies)
      if (b.pose.omega != 0) return true;
    return false;
  }
};

inline const std::vector<std::string>& shape_scenes() {
  static const std::vector<std::string> names = {"parked row", "gap", "oncoming", "street"};
  return names;
}

/// The same numbers on every machine.
class Draw {
 public:
  explicit Draw(unsigned seed) : engine_(seed) {}
  double operator()(double least, double most) {
    return least + (most - least) * static_cast<double>(engine_() >> 11U) * 0x1p-53;
  }

 private:
  std::mt19937_64 engine_;
};

/// Four cars parked at a slant on the right, of which each leaves the lane's left side free.
inline ShapeScene parked_row(Draw& draw) {
  ShapeScene scene{
      .name = "parked row", .bodies = {}, .y_min = -3, .y_max = 4, .goal = {46, 0}, .way = {}};
  for (int k = 0; k < 4; ++k)
    scene.bodies.push_back({4.5, 1.8, {12 + 6.5 * k, draw(-1.4, -0.8), draw(-0.15, 0.15)}});
  scene.way = {{10, 2}, {34, 2}};
  return scene;
}

/// Two lorries side by side, at a slant, and a way between them that is .7 m to 1.4 m wider than
/// the vehicle; there is no way around.
inline ShapeScene gap(Draw& draw) {
  constexpr double kLength = 8, kWidth = 2.6, kVehicle = 2;
  const world::Pose slot{24, draw(-1, 1), draw(-0.25, 0.25)};
  const double half = (kVehicle + draw(0.7, 1.4) + kWidth) / 2;
  ShapeScene scene{
      .name = "gap", .bodies = {}, .y_min = -3.5, .y_max = 3.5, .goal = {46, 0}, .way = {}};
  for (const double side : {1., -1.}) {
    const auto p = slot.to_world({draw(-1, 1), side * half});
    scene.bodies.push_back({kLength, kWidth, {p.x, p.y, slot.psi + side * draw(0, 0.05)}});
  }
  scene.way = {slot.to_world({-7, 0}), slot.to_world({9, 0})};
  return scene;
}

/// A lorry that comes at us, slides to one side and turns.
inline ShapeScene oncoming(Draw& draw) {
  const double off = draw(0.3, 1.2) * (draw(-1, 1) < 0 ? -1 : 1);
  ShapeScene scene{.name = "oncoming", .bodies = {}, .speed = 10, .goal = {60, 0}, .way = {}};
  scene.bodies.push_back(
      {7, 2.4, {58, off, M_PI + draw(-0.3, 0.3), draw(-9, -6), draw(-0.2, 0.2), draw(-0.2, 0.2)}});
  const double aside = off > 0 ? -3 : 3;
  scene.way = {{22, aside}, {40, aside}};
  return scene;
}

/// Eight cars parked at a slant on each side, two of which stand far out.
inline ShapeScene street(Draw& draw) {
  ShapeScene scene{
      .name = "street", .bodies = {}, .y_min = -5, .y_max = 5, .goal = {64, 0}, .way = {}};
  for (const double side : {1., -1.})
    for (int k = 0; k < 8; ++k) {
      const bool out = k == (side > 0 ? 5 : 2);
      const double off = out ? draw(2, 2.4) : draw(3.4, 3.8);
      scene.bodies.push_back({4.5, 1.8, {8 + 6.5 * k, side * off, draw(-0.1, 0.1)}});
      if (out)
        scene.way.insert(scene.way.begin() + (side < 0 ? 0 : scene.way.size()),
                         {8 + 6.5 * k, -side});
    }
  return scene;
}

inline ShapeScene shape_scene(const std::string& name, unsigned seed) {
  Draw draw(seed);
  return name == "parked row" ? parked_row(draw)
         : name == "gap"      ? gap(draw)
         : name == "street"   ? street(draw)
                              : oncoming(draw);
}

}  // namespace slalom::bench
