#include "slalom/base/timer.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace slalom {
namespace {

TEST(Timer, WallClockRunsWhileAsleepAndProcessorTimeDoesNot) {
  const Timer timer;
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  EXPECT_GE(timer.wall(), 0.06);
  EXPECT_LT(timer.cpu(), timer.wall() / 2);
}

TEST(Timer, ProcessorTimeGrowsWithWorkOfThisThreadAlone) {
  const Timer timer;
  const auto burn = [] {
    const Timer own;
    while (own.cpu() < 0.2) {
    }
  };
  std::thread(burn).join();
  EXPECT_LT(timer.cpu(), 0.1) << "another thread's time is not ours";
  burn();
  EXPECT_GE(timer.cpu(), 0.2);
  EXPECT_LE(timer.cpu(), timer.wall() + 0.02);
}

TEST(Timer, NeverRunsBackwards) {
  const Timer timer;
  double cpu = 0, wall = 0;
  for (int i = 0; i < 1000; ++i) {
    const double c = timer.cpu(), w = timer.wall();
    ASSERT_GE(c, cpu);
    ASSERT_GE(w, wall);
    cpu = c;
    wall = w;
  }
}

}  // namespace
}  // namespace slalom
