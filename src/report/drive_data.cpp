#include "drive_data.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "shapes.hpp"
#include "slalom/sim/marks.hpp"
#include "slalom/sim/verification.hpp"
#include "words.hpp"

namespace slalom::report {
namespace {

using Json = nlohmann::ordered_json;

/// `value` with `digits` decimals; null when it is not finite.
Json rounded(double value, int digits) {
  if (!std::isfinite(value)) return nullptr;
  const double power = std::pow(10.0, digits);
  const double scaled = std::round(value * power);
  if (!std::isfinite(scaled) || std::abs(scaled) > 1e15) return value;
  const double result = scaled / power;
  return result == 0 ? Json(0) : Json(result);
}

/// `value` as it is; null when it is not finite.
Json exact(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

constexpr int kStateDigits[] = {4, 4, 5, 5, 5, 6, 4, 4};
constexpr int kControlDigits[] = {6, 5};
constexpr int kTimeDigits = 6;

// What a page carries at the most, so that one of an hour's drive opens at once: samples of the
// plant, nodes of all plans together, and cycles with the terms of their cost.
// Of all obstacles together, rows of the motions that are given.
constexpr std::size_t kMostSamples = 11'000, kMostNodes = 24'000, kMostTerms = 2'000,
                      kMostTrackRows = 40'000;

/// Which of `count` entries are kept of at most `most`: evenly, the first and last among them.
std::vector<std::size_t> kept(std::size_t count, std::size_t most) {
  std::vector<std::size_t> indices;
  most = std::min(std::max<std::size_t>(most, 2), count);
  for (std::size_t k = 0; k < most; ++k)
    indices.push_back(most == 1 ? 0 : k * (count - 1) / (most - 1));
  return indices;
}

/// Least and greatest acceleration [m/s^2] at speeds as far apart as those at 0 and `ux_step`
/// [m/s].
Json acceleration_limits(const vehicle::Parameters& v) {
  constexpr int kSteps = 60;
  const double step = v.ux_max / kSteps;
  Json least = Json::array(), most = Json::array();
  for (int i = 0; i <= kSteps; ++i) {
    least.push_back(rounded(v.ax_min_at(i * step), 4));
    most.push_back(rounded(v.ax_max_at(i * step), 4));
  }
  return {{"ux_step", step}, {"least", least}, {"most", most}};
}

/// A motion by a table or along a path, in columns.
Json track_data(const Track& track) {
  Json json = {{"t", Json::array()}, {"x", Json::array()}, {"y", Json::array()}};
  json["psi"] = Json::array();
  for (const auto& row : track.rows) {
    json["t"].push_back(rounded(row.t, 3));
    json["x"].push_back(rounded(row.x, 3));
    json["y"].push_back(rounded(row.y, 3));
    json["psi"].push_back(rounded(row.psi, 4));
  }
  return json;
}

Json obstacle_data(const world::Obstacle& o, double sm_crash, double until, std::size_t rows) {
  const auto grown = o.grown(sm_crash);
  Json json = {{"name", o.name},    {"x", exact(o.x)},
               {"y", exact(o.y)},   {"a", exact(o.a)},
               {"b", exact(o.b)},   {"vx", exact(o.vx)},
               {"vy", exact(o.vy)}, {"grown", {{"a", exact(grown.a)}, {"b", exact(grown.b)}}}};
  if (o.psi != 0) json["psi"] = exact(o.psi);
  if (o.outline) {
    auto& corners = json["polygon"] = Json::array();
    for (const auto& p : o.outline->corners()) corners.push_back({exact(p.x), exact(p.y)});
  }
  if (o.trajectory) {
    const Track track = track_of(*o.trajectory, 0, until, rows);
    json["track"] = track_data(track);
    // From when to when it is there; null: from before, and for good.
    json["there"] = {track.appears ? rounded(track.rows.front().t, 3) : Json(nullptr),
                     track.vanishes ? rounded(track.rows.back().t, 3) : Json(nullptr)};
  }
  if (o.margin_start != 0 || o.margin_rate != 0)
    json["margin"] = {exact(o.margin_start), exact(o.margin_rate)};
  return json;
}

/// `until`: the last time that is looked at [s].
Json obstacles_data(const sim::Scenario& scenario, double until) {
  const auto& all = scenario.obstacles;
  const auto tracks = static_cast<std::size_t>(
      std::count_if(all.begin(), all.end(), [](const auto& o) { return o.trajectory != nullptr; }));
  Json json = Json::array();
  for (const auto& o : all)
    json.push_back(obstacle_data(o, scenario.loop.sm_crash, until,
                                 kMostTrackRows / std::max<std::size_t>(tracks, 1)));
  return json;
}

/// When the drive and the last of its plans end [s].
double end_of(const sim::Drive& drive) {
  double end = drive.time;
  for (const auto& cycle : drive.cycles) end = std::max(end, cycle.plan.t_start + cycle.plan.tf);
  return std::isfinite(end) ? end : drive.time;
}

Json places(const std::vector<world::Point>& points) {
  Json json = Json::array();
  for (const auto& p : points) json.push_back({rounded(p.x, 2), rounded(p.y, 2)});
  return json;
}

/// The places of what is drawn of it, in columns.
Json goal_data(const sim::Scenario& scenario) {
  Json json = {{"x", Json::array()}, {"y", Json::array()}};
  for (const auto& p : goal_shape(scenario)) {
    json["x"].push_back(exact(p.x));
    json["y"].push_back(exact(p.y));
  }
  return json;
}

Json road_data(const world::Road& road) {
  const RoadLines lines = lines_of(road);
  Json json = {{"left", places(lines.left)},
               {"right", places(lines.right)},
               {"middle", places(lines.middle)},
               {"lanes", Json::array()}};
  for (const auto& lane : road.lanes()) json["lanes"].push_back(places(lane));
  return json;
}

Json scenario_data(const sim::Scenario& scenario, double until) {
  const auto& v = scenario.vehicle;
  const auto& region = scenario.region;
  Json json;
  json["start"] = {{"x", exact(scenario.start[vehicle::X])},
                   {"y", exact(scenario.start[vehicle::Y])}};
  json["goal"] = goal_data(scenario);
  if (scenario.road) json["road"] = road_data(*scenario.road);
  json["region"] = {{"x_min", exact(region.x_min)},
                    {"x_max", exact(region.x_max)},
                    {"y_min", exact(region.y_min)},
                    {"y_max", exact(region.y_max)}};
  json["obstacles"] = obstacles_data(scenario, until);
  json["vehicle"] = {
      {"la", v.la},
      {"lb", v.lb},
      {"width", v.width},
      {"front_overhang", v.front_overhang},
      {"footprint", v.footprint == vehicle::FootprintKind::point ? "point" : "rectangle"},
      {"length", v.length},
      {"ax_limits", acceleration_limits(v)},
      {"ux_max", v.ux_max},
      {"sa_max", v.sa_max()},
      {"sr_max", v.sr_max()},
      {"Fz_min", v.Fz_min}};
  json["loop"] = {{"tex", scenario.loop.tex},
                  {"sm_crash", scenario.loop.sm_crash},
                  {"Fz_failure", scenario.loop.Fz_failure}};
  const auto& planner = scenario.planner;
  json["planner"] = {{"name", planner.name}, {"L_range", planner.L_range}};
  json["planner"]["margins"] = planner.method == planner::Method::verified
                                   ? Json::array({planner.verified_clearance})
                                   : Json::array({planner.sm_start, planner.sm_end});
  return json;
}

/// The values of a table of settings, by name, as files have them.
template <class S>
Json values(const OptionTable<S>& table, const S& settings) {
  Json json;
  for (const auto& entry : table.entries()) json[entry.info.name] = to_string(entry.get(settings));
  return json;
}

/// All settings by the section of a scenario file that has them.
Json settings_data(const sim::Scenario& scenario) {
  return {{"planner", values(planner::setting_options(), scenario.planner)},
          {"loop", values(sim::loop_options(), scenario.loop)},
          {"plant", values(sim::plant_options(), scenario.plant)},
          {"sensing", values(sim::sensing_options(), scenario.sensing)},
          {"vehicle", values(vehicle::parameter_options(), scenario.vehicle)},
          {"start", values(vehicle::state_options(), scenario.start)}};
}

/// What two drives are compared by.
Json summary_data(const sim::Drive& drive) {
  const auto times = solve_times(drive);
  const auto verification = sim::verification(drive);
  return {{"goal_time", drive.goal_time ? exact(*drive.goal_time) : Json(nullptr)},
          {"mean_speed", exact(mean_speed(drive))},
          {"least_clearance", exact(drive.least_clearance)},
          {"least_wheel_load", drive.plant.empty() ? Json(nullptr) : exact(drive.least_wheel_load)},
          {"solve_time_median", exact(median(times))},
          {"solve_time_max", exact(greatest(times))},
          {"cycles", times.size()},
          {"cycles_unsolved", sim::unsolved(drive).cycles},
          {"cycles_unverified", verification ? Json(verification->unverified) : Json(nullptr)}};
}

Json plant_data(const std::vector<sim::PlantSample>& plant) {
  auto t = Json::array();
  std::array<Json, vehicle::kStates> states;
  std::array<Json, vehicle::kControls> controls;
  std::array<Json, vehicle::kWheels> loads;
  states.fill(Json::array());
  controls.fill(Json::array());
  loads.fill(Json::array());
  auto clearance = Json::array();
  for (const std::size_t k : kept(plant.size(), kMostSamples)) {
    const auto& sample = plant[k];
    t.push_back(rounded(sample.t, kTimeDigits));
    for (std::size_t i = 0; i < vehicle::kStates; ++i)
      states[i].push_back(rounded(sample.state[i], kStateDigits[i]));
    for (std::size_t i = 0; i < vehicle::kControls; ++i)
      controls[i].push_back(rounded(sample.control[i], kControlDigits[i]));
    for (std::size_t i = 0; i < loads.size(); ++i)
      loads[i].push_back(rounded(sample.wheel_loads[i], 1));
    clearance.push_back(rounded(sample.clearance, 4));
  }
  Json json;
  json["t"] = std::move(t);
  for (std::size_t i = 0; i < states.size(); ++i)
    json[vehicle::kStateNames[i]] = std::move(states[i]);
  for (std::size_t i = 0; i < controls.size(); ++i)
    json[vehicle::kControlNames[i]] = std::move(controls[i]);
  for (std::size_t i = 0; i < loads.size(); ++i)
    json[vehicle::kWheelNames[i]] = std::move(loads[i]);
  json["clearance"] = std::move(clearance);
  return json;
}

/// `nodes`: so many of its nodes at the most.
Json plan_data(const planner::Plan& plan, std::size_t nodes) {
  const auto indices = kept(plan.t.size(), nodes);
  Json json;
  json["t_start"] = rounded(plan.t_start, kTimeDigits);
  json["tf"] = rounded(plan.tf, kTimeDigits);
  json["held"] =
      plan.obstacle_time_held >= 0 ? rounded(plan.obstacle_time_held, kTimeDigits) : Json(nullptr);
  json["t"] = Json::array();
  for (const auto k : indices) json["t"].push_back(rounded(plan.t[k], kTimeDigits));
  for (std::size_t i = 0; i < vehicle::kStates; ++i) {
    auto& column = json[vehicle::kStateNames[i]] = Json::array();
    for (const auto k : indices) column.push_back(rounded(plan.states[k][i], kStateDigits[i]));
  }
  for (std::size_t i = 0; i < vehicle::kControls; ++i) {
    auto& column = json[vehicle::kControlNames[i]] = Json::array();
    for (const auto k : indices) column.push_back(rounded(plan.controls[k][i], kControlDigits[i]));
  }
  return json;
}

Json certificate_data(const planner::Certificate& c) {
  return {{"verified", c.verified},
          {"clearance", rounded(c.least_clearance, 4)},
          {"nearest", c.nearest},
          {"wheel_load", rounded(c.least_wheel_load, 1)},
          {"until", rounded(c.until, kTimeDigits)},
          {"refused", c.refused}};
}

/// Of a planner that verifies: where its plan comes from, what is known of it, and what else there
/// was, each a candidate with its cost (null: refused).
void add_verification(Json& json, const planner::Plan& plan) {
  if (plan.rung == planner::Rung::none) return;
  json["rung"] = planner::to_string(plan.rung);
  json["certificate"] = certificate_data(plan.certificate);
  json["candidates"] = Json::array();
  for (const auto& candidate : plan.candidates) {
    const bool verified = candidate.certificate.verified;
    json["candidates"].push_back({{"name", candidate.name},
                                  {"cost", verified ? rounded(candidate.cost, 4) : Json(nullptr)},
                                  {"certificate", certificate_data(candidate.certificate)}});
  }
}

Json cycle_data(const sim::Cycle& cycle, std::size_t cycles) {
  const auto& report = cycle.plan.report;
  Json json;
  json["index"] = cycle.index;
  json["t0"] = rounded(cycle.t0, kTimeDigits);
  json["tex"] = rounded(cycle.tex, kTimeDigits);
  json["t_swap"] = rounded(cycle.t_swap, kTimeDigits);
  json["used"] = cycle.used;
  json["solved"] = report.solved;
  json["status"] = report.status_text();
  json["iterations"] = report.iterations;
  json["wall"] = rounded(report.wall_s, 6);
  json["cpu"] = rounded(report.cpu_s, 6);
  json["cost"] = rounded(report.cost, 4);
  json["terms"] = Json::array();
  for (const auto& [name, value] : report.cost_terms)
    if (cycles <= kMostTerms) json["terms"].push_back(Json::array({name, rounded(value, 4)}));
  json["worst"] = report.worst_constraint;
  if (!report.blocks.empty()) json["blocks"] = report.blocks;
  json["violation"] = exact(report.worst_violation);
  json["goal_in_range"] = cycle.plan.goal_in_range;
  const sim::StartSlack slack = sim::start_slack(cycle);
  json["start_slack"] = {rounded(slack.distance, 3), rounded(slack.heading * 180 / M_PI, 2)};
  if (report.passage.depth > 0)
    json["passage"] = {rounded(report.passage.depth, 3), report.passage.obstacle,
                       rounded(report.passage.at_nodes, 3)};
  if (report.road_exit.depth > 0)
    json["road_exit"] = {rounded(report.road_exit.depth, 3), report.road_exit.edge()};
  add_verification(json, cycle.plan);
  json["plan"] = plan_data(cycle.plan, kMostNodes / cycles);
  return json;
}

}  // namespace

nlohmann::ordered_json drive_data(const sim::Scenario& scenario, const sim::Drive& drive) {
  Json json;
  json["format"] = kDriveFormat;
  json["scenario"] = scenario.name;
  json.update(scenario_data(scenario, end_of(drive)));
  json["settings"] = settings_data(scenario);
  json["outcome"] = sim::to_string(drive.outcome);
  json["outcome_words"] = outcome_words(drive);
  json["message"] = drive.message;
  json["summary"] = summary_data(drive);
  json["goal_time"] = drive.goal_time ? exact(*drive.goal_time) : Json(nullptr);
  json["least_clearance_t"] =
      std::isfinite(drive.least_clearance) ? exact(drive.least_clearance_t) : Json(nullptr);
  json["marks"] = Json::array();
  for (const auto& mark : sim::marks(scenario, drive)) {
    auto times = Json::array();
    for (const double t : mark.times) times.push_back(rounded(t, kTimeDigits));
    json["marks"].push_back({{"kind", mark.kind}, {"text", mark.text}, {"times", times}});
  }
  json["plant"] = plant_data(drive.plant);
  json["cycles"] = Json::array();
  for (const auto& cycle : drive.cycles)
    json["cycles"].push_back(cycle_data(cycle, drive.cycles.size()));
  return json;
}

}  // namespace slalom::report
