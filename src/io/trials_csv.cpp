#include "trials_csv.hpp"

#include <fmt/format.h>

#include <cmath>

#include "csv.hpp"

namespace slalom::io {
namespace {

/// An empty cell for a figure that does not exist.
std::string number_cell(double value) {
  return std::isnan(value) ? "" : fmt::format("{}", value);
}

}  // namespace

std::string trials_csv_row(const study::SweepTable& study, const study::TrialRecord& r) {
  auto text = fmt::format("{},{},{}", r.trial, csv_cell(r.scenario), csv_cell(r.planner));
  for (const auto& value : r.values) text += "," + csv_cell(value);
  if (study.repeats > 1) text += fmt::format(",{}", r.repeat);
  text += fmt::format(",{},{},{}", r.outcome, number_cell(r.time), number_cell(r.max_solve_time));
  text += fmt::format(",{},{},{}", csv_cell(r.hit), number_cell(r.goal_time),
                      number_cell(r.least_clearance));
  text += fmt::format(",{},{},{},{},{}", csv_cell(r.least_clearance_obstacle),
                      number_cell(r.least_wheel_load), r.cycles, r.failed_cycles, r.iterations);
  text += fmt::format(",{},{},{},{},{}\n", number_cell(r.median_solve_time),
                      number_cell(r.max_cpu_time), number_cell(r.median_cpu_time), r.identity,
                      csv_cell(r.message));
  return text;
}

std::string trials_csv_head(const study::SweepTable& study) {
  std::string text = "trial,scenario,planner";
  for (const auto& column : study.columns) text += "," + csv_cell(column);
  if (study.repeats > 1) text += ",repeat";
  text +=
      ",outcome,time_s,max_solve_time_s,hit,goal_time_s,least_clearance_m,least_clearance_obstacle,"
      "least_wheel_load_N,cycles,failed_cycles,iterations,median_solve_time_s,max_cpu_time_s,"
      "median_cpu_time_s,identity,message\n";
  return text;
}

}  // namespace slalom::io
