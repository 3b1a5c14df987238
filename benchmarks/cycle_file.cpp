#include "cycle_file.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>

#include "slalom/base/error.hpp"

namespace slalom::bench {
namespace {

using nlohmann::json;
using vehicle::kControls;
using vehicle::kStates;

enum Field : std::size_t { META, X0P, LAST_X0P, LAST_PLAN, LAST_SLACKS, Y, ZL, ZU, WARM, COLD };
const std::vector<std::string> kFields = {"meta", "X0p", "last_X0p", "last_plan", "last_slacks",
                                          "y",    "zl",  "zu",       "warm_x",    "cold_x"};
const std::vector<std::string> kMeta = {"t0",       "t_start",       "in_range",
                                        "solved",   "drive",         "perturbed",
                                        "has_last", "last_in_range", "last_t_start"};
using Record = std::vector<std::vector<double>>;  // by Field

json names_of(const ocp::Transcription& transcription) {
  json variables = json::array(), rows = json::array();
  const auto& shape = transcription.structure();
  for (std::size_t i = 0; i < shape.variables; ++i)
    variables.push_back(transcription.variable_name(i));
  for (std::size_t r = 0; r < shape.rows; ++r) rows.push_back(transcription.row_name(r));
  return {{"variables", variables}, {"rows", rows}};
}

/// The plan's nodes one after the other, state and control, then tf.
std::vector<double> flat(const ocp::Trajectory& plan) {
  std::vector<double> values;
  for (std::size_t k = 0; k < plan.tau.size(); ++k) {
    values.insert(values.end(), plan.states[k].begin(), plan.states[k].end());
    values.insert(values.end(), plan.controls[k].begin(), plan.controls[k].end());
  }
  values.push_back(plan.tf);
  return values;
}

ocp::Trajectory unflat(const std::vector<double>& values) {
  constexpr std::size_t kNode = std::size_t{kStates} + std::size_t{kControls};
  const std::size_t nodes = values.size() / kNode;
  ocp::Trajectory plan;
  plan.tf = values.back();
  for (std::size_t k = 0; k < nodes; ++k) {
    const auto node = values.begin() + static_cast<std::ptrdiff_t>(k * kNode);
    plan.tau.push_back(static_cast<double>(k) / static_cast<double>(nodes - 1));
    plan.states.emplace_back(node, node + kStates);
    plan.controls.emplace_back(node + kStates, node + kNode);
  }
  return plan;
}

void rescale(nlp::Start& multipliers, const nlp::Structure& shape, bool to_user) {
  const auto apply = [&](std::vector<double>& values, const std::vector<double>& scale, bool up) {
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = up == to_user ? values[i] * scale[i] : values[i] / scale[i];
  };
  apply(multipliers.y, shape.row_scale, true);
  apply(multipliers.zl, shape.variable_scale, false);
  apply(multipliers.zu, shape.variable_scale, false);
}

Record record_of(const Cycle& cycle, PlannerCycle& planner) {
  Record record(kFields.size());
  const auto& r = cycle.request;
  record[META] = {r.t0,
                  r.t_start,
                  double(cycle.in_range),
                  double(cycle.solved),
                  double(cycle.drive),
                  double(cycle.perturbed),
                  double(cycle.last.has_value()),
                  0,
                  0};
  record[X0P].assign(r.X0p.begin(), r.X0p.end());
  record[WARM] = cycle.warm_x;
  record[COLD] = cycle.cold_x;
  if (!cycle.last) return record;
  const Last& last = *cycle.last;
  record[META][7] = double(last.plan.in_range);
  record[META][8] = last.plan.t_start;
  record[LAST_X0P].assign(last.plan.X0p.begin(), last.plan.X0p.end());
  record[LAST_PLAN] = flat(last.plan.trajectory);
  record[LAST_SLACKS] = last.plan.trajectory.slacks;
  nlp::Start user = last.multipliers;
  rescale(user, planner.form(last.plan.in_range).transcription.structure(), true);
  record[Y] = user.y;
  record[ZL] = user.zl;
  record[ZU] = user.zu;
  return record;
}

Cycle cycle_of(const Record& record, PlannerCycle& planner) {
  const auto& meta = record[META];
  Cycle cycle;
  cycle.request.t0 = meta[0];
  cycle.request.t_start = meta[1];
  cycle.in_range = meta[2] != 0;
  cycle.solved = meta[3] != 0;
  cycle.drive = static_cast<int>(meta[4]);
  cycle.perturbed = meta[5] != 0;
  std::copy_n(record[X0P].begin(), kStates, cycle.request.X0p.begin());
  cycle.warm_x = record[WARM];
  cycle.cold_x = record[COLD];
  if (meta[6] == 0) return cycle;
  Last& last = cycle.last.emplace();
  last.plan.in_range = meta[7] != 0;
  last.plan.t_start = meta[8];
  std::copy_n(record[LAST_X0P].begin(), kStates, last.plan.X0p.begin());
  last.plan.trajectory = unflat(record[LAST_PLAN]);
  last.plan.trajectory.slacks = record[LAST_SLACKS];
  last.multipliers = {{}, record[Y], record[ZL], record[ZU]};
  rescale(last.multipliers, planner.form(last.plan.in_range).transcription.structure(), false);
  return cycle;
}

}  // namespace

std::vector<double> in_user_units(const std::vector<double>& x, const nlp::Structure& shape) {
  std::vector<double> result(x);
  for (std::size_t i = 0; i < x.size(); ++i) result[i] *= shape.variable_scale[i];
  return result;
}

json describe(const nlp::Residuals& residuals, const ocp::Trajectory& trajectory) {
  std::vector<double> path;
  for (const auto& state : trajectory.states)
    path.insert(path.end(), {state[vehicle::X], state[vehicle::Y]});
  return {{"violation", residuals.violation},
          {"worst", residuals.worst_constraint},
          {"stationarity", residuals.stationarity},
          {"complementarity", residuals.complementarity},
          {"worst_pair", residuals.worst_pair},
          {"f", residuals.objective},
          {"phi", residuals.phi},
          {"tf", trajectory.tf},
          {"path", path}};
}

void place_starts(PlannerCycle& planner, Cycle& cycle) {
  cycle.in_range = planner.goal_in_range(cycle.request.X0p);
  const auto x = [&](const Last* last) {
    nlp::Start start;
    planner.start(cycle.request, last, start);
    return in_user_units(start.x, planner.form(cycle.in_range).transcription.structure());
  };
  cycle.cold_x = x(nullptr);
  cycle.warm_x = x(cycle.last ? &*cycle.last : nullptr);
}

void write_cycles(const std::string& path, PlannerCycle& planner, const std::string& environment,
                  const std::vector<Cycle>& cycles) {
  std::ofstream file(path, std::ios::binary);
  const json header = {{"environment", environment},
                       {"cycles", cycles.size()},
                       {"fields", kFields},
                       {"meta", kMeta},
                       {"forms",
                        {{"out_of_range", names_of(planner.form(false).transcription)},
                         {"in_range", names_of(planner.form(true).transcription)}}}};
  file << header.dump() << "\n";
  const auto put = [&](double value) {
    file.write(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const auto& cycle : cycles)
    for (const auto& values : record_of(cycle, planner)) {
      put(static_cast<double>(values.size()));
      for (const double value : values) put(value);
    }
  if (!file.flush()) throw InvalidValue(path, "an error while writing", "a folder to write to");
}

std::vector<Cycle> read_cycles(const std::string& path, PlannerCycle& planner) {
  std::ifstream file(path, std::ios::binary);
  std::string line;
  if (!std::getline(file, line)) throw InvalidValue(path, "no header", "cycles of bench_record");
  const auto get = [&] {
    double value = 0;
    if (!file.read(reinterpret_cast<char*>(&value), sizeof value))
      throw InvalidValue(path, "an early end", "cycles of bench_record");
    return value;
  };
  std::vector<Cycle> cycles(json::parse(line).at("cycles").get<std::size_t>());
  for (auto& cycle : cycles) {
    Record record(kFields.size());
    for (auto& values : record) {
      values.resize(static_cast<std::size_t>(get()));
      for (double& value : values) value = get();
    }
    cycle = cycle_of(record, planner);
  }
  return cycles;
}

}  // namespace slalom::bench
