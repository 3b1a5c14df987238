#include "slalom/vehicle/plausible.hpp"

#include <gtest/gtest.h>

#include "slalom/vehicle/derived.hpp"

namespace slalom::vehicle {
namespace {

template <class Change>
std::string all(const Change& change) {
  Parameters p;
  change(p);
  std::string text;
  for (const auto& sentence : implausible(p)) text += sentence + "\n";
  return text;
}

TEST(Plausible, NothingOfTheHmmwvAndOfACarByItsDataSheet) {
  EXPECT_EQ(all([](auto&) {}), "");
  EXPECT_EQ(all([](auto& p) {
              p.m = 1350;
              p.Izz = 2100;
              p.la = 1.1;
              p.lb = 1.5;
              p.h = 0.55;
              derive(p, {"m", "Izz", "la", "lb", "h"});
            }),
            "");
}

TEST(Plausible, EachThingByItself) {
  const auto expect = [](const std::string& part, auto change) {
    const auto text = all(change);
    EXPECT_NE(text.find(part), std::string::npos) << part << " in:\n" << text;
  };
  expect("FzF0 + FzR0 = 26376 N are not the weight m g = 29420 N", [](auto& p) { p.m = 3000; });
  expect("front axle is FzF0 = 9000 N", [](auto& p) {
    p.FzF0 = 9000;
    p.FzR0 = 17367;
  });
  expect("Fz_min = 7000 N is not below", [](auto& p) { p.Fz_min = 7000; });
  expect("KZX (la + lb) = 1981 kg m, but m h = 2661", [](auto& p) { p.KZX = 600; });
  expect("(KZYF + KZYR) track = 1635 kg m", [](auto& p) { p.KZYR = 401; });
  expect("the body ends 0.20 m short in front of an axle",
         [](auto& p) { p.front_overhang = -0.2; });
  expect("the body ends 0.35 m ahead of an axle", [](auto& p) { p.front_overhang = 1.648; });
  expect("less than the track of 1.52 m", [](auto& p) { p.width = 1.4; });
  expect("Izz is 0.14 times m la lb", [](auto& p) { p.Izz = 1000; });
  expect("lateral friction (PDY1, PDY2) is 3.", [](auto& p) { p.PDY1 = 3; });
  expect("longitudinal friction is PDX1 = 2", [](auto& p) { p.PDX1 = 2; });
  expect("ax_max is up to 7.0 m/s^2, but driving takes all friction of an axle (PDX1, drive_front)",
         [](auto& p) {
           p.ax_max = {0, 0, 0, 7};
         });
  expect("-ax_min is up to 9.0 m/s^2, but braking", [](auto& p) { p.ax_min = {0, 0, 0, -9}; });
  expect("PKY1 is not negative", [](auto& p) { p.PKY1 = 10; });
  expect("it spins by itself", [](auto& p) {
    p.la = 2.2;
    p.lb = 1.1;
  });
  expect("pulls to a side: ", [](auto& p) { p.F_offset_front = 1000; });
}

/// Limits beyond friction are within it where friction_share holds them.
TEST(Plausible, FrictionShareKeepsAccelerationsWithin) {
  EXPECT_EQ(all([](auto& p) {
              p.ax_max = {0, 0, 0, 12};
              p.ax_min = {0, 0, 0, -12};
              p.friction_share = 0.9;
            }),
            "");
}

}  // namespace
}  // namespace slalom::vehicle
