// Ways to keep a vehicle's rectangle off rectangles in an OCP, on the same problems: discs that
// cover the body; superellipses; how far they are apart along the axes of both, as the planner has
// it; a separating line as variables; the dual of the distance. One line of JSON for each problem
// and way.
//
//   bench_shape_forms [--forms discs-0.2,line] [--scenes gap] [--seeds 6] [--runs 5]
//                     [--intervals 40] [--floor 0]

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "shape_rows.hpp"
#include "shape_scenes.hpp"
#include "slalom/base/timer.hpp"
#include "slalom/ocp/guess.hpp"
#include "slalom/ocp/interpolant.hpp"
#include "slalom/ocp/prepared.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::bench {
namespace {

using nlohmann::json;
using ocp::Bounds;
using ocp::Expr;

/// How far to the left, and how much slower, the second solve begins [m], [m/s].
constexpr double kMoved = 0.1;
/// Solves are not timed again after so long [s].
constexpr double kLongEnough = 0.5;

/// The way as a guess: at even speed from place to place, heading along.
struct Way {
  std::vector<world::Point> places;
  std::vector<double> along;

  explicit Way(const ShapeScene& scene, bool straight) : places{{0, 0}} {
    if (!straight) places.insert(places.end(), scene.way.begin(), scene.way.end());
    places.push_back(scene.goal);
    along.push_back(0);
    for (std::size_t k = 1; k < places.size(); ++k)
      along.push_back(along.back() + (places[k] - places[k - 1]).norm());
  }
  world::Pose at(double s) const {
    std::size_t k = 1;
    while (k + 1 < along.size() && s > along[k]) ++k;
    const auto step = places[k] - places[k - 1];
    const auto p = places[k - 1] + step * ((s - along[k - 1]) / (along[k] - along[k - 1]));
    return {p.x, p.y, std::atan2(step.y, step.x)};
  }
};

/// The kinematic single-track model, its place that of the front axle's centre: in the least time,
/// with little of steering rate and acceleration.
struct Statement {
  ocp::Problem problem;
  Vehicle vehicle;
  Expr x, y, psi;

  Statement(const ShapeScene& scene, double slack) : problem(scene.name) {
    const vehicle::Parameters& car = vehicle.parameters;
    x = problem.state("x");
    y = problem.state("y", {scene.y_min, scene.y_max});
    psi = problem.state("psi", {-1.5, 1.5});
    const Expr v = problem.state("v", {1, 15}), steer = problem.state("steer", {-0.5, 0.5});
    const Expr rate = problem.control("rate", {-0.7, 0.7}), pull = problem.control("pull", {-6, 3});
    const Expr turn = v * sin(steer) / (car.la + car.lb);
    problem.dynamics(x, v * cos(psi + steer));
    problem.dynamics(y, v * sin(psi + steer));
    problem.dynamics(psi, turn);
    problem.dynamics(v, pull);
    problem.dynamics(steer, rate);
    problem.path("lateral", v * turn, {-5, 5});
    const double first[] = {0, slack, 0, scene.speed - slack, 0};
    const Expr states[] = {x, y, psi, v, steer};
    for (int k = 0; k < 5; ++k) problem.initial_bounds(states[k], Bounds::equal(first[k]));
    problem.final_bounds(x, Bounds::equal(scene.goal.x));
    problem.final_bounds(y, Bounds::equal(scene.goal.y));
    problem.final_bounds(psi, Bounds::equal(0));
    problem.final_time({0.5, 30}, Way(scene, true).along.back() / scene.speed);
    problem.mayer("time", problem.final_time());
    problem.lagrange("effort", 0.02 * square(pull) + 2 * square(rate));
  }
};

/// Of the vehicle's rectangle from the bodies, along the answer [m].
double least_gap(const ShapeScene& scene, const Statement& statement, const ocp::Solution& answer) {
  constexpr int kLooks = 2000;
  const ocp::Interpolant between(statement.problem, answer.trajectory, answer.mesh, answer.scheme);
  double least = INFINITY;
  for (int k = 0; k <= kLooks; ++k) {
    const double t = answer.tf() * k / kLooks;
    const auto s = between.states(t);
    const auto corners = statement.vehicle.corners_at({s[0], s[1], s[2]});
    for (const Body& body : scene.bodies)
      least = std::min(least, world::distance(corners, body.corners_at(t)));
  }
  return least;
}

struct Run {
  ShapeScene scene;
  std::string form;
  bool straight;
  int intervals, runs;
  nlp::Options options;
};

json solved(const Run& run) {
  const auto state = [&](Statement& statement) {
    return make_rows(run.form, run.scene, statement.problem, statement.vehicle, statement.x,
                     statement.y, statement.psi);
  };
  Statement statement(run.scene, 0);
  const auto rows = state(statement);
  const Way way(run.scene, run.straight);
  const double tf = way.along.back() / run.scene.speed;
  ocp::Guess guess(statement.problem, 201);
  guess.times(0, tf);
  const auto pose = [&](double t) { return way.at(t / tf * way.along.back()); };
  guess.function("x", [&](double t) { return pose(t).x; });
  guess.function("y", [&](double t) { return pose(t).y; });
  guess.function("psi", [&](double t) { return pose(t).psi; });
  guess.constant("v", run.scene.speed);
  rows->guess(guess, pose);
  const ocp::SolveSettings settings{
      .mesh = ocp::Mesh::uniform(run.intervals), .options = run.options, .guess = guess};
  ocp::Prepared prepared(statement.problem, settings);
  const auto timed = [&](const auto& solve, std::vector<double>& seconds) {
    ocp::Solution answer;
    const Timer all;
    while (static_cast<int>(seconds.size()) < run.runs &&
           (seconds.empty() || all.cpu() < kLongEnough)) {
      const Timer timer;
      answer = solve();
      seconds.push_back(timer.cpu());
    }
    return answer;
  };
  std::vector<double> seconds, again;
  const ocp::Solution answer = timed([&] { return prepared.solve(settings.guess); }, seconds);
  ocp::Solution second;
  if (answer.solved()) {
    Statement moved(run.scene, kMoved);
    state(moved);
    prepared.update(moved.problem);
    const ocp::Duals duals =
        ocp::Duals{answer.trajectory.tau, answer.collocated_costates, answer.multipliers};
    second = timed([&] { return prepared.solve(answer.trajectory, duals); }, again);
  }
  const auto middle = [](std::vector<double> of) {
    std::sort(of.begin(), of.end());
    return of.empty() ? 0 : of[of.size() / 2];
  };
  return {{"scene", run.scene.name},
          {"form", run.form},
          {"start", run.straight ? "straight" : "way"},
          {"rows", rows->rows()},
          {"variables", rows->variables()},
          {"solved", answer.solved()},
          {"status", nlp::to_string(answer.status)},
          {"iterations", answer.iterations},
          {"solve_s", middle(seconds)},
          {"warm_solved", second.solved()},
          {"warm_iterations", second.iterations},
          {"warm_s", middle(again)},
          {"cost", answer.objective},
          {"time_s", answer.tf()},
          {"gap", answer.solved() ? least_gap(run.scene, statement, answer) : 0},
          {"asked", kKept},
          {"length", statement.vehicle.parameters.length},
          {"width", statement.vehicle.parameters.width}};
}

}  // namespace
}  // namespace slalom::bench

int main(int argc, char** argv) {
  CLI::App app{"Forms of rows that keep a rectangle off rectangles, on the same problems"};
  std::vector<std::string> forms = slalom::bench::shape_forms();
  auto scenes = slalom::bench::shape_scenes();
  int seeds = 6, runs = 5, intervals = 40;
  app.add_option("--forms", forms)->delimiter(',');
  app.add_option("--scenes", scenes)->delimiter(',');
  app.add_option("--seeds", seeds);
  app.add_option("--runs", runs);
  app.add_option("--intervals", intervals);
  slalom::nlp::Options options;
  app.add_option("--floor", options.floor);
  CLI11_PARSE(app, argc, argv);
  try {
    for (const auto& scene : scenes)
      for (const auto& form : forms)
        for (int seed = 1; seed <= seeds; ++seed)
          for (const bool straight : {false, true}) {
            auto out = slalom::bench::solved(
                {slalom::bench::shape_scene(scene, static_cast<unsigned>(seed)), form, straight,
                 intervals, runs, options});
            out["seed"] = seed;
            std::cout << out.dump() << std::endl;  // NOLINT(performance-avoid-endl): as it comes
          }
  } catch (const std::exception& error) {
    std::cerr << "bench_shape_forms: " << error.what() << "\n";
    return EXIT_FAILURE;
  }
}
