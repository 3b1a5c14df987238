#include "sweep_data.hpp"

#include <fmt/format.h>

#include <cmath>

#include "html.hpp"
#include "sweep_axes.hpp"

namespace slalom::report {
namespace {

/// Beyond, the page would be more data than page: it then has the numbers of trials alone.
constexpr std::size_t kMostTold = 20'000;

nlohmann::ordered_json facts(const SweepTable& sweep, const TrialRecord& record) {
  auto list = nlohmann::ordered_json::array();
  const auto add = [&](const std::string& name, const std::string& value) {
    list.push_back({name, value});
  };
  const auto measured = [&](const char* name, double value, const char* unit) {
    if (std::isfinite(value)) add(name, significant(value, 4) + unit);
  };
  if (sweep.scenarios.size() > 1) add("scenario", record.scenario);
  add("planner", record.planner);
  for (std::size_t i = 0; i < record.values.size(); ++i) {
    const double value = number_at(record, i);
    add(sweep.columns[i], std::isnan(value) ? record.values[i] : significant(value, 4));
  }
  add("outcome", record.hit.empty() ? record.outcome : record.outcome + ", " + record.hit);
  measured("end", record.time, " s");
  measured("least clearance", record.least_clearance,
           (" m, to " + record.least_clearance_obstacle).c_str());
  measured("longest solve (CPU)", 1e3 * record.max_cpu_time, " ms");
  if (!record.message.empty()) add("", record.message);
  return list;
}

}  // namespace

nlohmann::ordered_json sweep_data(const SweepTable& sweep, const std::set<std::int64_t>& kept) {
  nlohmann::ordered_json data;
  data["kept"] = kept;
  data["trials"] = nlohmann::ordered_json::object();
  if (sweep.trials.size() <= kMostTold)
    for (const auto& record : sweep.trials)
      data["trials"][fmt::format("{}", record.trial)] = facts(sweep, record);
  return data;
}

}  // namespace slalom::report
