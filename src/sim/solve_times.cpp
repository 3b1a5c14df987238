#include "slalom/sim/solve_times.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace slalom::sim {

std::vector<double> solve_times(const Drive& drive, bool cpu) {
  std::vector<double> times;
  for (const auto& cycle : drive.cycles)
    if (cycle.index > 0) times.push_back(cpu ? cycle.plan.report.cpu_s : cycle.plan.report.wall_s);
  return times;
}

Unsolved unsolved(const Drive& drive) {
  Unsolved count;
  for (const auto& cycle : drive.cycles) {
    if (cycle.index == 0 || cycle.plan.report.solved) continue;
    ++count.cycles;
    count.best_iterates += cycle.used ? 1 : 0;
  }
  return count;
}

double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  const auto n = values.size();
  return n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

std::vector<double> cycle_medians(const std::vector<std::vector<double>>& runs) {
  std::vector<double> medians;
  for (std::size_t i = 0; !runs.empty() && i < runs.front().size(); ++i) {
    std::vector<double> times;
    for (const auto& run : runs)
      if (i < run.size()) times.push_back(run[i]);
    medians.push_back(median(std::move(times)));
  }
  return medians;
}

double percentile(std::vector<double> values, double per_cent) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  const auto rank = static_cast<std::size_t>(std::max(1.0, std::ceil(per_cent / 100 * n)));
  return values[std::min(rank, values.size()) - 1];
}

double greatest(const std::vector<double>& values) {
  return values.empty() ? std::nan("") : *std::max_element(values.begin(), values.end());
}

}  // namespace slalom::sim
