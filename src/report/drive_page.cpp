#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "drive_data.hpp"
#include "html.hpp"
#include "playing_page.hpp"
#include "slalom/report/report.hpp"
#include "slalom/sim/marks.hpp"
#include "slalom/sim/verification.hpp"
#include "viewer_assets.hpp"
#include "words.hpp"

namespace slalom::report {
namespace {

std::string fact(const std::string& name, const std::string& value, const std::string& more = "") {
  return fmt::format("    <div><dt>{}</dt><dd>{}{}</dd></div>\n", escape(name), escape(value),
                     more.empty() ? "" : "<small>" + escape(more) + "</small>");
}

/// The numbers in the page's head.
std::string facts(const sim::Scenario& scenario, const sim::Drive& drive) {
  const auto times = solve_times(drive);
  const double tex = scenario.loop.tex;
  std::string html;
  html += fact("Driven", number(drive.time, 2) + " s",
               drive.goal_time ? "goal entered at " + number(*drive.goal_time, 2) : "");
  html += fact("Least clearance", number(drive.least_clearance, 2) + " m",
               std::isfinite(drive.least_clearance)
                   ? fmt::format("beyond {:g} m, to {} at {} s", scenario.loop.sm_crash,
                                 drive.least_clearance_obstacle, number(drive.least_clearance_t, 2))
                   : "no obstacle");
  html += fact("Mean speed", number(mean_speed(drive), 1) + " m/s");
  html += fact("Least wheel load",
               number(drive.plant.empty() ? NAN : drive.least_wheel_load, 0) + " N");
  html += fact("Solve time, median", number(1e3 * median(times), 2) + " ms",
               fmt::format("greatest {}, tex {} ms", number(1e3 * greatest(times), 2),
                           number(1e3 * tex, 0)));
  if (const auto v = sim::verification(drive))
    html += fact("Cycles verified", fmt::format("{} of {}", v->cycles - v->unverified, v->cycles),
                 fmt::format("{} new, {} the rest of the last", v->of(planner::Rung::new_plan),
                             v->of(planner::Rung::rest)));
  return html;
}

/// What the outcome does not tell, one paragraph each.
std::string marks_html(const sim::Scenario& scenario, const sim::Drive& drive) {
  std::string html;
  for (const auto& mark : sim::marks(scenario, drive))
    html += fmt::format("    <p class=\"mark\" data-kind=\"{}\">{}</p>\n", escape(mark.kind),
                        escape(mark.text));
  return html;
}

/// One table of settings; a dot marks those that are not the default.
template <class S>
std::string settings_table(const std::string& title, const OptionTable<S>& table, const S& settings,
                           const std::string& extra_rows = "") {
  const S defaults;
  std::string rows = extra_rows;
  for (const auto& entry : table.entries()) {
    const auto value = to_string(entry.get(settings));
    const auto unit = entry.info.unit == "1" ? "" : entry.info.unit;
    rows +=
        fmt::format("<tr{}><td>{}</td><td>{} {}</td><td class=\"doc\">{}</td></tr>\n",
                    value == to_string(entry.get(defaults)) ? "" : " class=\"changed\"",
                    escape(entry.info.name), escape(value), escape(unit), escape(entry.info.doc));
  }
  return fmt::format(
      "<details class=\"card\"><summary>{}</summary>\n<table><thead><tr><th scope=\"col\">Name</th>"
      "<th scope=\"col\">Value</th><th scope=\"col\">Meaning</th></tr></thead><tbody>\n{}</tbody>"
      "</table><p class=\"note\"><span style=\"color:var(--orange)\">•</span> not the "
      "default</p></details>\n",
      escape(title), rows);
}

std::string named_row(const std::string& name, const std::string& value, const std::string& doc) {
  return fmt::format("<tr><td>{}</td><td>{}</td><td class=\"doc\">{}</td></tr>\n", escape(name),
                     escape(value), escape(doc));
}

/// Where to, and what counts as there.
std::pair<std::string, std::string> goal_in_words(const world::Goal& goal) {
  const auto place = fmt::format("({:g}, {:g}) m", goal.x, goal.y);
  switch (goal.kind()) {
    case world::GoalKind::square:
      return {place, fmt::format("within {:g} m along x and y", goal.sigma)};
    case world::GoalKind::rectangle:
      return {place, fmt::format("within {:g} by {:g} m about it, turned to {:.4g}°", goal.length,
                                 goal.width, goal.psi * 180 / M_PI)};
    case world::GoalKind::line:
      return {fmt::format("{:g} m", goal.s), "along the road"};
    case world::GoalKind::time:
      return {fmt::format("{:g} s", goal.time), "as far along the road as possible until then"};
    case world::GoalKind::laps:
      break;
  }
  return {fmt::format("{:g}", goal.laps), "laps"};
}

/// What they are: shapes and motions.
std::string obstacles_in_words(const std::vector<world::Obstacle>& obstacles) {
  const auto count = [&](const auto& is) {
    return std::count_if(obstacles.begin(), obstacles.end(), is);
  };
  const auto polygons = count([](const auto& o) { return o.outline != nullptr; });
  const auto moving = count([](const auto& o) { return o.trajectory != nullptr; });
  if (polygons + moving == 0) return "ellipses at constant velocity";
  return fmt::format(
      "{} of them polygons, the others ellipses; {} by a table or along a path, the "
      "others at constant velocity",
      polygons, moving);
}

std::string scenario_rows(const sim::Scenario& scenario) {
  const auto& start = scenario.start;
  const auto& goal = scenario.goal;
  std::string rows;
  rows += named_row("start", fmt::format("({:g}, {:g}) m", start[vehicle::X], start[vehicle::Y]),
                    fmt::format("heading {:.4g}°, {:g} m/s", start[vehicle::PSI] * 180 / M_PI,
                                start[vehicle::UX]));
  const auto [place, meaning] = goal_in_words(goal);
  rows += named_row("goal", place, meaning);
  if (scenario.road)
    rows += named_row("road", fmt::format("{:.4g} m", scenario.road->length()),
                      scenario.road->closed() ? "closed" : "along its reference line");
  rows += named_row("obstacles", fmt::format("{}", scenario.obstacles.size()),
                    obstacles_in_words(scenario.obstacles));
  return rows;
}

}  // namespace

std::string playing_page(const PlayingPage& page) {
  std::string script;
  for (const auto part : {viewer::drive_model_js, viewer::drive_course_js, viewer::drive_parts_js,
                          viewer::drive_stage_js, viewer::drive_signals_js, viewer::drive_charts_js,
                          viewer::drive_choice_js, viewer::drive_verification_js,
                          viewer::drive_compare_js, viewer::drive_page_js})
    script.append(part).append("\n");
  return fill(viewer::drive_html,
              {{"title", escape(page.title)},
               {"css", fmt::format("{}\n{}", viewer::base_css, viewer::drive_css)},
               {"head", page.head},
               {"settings", page.settings},
               {"data", script_json(page.data)},
               {"script", script}});
}

std::string drive_page(const sim::Scenario& scenario, const sim::Drive& drive) {
  const auto settings = settings_table("Planner " + scenario.planner.name,
                                       planner::setting_options(), scenario.planner) +
                        settings_table("Scenario and closed loop", sim::loop_options(),
                                       scenario.loop, scenario_rows(scenario)) +
                        settings_table("Plant", sim::plant_options(), scenario.plant) +
                        settings_table("Sensing", sim::sensing_options(), scenario.sensing) +
                        settings_table("Vehicle " + scenario.vehicle.name,
                                       vehicle::parameter_options(), scenario.vehicle);
  const auto head = fill(viewer::drive_head_html, {{"scenario", escape(scenario.name)},
                                                   {"scenario_title", escape(scenario.title)},
                                                   {"planner", escape(scenario.planner.name)},
                                                   {"outcome", sim::to_string(drive.outcome)},
                                                   {"outcome_words", escape(outcome_words(drive))},
                                                   {"message", escape(drive.message)},
                                                   {"facts", facts(scenario, drive)},
                                                   {"marks", marks_html(scenario, drive)}});
  return playing_page(
      {fmt::format("{} · {} · {}", scenario.name, scenario.planner.name, outcome_words(drive)),
       head, settings, drive_data(scenario, drive)});
}

}  // namespace slalom::report
