#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "slalom/report/sweep_report.hpp"
#include "sweep_axes.hpp"

namespace slalom::report {

std::optional<std::size_t> column_index(const SweepTable& table, const std::string& key) {
  const auto found = std::find(table.columns.begin(), table.columns.end(), key);
  if (found == table.columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - table.columns.begin());
}

double number_at(const TrialRecord& record, std::size_t column) {
  const auto& text = record.values.at(column);
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return text.empty() || *end != '\0' ? TrialRecord::kNone : value;
}

namespace {

/// A numeric column that takes several values.
bool varies(const SweepTable& table, std::size_t column) {
  std::set<double> values;
  for (const auto& record : table.trials) values.insert(number_at(record, column));
  return values.size() > 1 &&
         std::none_of(values.begin(), values.end(), [](double value) { return std::isnan(value); });
}

}  // namespace

std::vector<std::size_t> drawn_columns(const SweepTable& table) {
  std::vector<std::size_t> columns;
  const auto tex = column_index(table, kTexKey);
  if (tex && varies(table, *tex)) columns.push_back(*tex);
  for (std::size_t i = 0; i < table.columns.size() && columns.size() < 2; ++i)
    if ((!tex || i != *tex) && varies(table, i)) columns.push_back(i);
  return columns;
}

bool PublishedSweep::comparable(const SweepTable& table) {
  return table.scenarios == std::vector<std::string>{"E_C"} &&
         table.columns == std::vector<std::string>{kTexKey, kSpeedKey};
}

std::vector<PassCount> pass_counts(const SweepTable& table) {
  std::vector<PassCount> counts;
  for (const auto& planner : table.planners) {
    PassCount count{planner};
    for (const auto& record : table.trials) {
      if (record.planner != planner) continue;
      ++count.trials;
      count.passed += record.passed();
    }
    if (count.trials > 0) counts.push_back(count);
  }
  return counts;
}

std::vector<ScenarioCount> scenario_counts(const SweepTable& table) {
  std::map<std::string, std::map<std::string, PassCount>> found;
  for (const auto& record : table.trials) {
    auto& count = found[record.scenario][record.planner];
    ++count.trials;
    count.passed += record.passed();
  }
  std::vector<ScenarioCount> counts;
  for (const auto& scenario : table.scenarios) {
    const auto by_planner = found.find(scenario);
    if (by_planner == found.end()) continue;
    ScenarioCount row{scenario, {}};
    for (const auto& planner : table.planners) {
      auto count = by_planner->second[planner];
      count.planner = planner;
      row.planners.push_back(count);
    }
    counts.push_back(std::move(row));
  }
  return counts;
}

PairCount pair_count(const SweepTable& table, const std::string& planner1,
                     const std::string& planner2) {
  const auto key = [](const TrialRecord& r) { return std::tuple(r.scenario, r.values, r.repeat); };
  std::map<std::tuple<std::string, std::vector<std::string>, int>, bool> first;
  for (const auto& record : table.trials)
    if (record.planner == planner1) first[key(record)] = record.passed();
  PairCount pairs;
  for (const auto& record : table.trials) {
    const auto other = first.find(key(record));
    if (record.planner != planner2 || other == first.end()) continue;
    auto& count = other->second ? (record.passed() ? pairs.both : pairs.only1)
                                : (record.passed() ? pairs.only2 : pairs.neither);
    ++count;
  }
  return pairs;
}

double HorizonRow::pos() const {
  return trials > 0 ? static_cast<double>(passed) / static_cast<double>(trials)
                    : TrialRecord::kNone;
}

std::vector<HorizonRow> horizon_rows(const SweepTable& table, const std::string& planner,
                                     double speed) {
  const auto tex_column = column_index(table, kTexKey);
  const auto speed_column = column_index(table, kSpeedKey);
  if (!tex_column) return {};
  std::map<double, std::vector<const TrialRecord*>> groups;
  for (const auto& record : table.trials) {
    if (record.planner != planner) continue;
    if (speed_column && std::abs(number_at(record, *speed_column)) > speed) continue;
    groups[number_at(record, *tex_column)].push_back(&record);
  }
  std::vector<HorizonRow> rows;
  for (const auto& [tex, records] : groups) {
    HorizonRow row{.tex = tex};
    std::vector<double> wall, cpu;
    for (const auto* record : records) {
      ++row.trials;
      row.passed += record->passed();
      if (std::isfinite(record->max_solve_time)) wall.push_back(record->max_solve_time / tex);
      if (std::isfinite(record->max_cpu_time)) cpu.push_back(record->max_cpu_time / tex);
    }
    row.rtf = mean(wall);
    row.rtf_cpu = mean(cpu);
    row.rtf_cpu_95 = quantile(cpu, 0.95);
    rows.push_back(row);
  }
  return rows;
}

namespace {

/// Passes at each execution horizon.
using ByHorizon = std::map<double, PassCount>;

LongestHorizon::Planner longest_of(const std::string& planner, const ByHorizon& counts) {
  const auto share = [](const PassCount& count) {
    return static_cast<double>(count.passed) / static_cast<double>(count.trials);
  };
  LongestHorizon::Planner row{planner};
  double best = 0;
  for (const auto& [tex, count] : counts) best = std::max(best, share(count));
  if (best == 0) return row;
  bool from_the_shortest = true;
  for (const auto& [tex, count] : counts) {
    const bool as_good = share(count) == best;
    row.best += as_good;
    from_the_shortest = from_the_shortest && as_good;
    if (from_the_shortest) row.tex = tex;
  }
  return row;
}

}  // namespace

std::vector<LongestHorizon> longest_horizons(const SweepTable& table) {
  const auto columns = drawn_columns(table);
  if (columns.size() < 2 || table.columns[columns[0]] != kTexKey) return {};
  std::map<double, std::map<std::string, ByHorizon>> counts;
  for (const auto& record : table.trials) {
    auto& count =
        counts[number_at(record, columns[1])][record.planner][number_at(record, columns[0])];
    ++count.trials;
    count.passed += record.passed();
  }
  std::vector<LongestHorizon> rows;
  for (const auto& [value, planners] : counts) {
    LongestHorizon row{table.columns[columns[1]], value};
    for (const auto& planner : table.planners) {
      const auto found = planners.find(planner);
      row.planners.push_back(
          longest_of(planner, found == planners.end() ? ByHorizon{} : found->second));
      if (found != planners.end())
        row.horizons = std::max(row.horizons, static_cast<std::int64_t>(found->second.size()));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace slalom::report
