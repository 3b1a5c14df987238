#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "slalom/study/sweep_report.hpp"
#include "sweep_axes.hpp"

namespace slalom::study {

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

bool PaperSweep::comparable(const SweepTable& table) {
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

}  // namespace slalom::study
