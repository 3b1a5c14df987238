// Measures of drives, and what the paper printed of them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../report/words.hpp"
#include "comparison.hpp"
#include "evaluate.hpp"
#include "paper_index.hpp"
#include "slalom/base/error.hpp"

namespace slalom::paper {
namespace {

using Parts = std::vector<Expression>;
constexpr std::size_t kMany = std::numeric_limits<std::size_t>::max();

const ReproducedDrive& drive_at(const Expression& part, const Context& context) {
  const auto name = text_of(part, context);
  const auto found = context.evidence->drives.find(name);
  if (found == context.evidence->drives.end()) throw NotDriven{name};
  return *found->second;
}

/// A measure of one drive and further arguments.
template <class F>
Function measure(std::size_t arguments, F function) {
  return {arguments, arguments, [function](const Parts& parts, const Context& context) -> Value {
            return function(drive_at(parts[0], context), parts, context);
          }};
}

/// A list that several drives give one after the other.
template <class F>
Function together(F function) {
  return {1, kMany, [function](const Parts& parts, const Context& context) -> Value {
            Numbers all;
            for (const auto& part : parts) {
              const auto own = function(drive_at(part, context));
              all.insert(all.end(), own.begin(), own.end());
            }
            return all;
          }};
}

Numbers without_first(const Numbers& list) {
  return list.empty() ? list : Numbers(list.begin() + 1, list.end());
}

template <class F>
Numbers of_cycles(const ReproducedDrive& one, F value) {
  Numbers list;
  for (const auto& cycle : one.drive.cycles)
    if (cycle.index > 0) list.push_back(value(cycle));
  return list;
}

std::size_t state_index(const Expression& part, const Context& context) {
  const auto name = text_of(part, context);
  for (std::size_t i = 0; i < vehicle::kStates; ++i)
    if (name == vehicle::kStateNames[i]) return i;
  throw InvalidValue(name, "an unknown state", "x, y, v, r, psi, sa, ux or ax");
}

/// A state of a drive at a time; NaN without samples.
double state(const ReproducedDrive& one, std::size_t index, double t) {
  return one.drive.plant.empty() ? NAN : report::state_at(one.drive, t)[index];
}

/// "reached the goal at 6.00 s".
std::string ended_at(const ReproducedDrive& one) {
  return fmt::format("{} at {:.2f} s", ended_words(one.drive), one.drive.time);
}

/// "crash O1 2.9 s".
std::string short_end(const std::string& outcome, const std::string& hit, double time) {
  return fmt::format("{}{}{} {:.1f} s", outcome, hit.empty() ? "" : " ", hit, time);
}

/// Between the path and the line through the goal along y [m^2].
double area(const ReproducedDrive& one) {
  const double x = one.scenario.goal.x;
  double total = 0;
  for (std::size_t i = 1; i < one.drive.plant.size(); ++i) {
    const auto& a = one.drive.plant[i - 1].state;
    const auto& b = one.drive.plant[i].state;
    total += std::abs(a[vehicle::X] + b[vehicle::X] - 2 * x) / 2 *
             std::abs(b[vehicle::Y] - a[vehicle::Y]);
  }
  return total;
}

/// The farthest the vehicle strays from the line of its start [m], left positive.
double farthest_aside(const ReproducedDrive& one) {
  const auto& start = one.scenario.start;
  double farthest = 0;
  for (const auto& s : one.drive.plant) {
    const double dx = s.state[vehicle::X] - start[vehicle::X];
    const double dy = s.state[vehicle::Y] - start[vehicle::Y];
    const double aside = dy * std::cos(start[vehicle::PSI]) - dx * std::sin(start[vehicle::PSI]);
    if (std::abs(aside) > std::abs(farthest)) farthest = aside;
  }
  return farthest;
}

/// Where the vehicle comes beyond an x [m along y]; NaN if it never does.
double y_beyond(const ReproducedDrive& one, double x) {
  for (const auto& s : one.drive.plant)
    if (s.state[vehicle::X] >= x) return s.state[vehicle::Y];
  return NAN;
}

/// When the front axle is nearest to an obstacle's centre [s]; NaN without samples.
double nearest_time(const ReproducedDrive& one, const std::string& name) {
  const auto& list = one.scenario.obstacles;
  const auto obstacle =
      std::find_if(list.begin(), list.end(), [&](const auto& o) { return o.name == name; });
  if (obstacle == list.end()) throw InvalidValue(name, "no obstacle of this name", "one");
  const auto away = [&](const sim::PlantSample& s) {
    return std::hypot(s.state[vehicle::X] - obstacle->x_at(s.t),
                      s.state[vehicle::Y] - obstacle->y_at(s.t));
  };
  const auto& plant = one.drive.plant;
  const auto found = std::min_element(
      plant.begin(), plant.end(), [&](const auto& a, const auto& b) { return away(a) < away(b); });
  return found == plant.end() ? NAN : found->t;
}

const PaperDrive& printed(const Expression& part, const Context& context) {
  const auto name = text_of(part, context);
  for (const auto& drive : context.evidence->paper->drives)
    if (drive.environment + "/" + drive.planner == name) return drive;
  throw InvalidValue(name, "nothing that the paper printed", "one of its drives");
}

Value printed_end(const Parts& parts, const Context& context) {
  const auto& drive = printed(parts[0], context);
  return short_end(drive.outcome, drive.hit, drive.time);
}

/// Its position at the last instant of the figures.
Value printed_last(const Parts& parts, const Context& context) {
  const auto& shots = printed(parts[0], context).snapshots;
  if (shots.empty()) return NAN;
  const auto key = text_of(parts[1], context);
  return key == "x" ? shots.back().x : key == "y" ? shots.back().y : shots.back().t;
}

/// How many of a group's drives ("GROUP/...") there are; with an outcome, that end so.
Value group_count(const Parts& parts, const Context& context) {
  const auto group = text_of(parts[0], context) + "/";
  const auto outcome = parts.size() > 1 ? text_of(parts[1], context) : "";
  double all = 0, count = 0;
  for (const auto& [name, one] : context.evidence->drives) {
    if (name.rfind(group, 0) != 0) continue;
    ++all;
    count += outcome.empty() || outcome == sim::to_string(one->drive.outcome);
  }
  if (all == 0) throw NotDriven{group};
  return count;
}

Functions of_one_drive() {
  using One = const ReproducedDrive&;
  using P = const Parts&;
  using C = const Context&;
  return {
      {"time", measure(1, [](One d, P, C) { return d.drive.time; })},
      {"goal_time", measure(1, [](One d, P, C) { return d.drive.goal_time.value_or(NAN); })},
      {"clearance", measure(1, [](One d, P, C) { return d.drive.least_clearance; })},
      {"outcome", measure(1, [](One d, P, C) { return std::string(to_string(d.drive.outcome)); })},
      {"hit", measure(1, [](One d, P, C) { return d.drive.hit; })},
      {"arrives",
       measure(1, [](One d, P, C) { return double(d.drive.outcome == sim::Outcome::goal); })},
      {"crashes_into", measure(2,
                               [](One d, P p, C c) {
                                 return double(d.drive.outcome == sim::Outcome::crash &&
                                               d.drive.hit == text_of(p[1], c));
                               })},
      {"ended", measure(1, [](One d, P, C) { return ended_at(d); })},
      {"end", measure(1,
                      [](One d, P, C) {
                        return short_end(to_string(d.drive.outcome), d.drive.hit, d.drive.time);
                      })},
      {"at_start", measure(2, [](One d, P p, C c) { return state(d, state_index(p[1], c), 0); })},
      {"at_end",
       measure(2, [](One d, P p, C c) { return state(d, state_index(p[1], c), d.drive.time); })},
      {"at", measure(3, [](One d, P p,
                           C c) { return state(d, state_index(p[1], c), number_of(p[2], c)); })},
      {"effort", measure(1, [](One d, P, C) { return effort_paper(d.drive).total(); })},
      {"cost_effort", measure(2,
                              [](One d, P p, C c) {
                                const auto& weights = drive_at(p[1], c).scenario.planner;
                                return effort_weighted(d.drive, weights).total();
                              })},
      {"area", measure(1, [](One d, P, C) { return area(d); })},
      {"aside", measure(1, [](One d, P, C) { return farthest_aside(d); })},
      {"y_beyond", measure(2, [](One d, P p, C c) { return y_beyond(d, number_of(p[1], c)); })},
      {"nearest_time",
       measure(2, [](One d, P p, C c) { return nearest_time(d, text_of(p[1], c)); })},
      {"tex", measure(1, [](One d, P, C) { return d.scenario.loop.tex; })},
  };
}

}  // namespace

const Functions& drive_functions() {
  static const auto table = [] {
    using One = const ReproducedDrive&;
    auto t = of_one_drive();
    t["cpu"] = together([](One d) { return cpu_times(d); });
    t["later_cpu"] = together([](One d) { return without_first(cpu_times(d)); });
    t["wall"] = together([](One d) { return sim::solve_times(d.drive); });
    t["t0"] = together([](One d) { return of_cycles(d, [](const auto& c) { return c.t0; }); });
    t["iterations"] = together([](One d) {
      return of_cycles(d, [](const auto& c) { return double(c.plan.report.iterations); });
    });
    t["drives"] = {1, 2, group_count};
    t["printed_end"] = {1, 1, printed_end};
    t["printed_last"] = {2, 2, printed_last};
    t["printed_effort"] = {
        1, 1, [](const Parts& parts, const Context& context) -> Value {
          const auto& paper = *context.evidence->paper;
          return (text_of(parts[0], context) == "P_B" ? paper.effort_P_B : paper.effort_P_C).total;
        }};
    t["parameters"] = {1, 1, [](const Parts& parts, const Context& context) -> Value {
                         return compare_parameters(text_of(parts[0], context));
                       }};
    return t;
  }();
  return table;
}

}  // namespace slalom::paper
