#include "trial_message.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "slalom/base/error.hpp"
#include "slalom/sim/marks.hpp"
#include "slalom/sim/solve_times.hpp"
#include "slalom/sim/verification.hpp"

namespace slalom::sweep {
namespace {

using Json = nlohmann::json;
using report::TrialRecord;

/// The figures a worker sends: member and name.
template <class F>
void for_each_figure(TrialRecord& r, const F& f) {
  f("outcome", r.outcome);
  f("hit", r.hit);
  f("message", r.message);
  f("nearest", r.least_clearance_obstacle);
  f("time", r.time);
  f("goal_time", r.goal_time);
  f("least_clearance", r.least_clearance);
  f("least_wheel_load", r.least_wheel_load);
  f("cycles", r.cycles);
  f("failed_cycles", r.failed_cycles);
  f("iterations", r.iterations);
  f("new_plans", r.new_plans);
  f("rests", r.rests);
  f("least_bads", r.least_bads);
  f("marks", r.marks);
  f("max_solve_time", r.max_solve_time);
  f("median_solve_time", r.median_solve_time);
  f("max_cpu_time", r.max_cpu_time);
  f("p99_cpu_time", r.p99_cpu_time);
  f("median_cpu_time", r.median_cpu_time);
}

/// JSON has no infinity and no NaN.
Json to_json(double value) {
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return std::isnan(value) ? Json(nullptr) : Json(value);
}
template <class T>
Json to_json(const T& value) {
  return value;
}

void from_json_value(const Json& json, double& value) {
  if (json.is_string())
    value = json == "inf" ? HUGE_VAL : -HUGE_VAL;
  else
    value = json.is_null() ? TrialRecord::kNone : json.get<double>();
}
void from_json_value(const Json& json, int& value) {
  if (!json.is_number_unsigned() || json > std::numeric_limits<int>::max())
    throw InvalidValue("a count", json.dump(), "a whole number from 0 on");
  json.get_to(value);
}
void from_json_value(const Json& json, std::string& value) {
  json.get_to(value);
}

/// What `read` makes of a line of JSON. Throws InvalidValue for a line that is none of `content`.
template <class F>
auto parsed(const std::string& line, const std::string& content, const F& read) {
  constexpr std::size_t kShown = 80;
  try {
    return read(Json::parse(line));
  } catch (const Json::exception&) {
  } catch (const InvalidValue&) {
  }
  throw InvalidValue("a line between a sweep and its worker", "'" + line.substr(0, kShown) + "'",
                     content);
}

std::string dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string to_line(const TrialOrder& order) {
  return dump({{"resolved", order.resolved}, {"kernels", order.kernels}, {"folder", order.folder}});
}

TrialOrder parse_order(const std::string& line) {
  return parsed(line, "a trial's order", [](const Json& json) {
    return TrialOrder{json.at("resolved"), json.at("kernels"), json.at("folder")};
  });
}

std::string to_line(const TrialAnswer& answer) {
  Json json = {{"not_written", answer.not_written}};
  auto record = answer.record;
  for_each_figure(record, [&](const char* name, auto& value) { json[name] = to_json(value); });
  return dump(json);
}

TrialAnswer parse_answer(const std::string& line) {
  return parsed(line, "the figures of a drive", [](const Json& json) {
    TrialAnswer answer;
    answer.not_written = json.at("not_written");
    for_each_figure(answer.record,
                    [&](const char* name, auto& value) { from_json_value(json.at(name), value); });
    if (const auto& known = sim::outcome_names();
        answer.not_written.empty() &&
        std::find(known.begin(), known.end(), answer.record.outcome) == known.end())
      throw InvalidValue("outcome", answer.record.outcome, "a known one");
    return answer;
  });
}

TrialRecord record_of(const sim::Scenario& scenario, const sim::Drive& drive) {
  TrialRecord r;
  r.outcome = sim::to_string(drive.outcome);
  r.hit = drive.hit;
  r.message = drive.message;
  r.time = drive.time;
  r.goal_time = drive.goal_time.value_or(TrialRecord::kNone);
  r.least_clearance = drive.least_clearance;
  r.least_clearance_obstacle = drive.least_clearance_obstacle;
  r.least_wheel_load = drive.least_wheel_load;
  for (const auto& cycle : drive.cycles) {
    if (cycle.index == 0) continue;  // the warm-up
    ++r.cycles;
    r.iterations += cycle.plan.report.iterations;
  }
  r.failed_cycles = sim::unsolved(drive).cycles;
  if (const auto verification = sim::verification(drive)) {
    r.new_plans = verification->of(planner::Rung::new_plan);
    r.rests = verification->of(planner::Rung::rest);
    r.least_bads = verification->of(planner::Rung::least_bad);
  }
  for (const auto& mark : sim::marks(scenario, drive))
    r.marks += (r.marks.empty() ? "" : " ") + mark.kind;
  const auto wall = sim::solve_times(drive), cpu = sim::solve_times(drive, true);
  r.max_solve_time = sim::greatest(wall);
  r.median_solve_time = sim::median(wall);
  r.max_cpu_time = sim::greatest(cpu);
  r.p99_cpu_time = sim::percentile(cpu, 99);
  r.median_cpu_time = sim::median(cpu);
  return r;
}

}  // namespace slalom::sweep
