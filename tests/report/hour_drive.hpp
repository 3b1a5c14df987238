#pragma once

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "report/synthetic_drive.hpp"
#include "slalom/sim/drive.hpp"
#include "slalom/sim/scenario.hpp"

namespace slalom::report::testing {

/// A drive of an hour by a planner that verifies, at tex .1 s: numbers of full length that vary,
/// motions that were looked at in each cycle, and a few moments that stand out.
struct HourDrive {
  sim::Scenario scenario = synthetic_scenario();
  sim::Drive drive;
  std::vector<std::size_t> dips;      ///< samples at which a wheel load and clearance fall briefly
  std::vector<std::size_t> unsolved;  ///< cycles without a verified plan
  std::size_t slowest = 0;            ///< cycle
};

namespace hour {

/// Between 0 and 1, the same for the same numbers.
inline double noise(std::size_t k, unsigned salt) {
  return static_cast<double>(std::minstd_rand(static_cast<unsigned>(k) * 7919U + salt)() % 9973) /
         9973;
}

inline vehicle::State state_at(double t) {
  const double swing = std::sin(t / 3.1) + 0.3 * std::sin(2.3 * t);
  return {400 * std::sin(t / 120) + swing,
          400 * std::cos(t / 190),
          0.2 * swing,
          0.1 * std::cos(1.7 * t),
          1.57 + swing / 5,
          0.05 * std::sin(2.9 * t),
          17 + 3 * std::sin(t / 17.0) + 0.1 * swing,
          std::cos(t / 1.3)};
}

inline planner::Certificate certificate(std::size_t k, double t, bool verified) {
  const std::string name = k % 3 == 0 ? "O1" : "O2";
  return {verified,
          0.5 + noise(k, 1),
          0.15,
          name,
          1500 + 900 * noise(k, 2),
          t + 7.3 + noise(k, 3),
          verified ? "" : "clearance to " + name + " at 1234.5 s",
          verified ? 0 : t + 1};
}

inline planner::Plan plan(std::size_t k, double t, bool verified) {
  planner::Plan plan;
  plan.t_start = t;
  plan.tf = 6 + noise(k, 4);
  for (int node = 0; node <= 14; ++node) {
    plan.t.push_back(plan.tf * node / 14);
    plan.states.push_back(state_at(t + plan.t.back()));
    plan.controls.push_back({0.1 * noise(k + static_cast<std::size_t>(node), 5), noise(k, 6)});
  }
  plan.rung = !verified    ? planner::Rung::least_bad
              : k % 7 == 3 ? planner::Rung::rest
                           : planner::Rung::new_plan;
  plan.certificate = certificate(k, t, verified);
  for (const char* name : {"rest", "way 1, solved", "way 2", "along the last"})
    plan.candidates.push_back(
        {name, 100 * noise(k, 7), certificate(k + plan.candidates.size(), t, verified)});
  auto& report = plan.report;
  report.solved = verified;
  report.status = verified ? planner::PlanStatus::solved : planner::PlanStatus::unverified;
  report.iterations = static_cast<int>(10 + k % 9);
  report.wall_s = 0.03 + 0.02 * noise(k, 8);
  report.cpu_s = 0.9 * report.wall_s;
  report.cost = 200 * noise(k, 9);
  report.cost_terms = {{"final_time", report.cost / 3}, {"goal", report.cost * 2 / 3}};
  report.worst_constraint = "obstacle[O2] at node 3";
  report.worst_violation = 1e-9 * noise(k, 10);
  return plan;
}

}  // namespace hour

inline HourDrive hour_drive() {
  constexpr std::size_t kCycles = 36'000, kSamples = 180'000;
  HourDrive made;
  made.scenario.planner.name = "P_E";
  made.scenario.planner.method = planner::Method::verified;
  made.scenario.loop.tex = 0.1;
  auto& drive = made.drive;
  drive.time = 3600;
  drive.message = "still on its way";
  drive.least_clearance = 0.02;
  drive.least_clearance_t = 1800;
  drive.least_wheel_load = 400;
  for (std::size_t k = 0; k <= kSamples; ++k) {
    const double t = 0.02 * static_cast<double>(k);
    sim::PlantSample sample{t,
                            hour::state_at(t),
                            {0.02 * std::cos(5 * t), hour::noise(k, 11)},
                            {},
                            3 + 2 * std::sin(t / 2.2)};
    for (std::size_t wheel = 0; wheel < sample.wheel_loads.size(); ++wheel)
      sample.wheel_loads[wheel] = 6000 + 1500 * std::sin(1.9 * t + static_cast<double>(wheel));
    if (k % 997 == 500) {
      sample.wheel_loads[k % 4] = 400 + 800 * hour::noise(k, 12);
      sample.clearance = 0.02 + 0.3 * hour::noise(k, 13);
      made.dips.push_back(k);
    }
    drive.plant.push_back(sample);
  }
  for (std::size_t k = 0; k <= kCycles; ++k) {
    sim::Cycle cycle;
    cycle.index = static_cast<int>(k);
    cycle.t0 = k == 0 ? 0 : 0.1 * static_cast<double>(k - 1);
    cycle.tex = 0.1;
    cycle.t_swap = cycle.t0 + 0.1;
    const bool verified = k % 601 != 300;
    cycle.used = k > 0;
    cycle.plan = hour::plan(k, cycle.t_swap, verified);
    cycle.X0p = cycle.plan.states[0];
    if (!verified) made.unsolved.push_back(k);
    drive.cycles.push_back(std::move(cycle));
  }
  made.slowest = 12'345;
  drive.cycles[made.slowest].plan.report.wall_s = 0.4;
  return made;
}

}  // namespace slalom::report::testing
