#include <fmt/format.h>

#include <algorithm>

#include "../report/html.hpp"
#include "../report/page_parts.hpp"
#include "claims.hpp"
#include "comparison.hpp"
#include "concept_cases.hpp"
#include "reproduction.hpp"
#include "reproduction_tables.hpp"
#include "viewer_assets.hpp"

namespace slalom::paper {
namespace {

std::string note_html(const PaperData& paper, const char* topic) {
  const auto text = note(paper, topic);
  return text.empty() ? "" : fmt::format("<p class=\"remark\">{}</p>\n", report::escape(text));
}

/// One row of figures an environment, as the paper sets them: traces, paths, a closer look.
std::string figures_html(const std::vector<ReproducedDrive>& drives, const PaperData& paper) {
  std::string html;
  const auto figures = reproduction_figures(drives, paper);
  for (const auto& group : by_environment(drives)) {
    const auto& scenario = group.front()->scenario;
    html += fmt::format("<h3 id=\"{}\">{}</h3><p class=\"sub\">{}</p><div class=\"figures\">\n",
                        report::plain_name(scenario.name), report::escape(scenario.name),
                        report::escape(scenario.title));
    for (const auto& figure : figures)
      if (figure.file.rfind(report::plain_name(scenario.name) + "_", 0) == 0)
        html += report::figure_html(figure);
    html += fmt::format("</div>\n<p class=\"remark\">{}</p>\n",
                        report::link("figures/" + report::plain_name(scenario.name) + ".svg",
                                     "Traces and paths as one figure of two columns")) +
            note_html(paper, scenario.name.c_str());
  }
  return html;
}

std::string cases_html(const std::vector<ConceptCase>& cases) {
  if (cases.empty()) return "";
  return concept_table(cases) + "<div class=\"figures\">\n" +
         report::figure_html(concept_figure(cases)) + "</div>\n";
}

/// "as in the paper" counts for the page's head.
std::string summary(const std::vector<ReproducedDrive>& drives, const PaperData& paper,
                    const std::vector<Judged>& claims) {
  int printed = 0, same = 0, compared = 0, within = 0;
  for (const auto& one : drives) {
    const auto* drive = find(paper, one);
    if (drive == nullptr) continue;
    ++printed;
    same += as_paper(one.drive, *drive);
    for (const auto& snapshot : drive->snapshots) {
      const auto ours = compare(one.drive, *drive, snapshot);
      if (!ours || !ours->comparable || snapshot.t == 0) continue;
      ++compared;
      within += ours->within;
    }
  }
  const auto holding = std::count_if(claims.begin(), claims.end(), [](const auto& claim) {
    return claim.verdict == Verdict::holds;
  });
  const auto fact = [](const std::string& name, long count, long of) {
    return fmt::format("<div><dt>{}</dt><dd class=\"{}\">{} <small>of {}</small></dd></div>\n",
                       name, count == of ? "good" : "bad", count, of);
  };
  return fact("Drives that end as the paper’s", same, printed) +
         fact("Claims that hold", holding, static_cast<long>(claims.size())) +
         fact("Comparable positions within tolerance", within, compared);
}

std::string settings_line(const std::vector<ReproducedDrive>& drives) {
  if (drives.empty()) return "No drive.";
  const auto& s = drives.front().scenario;
  return fmt::format(
      "{} drives by the same settings: barrier floor {:g}, execution horizon {:g} s.",
      drives.size(), s.planner.floor, s.loop.tex);
}

}  // namespace

std::string reproduction_page(const std::vector<ReproducedDrive>& drives, const PaperData& paper,
                              const std::vector<ConceptCase>& cases,
                              const std::vector<Judged>& claims) {
  return report::fill(
      report::viewer::reproduction_html,
      {{"css", fmt::format("{}\n{}", report::viewer::base_css, report::viewer::reproduction_css)},
       {"settings", report::escape(settings_line(drives))},
       {"summary", summary(drives, paper, claims)},
       {"floor_note", note_html(paper, "floor")},
       {"claims", claims_table(claims)},
       {"outcomes", outcome_table(drives, paper) + note_html(paper, "outcomes")},
       {"cases", cases_html(cases)},
       {"positions", position_table(drives, paper) + note_html(paper, "positions")},
       {"effort", effort_table(drives, paper) + note_html(paper, "effort")},
       {"speeds", speed_table(drives, paper) + note_html(paper, "speeds")},
       {"solve_times", solve_time_table(drives) + note_html(paper, "solve_times")},
       {"figures", figures_html(drives, paper)}});
}

}  // namespace slalom::paper
