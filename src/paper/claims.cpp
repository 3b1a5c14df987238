#include "claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../report/html.hpp"
#include "../report/words.hpp"
#include "comparison.hpp"

namespace slalom::paper {
namespace {

using Drives = std::vector<ReproducedDrive>;

bool arrived(const ReproducedDrive& one) {
  return one.drive.outcome == sim::Outcome::goal;
}

bool hit(const ReproducedDrive& one, const std::string& obstacle) {
  return one.drive.outcome == sim::Outcome::crash && one.drive.hit == obstacle;
}

std::string end_of(const ReproducedDrive& one) {
  return fmt::format("{} at {} s", report::outcome_words(one.drive),
                     report::number(one.drive.time, 2));
}

double speed_gain(const ReproducedDrive& one) {
  const auto& plant = one.drive.plant;
  return plant.empty() ? NAN : plant.back().state[vehicle::UX] - plant.front().state[vehicle::UX];
}

/// The farthest the vehicle strays from the line of its start [m], left positive.
double farthest_aside(const ReproducedDrive& one) {
  const auto& start = one.scenario.start;
  double farthest = 0;
  for (const auto& s : one.drive.plant) {
    const double dx = s.state[vehicle::X] - start[vehicle::X];
    const double dy = s.state[vehicle::Y] - start[vehicle::Y];
    const double aside = dy * std::cos(start[vehicle::PSI]) - dx * std::sin(start[vehicle::PSI]);
    if (std::abs(aside) > std::abs(farthest)) farthest = aside;
  }
  return farthest;
}

std::string side(double aside) {
  return fmt::format("{} m to the {}", report::number(std::abs(aside), 1),
                     aside > 0 ? "left" : "right");
}

void add_static(std::vector<Claim>& list, const Drives& drives, const std::string& environment) {
  const auto* A = find(drives, environment, "P_A");
  const auto* B = find(drives, environment, "P_B");
  const auto* C = find(drives, environment, "P_C");
  if (A == nullptr || B == nullptr || C == nullptr) return;
  const double lead = A->drive.time - std::max(B->drive.time, C->drive.time);
  list.push_back({environment + ": all three planners reach the goal; P_B and P_C well before P_A",
                  fmt::format("P_A {} s, P_B {} s, P_C {} s: a lead of {} s",
                              report::number(A->drive.time, 1), report::number(B->drive.time, 1),
                              report::number(C->drive.time, 1), report::number(lead, 1)),
                  arrived(*A) && arrived(*B) && arrived(*C) && lead >= 1.5});
  const double a = speed_gain(*A), b = speed_gain(*B), c = speed_gain(*C);
  list.push_back({environment + ": the vehicle of P_A slows, those of P_B and P_C gain speed",
                  fmt::format("P_A {} m/s, P_B +{} m/s, P_C +{} m/s from start to end",
                              report::number(a, 1), report::number(b, 1), report::number(c, 1)),
                  a < 0 && b > 0 && c > 0});
  const double effort_B = effort_paper(B->drive).total();
  const double effort_C = effort_paper(C->drive).total();
  const double cost_B = effort_weighted(B->drive, C->scenario.planner).total();
  const double cost_C = effort_weighted(C->drive, C->scenario.planner).total();
  list.push_back({environment + ": P_C spends no more control effort than P_B",
                  fmt::format("{} and {} by the paper’s measure, {} and {} by the cost’s weights",
                              report::significant(effort_C, 4), report::significant(effort_B, 4),
                              report::significant(cost_C, 4), report::significant(cost_B, 4)),
                  effort_C <= effort_B && cost_C <= cost_B});
}

void add_moving(std::vector<Claim>& list, const Drives& drives) {
  const auto* C = find(drives, "E_B", "P_C");
  const auto* D = find(drives, "E_B", "P_D");
  if (C != nullptr) {
    const double aside = farthest_aside(*C);
    list.push_back(
        {"E_B: P_C, which holds the obstacles where they are, goes left and crashes "
         "into O1",
         fmt::format("{}; {}", side(aside), end_of(*C)), aside > 0 && hit(*C, "O1")});
  }
  if (D != nullptr) {
    const double aside = farthest_aside(*D);
    list.push_back({"E_B: P_D, which predicts their motion, goes right and arrives",
                    fmt::format("{}; {}", side(aside), end_of(*D)), aside < 0 && arrived(*D)});
  }
  const auto* slalom_C = find(drives, "E_C", "P_C");
  const auto* slalom_D = find(drives, "E_C", "P_D");
  if (slalom_C != nullptr)
    list.push_back(
        {"E_C: P_C crashes into the oncoming O2",
         slalom_C->drive.plant.empty()
             ? end_of(*slalom_C)
             : fmt::format("{}, at {} m/s", end_of(*slalom_C),
                           report::number(slalom_C->drive.plant.back().state[vehicle::UX], 1)),
         hit(*slalom_C, "O2")});
  if (slalom_D != nullptr)
    list.push_back({"E_C: P_D arrives", end_of(*slalom_D), arrived(*slalom_D)});
}

/// Where the vehicle comes into the other lane of E_C, whose boundary the cones mark at x = 12 [m
/// along y]; NaN if it never does.
double lane_change(const ReproducedDrive& one) {
  constexpr double boundary = 12;
  for (const auto& s : one.drive.plant)
    if (s.state[vehicle::X] >= boundary) return s.state[vehicle::Y];
  return NAN;
}

/// What the paper's text says of E_C seen 50 m ahead, and without its cones.
void add_variants(std::vector<Claim>& list, const Drives& drives) {
  for (const char* planner : {"P_C", "P_D"}) {
    const auto* seen = find(drives, "E_C-range-50", planner);
    if (seen == nullptr) continue;
    list.push_back(
        {fmt::format("E_C with L_range 50 m: the vehicle of {} crashes into O2", planner),
         end_of(*seen), hit(*seen, "O2")});
  }
  for (const char* planner : {"P_C", "P_D"}) {
    const auto* with = find(drives, "E_C", planner);
    const auto* without = find(drives, "E_C-no-cones", planner);
    if (with == nullptr || without == nullptr) continue;
    const double y = lane_change(*without), y_cones = lane_change(*with);
    list.push_back(
        {fmt::format("E_C without cones: the vehicle of {} changes lanes earlier", planner),
         fmt::format("at y = {} m, with cones at y = {} m; then {}", report::number(y, 0),
                     report::number(y_cones, 0), end_of(*without)),
         y < y_cones});
  }
}

/// All solve times stay below the execution horizon, but for P_A's. By the wall clock, since that
/// is when a plan is there; a machine that does other work shows in it, and not in CPU time.
void add_solve_times(std::vector<Claim>& list, const Drives& drives) {
  std::size_t count = 0;
  std::ptrdiff_t over = 0, over_cpu = 0;
  std::string where;
  for (const auto& one : drives) {
    if (one.scenario.planner.name == "P_A") continue;
    const auto slow = [&](const std::vector<double>& times) {
      return std::count_if(times.begin(), times.end(),
                           [&](double t) { return t >= one.scenario.loop.tex; });
    };
    const auto times = solve_times(one.drive);
    count += times.size();
    over += slow(times);
    over_cpu += slow(solve_times(one.drive, true));
    if (slow(times) > 0)
      where += fmt::format("{}{} {}", where.empty() ? "" : ", ", one.scenario.name,
                           one.scenario.planner.name);
  }
  if (count == 0) return;
  list.push_back({"Plans are ready within the execution horizon (all but some of P_A’s)",
                  over == 0 ? fmt::format("all {} of P_B, P_C and P_D are", count)
                            : fmt::format("{} of {} are not by the wall clock ({}), {} by CPU time",
                                          over, count, where, over_cpu),
                  over == 0});
}

}  // namespace

std::vector<Claim> claims(const std::vector<ReproducedDrive>& drives) {
  std::vector<Claim> list;
  add_static(list, drives, "E_A");
  add_static(list, drives, "E_A-figure");
  add_moving(list, drives);
  add_variants(list, drives);
  add_solve_times(list, drives);
  return list;
}

}  // namespace slalom::paper
