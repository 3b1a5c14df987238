#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "slalom/sim/drive.hpp"
#include "slalom/sim/scenario.hpp"

namespace slalom::report::testing {

/// A field with one standing and one moving obstacle, without any planner behind it.
inline sim::Scenario synthetic_scenario() {
  sim::Scenario scenario;
  scenario.name = "synthetic";
  scenario.title = "a drive made up for tests";
  scenario.goal = {0, 60, std::numbers::pi / 2, 10};
  scenario.region.x_min = -12;
  scenario.obstacles = {{"O1", 8, 20, 3, 3, 0, 0}, {"O2", -6, 50, 2, 4, 0, -2}};
  return scenario;
}

/// Steers to and fro over `seconds` at 17 m/s; samples every .02 s, a plan every .5 s.
inline sim::Drive synthetic_drive(double seconds = 4) {
  sim::Drive drive;
  drive.outcome = sim::Outcome::goal;
  drive.time = seconds;
  drive.goal_time = seconds * 0.9;
  drive.message = "arrived";
  drive.least_clearance = 1.5;
  drive.least_clearance_t = seconds / 2;
  drive.least_clearance_obstacle = "O1";
  drive.least_wheel_load = 3000;
  const auto state = [](double t) -> vehicle::State {
    return {std::sin(t),        17 * t,       0.1, 0.2, std::numbers::pi / 2,
            0.02 * std::sin(t), 17 + 0.2 * t, 0.2};
  };
  const auto count = static_cast<int>(std::lround(seconds / 0.02));
  for (int i = 0; i <= count; ++i) {
    const double t = seconds * i / std::max(count, 1);
    drive.plant.push_back(
        {t, state(t), {0.02 * std::cos(t), 0.1}, {6000, 6500, 6800, 7000}, 1.5 + std::abs(t - 2)});
  }
  for (int i = 0; i * 0.5 < seconds; ++i) {
    sim::Cycle cycle;
    cycle.index = i;
    cycle.t0 = std::max(0.0, 0.5 * (i - 1));
    cycle.tex = 0.5;
    cycle.used = i > 0;
    cycle.plan.t_start = cycle.t0 + 0.5;
    cycle.plan.tf = 2;
    if (i % 2 == 1) cycle.plan.obstacle_time_held = cycle.t0;
    for (int k = 0; k <= 5; ++k) {
      cycle.plan.t.push_back(0.4 * k);
      cycle.plan.states.push_back(state(cycle.plan.t_start + 0.4 * k));
      cycle.plan.controls.push_back({0.01, 0.1});
    }
    cycle.plan.report.solved = true;
    cycle.plan.report.status = planner::PlanStatus::solved;
    cycle.plan.report.wall_s = 0.05 + 0.01 * i;
    cycle.plan.report.cpu_s = 0.04;
    cycle.plan.report.cost_terms = {{"final_time", 200}};
    drive.cycles.push_back(cycle);
  }
  return drive;
}

/// Drives on which a page may stumble, by name.
struct OddDrive {
  std::string name;
  sim::Scenario scenario;
  sim::Drive drive;
};

inline std::vector<OddDrive> odd_drives() {
  constexpr double inf = std::numeric_limits<double>::infinity();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<OddDrive> list;
  list.push_back({"nothing was driven", synthetic_scenario(), {}});

  auto one = synthetic_drive(0);
  one.cycles.clear();
  list.push_back({"one sample", synthetic_scenario(), one});

  auto free_field = synthetic_scenario();
  free_field.obstacles.clear();
  auto clear = synthetic_drive();
  for (auto& sample : clear.plant) sample.clearance = inf;
  clear.least_clearance = inf;
  clear.least_clearance_obstacle = "";
  list.push_back({"no obstacles", free_field, clear});

  auto unsolved = synthetic_drive();
  unsolved.outcome = sim::Outcome::not_optimal;
  unsolved.goal_time.reset();
  unsolved.cycles.back().plan = {};
  unsolved.cycles.back().plan.report.cost = nan;
  unsolved.cycles.back().plan.report.worst_violation = inf;
  list.push_back({"an empty plan", synthetic_scenario(), unsolved});

  auto hostile = synthetic_scenario();
  hostile.name = "</script><script>alert(1)</script> & \"E'\"";
  hostile.title = "<!-- {{data}} ]]> \x01";
  hostile.obstacles[0].name = "</SCRIPT><b>";
  auto crashed = synthetic_drive();
  crashed.outcome = sim::Outcome::crash;
  crashed.hit = "</SCRIPT><b>";
  crashed.message = "hit </SCRIPT><b> \xff";
  list.push_back({"names that look like HTML", hostile, crashed});
  return list;
}

}  // namespace slalom::report::testing
