#include "../../src/sim/rehearsal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/fakes.hpp"

namespace slalom::sim {
namespace {

using vehicle::ControlSignal;
using vehicle::Plant;
using vehicle::State;

const State kStart = {3, 4, 0.1, 0.05, 1.5, 0.02, 17, 0.3};

ControlSignal signal(double jerk = 1) {
  return ControlSignal({0, 0.11, 0.4}, {{0.02, jerk}, {-0.05, 0.5}, {0, 0}});
}

struct Rehearsed {
  Plant plant{testing::open_field().vehicle, 1e-9, 0.02};
  Rehearsal rehearsal;
  State end = rehearsal.predict(plant, kStart, signal(), 0, 0.3);
};

TEST(Rehearsal, PredictsAsThePlantAndKnowsItsSteps) {
  Rehearsed r;
  EXPECT_EQ(r.end, r.plant.predict(kStart, signal(), 0, 0.3));
  State state = kStart;
  double t = 0;
  for (const double t1 : r.plant.instants(signal(), 0, 0.3)) {
    const auto known = r.rehearsal.end_of(state, signal(), t, t1);
    ASSERT_TRUE(known) << t1;
    EXPECT_EQ(*known, r.plant.advance(state, signal(), t, t1));
    state = *known;
    t = t1;
  }
  EXPECT_EQ(state, r.end);
  EXPECT_FALSE(r.rehearsal.end_of(state, signal(), t, t + 0.02)) << "beyond the prediction";
}

TEST(Rehearsal, KnowsNothingOfWhatDiffersInTheLastBit) {
  Rehearsed r;
  const double t1 = r.plant.instants(signal(), 0, 0.3).front();
  const auto more = [](double x) { return std::nextafter(x, 1e9); };
  for (std::size_t i = 0; i < kStart.size(); ++i) {
    State other = kStart;
    other[i] = more(other[i]);
    EXPECT_FALSE(r.rehearsal.end_of(other, signal(), 0, t1)) << i;
  }
  EXPECT_FALSE(r.rehearsal.end_of(kStart, signal(more(1)), 0, t1));
  EXPECT_FALSE(r.rehearsal.end_of(kStart, signal(), 0, more(t1)));
  EXPECT_FALSE(r.rehearsal.end_of(kStart, signal(), std::numeric_limits<double>::min(), t1));
  EXPECT_TRUE(r.rehearsal.end_of(kStart, signal(), 0, t1)) << "and goes on where it was";
  r.rehearsal.begin_anew();
  EXPECT_FALSE(r.rehearsal.end_of(kStart, signal(), 0, t1));
}

TEST(Rehearsal, OfAnotherVehicleIsNotDriven) {
  Scenario s = testing::open_field();
  s.vehicle.tyre_asymmetry = true;
  s.loop.tex = 0.5;
  const Drive believed = drive(s, testing::wavy);
  s.plant.mass_factor = 1.2;
  const Drive heavier = drive(s, testing::wavy);
  EXPECT_NE(believed.plant.back().state, heavier.plant.back().state);
  EXPECT_TRUE(is_as_believed({}));
  EXPECT_FALSE(is_as_believed(s.plant));
}

}  // namespace
}  // namespace slalom::sim
