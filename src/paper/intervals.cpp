#include "intervals.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "slalom/sim/solve_times.hpp"

namespace slalom::paper {
namespace {

constexpr double kTail = 0.025;  ///< outside of the interval, on either side
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The median of as many values, drawn with replacement.
double median_of_draw(const std::vector<double>& values, std::mt19937_64& random) {
  std::vector<double> drawn(values.size());
  for (auto& one : drawn) one = values[random() % values.size()];
  return sim::median(std::move(drawn));
}

}  // namespace

Estimate median_interval(std::vector<double> values) {
  if (values.empty()) return {kNone, kNone, kNone};
  std::sort(values.begin(), values.end());
  const auto n = values.size();
  std::size_t k = 0;
  double chance = std::pow(0.5, static_cast<double>(n)), tail = chance;
  if (tail > kTail) return {sim::median(values), kNone, kNone};
  while (k < n / 2 && tail < kTail) {
    ++k;
    chance *= static_cast<double>(n - k + 1) / static_cast<double>(k);
    tail += chance;
  }
  return {sim::median(values), values[k - 1], values[n - k]};
}

Estimate ratio_interval(const std::vector<double>& before, const std::vector<double>& after) {
  if (before.empty() || after.empty()) return {kNone, kNone, kNone};
  constexpr std::size_t draws = 2000;
  std::mt19937_64 random(1);
  std::vector<double> ratios(draws);
  for (auto& ratio : ratios) {
    const double above = median_of_draw(after, random);
    ratio = above / median_of_draw(before, random);
  }
  std::sort(ratios.begin(), ratios.end());
  const auto at = [&](double share) { return ratios[static_cast<std::size_t>(share * draws)]; };
  return {sim::median(after) / sim::median(before), at(kTail), at(1 - kTail)};
}

Estimate paired_interval(const std::vector<double>& before, const std::vector<double>& after) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i)
    ratios.push_back(after[i] / before[i]);
  return median_interval(std::move(ratios));
}

}  // namespace slalom::paper
