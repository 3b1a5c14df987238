#include "sweep_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "html.hpp"
#include "page_parts.hpp"
#include "sweep_axes.hpp"

namespace slalom::report {
namespace {

/// Speeds of O2 up to which the paper looks separately [m/s], with room for the grid's third digit.
constexpr double kModerate = 16.85, kLow = 4.215;

const PublishedSweep::Point* printed_point(const PublishedSweep& paper, const std::string& planner,
                                           double tex, double speed) {
  constexpr double kSameTex = 0.003;  // the paper prints .790 for .792
  for (const auto& point : paper.points)
    if (point.planner == planner && std::abs(point.tex - tex) < kSameTex &&
        std::abs(point.speed - speed) < 0.1)
      return &point;
  return nullptr;
}

/// `speed`: the paper's, to find its figures by; `limit`: what is left out.
std::string horizon_table(const SweepTable& sweep, const PublishedSweep& paper, bool beside,
                          double speed, double limit) {
  std::string rows;
  for (const auto& planner : sweep.planners)
    for (const auto& row : horizon_rows(sweep, planner, limit)) {
      rows += row_head(planner) + cell(number(row.tex, 3)) +
              cell(fmt::format("{} of {}", row.passed, row.trials)) + cell(number(row.pos(), 3)) +
              cell(significant(row.rtf_cpu, 3), row.rtf_cpu < 1 ? "num good" : "num bad") +
              cell(significant(row.rtf_cpu_95, 3)) + cell(significant(row.rtf, 3));
      if (beside) {
        const auto* point = printed_point(paper, planner, row.tex, speed);
        rows += cell(point == nullptr ? "" : number(point->rtf, 3), "num paper") +
                cell(point == nullptr ? "" : number(point->pos, 3), "num paper");
      }
      rows += "</tr>\n";
    }
  std::vector<std::string> names = {
      "planner",         "tex [s]", "at the goal", "POS", "RTF (CPU time)", "its 95th percentile",
      "RTF (wall clock)"};
  if (beside) names.insert(names.end(), {"paper: RTF", "paper: POS"});
  return table(head_cells(names), rows);
}

}  // namespace

std::string horizons_html(const SweepTable& sweep, const PublishedSweep& paper, bool beside) {
  if (!column_index(sweep, kTexKey)) return "<p class=\"sub\">The study does not vary tex.</p>\n";
  const auto part = [&](const char* title, double speed, double limit, bool open) {
    return fmt::format("<details{}><summary>{}</summary>\n{}</details>\n", open ? " open" : "",
                       title, horizon_table(sweep, paper, beside, speed, limit));
  };
  auto html = part("All speeds", 40, std::numeric_limits<double>::infinity(), true);
  if (column_index(sweep, kSpeedKey))
    html += part("O2 at up to 16.8 m/s", 16.8, kModerate, false) +
            part("O2 at up to 4.21 m/s", 4.21, kLow, false);
  return html;
}

std::string solve_time_table(const SweepTable& sweep) {
  std::string rows;
  for (const auto& planner : sweep.planners) {
    std::vector<double> median, cpu, wall;
    for (const auto& r : sweep.trials) {
      if (r.planner != planner || !std::isfinite(r.max_cpu_time)) continue;
      median.push_back(1e3 * r.median_cpu_time);
      cpu.push_back(1e3 * r.max_cpu_time);
      wall.push_back(1e3 * r.max_solve_time);
    }
    if (cpu.empty()) continue;
    rows += row_head(planner) + cell(significant(quantile(median, 0.5), 3));
    for (const auto* longest : {&cpu, &wall})
      for (const double q : {0.5, 0.95, 1.0}) rows += cell(significant(quantile(*longest, q), 3));
    rows += "</tr>\n";
  }
  if (rows.empty()) return "";
  return "<h3>Solve times [ms]</h3>\n<p class=\"remark\">The median trial\u2019s median solve, and "
         "percentiles over trials of each one\u2019s longest solve, failing ones included.</p>\n" +
         table(head_cells({"planner", "median", "longest, CPU: median", "95 %", "greatest",
                           "longest, wall: median", "95 %", "greatest"}),
               rows);
}

std::string failed_cycle_table(const SweepTable& sweep) {
  std::string rows;
  for (const auto& planner : sweep.planners) {
    std::int64_t cycles = 0, failed = 0, trials = 0, trials_failed = 0;
    std::int64_t fresh = 0, rests = 0, least_bads = 0;
    for (const auto& r : sweep.trials) {
      if (r.planner != planner) continue;
      cycles += r.cycles;
      failed += r.failed_cycles;
      fresh += r.new_plans;
      rests += r.rests;
      least_bads += r.least_bads;
      ++trials;
      trials_failed += r.failed_cycles > 0;
    }
    if (trials == 0) continue;
    rows += row_head(planner) + cell(fmt::format("{} of {}", failed, cycles)) +
            cell(fmt::format("{} of {}", trials_failed, trials));
    for (const auto count : {fresh, rests, least_bads})
      rows += cell(fresh + rests + least_bads == 0 ? "" : fmt::format("{}", count));
    rows += "</tr>\n";
  }
  if (rows.empty()) return "";
  return "<h3>Cycles that failed</h3>\n<p class=\"remark\">Those without a solved plan; of a "
         "planner "
         "that verifies its plans, those without a verified one, and beside them what was "
         "driven.</p>\n" +
         table(head_cells({"planner", "cycles that failed", "trials with one", "a new plan",
                           "the rest of the last", "the least bad"}),
               rows);
}

std::string longest_horizon_table(const SweepTable& sweep) {
  const auto rows_of = longest_horizons(sweep);
  if (rows_of.empty()) return "";
  std::string rows;
  for (const auto& row : rows_of) {
    rows += row_head(significant(row.value, 4));
    for (const auto& one : row.planners)
      rows += cell(std::isfinite(one.tex) ? number(one.tex, 3) : "\u2013") +
              cell(fmt::format("{} of {}", one.best, row.horizons));
    rows += "</tr>\n";
  }
  std::vector<std::string> names = {escape(rows_of.front().key)};
  for (const auto& one : rows_of.front().planners)
    names.insert(names.end(), {escape(one.planner) + ": tex [s]", "horizons as good"});
  return "<h3>How short tex must be</h3>\n<p class=\"remark\">The longest execution horizon of the "
         "grid at which, and at all shorter ones, as many trials arrive as at the best one: below "
         "it "
         "a shorter one helps no more. A dash: no trial arrives at any, or the shortest is not "
         "among "
         "the best. Beside it, how many horizons do as well as the best.</p>\n" +
         table(head_cells(names), rows);
}

/// Every pass with how near it came.
std::string pass_table(const SweepTable& sweep) {
  const bool several = sweep.scenarios.size() > 1;
  std::string rows;
  for (const auto& r : sweep.trials) {
    if (!r.passed()) continue;
    rows += row_head(fmt::format("{}", r.trial));
    if (several) rows += cell(escape(r.scenario), "");
    rows += cell(escape(r.planner), "");
    for (std::size_t i = 0; i < r.values.size(); ++i) {
      const double value = number_at(r, i);
      rows += cell(std::isnan(value) ? escape(r.values[i]) : significant(value, 4));
    }
    rows += cell(number(r.time, 2)) + cell(number(r.least_clearance, 3)) +
            cell(escape(r.least_clearance_obstacle), "") + "</tr>\n";
  }
  std::vector<std::string> names = {"trial"};
  if (several) names.push_back("scenario");
  names.push_back("planner");
  for (const auto& column : sweep.columns) names.push_back(escape(column));
  names.insert(names.end(), {"time [s]", "least clearance [m]", "to"});
  return table(head_cells(names), rows);
}

}  // namespace slalom::report
