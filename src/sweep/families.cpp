#include "slalom/sweep/families.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "family_scenes.hpp"
#include "slalom/base/error.hpp"
#include "slalom/world/path_exists.hpp"

namespace slalom::sweep {
namespace {

using sim::Scenario;
using world::Obstacle;

constexpr int kMostDraws = 200;

/// Start and goal, and room at both for every obstacle as it stands at t = 0.
Scenario empty_scene(const std::string& name, const std::string& about) {
  Scenario s;
  s.name = name;
  s.title = about;
  s.start = {0, 0, 0, 0, 1.5707963267948966, 0, kStartSpeed, 0};
  s.goal = {0, kStartToGoal, 1.5707963267948966, 15};
  return s;
}

bool start_is_clear(const Scenario& s) {
  return std::all_of(s.obstacles.begin(), s.obstacles.end(), [&](const Obstacle& o) {
    return world::distance(o.grown(s.planner.sm_end), 0, 0, 0) > 5;
  });
}

}  // namespace

const std::vector<Family>& families() {
  static const auto list = [] {
    std::vector<Family> names;
    for (const auto& maker : makers()) names.push_back(maker.family);
    return names;
  }();
  return list;
}

Scenario make_scenario(const std::string& family, const Draw& draw) {
  const auto& list = makers();
  const auto maker = std::find_if(list.begin(), list.end(),
                                  [&](const Maker& m) { return m.family.name == family; });
  if (maker == list.end()) {
    std::vector<std::string> names;
    for (const auto& m : list) names.push_back(m.family.name);
    throw InvalidValue("FAMILY", fmt::format("'{}'", family), one_of(family, names));
  }
  if (!(draw.difficulty >= 0 && draw.difficulty <= 1))
    throw InvalidValue("difficulty", fmt::format("{}", draw.difficulty), "a number from 0 to 1");
  for (int attempt = 0; attempt < kMostDraws; ++attempt) {
    Dice dice({draw.seed, static_cast<std::uint32_t>(maker - list.begin()),
               static_cast<std::uint32_t>(draw.index), static_cast<std::uint32_t>(attempt)});
    auto scenario = empty_scene(fmt::format("{}-{:04}", family, draw.index), maker->family.about);
    maker->fill(scenario, draw.difficulty, dice);
    if (start_is_clear(scenario) && world::path_exists(scenario, scenario.vehicle, scenario.start))
      return scenario;
  }
  throw Error(fmt::format("none of {} draws of {} at difficulty {} had a way from start to goal",
                          kMostDraws, family, draw.difficulty));
}

}  // namespace slalom::sweep
