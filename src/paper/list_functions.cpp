// Functions of lists of numbers: config/paper's formulas set measures in relation by them.
#include <algorithm>
#include <cmath>

#include "evaluate.hpp"
#include "intervals.hpp"
#include "slalom/base/error.hpp"
#include "slalom/report/statistics.hpp"
#include "slalom/sim/solve_times.hpp"

namespace slalom::paper {
namespace {

/// A function of evaluated lists that gives a list.
Function lists(std::size_t arguments, std::function<Numbers(const std::vector<Numbers>&)> make) {
  return {arguments, arguments,
          [make = std::move(make)](const auto& parts, const Context& context) -> Value {
            std::vector<Numbers> values;
            for (const auto& part : parts) values.push_back(numbers_of(part, context));
            return make(values);
          }};
}

Numbers numbers(const Estimate& estimate) {
  return {estimate.value, estimate.lo, estimate.hi};
}

Numbers select(const Numbers& list, const Numbers& mask) {
  if (list.size() != mask.size()) throw InvalidValue("select", "lists of two lengths", "one");
  Numbers kept;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (mask[i] != 0) kept.push_back(list[i]);
  return kept;
}

Numbers finite(const Numbers& list) {
  Numbers kept;
  for (const double one : list)
    if (std::isfinite(one)) kept.push_back(one);
  return kept;
}

double nearest(const Numbers& list, double value) {
  if (list.empty()) return NAN;
  return *std::min_element(list.begin(), list.end(), [&](double a, double b) {
    return std::abs(a - value) < std::abs(b - value);
  });
}

double sum(const Numbers& list) {
  double total = 0;
  for (const double one : list) total += one;
  return total;
}

double least(const Numbers& list) {
  return list.empty() ? NAN : *std::min_element(list.begin(), list.end());
}

double fisher(const std::vector<Numbers>& v) {
  const auto count = [&](std::size_t i) { return std::llround(v[i].at(0)); };
  return report::fisher_exact({count(0), count(1), count(2), count(3)});
}

}  // namespace

const Functions& list_functions() {
  using Arguments = std::vector<Numbers>;
  static const Functions table = {
      {"median", eager(1, [](const Arguments& v) { return sim::median(v[0]); })},
      {"mean", eager(1, [](const Arguments& v) { return report::mean(v[0]); })},
      {"least", eager(1, [](const Arguments& v) { return least(v[0]); })},
      {"greatest", eager(1, [](const Arguments& v) { return sim::greatest(v[0]); })},
      {"sum", eager(1, [](const Arguments& v) { return sum(v[0]); })},
      {"count", eager(1, [](const Arguments& v) { return double(v[0].size()); })},
      {"first", eager(1, [](const Arguments& v) { return v[0].empty() ? NAN : v[0].front(); })},
      {"last", eager(1, [](const Arguments& v) { return v[0].empty() ? NAN : v[0].back(); })},
      {"abs", eager(1, [](const Arguments& v) { return std::abs(v[0].at(0)); })},
      {"nearest", eager(2, [](const Arguments& v) { return nearest(v[0], v[1].at(0)); })},
      {"tail", lists(1,
                     [](const Arguments& v) {
                       return v[0].empty() ? Numbers() : Numbers(v[0].begin() + 1, v[0].end());
                     })},
      {"select", lists(2, [](const Arguments& v) { return select(v[0], v[1]); })},
      {"finite", lists(1, [](const Arguments& v) { return finite(v[0]); })},
      {"interval", lists(1, [](const Arguments& v) { return numbers(median_interval(v[0])); })},
      {"ratio", lists(2, [](const Arguments& v) { return numbers(ratio_interval(v[0], v[1])); })},
      {"paired", lists(2, [](const Arguments& v) { return numbers(paired_interval(v[0], v[1])); })},
      {"lo", eager(1, [](const Arguments& v) { return v[0].at(1); })},
      {"hi", eager(1, [](const Arguments& v) { return v[0].at(2); })},
      {"fisher", eager(4, fisher)},
  };
  return table;
}

}  // namespace slalom::paper
