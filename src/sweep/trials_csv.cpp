#include "trials_csv.hpp"

#include <fmt/format.h>

#include <cmath>

#include "../io/csv.hpp"

namespace slalom::sweep {
namespace {

/// An empty cell for a figure that does not exist.
std::string number_cell(double value) {
  return std::isnan(value) ? "" : fmt::format("{}", value);
}

}  // namespace

std::string trials_csv_row(const report::SweepTable& study, const report::TrialRecord& r) {
  auto text = fmt::format("{},{},{}", r.trial, io::csv_cell(r.scenario), io::csv_cell(r.planner));
  for (const auto& value : r.values) text += "," + io::csv_cell(value);
  if (study.repeats > 1) text += fmt::format(",{}", r.repeat);
  text += fmt::format(",{},{},{}", r.outcome, number_cell(r.time), number_cell(r.max_solve_time));
  text += fmt::format(",{},{},{}", io::csv_cell(r.hit), number_cell(r.goal_time),
                      number_cell(r.least_clearance));
  text += fmt::format(",{},{},{},{},{}", io::csv_cell(r.least_clearance_obstacle),
                      number_cell(r.least_wheel_load), r.cycles, r.failed_cycles, r.iterations);
  text += fmt::format(",{},{},{},{}", r.new_plans, r.rests, r.least_bads, io::csv_cell(r.marks));
  text += fmt::format(",{},{},{},{},{},{}\n", number_cell(r.median_solve_time),
                      number_cell(r.max_cpu_time), number_cell(r.p99_cpu_time),
                      number_cell(r.median_cpu_time), r.identity, io::csv_cell(r.message));
  return text;
}

std::string trials_csv_head(const report::SweepTable& study) {
  std::string text = "trial,scenario,planner";
  for (const auto& column : study.columns) text += "," + io::csv_cell(column);
  if (study.repeats > 1) text += ",repeat";
  text +=
      ",outcome,time_s,max_solve_time_s,hit,goal_time_s,least_clearance_m,least_clearance_obstacle,"
      "least_wheel_load_N,cycles,failed_cycles,iterations,new_plans,rests,least_bads,marks,"
      "median_solve_time_s,max_cpu_time_s,p99_cpu_time_s,median_cpu_time_s,identity,message\n";
  return text;
}

}  // namespace slalom::sweep
