#include "sweep_evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "slalom/report/statistics.hpp"

namespace slalom::paper {
namespace {

using io::Json;
using report::PublishedSweep;

constexpr double kTexStep = 0.003;   ///< a printed tex is rounded by less [s]
constexpr double kSpeedStep = 0.05;  ///< likewise a printed speed [m/s]
constexpr double kLong = 0.5;        ///< the tex that tells long horizons from short [s]

double greatest_speed(const std::vector<SweepTrial>& trials) {
  double speed = 0;
  for (const auto& trial : trials) speed = std::max(speed, trial.speed);
  return speed;
}

std::vector<PublishedSweep::Count> counts_of(const report::SweepTable& table) {
  std::vector<PublishedSweep::Count> counts;
  for (const auto& count : report::pass_counts(table))
    counts.push_back(
        {count.planner, static_cast<int>(count.passed), static_cast<int>(count.trials)});
  return counts;
}

/// What is printed of a planner at a tex for O2 at up to `speed`; null for nothing.
Json printed_json(const PublishedSweep& published, const std::string& planner, double tex,
                  double speed) {
  for (const auto& point : published.points)
    if (point.planner == planner && std::abs(point.tex - tex) < kTexStep &&
        std::abs(point.speed - speed) < kSpeedStep)
      return {{"pos", number_or_null(point.pos)}, {"rtf", number_or_null(point.rtf)}};
  return {};
}

Json horizon_json(const report::HorizonRow& row) {
  return {{"tex_s", row.tex},
          {"passed", row.passed},
          {"trials", row.trials},
          {"pos", number_or_null(row.pos())},
          {"rtf_cpu", number_or_null(row.rtf_cpu)},
          {"rtf_wall", number_or_null(row.rtf)}};
}

Json horizons_json(const report::SweepTable& table, const PublishedSweep& published, double speed) {
  Json list = Json::array();
  for (const auto& planner : table.planners)
    for (const auto& row : report::horizon_rows(table, planner)) {
      auto entry = horizon_json(row);
      entry["planner"] = planner;
      entry["printed"] = printed_json(published, planner, row.tex, speed);
      list.push_back(std::move(entry));
    }
  return list;
}

/// The points that are printed for slower O2 alone.
Json slower_json(const report::SweepTable& table, const PublishedSweep& published) {
  Json list = Json::array();
  for (const auto& point : published.points) {
    if (!std::isfinite(point.rtf)) continue;
    for (const auto& row : report::horizon_rows(table, point.planner, point.speed + kSpeedStep)) {
      if (std::abs(row.tex - point.tex) >= kTexStep) continue;
      auto entry = horizon_json(row);
      entry["planner"] = point.planner;
      entry["speed_mps"] = point.speed;
      entry["printed"] = {{"pos", point.pos}, {"rtf", point.rtf}};
      list.push_back(std::move(entry));
    }
  }
  return list;
}

/// How trials of one planner end, with short and with long execution horizons.
Json ends_json(const report::SweepTable& table, const std::vector<SweepTrial>& trials) {
  Json list = Json::array();
  for (const auto& planner : table.planners)
    for (const bool is_long : {false, true}) {
      int all = 0, passed = 0, o2 = 0, other = 0, none = 0;
      double fastest = std::numeric_limits<double>::quiet_NaN();
      for (const auto& trial : trials) {
        if (trial.planner != planner || (trial.tex > kLong) != is_long) continue;
        const bool goal = trial.outcome == "goal", crash = trial.outcome == "crash";
        ++all;
        passed += goal;
        o2 += crash && trial.hit == "O2";
        other += crash && trial.hit != "O2";
        none += trial.outcome == "not_optimal";
        if (goal) fastest = std::fmax(fastest, trial.speed);
      }
      list.push_back({{"planner", planner},
                      {"tex", is_long ? "above" : "up to"},
                      {"tex_s", kLong},
                      {"trials", all},
                      {"passed", passed},
                      {"crash_O2", o2},
                      {"crash_other", other},
                      {"no_plan", none},
                      {"else", all - passed - o2 - other - none},
                      {"fastest_passed_mps", number_or_null(fastest)}});
    }
  return list;
}

}  // namespace

Json number_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

Json counts_json(const std::vector<PublishedSweep::Count>& counts) {
  Json json = {{"planners", Json::array()}, {"ratio", nullptr}, {"fisher_p", nullptr}};
  for (const auto& count : counts)
    json["planners"].push_back(
        {{"planner", count.planner}, {"passed", count.passed}, {"trials", count.trials}});
  if (counts.size() < 2) return json;
  const auto& [one, two] = std::pair(counts[0], counts[1]);
  json["ratio"] = number_or_null(static_cast<double>(two.passed) / two.trials /
                                 (static_cast<double>(one.passed) / one.trials));
  json["fisher_p"] = report::fisher_exact(
      {one.passed, one.trials - one.passed, two.passed, two.trials - two.passed});
  return json;
}

Json sweep_json(const report::SweepTable& table, const std::vector<SweepTrial>& trials,
                const PublishedSweep& published) {
  const double speed = greatest_speed(trials);
  return {{"title", table.title},
          {"trials", trials.size()},
          {"size", table.size},
          {"greatest_speed_mps", speed},
          {"counts", counts_json(counts_of(table))},
          {"horizons", horizons_json(table, published, speed)},
          {"slower", slower_json(table, published)},
          {"ends", ends_json(table, trials)}};
}

}  // namespace slalom::paper
