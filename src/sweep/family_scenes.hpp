#pragma once

#include <random>
#include <vector>

#include "slalom/sweep/families.hpp"

namespace slalom::sweep {

/// Of every scenario of a family: the vehicle starts at (0, 0) northwards, the goal is ahead.
inline constexpr double kStartToGoal = 200;  ///< [m]
inline constexpr double kStartSpeed = 17;    ///< [m/s]

/// Random numbers of one draw, spelt out, for distributions of the standard library differ from one
/// to another.
class Dice {
 public:
  explicit Dice(std::seed_seq&& seed) : generator_(seed) {}
  double uniform(double lo, double hi) {
    return lo + (hi - lo) * (static_cast<double>(generator_() >> 11U) + 0.5) * 0x1p-53;
  }
  double sign() { return uniform(-1, 1) < 0 ? -1 : 1; }

 private:
  std::mt19937_64 generator_;
};

/// A family, and what puts its obstacles and its region into a scenario that has neither.
struct Maker {
  Family family;
  void (*fill)(sim::Scenario&, double difficulty, Dice&);
};

/// All families. Draws depend on a family's place in the list: new ones are put at its end.
const std::vector<Maker>& makers();

}  // namespace slalom::sweep
