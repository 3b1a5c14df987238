#include "cycle_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>

#include "page_json.hpp"
#include "slalom/sim/marks.hpp"
#include "thinning.hpp"

namespace slalom::report {
namespace {

using Json = nlohmann::ordered_json;

/// Of the bytes of all cycles, the share of what each has for certain, and of their details; nodes
/// have the rest.
constexpr double kBriefShare = 0.42, kDetailsShare = 0.2;
constexpr std::size_t kPlanBytes = 190;  ///< a plan's names, and what is said of a gap
constexpr std::size_t kNodeBytes = 100;  ///< a node, with long numbers
constexpr std::size_t kFewestNodes = 3;
constexpr std::size_t kMostNodes = 24'000;  ///< of all plans together

/// `value` with three digits, as an order of magnitude has them.
Json roughly(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::strtod(fmt::format("{:.2e}", value).c_str(), nullptr);
}

Json plan_data(const planner::Plan& plan, std::size_t nodes) {
  const auto indices = kept_evenly(plan.t.size(), nodes);
  Json json;
  json["t_start"] = rounded(plan.t_start, kTimeDigits);
  json["tf"] = rounded(plan.tf, kTimeDigits);
  json["held"] =
      plan.obstacle_time_held ? rounded(*plan.obstacle_time_held, kTimeDigits) : Json(nullptr);
  json["t"] = Json::array();
  for (const auto k : indices) json["t"].push_back(rounded(plan.t[k], kTimeDigits));
  for (std::size_t i = 0; i < vehicle::kStates; ++i) {
    auto& column = json[vehicle::kStateNames[i]] = Json::array();
    for (const auto k : indices) column.push_back(rounded(plan.states[k][i], kStateDigits[i]));
  }
  for (std::size_t i = 0; i < vehicle::kControls; ++i) {
    auto& column = json[vehicle::kControlNames[i]] = Json::array();
    for (const auto k : indices) column.push_back(rounded(plan.controls[k][i], kControlDigits[i]));
  }
  return json;
}

Json certificate_data(const planner::Certificate& c) {
  return {{"verified", c.verified},
          {"clearance", rounded(c.least_clearance, 4)},
          {"nearest", c.nearest},
          {"wheel_load", rounded(c.least_wheel_load, 1)},
          {"until", rounded(c.until, kTimeDigits)},
          {"refused", c.refused}};
}

/// An obstacle that a plan does not get past, and when.
struct Blocker {
  std::string name;
  double t = 0;  ///< absolute [s]
};

/// When the node is at which an obstacle's row stands that a plan violates most.
double time_of_row(const planner::Plan& plan, const std::string& obstacle) {
  const std::string& row = plan.report.worst_constraint;
  const auto part = fmt::format("obstacle[{}] at node ", obstacle);
  const auto found = row.find(part);
  if (found == std::string::npos || plan.t.empty()) return plan.t_start;
  const auto node = std::strtoul(row.c_str() + found + part.size(), nullptr, 10);
  return plan.t_start + plan.t[std::min<std::size_t>(node, plan.t.size() - 1)];
}

/// The obstacle that a cycle names as what is in the way: the longest such name.
std::optional<Blocker> blocker_of(const sim::Scenario& scenario, const planner::Plan& plan) {
  const auto& certificate = plan.certificate;
  const bool refused = plan.rung != planner::Rung::none && !certificate.verified;
  std::optional<Blocker> found;
  for (const auto& o : scenario.obstacles) {
    if (found && o.name.size() <= found->name.size()) continue;
    if (plan.report.blocks.starts_with(o.name + " in the way: "))
      found = {o.name,
               plan.obstacle_time_held ? *plan.obstacle_time_held : time_of_row(plan, o.name)};
    else if (refused &&
             (certificate.refused.starts_with("clearance to " + o.name + " at ") ||
              certificate.refused.starts_with("standing in the way of " + o.name + " at ")))
      found = {o.name, certificate.refused_at};
  }
  return found;
}

/// Without details and plan.
Json brief_data(const sim::Scenario& scenario, const sim::Cycle& cycle) {
  const auto& plan = cycle.plan;
  const auto& report = plan.report;
  Json json;
  json["index"] = cycle.index;
  json["t0"] = rounded(cycle.t0, kTimeDigits);
  json["tex"] = rounded(cycle.tex, kTimeDigits);
  json["t_swap"] = rounded(cycle.t_swap, kTimeDigits);
  json["used"] = cycle.used;
  json["solved"] = report.solved;
  json["status"] = report.status_text();
  json["iterations"] = report.iterations;
  json["wall"] = rounded(report.wall_s, 6);
  json["cpu"] = rounded(report.cpu_s, 6);
  json["cost"] = rounded(report.cost, 4);
  json["terms"] = Json::array();
  json["worst"] = report.worst_constraint;
  if (!report.blocks.empty()) json["blocks"] = report.blocks;
  if (const auto blocker = blocker_of(scenario, plan))
    json["blocker"] = {{"name", blocker->name}, {"t", rounded(blocker->t, 3)}};
  json["violation"] = roughly(report.worst_violation);
  json["goal_in_range"] = plan.goal_in_range;
  const sim::StartSlack slack = sim::start_slack(cycle);
  json["start_slack"] = {rounded(slack.distance, 3), rounded(slack.heading * 180 / M_PI, 2)};
  if (report.passage.depth > 0)
    json["passage"] = {rounded(report.passage.depth, 3), report.passage.obstacle,
                       rounded(report.passage.at_nodes, 3)};
  if (report.road_exit.depth > 0)
    json["road_exit"] = {rounded(report.road_exit.depth, 3), report.road_exit.edge()};
  if (plan.rung != planner::Rung::none) {
    json["rung"] = planner::to_string(plan.rung);
    json["certificate"] = certificate_data(plan.certificate);
  }
  return json;
}

/// The terms of its cost; of a planner that verifies, also what else there was, each a candidate
/// with its cost (null: refused).
Json details_data(const planner::Plan& plan) {
  Json json = {{"terms", Json::array()}};
  for (const auto& [name, value] : plan.report.cost_terms)
    json["terms"].push_back(Json::array({name, rounded(value, 4)}));
  if (plan.rung == planner::Rung::none) return json;
  auto& candidates = json["candidates"] = Json::array();
  for (const auto& candidate : plan.candidates) {
    const bool verified = candidate.certificate.verified;
    auto path = Json::array();
    for (const auto& place : candidate.path)
      path.push_back({rounded(place.x, 2), rounded(place.y, 2)});
    candidates.push_back({{"name", candidate.name},
                          {"cost", verified ? rounded(candidate.cost, 4) : Json(nullptr)},
                          {"certificate", certificate_data(candidate.certificate)},
                          {"path", path}});
  }
  return json;
}

std::size_t size_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace).size();
}

/// Says of each cycle whose successor is left out until when its plan was driven.
void note_gaps(const std::vector<sim::Cycle>& cycles, const std::vector<std::size_t>& kept,
               Json& json) {
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const std::size_t next = i + 1 < kept.size() ? kept[i + 1] : cycles.size();
    if (next == kept[i] + 1) continue;
    json[i]["left_out"] = next - kept[i] - 1;
    const auto driven = std::find_if(cycles.begin() + static_cast<std::ptrdiff_t>(kept[i]) + 1,
                                     cycles.begin() + static_cast<std::ptrdiff_t>(next),
                                     [](const auto& cycle) { return cycle.used; });
    if (driven != cycles.begin() + static_cast<std::ptrdiff_t>(next))
      json[i]["until"] = rounded(driven->t_swap, kTimeDigits);
  }
}

}  // namespace

CyclesData cycles_data(const sim::Scenario& scenario, const sim::Drive& drive,
                       const std::vector<double>& marked, std::size_t bytes) {
  const auto& cycles = drive.cycles;
  const auto order = by_weight(cycles, marked);
  const auto share = [&](double of) {
    return static_cast<std::size_t>(of * static_cast<double>(bytes));
  };
  std::vector<std::pair<std::size_t, Json>> chosen;
  std::size_t used = 0;
  for (const std::size_t k : order) {
    Json json = brief_data(scenario, cycles[k]);
    used += size_of(json) + kPlanBytes;
    if (used > share(kBriefShare) && chosen.size() > 1) break;
    chosen.emplace_back(k, std::move(json));
  }
  CyclesData data;
  std::size_t details = 0;
  for (auto& [k, json] : chosen) {
    const Json more = details_data(cycles[k].plan);
    details += size_of(more);
    if (details > share(kDetailsShare)) break;
    json.update(more);
    ++data.detailed;
  }
  std::sort(chosen.begin(), chosen.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  const std::size_t left = bytes - std::min(bytes, used + std::min(details, share(kDetailsShare)));
  data.nodes = std::max(kFewestNodes, std::min(left / kNodeBytes, kMostNodes) /
                                          std::max<std::size_t>(chosen.size(), 1));
  data.cycles = Json::array();
  std::vector<std::size_t> kept;
  for (auto& [k, json] : chosen) {
    const auto& plan = cycles[k].plan;
    data.all_nodes = data.all_nodes && plan.t.size() <= data.nodes;
    json["plan"] = plan_data(plan, data.nodes);
    data.cycles.push_back(std::move(json));
    kept.push_back(k);
  }
  note_gaps(cycles, kept, data.cycles);
  return data;
}

}  // namespace slalom::report
