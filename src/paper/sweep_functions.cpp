// Measures of the sweep's trials. A condition is a formula that every trial is put to:
// number(planner == P_D and tex <= 0.5).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "../report/sweep_axes.hpp"
#include "evaluate.hpp"
#include "slalom/base/error.hpp"

namespace slalom::paper {
namespace {

using Parts = std::vector<Expression>;

const std::vector<SweepTrial>& trials_of(const Context& context) {
  if (context.trials == nullptr) throw NotDriven{"the sweep"};
  return *context.trials;
}

/// Calls `found` with each trial's context for which the condition holds.
template <class F>
void each(const Expression& condition, const Context& context, F found) {
  auto inner = context;
  for (const auto& trial : trials_of(context)) {
    inner.trial = &trial;
    if (number_of(condition, inner) != 0) found(inner);
  }
}

struct Count {
  double passed = 0, all = 0;
};

Count count(const Expression& condition, const Context& context) {
  Count result;
  each(condition, context, [&](const Context& inner) {
    ++result.all;
    result.passed += inner.trial->outcome == "goal";
  });
  return result;
}

Value number(const Parts& parts, const Context& context) {
  return count(parts[0], context).all;
}

/// Of the trials of a condition, the share that arrive; NaN for none.
Value share(const Parts& parts, const Context& context) {
  const auto found = count(parts[0], context);
  return found.all > 0 ? found.passed / found.all : NAN;
}

/// The same as words: "18 of 400".
Value arrive(const Parts& parts, const Context& context) {
  const auto found = count(parts[0], context);
  return fmt::format("{:g} of {:g}", found.passed, found.all);
}

/// A value of each trial of a condition, where it has one.
Value values(const Parts& parts, const Context& context) {
  Numbers list;
  each(parts[1], context, [&](const Context& inner) {
    const double value = number_of(parts[0], inner);
    if (std::isfinite(value)) list.push_back(value);
  });
  return list;
}

std::set<double> all_tex(const Context& context) {
  std::set<double> found;
  for (const auto& trial : trials_of(context)) found.insert(trial.tex);
  return found;
}

Value tex_values(const Parts&, const Context& context) {
  const auto found = all_tex(context);
  return Numbers(found.begin(), found.end());
}

/// A formula for the trials of each execution horizon alone, in order of it.
Value by_tex(const Parts& parts, const Context& context) {
  Numbers list;
  for (const double tex : all_tex(context)) {
    std::vector<SweepTrial> own;
    for (const auto& trial : trials_of(context))
      if (trial.tex == tex) own.push_back(trial);
    auto inner = context;
    inner.trials = &own;
    list.push_back(number_of(parts[0], inner));
  }
  return list;
}

/// A value of one planner's trial over that of another's with the same tex and speed.
Value pairs(const Parts& parts, const Context& context) {
  const auto over = text_of(parts[1], context), under = text_of(parts[2], context);
  std::map<std::pair<double, double>, const SweepTrial*> others;
  for (const auto& trial : trials_of(context))
    if (trial.planner == under) others[{trial.tex, trial.speed}] = &trial;
  Numbers ratios;
  auto inner = context;
  for (const auto& trial : trials_of(context)) {
    const auto other = others.find({trial.tex, trial.speed});
    if (trial.planner != over || other == others.end()) continue;
    inner.trial = &trial;
    const double above = number_of(parts[0], inner);
    inner.trial = other->second;
    const double ratio = above / number_of(parts[0], inner);
    if (std::isfinite(ratio)) ratios.push_back(ratio);
  }
  return ratios;
}

const report::PublishedSweep::Count& printed_count(const Expression& part, const Context& context) {
  const auto planner = text_of(part, context);
  for (const auto& one : context.evidence->published->counts)
    if (one.planner == planner) return one;
  throw InvalidValue(planner, "no count", "a planner of the paper's sweep");
}

/// What is printed of a planner at a tex, over speeds up to one. Throws InvalidValue where nothing
/// is.
Function printed_point(double report::PublishedSweep::Point::*figure) {
  return {3, 3, [figure](const Parts& parts, const Context& context) -> Value {
            const auto planner = text_of(parts[0], context);
            const double tex = number_of(parts[1], context), speed = number_of(parts[2], context);
            for (const auto& point : context.evidence->published->points)
              if (point.planner == planner && point.tex == tex && point.speed == speed)
                return point.*figure;
            throw InvalidValue(planner, fmt::format("nothing at tex {} and {} m/s", tex, speed),
                               "a point of the paper's sweep");
          }};
}

}  // namespace

std::vector<SweepTrial> sweep_trials(const report::SweepTable& table) {
  const auto tex = report::column_index(table, report::kTexKey);
  const auto speed = report::column_index(table, report::kSpeedKey);
  if (!tex || !speed)
    throw InvalidValue("the sweep " + table.name, "other axes",
                       fmt::format("{} and {}", report::kTexKey, report::kSpeedKey));
  std::vector<SweepTrial> trials;
  for (const auto& record : table.trials)
    trials.push_back({record.planner, record.outcome, record.hit, report::number_at(record, *tex),
                      std::abs(report::number_at(record, *speed)), record.max_cpu_time,
                      record.max_solve_time, record.median_cpu_time});
  return trials;
}

const Functions& sweep_functions() {
  static const Functions table = {
      {"number", {1, 1, number}},
      {"share", {1, 1, share}},
      {"arrive", {1, 1, arrive}},
      {"trials", {2, 2, values}},
      {"tex_values", {0, 0, tex_values}},
      {"by_tex", {1, 1, by_tex}},
      {"pairs", {3, 3, pairs}},
      {"printed_passed",
       {1, 1,
        [](const Parts& p, const Context& c) -> Value {
          return double(printed_count(p[0], c).passed);
        }}},
      {"printed_trials",
       {1, 1,
        [](const Parts& p, const Context& c) -> Value {
          return double(printed_count(p[0], c).trials);
        }}},
      {"printed_rtf", printed_point(&report::PublishedSweep::Point::rtf)},
      {"printed_pos", printed_point(&report::PublishedSweep::Point::pos)},
  };
  return table;
}

}  // namespace slalom::paper
