#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "comparison.hpp"
#include "html.hpp"
#include "map.hpp"
#include "page_parts.hpp"
#include "slalom/study/plot.hpp"
#include "slalom/study/reproduction.hpp"
#include "traces.hpp"

namespace slalom::study {
namespace {

/// The paper's column of traces: solve time, sa, ux, ax.
Figure traces_figure(const std::vector<const ReproducedDrive*>& group) {
  const auto& scenario = group.front()->scenario;
  Plot solve{.x_label = "planning cycle", .y_label = "solve time [s]"};
  solve.levels = {{scenario.loop.tex, "execution horizon", {colours::purple, 0.9, "3 2", 1}}};
  solve.log_y = true;
  Plot sa{.x_label = "t [s]", .y_label = "sa [rad]", .x_tick_labels = false};
  Plot ux{.x_label = "t [s]", .y_label = "ux [m/s]", .x_tick_labels = false};
  Plot ax{.x_label = "t [s]", .y_label = "ax [m/s²]"};
  for (const auto* one : group) {
    const auto& name = one->scenario.planner.name;
    const auto stroke = planner_stroke(name);
    solve.series.push_back(solve_time_series(name, one->drive, false, stroke));
    sa.series.push_back(state_series(name, one->drive, vehicle::SA, 1, stroke));
    ux.series.push_back(state_series(name, one->drive, vehicle::UX, 1, stroke));
    ax.series.push_back(state_series(name, one->drive, vehicle::AX, 1, stroke));
  }
  const auto name = plain_name(scenario.name) + "_traces";
  return {name + ".svg",
          scenario.name + ": solve time of each cycle, steering angle, speed, acceleration",
          stacked_svg(name, scenario.name + ": traces", {solve, sa, ux, ax}, 98)};
}

Map group_map(const std::vector<const ReproducedDrive*>& group, const PaperData& paper) {
  Map map;
  map.scenario = &group.front()->scenario;
  double longest = -1;
  for (const auto* one : group) {
    const auto& name = one->scenario.planner.name;
    const auto* printed = find(paper, *one);
    MapVehicle vehicle{&one->drive, name, planner_stroke(name), thirds(one->drive), {}};
    if (printed != nullptr && !printed->snapshots.empty()) {
      vehicle.paper = printed->snapshots;
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

Figure path_figure(const std::vector<const ReproducedDrive*>& group, const PaperData& paper) {
  const auto map = group_map(group, paper);
  const auto name = plain_name(map.scenario->name) + "_path";
  return {
      name + ".svg",
      map.scenario->name +
          ": paths, with vehicles and obstacles where the paper's figure shows them; rings mark "
          "the paper's vehicles (dotted: a series that lags)",
      map_svg(name, map.scenario->name + ": paths", map)};
}

/// The moment of a crash, with the others where they are just then.
Figure crash_figure(const std::vector<const ReproducedDrive*>& group, const ReproducedDrive& crash,
                    const PaperData& paper) {
  auto map = group_map(group, paper);
  const double t = crash.drive.time;
  map.obstacle_instants = {t};
  for (auto& vehicle : map.vehicles) {
    vehicle.instants = {t};
    std::erase_if(vehicle.paper, [&](const auto& s) { return std::abs(s.t - t) > 0.1; });
  }
  const auto& state = crash.drive.plant.back().state;
  const auto name = plain_name(map.scenario->name) + "_crash";
  return {
      name + ".svg",
      fmt::format("{}: {} s, the vehicle of {} touches the grown edge of {}", map.scenario->name,
                  fmt::format("{:.2f}", t), crash.scenario.planner.name, crash.drive.hit),
      zoom_svg(name, map.scenario->name + ": crash", map, state[vehicle::X], state[vehicle::Y],
               12)};
}

}  // namespace

std::vector<Figure> reproduction_figures(const std::vector<ReproducedDrive>& drives,
                                         const PaperData& paper) {
  std::vector<Figure> figures;
  for (const auto& group : by_environment(drives)) {
    figures.push_back(traces_figure(group));
    figures.push_back(path_figure(group, paper));
    for (const auto* one : group)
      if (one->drive.outcome == sim::Outcome::crash && !one->drive.plant.empty()) {
        figures.push_back(crash_figure(group, *one, paper));
        break;
      }
  }
  return figures;
}

}  // namespace slalom::study
