#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "../report/html.hpp"
#include "../report/map.hpp"
#include "../report/page_parts.hpp"
#include "../report/traces.hpp"
#include "comparison.hpp"
#include "concept_cases.hpp"
#include "reproduction.hpp"
#include "slalom/report/plot.hpp"

namespace slalom::paper {
namespace {

using Group = std::vector<const ReproducedDrive*>;

constexpr double kDeg = 180 / std::numbers::pi;
const report::Stroke kLimit = {report::colours::muted, 0.7, "3 2", 1};

bool brakes_hard(const ReproducedDrive& one) {
  return std::any_of(one.drive.plant.begin(), one.drive.plant.end(), [&](const auto& s) {
    return s.state[vehicle::AX] < one.scenario.vehicle.ax_min_at(s.state[vehicle::UX]) / 2;
  });
}

/// ax of each drive with its limits at the speeds driven: the upper one of each, the lower one
/// where a vehicle comes near it.
report::Plot acceleration_plot(const Group& group) {
  report::Plot plot{.x_label = "t [s]", .y_label = "ax [m/s²]"};
  for (const auto* one : group) {
    const auto stroke = report::planner_stroke(one->scenario.planner.name);
    report::Stroke limit = stroke;
    limit.width = 0.5;
    limit.dash = "1 1.5";
    plot.series.push_back(report::state_series("", one->drive, vehicle::AX, 1, stroke));
    plot.series.push_back(report::limit_series("", one->drive, one->scenario.vehicle, true, limit));
    if (brakes_hard(*one))
      plot.series.push_back(
          report::limit_series("", one->drive, one->scenario.vehicle, false, limit));
  }
  return plot;
}

/// The paper's column of traces: solve time, sa, ux, ax.
report::Figure traces_figure(const Group& group) {
  const auto& scenario = group.front()->scenario;
  report::Plot solve{.x_label = "planning cycle", .y_label = "solve time [ms]"};
  solve.levels = {
      {1e3 * scenario.loop.tex, "execution horizon", {report::colours::purple, 0.9, "3 2", 1}}};
  solve.log_y = true;
  report::Plot sa{.x_label = "t [s]", .y_label = "sa [rad]", .x_tick_labels = false};
  report::Plot ux{.x_label = "t [s]", .y_label = "ux [m/s]", .x_tick_labels = false};
  for (const auto* one : group) {
    const auto& name = one->scenario.planner.name;
    const auto stroke = report::planner_stroke(name);
    solve.series.push_back(report::solve_time_series(name, one->drive, false, stroke));
    sa.series.push_back(report::state_series(name, one->drive, vehicle::SA, 1, stroke));
    ux.series.push_back(report::state_series(name, one->drive, vehicle::UX, 1, stroke));
  }
  const auto name = report::plain_name(scenario.name) + "_traces";
  return {name + ".svg",
          scenario.name +
              ": solve time of each cycle, steering angle, speed, acceleration with its limits at "
              "the speed driven (dotted)",
          report::stacked_svg(name, scenario.name + ": traces",
                              {solve, sa, ux, acceleration_plot(group)}, 98)};
}

/// What the paper's column leaves out: lateral speed, yaw rate, the controls with their bounds, the
/// least wheel load with its limits.
report::Figure dynamics_figure(const Group& group) {
  const auto& scenario = group.front()->scenario;
  const auto& limits = scenario.vehicle;
  report::Plot v{.x_label = "t [s]", .y_label = "v [m/s]", .x_tick_labels = false};
  report::Plot r{.x_label = "t [s]", .y_label = "r [°/s]", .x_tick_labels = false};
  report::Plot sr{.x_label = "t [s]", .y_label = "sr [°/s]", .x_tick_labels = false};
  report::Plot jx{.x_label = "t [s]", .y_label = "jx [m/s³]", .x_tick_labels = false};
  report::Plot load{.x_label = "t [s]", .y_label = "least Fz [kN]"};
  for (const auto* one : group) {
    const auto& name = one->scenario.planner.name;
    const auto stroke = report::planner_stroke(name);
    v.series.push_back(report::state_series(name, one->drive, vehicle::V, 1, stroke));
    r.series.push_back(report::state_series(name, one->drive, vehicle::R, kDeg, stroke));
    sr.series.push_back(report::control_series(name, one->drive, vehicle::SR, kDeg, stroke));
    jx.series.push_back(report::control_series(name, one->drive, vehicle::JX, 1, stroke));
    load.series.push_back(report::least_wheel_series(name, one->drive, 1e-3, stroke));
  }
  sr.levels = {{limits.sr_max_deg, "bound", kLimit}, {-limits.sr_max_deg, "", kLimit}};
  jx.levels = {{limits.jx_max, "bound", kLimit}, {-limits.jx_max, "", kLimit}};
  load.levels = {
      {limits.Fz_min / 1000, "least in a plan", kLimit},
      {scenario.loop.Fz_failure / 1000, "failure", {report::colours::purple, 0.7, "3 2", 1}, true}};
  load.y_min = 0;
  const auto name = report::plain_name(scenario.name) + "_dynamics";
  return {name + ".svg",
          scenario.name +
              ": lateral speed, yaw rate, steering rate, longitudinal jerk, least wheel load",
          report::stacked_svg(name, scenario.name + ": dynamics", {v, r, sr, jx, load}, 84)};
}

report::Map group_map(const Group& group, const PaperData& paper) {
  report::Map map;
  map.scenario = &group.front()->scenario;
  double longest = -1;
  for (const auto* one : group) {
    const auto& name = one->scenario.planner.name;
    const auto* printed = find(paper, *one);
    report::MapVehicle vehicle{
        &one->drive, name, report::planner_stroke(name), report::thirds(one->drive), {}};
    if (printed != nullptr && !printed->snapshots.empty()) {
      for (const auto& s : printed->snapshots)
        vehicle.printed.push_back({s.t, s.x, s.y, s.comparable});
      vehicle.instants.clear();
      for (const auto& s : printed->snapshots)
        vehicle.instants.push_back(std::min(s.t, one->drive.time));
    }
    if (one->drive.time > longest) {
      longest = one->drive.time;
      map.obstacle_instants = vehicle.instants;
    }
    map.vehicles.push_back(std::move(vehicle));
  }
  return map;
}

report::Figure path_figure(const Group& group, const PaperData& paper) {
  const auto map = group_map(group, paper);
  const auto name = report::plain_name(map.scenario->name) + "_path";
  return {
      name + ".svg",
      map.scenario->name +
          ": paths, with vehicles and obstacles where the paper's figure shows them; rings mark "
          "the paper's vehicles (dotted: a series that lags)",
      report::map_svg(name, map.scenario->name + ": paths", map)};
}

/// The plan that drives at time t; nullptr before the first takes over.
const planner::Plan* plan_at(const sim::Drive& drive, double t) {
  const planner::Plan* plan = nullptr;
  for (const auto& cycle : drive.cycles)
    if (cycle.used && cycle.t_swap <= t) plan = &cycle.plan;
  return plan;
}

/// The moment of a crash, with the others where they are just then.
report::Figure crash_figure(const Group& group, const ReproducedDrive& crash,
                            const PaperData& paper, const std::string& suffix) {
  auto map = group_map(group, paper);
  const double t = crash.drive.time;
  map.obstacle_instants = {t};
  for (auto& vehicle : map.vehicles) {
    vehicle.instants = {t};
    std::erase_if(vehicle.printed, [&](const auto& s) { return std::abs(s.t - t) > 0.1; });
    if (vehicle.drive == &crash.drive) vehicle.plan = plan_at(crash.drive, t);
  }
  const auto& state = crash.drive.plant.back().state;
  const auto name = report::plain_name(map.scenario->name + "_crash" + suffix);
  return {name + ".svg",
          fmt::format(
              "{}: {:.2f} s, the vehicle of {} touches the grown edge of {}; its plan then, node "
              "by node, and where that plan takes a moving obstacle to stand (dashed)",
              map.scenario->name, t, crash.scenario.planner.name, crash.drive.hit),
          report::zoom_svg(name, map.scenario->name + ": crash", map, state[vehicle::X],
                           state[vehicle::Y], 12)};
}

/// Of all drives of a group, such as "P_A, P_B and P_C".
std::string planners_of(const Group& group) {
  std::string list;
  for (std::size_t i = 0; i < group.size(); ++i)
    list += (i == 0 ? "" : i + 1 < group.size() ? ", " : " and ") + group[i]->scenario.planner.name;
  return list;
}

/// The paper's figure of two columns: its traces, and beside them the paths.
report::Figure whole_figure(const Group& group, const report::Figure& traces,
                            const report::Figure& path) {
  const auto& name = group.front()->scenario.name;
  return {
      report::plain_name(name) + ".svg",
      fmt::format("{}: traces and paths of {}, for two columns; rings mark the paper's vehicles",
                  name, planners_of(group)),
      report::side_by_side(name + ": traces and paths", {traces.svg, path.svg}, 12)};
}

std::vector<report::Figure> group_figures(const Group& group, const PaperData& paper) {
  const auto traces = traces_figure(group);
  const auto path = path_figure(group, paper);
  std::vector<report::Figure> figures = {traces, dynamics_figure(group), path,
                                         whole_figure(group, traces, path)};
  bool first = true;
  for (const auto* one : group) {
    if (one->drive.outcome != sim::Outcome::crash || one->drive.plant.empty()) continue;
    figures.push_back(
        crash_figure(group, *one, paper, first ? "" : "_" + one->scenario.planner.name));
    first = false;
  }
  return figures;
}

}  // namespace

std::vector<report::Figure> reproduction_figures(const std::vector<ReproducedDrive>& drives,
                                                 const PaperData& paper,
                                                 const std::vector<ConceptCase>& cases) {
  std::vector<report::Figure> figures;
  for (const auto& group : by_environment(drives))
    for (auto& figure : group_figures(group, paper)) figures.push_back(std::move(figure));
  if (!cases.empty()) figures.push_back(concept_figure(cases));
  return figures;
}

}  // namespace slalom::paper
