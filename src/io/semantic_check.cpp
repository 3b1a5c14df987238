#include "semantic_check.hpp"

#include <fmt/format.h>

#include <tuple>
#include <vector>

namespace slalom::io {
namespace {

/// How near a place is to the user: the command line, then the scenario, then a file it names.
int rank_of(const Place& place, const std::string& file) {
  if (place.line == 0) return 0;
  return place.source == file ? 1 : 2;
}

/// Where the values at fault stand: of several places the one nearest to the user, whose slip it
/// most likely is; of equally near ones the first. Where no key has a place, that of its section
/// counts; `whole` where that has none either.
const Place& place_of(const std::vector<std::string>& keys, const Place& whole,
                      const Places& places) {
  const Place* best = &whole;
  std::tuple<bool, int> best_order = {true, 3};
  const auto offer = [&](const std::string& path, bool section) {
    const auto found = places.find(path);
    if (found == places.end()) return;
    const std::tuple order(section, rank_of(found->second, whole.source));
    if (order >= best_order) return;
    best = &found->second;
    best_order = order;
  };
  for (const auto& key : keys) {
    offer(key, false);
    offer(key.substr(0, key.rfind('.')), true);
  }
  return *best;
}

/// What the check names after the file, with a space behind it: "start ", "obstacle O2 ", or
/// nothing.
std::string subject_of(const InvalidValue& error, const std::string& file) {
  const auto prefix = file + ": ";
  return error.where().starts_with(prefix) ? error.where().substr(prefix.size()) + " " : "";
}

}  // namespace

void check_scenario(const sim::Scenario& scenario, const Place& whole, const Places& places) {
  try {
    sim::check(scenario, whole.source);
  } catch (const InvalidValue& error) {
    throw InvalidValue(place_of(error.keys(), whole, places).to_string(),
                       subject_of(error, whole.source) + error.found(), error.expected(),
                       error.keys());
  }
}

void follow_footprint(sim::Scenario& scenario, const Places& stated) {
  if (stated.count("loop.sm_crash") > 0) scenario.sm_crash_follows = false;
  if (!scenario.sm_crash_follows) return;
  // The default margin makes up for the body that a point has not.
  const bool point = scenario.vehicle.footprint == vehicle::FootprintKind::point;
  scenario.loop.sm_crash = point ? sim::LoopSettings{}.sm_crash : 0;
}

void check_goal_keys(const sim::Scenario& scenario, const Places& stated) {
  const auto kind = scenario.goal.kind();
  if (kind == world::GoalKind::square) return;
  const bool rectangle = kind == world::GoalKind::rectangle;
  const std::string by = rectangle                       ? "length"
                         : kind == world::GoalKind::line ? "s"
                         : kind == world::GoalKind::time ? "time"
                                                         : "laps";
  const auto winner = stated.find("goal." + by);
  for (const std::string key : {"sigma", "psi_deg", "psi", "x", "y"}) {
    if (rectangle && key != "sigma") continue;
    const auto lost = stated.find("goal." + key);
    if (lost == stated.end()) continue;
    // The command line may put another goal in the place of the file's.
    if (lost->second.line > 0 && winner != stated.end() && winner->second.line == 0) continue;
    throw InvalidValue(lost->second.to_string(), fmt::format("{} of the goal beside {}", key, by),
                       rectangle ? "sigma only without length and width"
                                 : fmt::format("{} only without {}", key, by));
  }
}

}  // namespace slalom::io
