#include "reproduction_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "../report/html.hpp"
#include "../report/page_parts.hpp"
#include "../report/words.hpp"
#include "claims.hpp"
#include "comparison.hpp"

namespace slalom::paper {
namespace {

/// The head of a row: environment and planner, linked to the drive's page.
std::string row_head(const ReproducedDrive& one) {
  return fmt::format("<th scope=\"row\">{}</th><td>{}</td>", report::escape(one.scenario.name),
                     report::link(one.folder + "/report.html", one.scenario.planner.name));
}

std::string mark(bool good, const std::string& yes = "yes", const std::string& no = "no") {
  return fmt::format("<span class=\"{}\">{} {}</span>", good ? "good" : "bad", good ? "✓" : "✕",
                     report::escape(good ? yes : no));
}

std::string signed_number(double value, int digits) {
  return value > 0 ? "+" + report::number(value, digits) : report::number(value, digits);
}

std::string percent(double from, double to) {
  return from > 0 ? signed_number(100 * (to - from) / from, 1) + " %" : "–";
}

std::string paper_outcome(const PaperDrive& paper) {
  if (paper.outcome == "goal") return "Reached the goal";
  if (paper.outcome == "crash" && !paper.hit.empty()) return "Crashed into " + paper.hit;
  return paper.outcome;
}

}  // namespace

std::string claims_table(const std::vector<Judged>& claims) {
  std::string rows;
  for (const auto& claim : claims) {
    const bool part = claim.verdict == Verdict::in_part;
    rows += fmt::format("<tr><td>{}</td><td>{}</td><td class=\"paper\">{}</td><td>{}</td></tr>\n",
                        part ? "<span class=\"muted\">◐&nbsp;in&nbsp;part</span>"
                             : mark(claim.verdict == Verdict::holds),
                        report::escape(claim.says), report::escape(claim.printed),
                        report::escape(claim.ours));
  }
  return report::table(
      "<tr><th scope=\"col\">Holds</th><th scope=\"col\">The paper says</th>"
      "<th scope=\"col\" class=\"paper\">Its figures</th><th scope=\"col\">Ours</th></tr>",
      rows);
}

std::string outcome_table(const std::vector<ReproducedDrive>& drives, const PaperData& paper) {
  std::string rows;
  for (const auto& one : drives) {
    const auto& drive = one.drive;
    const auto* printed = find(paper, one);
    rows += "<tr>" + row_head(one);
    rows += report::cell(report::escape(report::outcome_words(drive)), "words") +
            report::cell(report::number(drive.time, 2)) +
            report::cell(drive.goal_time ? report::number(*drive.goal_time, 2) : "–");
    rows += report::cell(report::number(drive.least_clearance, 2)) +
            report::cell(report::escape(drive.least_clearance_obstacle), "");
    if (printed == nullptr) {
      rows += "<td class=\"paper\" colspan=\"4\">not in the paper</td></tr>\n";
      continue;
    }
    rows +=
        report::cell(report::escape(paper_outcome(*printed)), "words paper") +
        report::cell(report::number(printed->time, 1), "num paper") +
        report::cell(signed_number(drive.time - printed->time, 2), "num paper") +
        report::cell(mark(as_paper(drive, *printed), "as the paper’s", "differs"), "words paper") +
        "</tr>\n";
    if (!printed->note.empty())
      rows += fmt::format("<tr class=\"note\"><td></td><td></td><td colspan=\"9\">{}</td></tr>\n",
                          report::escape(printed->note));
  }
  return report::table(
      "<tr><th scope=\"col\" rowspan=\"2\">Environment</th><th scope=\"col\" rowspan=\"2\">Planner"
      "</th><th colspan=\"5\" scope=\"colgroup\">Ours</th><th colspan=\"4\" scope=\"colgroup\" "
      "class=\"paper\">Paper</th></tr>"
      "<tr><th scope=\"col\">Outcome</th><th scope=\"col\" class=\"num\">Time [s]</th>"
      "<th scope=\"col\" class=\"num\">Goal entered [s]</th><th scope=\"col\" class=\"num\">Least "
      "clearance [m]</th><th scope=\"col\">to</th><th scope=\"col\" class=\"paper\">Outcome</th>"
      "<th scope=\"col\" class=\"num paper\">Time [s]</th><th scope=\"col\" class=\"num "
      "paper\">Ours"
      " − paper [s]</th><th scope=\"col\" class=\"paper\">Verdict</th></tr>",
      rows);
}

namespace {

std::string effort_rows(const std::string& measure, const ControlEffort& b, const ControlEffort& c,
                        const PaperData* paper) {
  struct Row {
    const char* name;
    double b, c, paper_b, paper_c;
  };
  const PaperData::Effort none{NAN, NAN, NAN, NAN};
  const auto pb = paper != nullptr ? paper->effort_P_B : none;
  const auto pc = paper != nullptr ? paper->effort_P_C : none;
  const std::array<Row, 4> list = {
      Row{"steering angle", b.steering_angle, c.steering_angle, pb.steering_angle,
          pc.steering_angle},
      Row{"steering rate", b.steering_rate, c.steering_rate, pb.steering_rate, pc.steering_rate},
      Row{"longitudinal jerk", b.jerk, c.jerk, pb.jerk, pc.jerk},
      Row{"total", b.total(), c.total(), pb.total, pc.total}};
  std::string rows;
  for (const auto& row : list) {
    const bool first = &row == &list.front();
    rows += fmt::format("<tr{}>", &row == &list.back() ? " class=\"total\"" : "");
    if (first) rows += fmt::format("<th scope=\"rowgroup\" rowspan=\"4\">{}</th>", measure);
    rows += fmt::format("<td>{}</td>", row.name) + report::cell(report::significant(row.b, 3)) +
            report::cell(report::significant(row.c, 3)) + report::cell(percent(row.b, row.c)) +
            report::cell(report::significant(row.paper_b, 3), "num paper") +
            report::cell(report::significant(row.paper_c, 3), "num paper") +
            report::cell(std::isfinite(row.paper_b) ? percent(row.paper_b, row.paper_c) : "–",
                         "num paper") +
            "</tr>\n";
  }
  return rows;
}

}  // namespace

std::string effort_table(const std::vector<ReproducedDrive>& drives, const PaperData& paper) {
  std::string rows;
  for (const char* environment : {"E_A-figure", "E_A"}) {
    const auto* B = find(drives, environment, "P_B");
    const auto* C = find(drives, environment, "P_C");
    if (B == nullptr || C == nullptr) continue;
    // The paper's numbers are of the obstacle field of its figures.
    const bool figure = std::string(environment) == "E_A-figure";
    rows += effort_rows(fmt::format("{}<br><small>0.1 ∫(·)² dt, the paper’s</small>", environment),
                        effort_paper(B->drive), effort_paper(C->drive), figure ? &paper : nullptr);
    // P_B's cost has no effort term; both are weighed as P_C weighs them.
    const auto& weights = C->scenario.planner;
    rows += effort_rows(fmt::format("{}<br><small>the cost’s weights {:g}, {:g}, {:g}</small>",
                                    environment, weights.w_sa, weights.w_sr, weights.w_jx),
                        effort_weighted(B->drive, weights), effort_weighted(C->drive, weights),
                        nullptr);
  }
  return report::table(
      "<tr><th scope=\"col\" rowspan=\"2\">Measure</th><th scope=\"col\" rowspan=\"2\">Term</th>"
      "<th colspan=\"3\" scope=\"colgroup\">Ours</th><th colspan=\"3\" scope=\"colgroup\" "
      "class=\"paper\">Paper</th></tr><tr><th scope=\"col\" class=\"num\">P_B</th>"
      "<th scope=\"col\" class=\"num\">P_C</th><th scope=\"col\" class=\"num\">Change</th>"
      "<th scope=\"col\" class=\"num paper\">P_B</th><th scope=\"col\" class=\"num paper\">P_C</th>"
      "<th scope=\"col\" class=\"num paper\">Change</th></tr>",
      rows);
}

std::string speed_table(const std::vector<ReproducedDrive>& drives, const PaperData& paper) {
  std::string rows;
  for (const auto& one : drives) {
    double start = NAN, end = NAN, least = NAN, most = NAN;
    for (const auto& sample : one.drive.plant) {
      const double ux = sample.state[vehicle::UX];
      if (std::isnan(start)) start = least = most = ux;
      end = ux;
      least = std::min(least, ux);
      most = std::max(most, ux);
    }
    const auto* printed = find(paper, one);
    rows += "<tr>" + row_head(one);
    for (const double v : {start, end, least, most, report::mean_speed(one.drive)})
      rows += report::cell(report::number(v, 2));
    rows +=
        report::cell(printed != nullptr ? report::number(printed->end_ux, 1) : "–", "num paper") +
        "</tr>\n";
  }
  return report::table(
      "<tr><th scope=\"col\">Environment</th><th scope=\"col\">Planner</th><th scope=\"col\" "
      "class=\"num\">Start [m/s]</th><th scope=\"col\" class=\"num\">End [m/s]</th><th "
      "scope=\"col\" class=\"num\">Least [m/s]</th><th scope=\"col\" class=\"num\">Greatest [m/s]"
      "</th><th scope=\"col\" class=\"num\">Mean [m/s]</th><th scope=\"col\" class=\"num paper\">"
      "Paper, end [m/s]</th></tr>",
      rows);
}

std::string solve_time_table(const std::vector<ReproducedDrive>& drives) {
  std::string rows;
  for (const auto& one : drives) {
    rows += "<tr>" + row_head(one);
    const double tex = one.scenario.loop.tex;
    const auto count = solve_times(one.drive).size();
    rows += report::cell(fmt::format("{}", count)) + report::cell(report::number(tex, 2));
    for (const bool cpu : {false, true}) {
      const auto times = solve_times(one.drive, cpu);
      const auto fast = static_cast<double>(
          std::count_if(times.begin(), times.end(), [&](double t) { return t < tex; }));
      rows += report::cell(report::number(1e3 * sim::median(times), 1)) +
              report::cell(report::number(1e3 * sim::greatest(times), 1)) +
              report::cell(times.empty()
                               ? "–"
                               : report::number(100 * fast / static_cast<double>(times.size()), 0) +
                                     " %");
    }
    rows += "</tr>\n";
  }
  return report::table(
      "<tr><th scope=\"col\" rowspan=\"2\">Environment</th><th scope=\"col\" rowspan=\"2\">Planner"
      "</th><th scope=\"col\" rowspan=\"2\" class=\"num\">Cycles</th><th scope=\"col\" "
      "rowspan=\"2\" class=\"num\">tex [s]</th><th colspan=\"3\" scope=\"colgroup\">Wall clock "
      "[ms]</th><th colspan=\"3\" scope=\"colgroup\">CPU [ms]</th></tr><tr>"
      "<th scope=\"col\" class=\"num\">Median</th><th scope=\"col\" class=\"num\">Greatest</th><th "
      "scope=\"col\" class=\"num\">below tex</th><th scope=\"col\" class=\"num\">Median</th><th "
      "scope=\"col\" class=\"num\">Greatest</th><th scope=\"col\" class=\"num\">below "
      "tex</th></tr>",
      rows);
}

namespace {

std::string position_cells(const ReproducedDrive& one, const PaperDrive& printed,
                           const PaperDrive::Snapshot& snapshot) {
  constexpr double deg = 180 / std::numbers::pi;
  const auto ours = compare(one.drive, printed, snapshot);
  std::string cells;
  if (ours) {
    cells += report::cell(
                 fmt::format("{}, {}", report::number(ours->x, 2), report::number(ours->y, 2))) +
             report::cell(report::number(ours->psi * deg, 1));
  } else {
    cells += fmt::format("<td class=\"num\" colspan=\"2\">over at {} s</td>",
                         report::number(one.drive.time, 2));
  }
  cells += report::cell(
               fmt::format("{}, {}", report::number(snapshot.x, 2), report::number(snapshot.y, 2)),
               "num paper") +
           report::cell(report::number(snapshot.psi * deg, 1), "num paper");
  if (!ours)
    return cells + report::cell("–") + report::cell("–") +
           report::cell(report::number(snapshot.tolerance, 1)) + report::cell("", "");
  const auto verdict = ours->comparable ? mark(ours->within, "within", "outside")
                                        : "<span class=\"muted\">the series lags</span>";
  return cells + report::cell(report::number(ours->distance, 2)) +
         report::cell(report::number(ours->unlagged, 2)) +
         report::cell(ours->comparable ? report::number(snapshot.tolerance, 1) : "–") +
         report::cell(verdict, "");
}

}  // namespace

std::string position_table(const std::vector<ReproducedDrive>& drives, const PaperData& paper) {
  std::string rows;
  for (const auto& one : drives) {
    const auto* printed = find(paper, one);
    if (printed == nullptr) continue;
    for (const auto& snapshot : printed->snapshots) {
      if (snapshot.t == 0) continue;  // the start is given
      rows += "<tr>" + row_head(one) +
              report::cell(report::link(fmt::format("{}/report.html#t={:.4f}", one.folder,
                                                    std::min(snapshot.t, one.drive.time)),
                                        report::number(snapshot.t, 2))) +
              position_cells(one, *printed, snapshot) + "</tr>\n";
    }
  }
  return report::table(
      "<tr><th scope=\"col\">Environment</th><th scope=\"col\">Planner</th><th scope=\"col\" "
      "class=\"num\">t [s]</th><th scope=\"col\" class=\"num\">Ours x, y [m]</th><th scope=\"col\" "
      "class=\"num\">heading [°]</th><th scope=\"col\" class=\"num paper\">Paper x, y [m]</th><th "
      "scope=\"col\" class=\"num paper\">heading [°]</th><th scope=\"col\" class=\"num\">Distance "
      "[m]</th><th scope=\"col\" class=\"num\">without lag [m]</th><th scope=\"col\" "
      "class=\"num\">Allowed [m]</th><th scope=\"col\">Verdict</th></tr>",
      rows);
}

}  // namespace slalom::paper
