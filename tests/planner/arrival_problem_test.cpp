#include "../../src/planner/arrival_problem.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "../../src/planner/road_reference.hpp"
#include "slalom/vehicle/plant.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;

/// Round a bend of radius 30 m as fast as it goes, with the least wheel load that is verified.
double least_load(double verified) {
  Task task;
  task.vehicle.footprint = FootprintKind::rectangle;
  task.planner.method = Method::verified;
  task.planner.arrival_N = 20;
  task.planner.verified_wheel_load = verified;
  std::vector<world::RoadPoint> line;
  for (double angle = 0; angle < 2; angle += 0.1)
    line.push_back({30 * std::sin(angle), 30 - 30 * std::cos(angle), 4, 4});
  task.road =
      std::make_shared<world::Road>(line, false, std::vector<std::vector<world::Point>>{}, "bend");
  task.goal.s = 45;
  task.goal = world::placed(task.goal, task.road.get());
  const State start = {0.5, 0, 0, 0, 0.02, 0, 8, 0};
  const Motion guess = road_reference(*task.road, start, 0, 5.8, 0, task.vehicle);
  ArrivalProblem problem(task, {});
  nlp::Options options;
  options.floor = task.planner.arrival_floor;
  options.tol = task.planner.tol;
  options.max_iterations = 400;
  const auto solver = nlp::make_solver(to_string(task.planner.solver));
  const auto answer = problem.solve(guess, start, {}, 0.05, *solver, options);
  double least = HUGE_VAL;
  if (!answer) return least;
  const Plant plant(task.vehicle, 1e-9, 0.02);
  for (const State& x : answer->states)
    for (const double load : plant.dynamics().wheel_loads(x)) least = std::min(least, load);
  return least;
}

// A vehicle's own Fz_min may be less than what is verified: an answer with no more would be
// refused.
TEST(ArrivalProblem, KeepsTheWheelLoadsThatVerificationAsksFor) {
  EXPECT_LT(least_load(400), 3000) << "as fast as it goes";
  const double kept = least_load(4000);
  EXPECT_GT(kept, 4000);
  EXPECT_LT(kept, 5000) << "it is solved, and does not give away more";
}

// The last plans of a drive that has so much time begin when that is up.
TEST(ArrivalProblem, HasNoAnswerOnceTheTimeIsUp) {
  Task task;
  task.vehicle.footprint = FootprintKind::rectangle;
  task.planner.method = Method::verified;
  task.planner.arrival_N = 20;
  task.road = std::make_shared<world::Road>(
      std::vector<world::RoadPoint>{{0, 0, 4, 4}, {100, 0, 4, 4}, {200, 0, 4, 4}}, false,
      std::vector<std::vector<world::Point>>{}, "straight");
  task.goal = {};
  task.goal.time = 7.5;
  task.goal = world::placed(task.goal, task.road.get());
  const State start = {20, 0, 0, 0, 0, 0, 8, 0};
  ArrivalProblem problem(task, {});
  nlp::Options options;
  options.floor = task.planner.arrival_floor;
  options.max_iterations = 400;
  const auto solver = nlp::make_solver(to_string(task.planner.solver));
  const auto from = [&](double t) {
    const Motion guess = road_reference(*task.road, start, t, 3, 0, task.vehicle);
    return problem.solve(guess, start, {}, 0.05, *solver, options);
  };
  EXPECT_TRUE(from(5).has_value());
  EXPECT_GT(problem.iterations(), 0);
  EXPECT_FALSE(from(7.6).has_value());
  EXPECT_EQ(problem.iterations(), 0);
}

// Five rows about each point of a close obstacle, or the point's alone.
TEST(ArrivalProblem, HasRowsBetweenItsPointsAsTheSettingsSay) {
  Task task;
  task.planner.method = Method::verified;
  task.planner.arrival_N = 20;
  task.goal = {0, 180, std::numbers::pi / 2, 15};
  const auto rows = [&](bool close, bool between) {
    task.planner.rows_between = between;
    ArrivalProblem::Obstacles obstacles;
    if (close) obstacles.close = {{"O1", 1, 80, 4, 4, 1, 0}};
    return ArrivalProblem(task, ArrivalProblem::room_for(obstacles)).rows();
  };
  const std::size_t none = rows(false, true);
  EXPECT_GT(rows(true, false), none);
  EXPECT_EQ(rows(true, true) - none, 5 * (rows(true, false) - none));
}

}  // namespace
}  // namespace slalom::planner
