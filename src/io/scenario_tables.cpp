#include "scenario_tables.hpp"

namespace slalom::io {

using vehicle::State;

Start::Start(const State& state)
    : x(state[vehicle::X]),
      y(state[vehicle::Y]),
      v(state[vehicle::V]),
      r(state[vehicle::R]),
      psi(state[vehicle::PSI]),
      sa(state[vehicle::SA]),
      ux(state[vehicle::UX]),
      ax(state[vehicle::AX]) {}

State Start::state() const {
  return {x, y, v, r, psi, sa, ux, ax};
}

const OptionTable<Start>& start_options() {
  static const auto table = [] {
    const auto any = OptionRange::any();
    OptionTable<Start> t;
    t.real("x", &Start::x, any, "m", "East position of the front axle's centre.")
        .real("y", &Start::y, any, "m", "North position of the front axle's centre.")
        .real("v", &Start::v, any, "m/s", "Lateral speed of the centre of gravity, left positive.")
        .real("r", &Start::r, any, "rad/s", "Yaw rate, counter-clockwise positive.")
        .real("psi", &Start::psi, any, "rad", "Heading from +x, counter-clockwise.")
        .real("sa", &Start::sa, any, "rad", "Front steering angle, left positive.")
        .real("ux", &Start::ux, any, "m/s", "Longitudinal speed.")
        .real("ax", &Start::ax, any, "m/s^2", "Longitudinal acceleration.");
    return t;
  }();
  return table;
}

const OptionTable<world::Goal>& goal_options() {
  using world::Goal;
  static const auto table = [] {
    const auto any = OptionRange::any();
    OptionTable<Goal> t;
    t.real("x", &Goal::x, any, "m", "East position of the goal.")
        .real("y", &Goal::y, any, "m", "North position of the goal.")
        .real("psi", &Goal::psi, any, "rad", "Direction of the line through the goal to keep to.")
        .real("sigma", &Goal::sigma, OptionRange::positive(), "m",
              "Half-width of the square around the goal; within it the vehicle has arrived.");
    return t;
  }();
  return table;
}

const OptionTable<world::Region>& region_options() {
  using world::Region;
  static const auto table = [] {
    const auto any = OptionRange::any();
    OptionTable<Region> t;
    t.real("x_min", &Region::x_min, any, "m",
           "West side of the box a plan stays in; none if left out.")
        .real("x_max", &Region::x_max, any, "m", "East side; none if left out.")
        .real("y_min", &Region::y_min, any, "m", "South side; none if left out.")
        .real("y_max", &Region::y_max, any, "m", "North side; none if left out.");
    return t;
  }();
  return table;
}

const OptionTable<world::Obstacle>& obstacle_options() {
  using world::Obstacle;
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

const OptionTable<ObstacleEntry>& repeat_options() {
  static const auto table = [] {
    OptionTable<ObstacleEntry> t;
    t.integer("repeat", &ObstacleEntry::repeat, OptionRange::closed(1, 1000), "1",
              "How many of these stand in a row; they are named name1, name2, ...")
        .vector("step", &ObstacleEntry::step, OptionRange::any(), "m",
                "From the centre of one to the centre of the next, [east, north].");
    return t;
  }();
  return table;
}

Section start_section(Start& start) {
  Section section("start");
  section.add(start_options(), start).add_degrees("psi").add_degrees("sa");
  return section;
}

Section goal_section(world::Goal& goal) {
  Section section("goal");
  section.add(goal_options(), goal).add_degrees("psi");
  return section;
}

Section region_section(world::Region& region) {
  Section section("region");
  section.add(region_options(), region);
  return section;
}

Section obstacle_section(world::Obstacle& obstacle, const std::string& path) {
  Section section(path);
  section.add(obstacle_options(), obstacle);
  OptionInfo radius;
  radius.name = "r";
  radius.kind = OptionKind::real;
  radius.range = OptionRange::positive();
  radius.unit = "m";
  radius.doc = "Radius of a circle, instead of a and b.";
  section.add(
      {radius,
       [&obstacle](const OptionValue& value) { obstacle.a = obstacle.b = std::get<double>(value); },
       [&obstacle] { return OptionValue(obstacle.a); },
       {"a", "b"}});
  return section;
}

}  // namespace slalom::io
