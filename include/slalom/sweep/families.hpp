#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "slalom/sim/scenario.hpp"

namespace slalom::sweep {

/// A family of random scenarios.
struct Family {
  std::string name, about;  ///< about: one sentence, with what difficulty does
};
const std::vector<Family>& families();

/// Which scenario of a family: the same numbers give the same scenario on every machine, whatever
/// else is made.
struct Draw {
  std::uint32_t seed = 0;
  int index = 1;            ///< 1, 2, ... within the seed
  double difficulty = 0.5;  ///< 0 easy ... 1 hard
};

/// A scenario through which path_exists() finds a way: draws that have none are drawn again. The
/// vehicle starts at (0, 0) northwards at 17 m/s; the goal is 200 m ahead. Throws InvalidValue for
/// a family that is none or a difficulty outside [0, 1], Error when 200 draws had no way.
sim::Scenario make_scenario(const std::string& family, const Draw& draw);

}  // namespace slalom::sweep
