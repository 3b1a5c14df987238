#include "drive_data.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "cycle_data.hpp"
#include "page_json.hpp"
#include "shapes.hpp"
#include "slalom/sim/marks.hpp"
#include "slalom/sim/verification.hpp"
#include "thinning.hpp"
#include "words.hpp"

namespace slalom::report {
namespace {

using Json = nlohmann::ordered_json;

// What a page carries at the most, so that one of an hour's drive opens at once: in all, what its
// frame with all settings takes of that, and what is left for the cycles at the least [bytes].
constexpr std::size_t kPageBytes = 4'800'000, kFrameBytes = 200'000, kCycleBytes = 500'000;
// Samples of the plant; rows of the motions that are given, of all obstacles together; points of
// all lanes; times of a mark.
constexpr std::size_t kMostSamples = 11'000, kMostTrackRows = 40'000, kMostLanePoints = 16'000,
                      kMostTimes = 1'000;

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

Json places(const std::vector<world::Point>& points, std::size_t most) {
  Json json = Json::array();
  for (const auto k : kept_evenly(points.size(), most))
    json.push_back({rounded(points[k].x, 2), rounded(points[k].y, 2)});
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
  const auto whole = [](const auto& line) { return places(line, line.size()); };
  Json json = {{"left", whole(lines.left)},
               {"right", whole(lines.right)},
               {"middle", whole(lines.middle)},
               {"lanes", Json::array()}};
  const auto& lanes = road.lanes();
  for (const auto& lane : lanes)
    json["lanes"].push_back(places(lane, kMostLanePoints / lanes.size()));
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

Json plant_data(const std::vector<sim::PlantSample>& plant, const std::vector<double>& marked) {
  auto t = Json::array();
  std::array<Json, vehicle::kStates> states;
  std::array<Json, vehicle::kControls> controls;
  std::array<Json, vehicle::kWheels> loads;
  states.fill(Json::array());
  controls.fill(Json::array());
  loads.fill(Json::array());
  auto clearance = Json::array();
  for (const std::size_t k : kept_samples(plant, marked, kMostSamples)) {
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

/// What the outcome does not tell, and all times of it.
Json marks_data(const std::vector<sim::Mark>& marks) {
  Json json = Json::array();
  for (const auto& mark : marks) {
    auto times = Json::array();
    for (const auto k : kept_evenly(mark.times.size(), kMostTimes))
      times.push_back(rounded(mark.times[k], kTimeDigits));
    json.push_back({{"kind", mark.kind}, {"text", mark.text}, {"times", times}});
  }
  return json;
}

/// How many cycles on the clock have a plan of each rung; null for planners that do not verify.
Json rungs_data(const sim::Drive& drive) {
  const auto verification = sim::verification(drive);
  if (!verification) return nullptr;
  Json json;
  for (const auto rung : {planner::Rung::new_plan, planner::Rung::rest, planner::Rung::least_bad})
    json[planner::to_string(rung)] = verification->of(rung);
  return json;
}

/// Puts the cycles in, in what the page has left, and says what it leaves out.
void add_cycles(Json& json, const sim::Scenario& scenario, const sim::Drive& drive,
                const std::vector<double>& marked) {
  const std::size_t so_far =
      kFrameBytes + json.dump(-1, ' ', false, Json::error_handler_t::replace).size();
  const std::size_t left = kPageBytes - std::min(kPageBytes - kCycleBytes, so_far);
  CyclesData data = cycles_data(scenario, drive, marked, left);
  const std::size_t samples = json["plant"]["t"].size(), cycles = data.cycles.size();
  json["left_out"] = nullptr;
  if (samples < drive.plant.size() || data.detailed < drive.cycles.size() || !data.all_nodes)
    json["left_out"] = {{"samples", {samples, drive.plant.size()}},
                        {"cycles", {cycles, drive.cycles.size()}},
                        {"detailed", data.detailed},
                        {"nodes", data.all_nodes ? Json(nullptr) : Json(data.nodes)}};
  json["cycles"] = std::move(data.cycles);
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
  const auto marks = sim::marks(scenario, drive);
  std::vector<double> marked = {drive.least_clearance_t};
  if (drive.goal_time) marked.push_back(*drive.goal_time);
  for (const auto& mark : marks) marked.insert(marked.end(), mark.times.begin(), mark.times.end());
  json["marks"] = marks_data(marks);
  json["rungs"] = rungs_data(drive);
  json["plant"] = plant_data(drive.plant, marked);
  add_cycles(json, scenario, drive, marked);
  return json;
}

}  // namespace slalom::report
