#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "csv.hpp"
#include "slalom/io/drive_files.hpp"
#include "slalom/sim/marks.hpp"
#include "slalom/sim/verification.hpp"

namespace slalom::io {
namespace {

template <class Range>
void append_all(std::string& row, const Range& values) {
  for (const auto& value : values) row += fmt::format(",{}", value);
}

/// The names of all cost terms, in order of first appearance: a term may be absent from the cycles
/// in which it is switched off.
std::vector<std::string> cost_term_names(const sim::Drive& drive) {
  std::vector<std::string> names;
  for (const auto& cycle : drive.cycles)
    for (const auto& [name, value] : cycle.plan.report.cost_terms)
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

double cost_term(const planner::SolveReport& report, const std::string& name) {
  for (const auto& [term, value] : report.cost_terms)
    if (term == name) return value;
  return 0;
}

/// What a planner that verifies says of its plan. Of a plan that there is not, nothing but that.
std::string verification_cells(const planner::Plan& plan) {
  const auto& c = plan.certificate;
  if (plan.rung == planner::Rung::none) return ",,0,,,,,";
  return fmt::format(",{},{},{},{},{},{},{}", planner::to_string(plan.rung), c.verified ? 1 : 0,
                     c.least_clearance, c.least_wheel_load, c.until, csv_cell(c.refused),
                     plan.candidates.size());
}

}  // namespace

std::string plant_csv(const sim::Drive& drive) {
  std::string text = "t";
  append_all(text, vehicle::kStateNames);
  append_all(text, vehicle::kControlNames);
  append_all(text, vehicle::kWheelNames);
  text += ",clearance\n";
  for (const auto& sample : drive.plant) {
    text += fmt::format("{}", sample.t);
    append_all(text, sample.state);
    append_all(text, sample.control);
    append_all(text, sample.wheel_loads);
    text += fmt::format(",{}\n", sample.clearance);
  }
  return text;
}

std::string plans_csv(const sim::Drive& drive) {
  std::string text = "cycle,t_start,node,t";
  append_all(text, vehicle::kStateNames);
  append_all(text, vehicle::kControlNames);
  text += "\n";
  for (const auto& cycle : drive.cycles) {
    if (cycle.index == 0) continue;
    const auto& plan = cycle.plan;
    for (std::size_t k = 0; k < plan.t.size(); ++k) {
      text += fmt::format("{},{},{},{}", cycle.index, plan.t_start, k, plan.t_start + plan.t[k]);
      append_all(text, plan.states[k]);
      append_all(text, plan.controls[k]);
      text += "\n";
    }
  }
  return text;
}

std::string plan_csv(const planner::Plan& plan) {
  std::string text = "node,t";
  append_all(text, vehicle::kStateNames);
  append_all(text, vehicle::kControlNames);
  text += "\n";
  for (std::size_t k = 0; k < plan.t.size(); ++k) {
    text += fmt::format("{},{}", k, plan.t_start + plan.t[k]);
    append_all(text, plan.states[k]);
    append_all(text, plan.controls[k]);
    text += "\n";
  }
  return text;
}

std::string cycles_csv(const sim::Drive& drive) {
  const auto terms = cost_term_names(drive);
  std::string text = "cycle,t0,tex,solve_time_s,iterations,status,cpu_time_s,cost";
  for (const auto& term : terms) text += "," + csv_cell("cost_" + term);
  text +=
      ",worst_constraint,worst_violation,stationarity,complementarity,phi,tf,goal_in_range,used,"
      "backend,best_iterate,planning_cpu_s,charged_s,t_swap,start_slack_m,start_slack_deg,passage_"
      "m,"
      "passage_obstacle,road_exit_m,road_exit_edge";
  const bool verifies = sim::verification(drive).has_value();
  if (verifies)
    text +=
        ",rung,verified,verified_clearance,verified_wheel_load,verified_until,refused,candidates";
  text += "\n";
  for (const auto& cycle : drive.cycles) {
    if (cycle.index == 0) continue;
    const auto& report = cycle.plan.report;
    text +=
        fmt::format("{},{},{},{},{},{},{},{}", cycle.index, cycle.t0, cycle.tex, report.wall_s,
                    report.iterations, csv_cell(report.status_text()), report.cpu_s, report.cost);
    for (const auto& term : terms) text += fmt::format(",{}", cost_term(report, term));
    text +=
        fmt::format(",{},{},{},{},{},{},{},{},{},{},{},{},{}", csv_cell(report.worst_constraint),
                    report.worst_violation, report.stationarity, report.complementarity, report.phi,
                    cycle.plan.tf, cycle.plan.goal_in_range ? 1 : 0, cycle.used ? 1 : 0,
                    csv_cell(report.backend), report.best_iterate ? 1 : 0, report.planning_cpu_s,
                    cycle.charged, cycle.t_swap);
    const sim::StartSlack slack = sim::start_slack(cycle);
    text +=
        fmt::format(",{},{},{},{},{},{}", slack.distance, slack.heading * 180 / std::numbers::pi,
                    report.passage.depth, csv_cell(report.passage.obstacle), report.road_exit.depth,
                    report.road_exit.edge());
    text += verifies ? verification_cells(cycle.plan) + "\n" : "\n";
  }
  return text;
}

}  // namespace slalom::io
