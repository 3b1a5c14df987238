#include "concept_cases.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "../report/html.hpp"
#include "../report/map.hpp"
#include "../report/page_parts.hpp"
#include "comparison.hpp"

namespace slalom::paper {
namespace {

using Cases = std::vector<ConceptCase>;

const ConceptCase* named(const Cases& cases, const std::string& name) {
  const auto found =
      std::find_if(cases.begin(), cases.end(), [&](const auto& c) { return c.name == name; });
  return found == cases.end() ? nullptr : &*found;
}

/// When the goal's square was entered, or the drive ended.
double arrival(const sim::Drive& drive) {
  return drive.goal_time.value_or(drive.time);
}

bool arrived(const ConceptCase& one) {
  return one.driven.drive.outcome == sim::Outcome::goal;
}

/// Every two seconds, and the end: equal steps tell the fast from the slow.
std::vector<double> instants(const sim::Drive& drive) {
  std::vector<double> list;
  for (double t = 0; t < drive.time - 0.5; t += 2) list.push_back(t);
  list.push_back(drive.time);
  return list;
}

report::Strip strip(const ConceptCase& one) {
  const auto& drive = one.driven.drive;
  report::Strip result;
  result.heading = fmt::format("{}: {} ({})", one.name, ended(one), one.specifications);
  result.map.scenario = &one.driven.scenario;
  const bool good = arrived(one);
  result.map.vehicles = {{&drive,
                          "",
                          {good ? report::colours::blue : report::colours::vermilion, 1, "", 1},
                          instants(drive),
                          {}}};
  result.map.obstacle_instants = {0, drive.least_clearance_t};
  return result;
}

}  // namespace

std::string planner_words(const ConceptCase& one) {
  const auto& planner = one.driven.scenario.planner;
  if (planner.model == planner::Settings().model) return planner.name;
  return planner.name + ", model " +
         to_string(planner::setting_options().find("model")->get(planner));
}

std::string ended(const ConceptCase& one) {
  const auto& drive = one.driven.drive;
  if (arrived(one)) return fmt::format("arrives at {} s", report::number(arrival(drive), 1));
  return fmt::format("{} at {} s", ended_words(drive), report::number(drive.time, 1));
}

bool holds(const ConceptCase& one, const Cases& cases) {
  if (one.outcome != sim::to_string(one.driven.drive.outcome)) return false;
  if (one.faster_than.empty()) return true;
  const auto* slower = named(cases, one.faster_than);
  return slower != nullptr && arrived(*slower) &&
         arrival(one.driven.drive) < arrival(slower->driven.drive);
}

report::Figure concept_figure(const Cases& cases) {
  std::vector<report::Strip> strips;
  for (const auto& one : cases) strips.push_back(strip(one));
  return {
      "cases.svg",
      "What planners lack and what comes of it: vehicles every 2 s, obstacles at the start (pale) "
      "and when they are nearest",
      report::strips_svg("cases", "The cases of the paper's conceptual figure, driven", strips)};
}

std::string concept_table(const Cases& cases) {
  std::string rows;
  for (const auto& one : cases) {
    const bool good = holds(one, cases);
    rows += fmt::format(
        "<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td>{}<td><span "
        "class=\"{}\">{}</span></td></tr>\n",
        report::escape(one.name), report::escape(one.specifications),
        report::link(one.driven.folder + "/report.html", planner_words(one)),
        report::escape(one.driven.scenario.title),
        report::escape(one.says + (one.faster_than.empty() ? std::string()
                                                           : " (than " + one.faster_than + ")")),
        report::cell(report::escape(ended(one)), "words"), good ? "good" : "bad",
        good ? "✓ yes" : "✕ no");
  }
  return report::table(
      "<tr><th scope=\"col\">Case</th><th scope=\"col\">Has</th><th scope=\"col\">Planner</th>"
      "<th scope=\"col\">Way</th><th scope=\"col\">The paper’s text</th><th scope=\"col\">Ours</th>"
      "<th scope=\"col\">Holds</th></tr>",
      rows);
}

}  // namespace slalom::paper
