// Work in turns: it stops where its turn ends, and goes on from there.

#include "../../src/planner/turns.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace slalom::planner {
namespace {

TEST(TurnsInThreads, WorkStopsWhereItsTurnEndsAndGoesOnFromThere) {
  Turns turns;
  std::vector<int> done;
  turns.begin([&] {
    for (int k = 0; k < 7 && !turns.spend(1); ++k) done.push_back(k);
  });
  EXPECT_TRUE(done.empty()) << "nothing is done before the first turn";
  turns.go_on({3});
  EXPECT_EQ(done, (std::vector{0, 1}));
  turns.go_on({3});
  EXPECT_EQ(done, (std::vector{0, 1, 2, 3, 4}));
  EXPECT_TRUE(turns.under_way());
  turns.go_on({});
  EXPECT_EQ(done.size(), 7U);
  EXPECT_FALSE(turns.under_way());
  turns.go_on({});
  EXPECT_EQ(done.size(), 7U) << "what is done is not done again";
  EXPECT_EQ(turns.work(), 7);
}

TEST(TurnsInThreads, WhatBeginsAnewTakesThePlaceOfWhatWasUnderWay) {
  Turns turns;
  bool ended = false, told = false;
  turns.begin([&] {
    told = turns.spend(1);
    ended = true;
  });
  turns.go_on({1});
  EXPECT_FALSE(ended);
  int other = 0;
  turns.begin([&] { ++other; });
  EXPECT_TRUE(told && ended) << "it was told to end, and did";
  EXPECT_EQ(other, 0);
  turns.go_on({});
  EXPECT_EQ(other, 1);
}

TEST(TurnsInThreads, WorkUnderWayEndsWithItsOwner) {
  int spent = 0;
  {
    Turns turns, never;
    turns.begin([&] {
      while (!turns.spend(1)) ++spent;
    });
    never.begin([&] { spent = -1000; });
    turns.go_on({5});
  }
  EXPECT_EQ(spent, 4);
}

TEST(TurnsInThreads, AnExceptionIsTheOwners) {
  Turns turns;
  turns.begin([&] {
    turns.spend(1);
    throw std::runtime_error("no");
  });
  EXPECT_NO_THROW(turns.go_on({1}));
  EXPECT_THROW(turns.go_on({1}), std::runtime_error);
  EXPECT_FALSE(turns.under_way());
  EXPECT_NO_THROW(turns.go_on({1}));
}

TEST(TurnsInThreads, WhatNeedsMoreTimeWaitsForATurnThatHasIt) {
  Turns turns;
  std::vector<bool> had;
  turns.begin([&] {
    had.push_back(turns.wait_for(10));
    had.push_back(turns.wait_for(10));
  });
  turns.go_on({1e9, 1});
  EXPECT_TRUE(had.empty());
  EXPECT_TRUE(turns.wants_more());
  turns.go_on({1e9, 100});
  EXPECT_EQ(had, (std::vector{true, true}));
  EXPECT_FALSE(turns.wants_more());
  turns.begin([&] { had.push_back(turns.wait_for(10)); });
  turns.go_on({1e9, 1});
  turns.go_on({1e9, 2});
  EXPECT_FALSE(had.back()) << "it waits once";
  EXPECT_GE(turns.cpu_s(), 0);
}

TEST(TurnsInThreads, ATurnEndsWhenItsTimeIsUp) {
  Turns turns;
  int rounds = 0;
  turns.begin([&] {
    while (!turns.spend(0)) ++rounds;
  });
  turns.go_on({1, 0.002});
  EXPECT_TRUE(turns.under_way());
  EXPECT_GT(rounds, 0);
  EXPECT_LT(turns.cpu_s(), 1);
}

}  // namespace
}  // namespace slalom::planner
