#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "html.hpp"
#include "page_parts.hpp"
#include "slalom/report/statistics.hpp"
#include "slalom/report/sweep_report.hpp"
#include "sweep_data.hpp"
#include "sweep_tables.hpp"
#include "viewer_assets.hpp"

namespace slalom::report {
namespace {

std::string share(std::int64_t k, std::int64_t n) {
  return n > 0 ? number(100.0 * static_cast<double>(k) / static_cast<double>(n), 1) + " %" : "–";
}

std::string p_value(double p) {
  return p < 1e-4 ? fmt::format("{:.1e}", p) : significant(p, 3);
}

const PublishedSweep::Count* printed_count(const PublishedSweep& paper,
                                           const std::string& planner) {
  for (const auto& count : paper.counts)
    if (count.planner == planner) return &count;
  return nullptr;
}

std::string notes_html(const PublishedSweep& paper, const std::string& topic) {
  std::string html;
  for (const auto& note : paper.notes)
    if (note.topic == topic) html += fmt::format("<p class=\"remark\">{}</p>\n", escape(note.text));
  return html;
}

std::string count_table(const SweepTable& sweep, const PublishedSweep& paper, bool beside) {
  std::string rows;
  for (const auto& count : pass_counts(sweep)) {
    const auto interval = clopper_pearson(count.passed, count.trials);
    rows +=
        row_head(count.planner) + cell(fmt::format("{}", count.passed)) +
        cell(fmt::format("{}", count.trials)) + cell(share(count.passed, count.trials)) +
        cell(fmt::format("{} to {} %", number(100 * interval.lo, 1), number(100 * interval.hi, 1)));
    if (beside) {
      const auto* printed = printed_count(paper, count.planner);
      rows +=
          cell(printed == nullptr ? "–"
                                  : fmt::format("{} of {} ({})", printed->passed, printed->trials,
                                                share(printed->passed, printed->trials)),
               "num paper");
    }
    rows += "</tr>\n";
  }
  std::vector<std::string> names = {"planner", "at the goal", "trials", "share",
                                    "95 % interval (Clopper–Pearson)"};
  if (beside) names.push_back("paper");
  return table(head_cells(names), rows);
}

std::string comparison_row(const PassCount& a, const PassCount& b, const PairCount* pairs,
                           const char* kind) {
  const Fourfold counts{a.passed, a.trials - a.passed, b.passed, b.trials - b.passed};
  const auto odds = odds_ratio(counts);
  const auto per_trial = [](const PassCount& c) {
    return static_cast<double>(c.passed) / static_cast<double>(c.trials);
  };
  return cell(number(per_trial(b) / per_trial(a), 2), kind) +
         cell(fmt::format("{} ({} to {})", significant(odds.ratio, 3),
                          significant(odds.interval.lo, 3), significant(odds.interval.hi, 3)),
              kind) +
         cell(p_value(fisher_exact(counts)), kind) +
         cell(pairs == nullptr ? "–" : fmt::format("{} : {}", pairs->only1, pairs->only2), kind) +
         cell(pairs == nullptr ? "–" : p_value(mcnemar_exact(pairs->only1, pairs->only2)), kind) +
         "</tr>\n";
}

std::string comparison_table(const SweepTable& sweep, const PublishedSweep& paper, bool beside) {
  const auto counts = pass_counts(sweep);
  std::string rows;
  for (std::size_t i = 0; i < counts.size(); ++i)
    for (std::size_t j = i + 1; j < counts.size(); ++j) {
      const auto &a = counts[i], &b = counts[j];
      const auto pairs = pair_count(sweep, a.planner, b.planner);
      const auto name = fmt::format("{} → {}", a.planner, b.planner);
      rows += row_head(name) + comparison_row(a, b, &pairs, "num");
      const auto* one = printed_count(paper, a.planner);
      const auto* two = printed_count(paper, b.planner);
      if (beside && one != nullptr && two != nullptr)
        rows += row_head("the same, from the paper’s counts") +
                comparison_row({a.planner, one->passed, one->trials},
                               {b.planner, two->passed, two->trials}, nullptr, "num paper");
    }
  if (rows.empty()) return "<p class=\"sub\">One planner: nothing to compare.</p>\n";
  return table(head_cells({"planners", "ratio of shares", "odds ratio (95 %, Woolf)",
                           "Fisher’s exact test p", "pairs only one passes", "McNemar p"}),
               rows);
}

/// Names of the planners as the heads of columns, after the first.
std::string planner_heads(const SweepTable& sweep, const char* first) {
  auto names = sweep.planners;
  for (auto& name : names) name = escape(name);
  names.insert(names.begin(), first);
  return head_cells(names);
}

/// Who arrives where, folded up; empty for one scenario.
std::string scenario_table(const SweepTable& sweep) {
  if (sweep.scenarios.size() <= 1) return "";
  std::string rows;
  for (const auto& row : scenario_counts(sweep)) {
    rows += row_head(row.scenario);
    for (const auto& count : row.planners)
      rows += cell(count.trials == 0 ? "–" : fmt::format("{} of {}", count.passed, count.trials));
    rows += "</tr>\n";
  }
  return fmt::format("<details><summary>At the goal, by scenario</summary>\n{}</details>\n",
                     table(planner_heads(sweep, "scenario"), rows));
}

/// Causes with their counts, a column a planner.
std::string outcome_table(const SweepTable& sweep) {
  std::map<std::string, std::map<std::string, int>> counts;
  for (const auto& record : sweep.trials) {
    const bool hit = record.outcome == "crash" || record.outcome == "wheel_lift";
    const bool cone = record.hit.starts_with("cone");
    const auto what = !hit || record.hit.empty() ? "" : cone ? " cone" : " " + record.hit;
    ++counts[record.outcome + what][record.planner];
  }
  std::string rows;
  for (const auto& [cause, by_planner] : counts) {
    rows += row_head(cause);
    for (const auto& planner : sweep.planners) {
      const auto found = by_planner.find(planner);
      rows += cell(fmt::format("{}", found == by_planner.end() ? 0 : found->second));
    }
    rows += "</tr>\n";
  }
  return table(planner_heads(sweep, "outcome"), rows);
}

/// Under which the page stands: few scenarios by name.
std::string settings_line(const SweepTable& sweep) {
  constexpr std::size_t kNamed = 8;
  const auto n = sweep.scenarios.size();
  const auto scenarios = n == 1 ? "Scenario " + sweep.scenarios.front()
                         : n <= kNamed
                             ? fmt::format("Scenarios {}", fmt::join(sweep.scenarios, ", "))
                             : fmt::format("{} scenarios", n);
  return fmt::format("{}, instruction set {}, study {}.", scenarios, sweep.kernels, sweep.identity);
}

std::string summary(const SweepTable& sweep) {
  const auto run = static_cast<std::int64_t>(sweep.trials.size());
  auto html = fmt::format("<div><dt>Trials run</dt><dd>{} <small>of {}</small></dd></div>\n", run,
                          sweep.size);
  for (const auto& count : pass_counts(sweep))
    html += fmt::format("<div><dt>{} at the goal</dt><dd>{} <small>of {}</small></dd></div>\n",
                        escape(count.planner), count.passed, count.trials);
  return html;
}

}  // namespace

std::string sweep_page(const SweepTable& sweep, const PublishedSweep& paper,
                       const std::set<std::int64_t>& kept) {
  const bool beside = PublishedSweep::comparable(sweep);
  const auto notes = [&](const char* topic) { return beside ? notes_html(paper, topic) : ""; };
  std::string figures;
  for (const auto& figure : sweep_figures(sweep)) figures += figure_html(figure);
  return fill(
      viewer::sweep_html,
      {{"css", fmt::format("{}\n{}", viewer::base_css, viewer::reproduction_css)},
       {"name", escape(sweep.name)},
       {"title", escape(sweep.title)},
       {"settings", escape(settings_line(sweep))},
       {"summary", summary(sweep)},
       {"figures", figures},
       {"counts", count_table(sweep, paper, beside) + comparison_table(sweep, paper, beside) +
                      notes("counts") + scenario_table(sweep)},
       {"outcomes", outcome_table(sweep) + failed_cycle_table(sweep)},
       {"horizons", horizons_html(sweep, paper, beside) + notes("real_time")},
       {"times", solve_time_table(sweep) + longest_horizon_table(sweep)},
       {"data", script_json(sweep_data(sweep, kept))},
       {"script", std::string(viewer::sweep_js)},
       {"passes", pass_table(sweep)}});
}

}  // namespace slalom::report
