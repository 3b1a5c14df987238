// A whole drive of a planner that verifies, among boxes, a polygon and a car that turns, with the
// vehicle's body.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "slalom/planner/planner.hpp"
#include "slalom/vehicle/plant.hpp"
#include "slalom/world/footprint.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;
using world::Obstacle;
using world::Polygon;

Obstacle with(Obstacle o, Polygon outline) {
  o.outline = std::make_shared<Polygon>(std::move(outline));
  o.a = o.b = o.outline->reach();
  return o;
}

/// A street 15 m wide eastwards.
Task street() {
  Task task;
  task.planner.method = Method::verified;
  task.planner.verified_clearance = 0.3;
  task.planner.kept_clearance = 0.25;
  task.vehicle.footprint = FootprintKind::rectangle;
  task.goal = {.x = 140, .y = 0, .psi = 0, .sigma = 8};
  task.region = {-20, 170, -7.5, 7.5};
  const auto car = Polygon::rectangle(4.5, 1.8);
  task.obstacles = {
      with({.name = "parked", .x = 35, .y = -2.5, .psi = 0.3}, car),
      with({.name = "lorry", .x = 60, .y = 4.5, .psi = -0.15}, Polygon::rectangle(12, 2.5)),
      with({.name = "rock", .x = 95, .y = -1}, Polygon({{-1, -1}, {2, 0}, {0, 1.5}}, "rock")),
      with({.name = "turner"}, car)};
  task.obstacles.back().trajectory = std::make_shared<world::TableTrajectory>(
      std::vector<world::TrajectoryRow>{{0, 90, 30, -1.57},
                                        {4, 90, 12, -1.57},
                                        {5.5, 92, 4, -1.9},
                                        {7, 86, 1, -3.0},
                                        {9, 70, 3, -3.14}},
      world::BeyondEnd::stands, world::BeyondEnd::goes_on, "turner");
  return task;
}

/// Drives the plans of cycles .2 s long on the plant. The least distance of the body from any
/// shape. Where belief is the truth, every plan is verified.
double driven(const Task& truth, const Task& believed, int cycles) {
  const bool right = believed.planner.prediction == Prediction::known;
  const Plant plant(truth.vehicle, 1e-9, 0.02);
  const world::Footprint body(truth.vehicle);
  Planner planner(believed);
  Request request;
  request.t0 = -0.2;
  request.t_start = 0;
  request.X0p = {0, 0, 0, 0, 0, 0, 10, 0};
  double least = INFINITY;
  for (int cycle = 0; cycle < cycles; ++cycle) {
    const Plan plan = planner.plan(request);
    EXPECT_TRUE(plan.certificate.verified || !right) << cycle << ": " << plan.certificate.refused;
    if (!usable(plan)) return -INFINITY;
    const auto signal = control_signal(plan);
    State x = request.X0p;
    for (int part = 0; part < 20; ++part) {
      const double t = plan.t_start + 0.01 * part;
      for (const auto& o : truth.obstacles)
        if (o.present(t, t)) least = std::min(least, body.distance(o, x, t));
      x = plant.predict(x, signal, t, t + 0.01);
    }
    if (truth.arrived(x, 0)) return least;
    request.X0p = x;
    request.t0 += 0.2;
    request.t_start += 0.2;
  }
  ADD_FAILURE() << "it does not arrive";
  return least;
}

TEST(BodiesDrive, KeepsItsDistanceFromEveryShape) {
  const Task task = street();
  const double least = driven(task, task, 100);
  EXPECT_GE(least, task.planner.kept_clearance - 1e-3);
  EXPECT_LT(least, 1.5) << "or the street is empty";
}

// At a metre a second all of twelve starts arrive; at .2 m/s five hit the car.
TEST(BodiesDrive, AMarginThatGrowsKeepsOffACarThatTurnsUnexpectedly) {
  Task believed = street();
  believed.planner.prediction = Prediction::constant_turn;
  believed.obstacles.back().margin_rate = 1;
  EXPECT_GT(driven(street(), believed, 150), 0);
}

}  // namespace
}  // namespace slalom::planner
