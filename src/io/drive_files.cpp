#include "slalom/io/drive_files.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "file_set.hpp"
#include "slalom/io/scenario_file.hpp"
#include "slalom/io/version.hpp"
#include "slalom/report/report.hpp"
#include "slalom/sim/marks.hpp"
#include "slalom/sim/solve_times.hpp"
#include "slalom/sim/verification.hpp"

namespace slalom::io {
namespace {

using Json = nlohmann::ordered_json;

/// JSON knows no infinity and no NaN.
Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json text_or_null(const std::string& text) {
  return text.empty() ? Json(nullptr) : Json(text);
}

Json warm_up_json(const sim::Cycle& cycle) {
  const auto& report = cycle.plan.report;
  return {{"status", report.status_text()},
          {"iterations", report.iterations},
          {"solve_time_s", number(report.wall_s)},
          {"cpu_time_s", number(report.cpu_s)}};
}

/// Nothing for a planner that does not verify its plans.
void add_verification(Json& summary, const sim::Scenario& scenario, const sim::Drive& drive) {
  const auto verification = sim::verification(drive);
  if (!verification) return;
  summary["cycles_unverified"] = verification->unverified;
  Json& rungs = summary["rungs"] = Json::object();
  for (const auto rung : {planner::Rung::new_plan, planner::Rung::rest, planner::Rung::least_bad})
    rungs[planner::to_string(rung)] = verification->of(rung);
  const auto crash = sim::verified_crash(scenario, drive);
  if (!crash) return;
  summary["verified_crash"] = {
      {"cycle", crash->cycle},
      {"kept_m", number(crash->kept)},
      {"off_plan_m", number(crash->off_plan)},
      {"off_belief_m", crash->off_belief ? number(*crash->off_belief) : Json(nullptr)}};
}

void add_marks(Json& summary, const sim::Scenario& scenario, const sim::Drive& drive) {
  double farthest = 0, turned = 0;
  for (const auto& cycle : drive.cycles) {
    if (!cycle.used) continue;
    const auto slack = sim::start_slack(cycle);
    farthest = std::max(farthest, slack.distance);
    turned = std::max(turned, slack.heading);
  }
  summary["start_slack_max_m"] = number(farthest);
  summary["start_slack_max_deg"] = number(turned * 180 / std::numbers::pi);
  Json& marks = summary["marks"] = Json::array();
  for (const auto& mark : sim::marks(scenario, drive))
    marks.push_back({{"kind", mark.kind}, {"text", mark.text}, {"times_s", mark.times}});
}

/// Median and greatest time of the solves on the clock; the warm-up stands by itself.
void add_solve_times(Json& summary, const sim::Scenario& scenario, const sim::Drive& drive) {
  const auto wall = sim::solve_times(drive), cpu = sim::solve_times(drive, true);
  const auto unsolved = sim::unsolved(drive);
  summary["cycles"] = wall.size();
  summary["cycles_unsolved"] = unsolved.cycles;
  summary["cycles_best_iterate"] = unsolved.best_iterates;
  add_verification(summary, scenario, drive);
  summary["solve_time_median_s"] = number(sim::median(wall));
  summary["solve_time_max_s"] = number(sim::greatest(wall));
  summary["cpu_time_median_s"] = number(sim::median(cpu));
  summary["cpu_time_max_s"] = number(sim::greatest(cpu));
  Json warm_up = nullptr;
  for (const auto& cycle : drive.cycles)
    if (cycle.index == 0) warm_up = warm_up_json(cycle);
  summary["warm_up"] = warm_up;
}

Json state_json(const vehicle::State& state) {
  Json json;
  for (std::size_t i = 0; i < state.size(); ++i) json[vehicle::kStateNames[i]] = number(state[i]);
  return json;
}

std::string dump(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string summary_json(const sim::Scenario& scenario, const sim::Drive& drive) {
  Json summary;
  summary["scenario"] = scenario.name;
  summary["title"] = scenario.title;
  summary["planner"] = scenario.planner.name;
  summary["vehicle"] = scenario.vehicle.name;
  summary["outcome"] = sim::to_string(drive.outcome);
  summary["time_s"] = number(drive.time);
  summary["goal_time_s"] = drive.goal_time ? number(*drive.goal_time) : Json(nullptr);
  summary["hit"] = text_or_null(drive.hit);
  summary["message"] = drive.message;
  summary["least_clearance_m"] = number(drive.least_clearance);
  summary["least_clearance_t_s"] =
      std::isfinite(drive.least_clearance) ? number(drive.least_clearance_t) : Json(nullptr);
  summary["least_clearance_obstacle"] = text_or_null(drive.least_clearance_obstacle);
  summary["least_wheel_load_N"] = number(drive.least_wheel_load);
  if (std::isfinite(drive.least_edge_distance)) {
    summary["least_edge_distance_m"] = number(drive.least_edge_distance);
    summary["progress_m"] = number(drive.progress);
    if (scenario.road && scenario.road->closed()) summary["lap_ends_s"] = drive.lap_ends;
  }
  summary["tex_s"] = number(scenario.loop.tex);
  summary["floor"] = number(scenario.planner.floor);
  add_solve_times(summary, scenario, drive);
  add_marks(summary, scenario, drive);
  summary["version"] = kVersion;
  return dump(summary);
}

std::string plan_json(const sim::Scenario& scenario, const sim::Cycle& cycle,
                      const sim::Cycle* warm_up) {
  const auto& report = cycle.plan.report;
  Json json;
  json["scenario"] = scenario.name;
  json["planner"] = scenario.planner.name;
  json["vehicle"] = scenario.vehicle.name;
  json["solved"] = report.solved;
  json["status"] = report.status_text();
  json["backend"] = report.backend;
  json["iterations"] = report.iterations;
  json["solve_time_s"] = number(report.wall_s);
  json["cpu_time_s"] = number(report.cpu_s);
  json["warm_up"] = warm_up == nullptr ? Json(nullptr) : warm_up_json(*warm_up);
  json["t0_s"] = number(cycle.t0);
  json["tex_s"] = number(cycle.tex);
  json["t_start_s"] = number(cycle.plan.t_start);
  json["tf_s"] = number(cycle.plan.tf);
  json["goal_in_range"] = cycle.plan.goal_in_range;
  json["X0p"] = state_json(cycle.X0p);
  json["end"] = cycle.plan.empty() ? Json(nullptr) : state_json(cycle.plan.states.back());
  json["cost"] = number(report.cost);
  Json terms = Json::object();
  for (const auto& [name, value] : report.cost_terms) terms[name] = number(value);
  json["cost_terms"] = terms;
  json["phi"] = number(report.phi);
  json["floor"] = number(scenario.planner.floor);
  json["worst_constraint"] = text_or_null(report.worst_constraint);
  json["worst_violation"] = number(report.worst_violation);
  json["stationarity"] = number(report.stationarity);
  json["complementarity"] = number(report.complementarity);
  json["version"] = kVersion;
  return dump(json);
}

void write_drive(const std::filesystem::path& folder, const sim::Scenario& scenario,
                 const sim::Drive& drive) {
  FileSet files;
  files.add(folder / "plant.csv", plant_csv(drive));
  files.add(folder / "plans.csv", plans_csv(drive));
  files.add(folder / "cycles.csv", cycles_csv(drive));
  files.add(folder / "summary.json", summary_json(scenario, drive));
  files.add(folder / "resolved.yaml", to_yaml(scenario));
  files.add(folder / "report.html", report::drive_page(scenario, drive));
  for (const auto& figure : report::drive_figures(scenario, drive))
    files.add(folder / "figures" / figure.file, figure.svg);
  files.replace_results(folder);
  files.commit();
}

void write_plan(const std::filesystem::path& folder, const sim::Scenario& scenario,
                const sim::Cycle& cycle, const sim::Cycle* warm_up) {
  FileSet files;
  files.add(folder / "plan.csv", plan_csv(cycle.plan));
  files.add(folder / "plan.json", plan_json(scenario, cycle, warm_up));
  files.add(folder / "resolved.yaml", to_yaml(scenario));
  files.replace_results(folder);
  files.commit();
}

}  // namespace slalom::io
