#include "slalom/sweep/families.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "slalom/base/error.hpp"
#include "slalom/world/path_exists.hpp"

namespace slalom::sweep {
namespace {

using sim::Scenario;
using world::Obstacle;

constexpr int kMostDraws = 200;
constexpr double kLength = 200;  ///< from start to goal [m]
constexpr double kSpeed = 17;    ///< of the vehicle at the start [m/s]

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

int count(double easy, double hard, double d) {
  return static_cast<int>(std::lround(easy + (hard - easy) * d));
}

void add(Scenario& s, double x, double y, double a, double b, double vx = 0, double vy = 0) {
  s.obstacles.push_back({fmt::format("O{}", s.obstacles.size() + 1), x, y, a, b, vx, vy});
}

void static_field(Scenario& s, double d, Dice& dice) {
  for (int k = count(3, 14, d); k > 0; --k) {
    const double r = dice.uniform(1, 3);
    add(s, dice.uniform(-18, 18), dice.uniform(45, 175), r, r);
  }
}

void moving_field(Scenario& s, double d, Dice& dice) {
  for (int k = count(3, 14, d); k > 0; --k) {
    const double r = dice.uniform(1, 3), speed = dice.uniform(0, 2 + 8 * d);
    const double towards = dice.uniform(-3.141592653589793, 3.141592653589793);
    add(s, dice.uniform(-25, 25), dice.uniform(45, 175), r, r, speed * std::cos(towards),
        speed * std::sin(towards));
  }
}

/// Vehicles across the way, timed to be near it when the vehicle comes at 17 to 25 m/s.
void crossing(Scenario& s, double d, Dice& dice) {
  for (int k = count(2, 7, d); k > 0; --k) {
    const double y = dice.uniform(50, 170), vx = dice.sign() * dice.uniform(4, 6 + 10 * d);
    const double t = y / dice.uniform(kSpeed, 25);
    add(s, dice.uniform(-4, 4) - vx * t, y, 2.4, 1, vx, 0);
  }
}

/// Vehicles in three lanes of 5 m, towards the start.
void oncoming(Scenario& s, double d, Dice& dice) {
  s.region.x_min = -12;
  s.region.x_max = 12;
  for (int k = count(2, 6, d); k > 0; --k) {
    const double lane = std::floor(dice.uniform(-1, 2)), vy = -dice.uniform(5, 8 + 17 * d);
    add(s, 5 * lane, dice.uniform(90, 320), 1, 2.4, 0, vy);
  }
}

/// Barriers from alternate sides beyond the middle line.
void slalom(Scenario& s, double d, Dice& dice) {
  s.region.x_min = -25;
  s.region.x_max = 25;
  const double spacing = 50 - 16 * d;
  double side = dice.sign();
  for (double y = 55; y < 180; y += spacing * dice.uniform(0.9, 1.1), side = -side)
    add(s, side * (12 - dice.uniform(0, 1 + 3 * d)), y, 12, 1);
}

/// Cones along both sides of three lanes, the middle one moved aside.
void double_lane_change(Scenario& s, double d, Dice& dice) {
  const double half = 7.5 - 1.5 * d, aside = dice.sign() * dice.uniform(3, 4 + 4 * d);
  const double gap = 40 - 10 * d;
  const auto lane = [&](double from, double to, double x) {
    for (double y = from; y <= to; y += 5)
      for (const double side : {-1.0, 1.0}) add(s, x + side * half, y, 0.3, 0.3);
  };
  lane(30, 50, 0);
  lane(50 + gap, 75 + gap, aside);
  lane(75 + 2 * gap, 95 + 2 * gap, 0);
}

void gates(Scenario& s, double d, Dice& dice) {
  for (double y = 50; y < 180; y += dice.uniform(35, 45)) {
    const double middle = dice.uniform(-1, 1) * (2 + 6 * d), half = dice.uniform(8 - 1.5 * d, 9);
    for (const double side : {-1.0, 1.0}) add(s, middle + side * (half + 6), y, 6, 1.5);
  }
}

/// Pockets that open towards the start.
void dead_ends(Scenario& s, double d, Dice& dice) {
  for (int k = 0; k < count(1, 2, d); ++k) {
    const double half = dice.uniform(6, 8 + 5 * d), depth = dice.uniform(6, 8 + 10 * d);
    const double x = dice.uniform(-4, 4), y = 75 + 65 * k + dice.uniform(-5, 5);
    add(s, x, y, half, 1);
    for (const double side : {-1.0, 1.0}) add(s, x + side * half, y - depth / 2, 1, depth / 2);
  }
}

struct Maker {
  Family family;
  void (*fill)(Scenario&, double difficulty, Dice&);
};

const std::vector<Maker>& makers() {
  static const std::vector<Maker> list = {
      {{"static_field", "standing circles of 1 to 3 m: 3, and 14 at difficulty 1"}, static_field},
      {{"moving_field", "the same, moving anywhere at up to 2 m/s, and 10 at difficulty 1"},
       moving_field},
      {{"crossing", "2 to 7 vehicles across the way at up to 6 to 16 m/s, timed to meet"},
       crossing},
      {{"oncoming", "2 to 6 vehicles towards the start in three lanes, at up to 8 to 25 m/s"},
       oncoming},
      {{"slalom", "barriers from alternate sides beyond the middle, 50 to 34 m apart"}, slalom},
      {{"double_lane_change", "lanes of cones 15 to 12 m wide, the middle one moved aside"},
       double_lane_change},
      {{"gates", "gates 16 to 13 m wide or wider, off the middle by up to 2 to 8 m"}, gates},
      {{"dead_ends", "pockets open towards the start, one or two, wider and deeper"}, dead_ends},
  };
  return list;
}

/// Start and goal, and room at both for every obstacle as it stands at t = 0.
Scenario empty_scene(const std::string& name, const std::string& about) {
  Scenario s;
  s.name = name;
  s.title = about;
  s.start = {0, 0, 0, 0, 1.5707963267948966, 0, kSpeed, 0};
  s.goal = {0, kLength, 1.5707963267948966, 15};
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
    if (start_is_clear(scenario) && world::path_exists(scenario, scenario.start)) return scenario;
  }
  throw Error(fmt::format("none of {} draws of {} at difficulty {} had a way from start to goal",
                          kMostDraws, family, draw.difficulty));
}

}  // namespace slalom::sweep
