#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "html.hpp"
#include "page_parts.hpp"
#include "slalom/report/plot.hpp"
#include "slalom/report/sweep_report.hpp"
#include "sweep_axes.hpp"

namespace slalom::report {
namespace {

/// A key path for people, with its unit where it is one of the paper's axes.
std::string axis_label(const std::string& key) {
  if (key == kTexKey) return "execution horizon tex [s]";
  if (key == kSpeedKey) return "speed of O2 northward [m/s]";
  return key;
}

/// All trials at one point of the map.
struct MapPoint {
  int trials = 0, passed = 0, crashed = 0, unsolved = 0;
  std::string numbers;  ///< of the trials
};

std::vector<Series> map_series(const std::map<std::pair<double, double>, MapPoint>& points) {
  const auto series = [](const char* label, const char* colour, bool hollow) {
    Series s;
    s.label = label;
    s.stroke.colour = colour;
    s.markers = true;
    s.hollow = hollow;
    s.line = false;
    s.size = hollow ? 0.8 : 1.9;  // arrivals first catch the eye
    return s;
  };
  std::array<Series, 5> all = {
      series("at the goal", colours::green, false), series("some at the goal", colours::sky, false),
      series("crash", colours::vermilion, true), series("no plan", colours::purple, true),
      series("other", colours::muted, true)};
  for (const auto& [at, p] : points) {
    const std::size_t kind = p.passed == p.trials         ? 0
                             : p.passed > 0               ? 1
                             : 2 * p.crashed >= p.trials  ? 2
                             : 2 * p.unsolved >= p.trials ? 3
                                                          : 4;
    all[kind].x.push_back(at.first);
    all[kind].y.push_back(at.second);
    all[kind].marks.push_back(p.numbers);
  }
  std::vector<Series> used;
  for (auto& one : all)
    if (!one.x.empty()) used.push_back(std::move(one));
  return used;
}

Figure map_figure(const SweepTable& table, const std::string& planner,
                  const std::vector<std::size_t>& columns) {
  std::map<std::pair<double, double>, MapPoint> points;
  for (const auto& record : table.trials) {
    if (record.planner != planner) continue;
    auto& p = points[{number_at(record, columns[0]), number_at(record, columns[1])}];
    ++p.trials;
    p.numbers += fmt::format("{}{}", p.numbers.empty() ? "" : " ", record.trial);
    p.passed += record.passed();
    p.crashed += record.outcome == "crash";
    p.unsolved += record.outcome == "not_optimal";
  }
  Plot plot{.x_label = axis_label(table.columns[columns[0]]),
            .y_label = axis_label(table.columns[columns[1]])};
  plot.series = map_series(points);
  if (!points.empty()) {
    // Room for the markers at both ends.
    const double lo = points.begin()->first.first, hi = points.rbegin()->first.first;
    plot.x_min = lo - 0.03 * (hi - lo);
    plot.x_max = hi + 0.03 * (hi - lo);
  }
  const auto name = plain_name("map_" + planner);
  const auto title = fmt::format("{}: where {} arrives", table.name, planner);
  return {name + ".svg", title, plot_svg(name, title, plot, 200)};
}

/// Real-time factor above, probability of safety below, over tex.
Figure horizon_figure(const SweepTable& table) {
  Plot rtf{.x_label = "", .y_label = "real-time factor [1]"};
  rtf.log_y = true;
  rtf.x_tick_labels = false;
  rtf.levels = {{1, "real time", {colours::purple, 0.9, "3 2", 1}}};
  Plot pos{.x_label = axis_label(kTexKey), .y_label = "probability of safety [1]"};
  pos.y_min = -0.03;
  pos.y_max = 1.03;
  for (const auto& planner : table.planners) {
    Series left;
    left.label = planner;
    left.stroke = planner_stroke(planner);
    left.markers = true;
    auto right = left;
    for (const auto& row : horizon_rows(table, planner)) {
      left.x.push_back(row.tex);
      left.y.push_back(row.rtf_cpu);
      right.x.push_back(row.tex);
      right.y.push_back(row.pos());
    }
    rtf.series.push_back(std::move(left));
    pos.series.push_back(std::move(right));
  }
  const auto title = table.name + ": real-time factor (CPU time) and probability of safety";
  return {"real_time.svg", title, stacked_svg("real_time", title, {rtf, pos}, 130)};
}

}  // namespace

std::vector<Figure> sweep_figures(const SweepTable& table) {
  std::vector<Figure> figures;
  const auto columns = drawn_columns(table);
  if (columns.size() == 2)
    for (const auto& count : pass_counts(table))
      figures.push_back(map_figure(table, count.planner, columns));
  if (!columns.empty() && table.columns[columns[0]] == kTexKey)
    figures.push_back(horizon_figure(table));
  return figures;
}

}  // namespace slalom::report
