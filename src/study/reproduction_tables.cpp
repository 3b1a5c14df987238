#include "reproduction_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "claims.hpp"
#include "comparison.hpp"
#include "html.hpp"
#include "page_parts.hpp"
#include "words.hpp"

namespace slalom::study {
namespace {

/// The head of a row: environment and planner, linked to the drive's page.
std::string row_head(const ReproducedDrive& one) {
  return fmt::format("<th scope=\"row\">{}</th><td>{}</td>", escape(one.scenario.name),
                     link(one.folder + "/report.html", one.scenario.planner.name));
}

std::string mark(bool good, const std::string& yes = "yes", const std::string& no = "no") {
  return fmt::format("<span class=\"{}\">{} {}</span>", good ? "good" : "bad", good ? "✓" : "✕",
                     escape(good ? yes : no));
}

std::string signed_number(double value, int digits) {
  return value > 0 ? "+" + number(value, digits) : number(value, digits);
}

std::string percent(double from, double to) {
  return from > 0 ? signed_number(100 * (to - from) / from, 1) + " %" : "–";
}

bool as_paper(const sim::Drive& drive, const PaperDrive& paper) {
  return paper.outcome == sim::to_string(drive.outcome) &&
         (paper.hit.empty() || paper.hit == drive.hit);
}

std::string paper_outcome(const PaperDrive& paper) {
  if (paper.outcome == "goal") return "Reached the goal";
  if (paper.outcome == "crash" && !paper.hit.empty()) return "Crashed into " + paper.hit;
  return paper.outcome;
}

}  // namespace

std::string claims_table(const std::vector<ReproducedDrive>& drives) {
  std::string rows;
  for (const auto& claim : claims(drives))
    rows += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", mark(claim.holds),
                        escape(claim.text), escape(claim.ours));
  return table(
      "<tr><th scope=\"col\">Holds</th><th scope=\"col\">The paper’s drives show</th>"
      "<th scope=\"col\">Ours</th></tr>",
      rows);
}

std::string outcome_table(const std::vector<ReproducedDrive>& drives, const PaperData& paper) {
  std::string rows;
  for (const auto& one : drives) {
    const auto& drive = one.drive;
    const auto* printed = find(paper, one);
    rows += "<tr>" + row_head(one);
    rows += cell(escape(outcome_words(drive)), "words") + cell(number(drive.time, 2)) +
            cell(drive.goal_time ? number(*drive.goal_time, 2) : "–");
    rows +=
        cell(number(drive.least_clearance, 2)) + cell(escape(drive.least_clearance_obstacle), "");
    if (printed == nullptr) {
      rows += "<td class=\"paper\" colspan=\"4\">not in the paper</td></tr>\n";
      continue;
    }
    rows += cell(escape(paper_outcome(*printed)), "words paper") +
            cell(number(printed->time, 1), "num paper") +
            cell(signed_number(drive.time - printed->time, 2), "num paper") +
            cell(mark(as_paper(drive, *printed), "as the paper’s", "differs"), "words paper") +
            "</tr>\n";
    if (!printed->note.empty())
      rows += fmt::format("<tr class=\"note\"><td></td><td></td><td colspan=\"9\">{}</td></tr>\n",
                          escape(printed->note));
  }
  return table(
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
    rows +=
        fmt::format("<td>{}</td>", row.name) + cell(significant(row.b, 3)) +
        cell(significant(row.c, 3)) + cell(percent(row.b, row.c)) +
        cell(significant(row.paper_b, 3), "num paper") +
        cell(significant(row.paper_c, 3), "num paper") +
        cell(std::isfinite(row.paper_b) ? percent(row.paper_b, row.paper_c) : "–", "num paper") +
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
  return table(
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
    for (const double v : {start, end, least, most, mean_speed(one.drive)})
      rows += cell(number(v, 2));
    rows += cell(printed != nullptr ? number(printed->end_ux, 1) : "–", "num paper") + "</tr>\n";
  }
  return table(
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
    rows += cell(fmt::format("{}", count)) + cell(number(tex, 2));
    for (const bool cpu : {false, true}) {
      const auto times = solve_times(one.drive, cpu);
      const auto fast = static_cast<double>(
          std::count_if(times.begin(), times.end(), [&](double t) { return t < tex; }));
      rows +=
          cell(number(1e3 * median(times), 1)) + cell(number(1e3 * greatest(times), 1)) +
          cell(times.empty() ? "–"
                             : number(100 * fast / static_cast<double>(times.size()), 0) + " %");
    }
    rows += "</tr>\n";
  }
  return table(
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
    cells += cell(fmt::format("{}, {}", number(ours->x, 2), number(ours->y, 2))) +
             cell(number(ours->psi * deg, 1));
  } else {
    cells +=
        fmt::format("<td class=\"num\" colspan=\"2\">over at {} s</td>", number(one.drive.time, 2));
  }
  cells += cell(fmt::format("{}, {}", number(snapshot.x, 2), number(snapshot.y, 2)), "num paper") +
           cell(number(snapshot.psi * deg, 1), "num paper");
  if (!ours)
    return cells + cell("–") + cell("–") + cell(number(snapshot.tolerance, 1)) + cell("", "");
  const auto verdict = ours->comparable ? mark(ours->within, "within", "outside")
                                        : "<span class=\"muted\">the series lags</span>";
  return cells + cell(number(ours->distance, 2)) + cell(number(ours->unlagged, 2)) +
         cell(ours->comparable ? number(snapshot.tolerance, 1) : "–") + cell(verdict, "");
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
              cell(link(fmt::format("{}/report.html#t={:.4f}", one.folder,
                                    std::min(snapshot.t, one.drive.time)),
                        number(snapshot.t, 2))) +
              position_cells(one, *printed, snapshot) + "</tr>\n";
    }
  }
  return table(
      "<tr><th scope=\"col\">Environment</th><th scope=\"col\">Planner</th><th scope=\"col\" "
      "class=\"num\">t [s]</th><th scope=\"col\" class=\"num\">Ours x, y [m]</th><th scope=\"col\" "
      "class=\"num\">heading [°]</th><th scope=\"col\" class=\"num paper\">Paper x, y [m]</th><th "
      "scope=\"col\" class=\"num paper\">heading [°]</th><th scope=\"col\" class=\"num\">Distance "
      "[m]</th><th scope=\"col\" class=\"num\">without lag [m]</th><th scope=\"col\" "
      "class=\"num\">Allowed [m]</th><th scope=\"col\">Verdict</th></tr>",
      rows);
}

}  // namespace slalom::study
