#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "map.hpp"
#include "slalom/report/plot.hpp"
#include "slalom/report/report.hpp"
#include "traces.hpp"

namespace slalom::report {
namespace {

constexpr double kDeg = 180 / std::numbers::pi;
constexpr Stroke solid(const char* colour) {
  return {colour, 1, "", 1};
}

std::string file_title(const sim::Scenario& scenario, const std::string& what) {
  return scenario.name + ", " + scenario.planner.name + ": " + what;
}

Figure path_figure(const sim::Scenario& scenario, const sim::Drive& drive) {
  Map map;
  map.scenario = &scenario;
  map.vehicles = {{&drive, scenario.planner.name, solid(colours::blue), thirds(drive), {}}};
  map.obstacle_instants = thirds(drive);
  const auto title = file_title(scenario, "path");
  return {"path.svg", "Path, with the vehicle and the obstacles at thirds of the drive",
          map_svg("path", title, map)};
}

Figure speed_figure(const sim::Scenario& scenario, const sim::Drive& drive) {
  Plot plot{.x_label = "t [s]", .y_label = "ux [m/s]"};
  plot.series = {state_series("", drive, vehicle::UX, 1, solid(colours::blue))};
  plot.levels = {{scenario.vehicle.ux_max, "bound"}};
  return {"speed.svg", "Longitudinal speed",
          plot_svg("speed", file_title(scenario, "speed"), plot)};
}

/// The lower limit stays outside while the vehicle does not brake hard: it would flatten the rest.
bool near_lower_limit(const sim::Scenario& scenario, const sim::Drive& drive) {
  for (const auto& sample : drive.plant)
    if (sample.state[vehicle::AX] < scenario.vehicle.ax_min_at(sample.state[vehicle::UX]) / 2)
      return true;
  return false;
}

Figure acceleration_figure(const sim::Scenario& scenario, const sim::Drive& drive) {
  Plot plot{.x_label = "t [s]", .y_label = "ax [m/s²]"};
  const Stroke limit = {colours::muted, 0.7, "3 2", 1};
  plot.series = {state_series("driven", drive, vehicle::AX, 1, solid(colours::blue)),
                 limit_series("limit at that speed", drive, scenario.vehicle, true, limit)};
  if (near_lower_limit(scenario, drive))
    plot.series.push_back(limit_series("", drive, scenario.vehicle, false, limit));
  return {"acceleration.svg", "Longitudinal acceleration and its limits",
          plot_svg("acceleration", file_title(scenario, "acceleration"), plot)};
}

Figure steering_figure(const sim::Scenario& scenario, const sim::Drive& drive) {
  Plot angle{.x_label = "t [s]", .y_label = "sa [°]"};
  angle.series = {state_series("", drive, vehicle::SA, kDeg, solid(colours::blue))};
  angle.x_tick_labels = false;
  Plot rate{.x_label = "t [s]", .y_label = "sr [°/s]"};
  rate.series = {control_series("", drive, vehicle::SR, kDeg, solid(colours::blue))};
  const double bound = scenario.vehicle.sr_max_deg;
  rate.levels = {{bound, "bound"}, {-bound, ""}};
  return {"steering.svg", "Steering angle and rate, left positive",
          stacked_svg("steering", file_title(scenario, "steering"), {angle, rate}, 105)};
}

Figure lateral_figure(const sim::Scenario& scenario, const sim::Drive& drive) {
  Plot speed{.x_label = "t [s]", .y_label = "v [m/s]"};
  speed.series = {state_series("", drive, vehicle::V, 1, solid(colours::blue))};
  speed.x_tick_labels = false;
  Plot rate{.x_label = "t [s]", .y_label = "r [°/s]"};
  rate.series = {state_series("", drive, vehicle::R, kDeg, solid(colours::blue))};
  return {"lateral.svg", "Lateral speed of the centre of gravity and yaw rate, left positive",
          stacked_svg("lateral", file_title(scenario, "lateral motion"), {speed, rate}, 105)};
}

Figure wheel_load_figure(const sim::Scenario& scenario, const sim::Drive& drive) {
  Plot plot{.x_label = "t [s]", .y_label = "wheel load [kN]"};
  const Stroke strokes[] = {{colours::blue, 1, "", 1},
                            {colours::vermilion, 1, "4 1.5", 1},
                            {colours::green, 1, "", 1},
                            {colours::purple, 1, "4 1.5", 1}};
  const char* labels[] = {"rear left", "rear right", "front left", "front right"};
  for (std::size_t i = 0; i < vehicle::kWheels; ++i)
    plot.series.push_back(wheel_series(labels[i], drive, i, 1e-3, strokes[i]));
  plot.levels = {
      {scenario.vehicle.Fz_min / 1000, "least in a plan"},
      {scenario.loop.Fz_failure / 1000, "failure", {colours::vermilion, 0.7, "3 2", 1}, true}};
  plot.y_min = 0;
  return {"wheel_loads.svg", "Vertical wheel loads",
          plot_svg("wheel_loads", file_title(scenario, "wheel loads"), plot, 170)};
}

Figure solve_time_figure(const sim::Scenario& scenario, const sim::Drive& drive) {
  Plot plot{.x_label = "planning cycle", .y_label = "solve time [ms]"};
  plot.series = {solve_time_series("wall clock", drive, false, solid(colours::blue)),
                 solve_time_series("CPU", drive, true, {colours::orange, 1, "2 1.5", 1})};
  plot.series.front().markers = true;
  plot.levels = {
      {1e3 * scenario.loop.tex, "execution horizon", {colours::vermilion, 0.8, "3 2", 1}}};
  plot.log_y = true;
  return {"solve_time.svg", "Solve time of each planning cycle beside the execution horizon",
          plot_svg("solve_time", file_title(scenario, "solve time"), plot)};
}

}  // namespace

std::vector<Figure> drive_figures(const sim::Scenario& scenario, const sim::Drive& drive) {
  return {path_figure(scenario, drive),         speed_figure(scenario, drive),
          acceleration_figure(scenario, drive), steering_figure(scenario, drive),
          lateral_figure(scenario, drive),      wheel_load_figure(scenario, drive),
          solve_time_figure(scenario, drive)};
}

}  // namespace slalom::report
