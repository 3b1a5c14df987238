#include "family_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace slalom::sweep {
namespace {

using sim::Scenario;

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
    const double t = y / dice.uniform(kStartSpeed, 25);
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

/// A narrow road, more than half of it closed by something that stands, and two vehicles that come
/// through what is left: the first when the vehicle would, the second 3 to 6 s later and off the
/// first's line. Neither leaves room beside itself there.
void two_oncoming(Scenario& s, double d, Dice& dice) {
  s.region.x_min = -7;
  s.region.x_max = 7;
  const double side = dice.sign(), y = dice.uniform(80, 120);
  const double closed_from = dice.uniform(0, 0.9);
  add(s, side * 7, y, 7 - closed_from, dice.uniform(1.5, 3 + 5 * d));
  const double first_lane = dice.sign();
  double t = y / dice.uniform(13, 19);
  for (const double lane : {first_lane, -first_lane}) {
    const double speed = dice.uniform(8, 13 + 20 * d);
    add(s, side * (-4.3 + 0.7 * lane), y + speed * t, 1, 2.4, 0, -speed);
    t += dice.uniform(3, 6);
  }
}

/// A lane closed by something slow or standing, and faster vehicles from behind in the only other
/// one, the first beside it when the vehicle comes up to it at 17 m/s.
void overtaking(Scenario& s, double d, Dice& dice) {
  const double side = dice.sign();
  s.region.x_min = side < 0 ? -8 : -3;
  s.region.x_max = side < 0 ? 3 : 8;
  const double ahead = dice.uniform(50, 90), slow = std::max(0.0, dice.uniform(-4, 6));
  add(s, 0, ahead, 1, 2.4, 0, slow);
  double t = ahead / (kStartSpeed - slow) + dice.uniform(-0.5, 1.5);
  for (int k = count(1, 4, d); k > 0; --k) {
    const double speed = dice.uniform(20, 24 + 9 * d);
    add(s, side * 5, ahead + (slow - speed) * t, 1, 2.4, 0, speed);
    t += dice.uniform(2, 4);
  }
}

/// A wall with one gap, which vehicles fill from before anything could be through it: a chain of
/// them across the way behind it, or a train that comes through it. In front of the wall, where
/// one would wait, others cross meanwhile.
void crossing_at_rest(Scenario& s, double d, Dice& dice) {
  s.region.x_min = -9;
  s.region.x_max = 9;
  const double gap = dice.uniform(-1, 1), half = dice.uniform(4.5, 5.5), y = dice.uniform(70, 100);
  for (const double side : {-1.0, 1.0}) add(s, gap + side * (half + 6), y, 6, 1.2);
  const double from = y / 22, to = y / kStartSpeed + dice.uniform(1, 2 + 3 * d);
  if (dice.sign() < 0) {
    const double side = dice.sign(), vx = side * dice.uniform(5, 8 + 4 * d), spacing = 8;
    for (double t = from; t < to; t += spacing / std::fabs(vx))
      add(s, gap - vx * t, y + 4.5, 2.4, 1, vx, 0);
  } else {
    const double vy = -dice.uniform(3, 4 + 2 * d), half_length = -vy * (to - from) / 2;
    add(s, gap, y - vy * (from + to) / 2, half - 2.2, half_length, 0, vy);
  }
  for (int k = count(1, 2, d); k > 0; --k) {
    const double side = dice.sign(), vx = side * dice.uniform(4, 6 + 6 * d);
    const double t = dice.uniform(from, to);
    add(s, gap - vx * t, y - dice.uniform(7, 20), 2.4, 1, vx, 0);
  }
}

}  // namespace

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
      {{"two_oncoming",
        "a narrow place, and two vehicles that come through it at up to 13 to 33 m/s"},
       two_oncoming},
      {{"overtaking",
        "a lane closed, and 1 to 4 vehicles from behind in the other at up to 24 to 33 m/s"},
       overtaking},
      {{"crossing_at_rest",
        "a wall whose gap is full for a while, and 1 or 2 vehicles across in front of it"},
       crossing_at_rest},
  };
  return list;
}

}  // namespace slalom::sweep
