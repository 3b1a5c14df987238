#include "slalom/sweep/open_sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "../../src/sweep/trial_message.hpp"
#include "io/files.hpp"
#include "slalom/base/error.hpp"
#include "sweep/six_trials.hpp"

namespace slalom::sweep {
namespace {

using test::numbers;
using test::request_for;
using test::six_trials;
using test::study_from;
using test::TemporaryFolder;

TEST(OpenSweep, HandsOutWhatWaitsAndRecordsWhatContradictsItself) {
  const TemporaryFolder folder;
  const auto study = six_trials();
  std::vector<std::int64_t> given;
  {
    OpenSweep sweep(study, request_for(folder));
    while (const auto job = sweep.next()) given.push_back(job->trial);
    EXPECT_EQ(given, (std::vector<std::int64_t>{1, 2, 3, 5}));
    EXPECT_EQ(sweep.summary().done, 2);
    sweep.record_failed(2, "died");
    EXPECT_EQ(sweep.summary().failed, 3);
    EXPECT_EQ(sweep.summary().pending, 3);
  }
  const auto table = read_sweep(folder.path());
  EXPECT_EQ(numbers(table), (std::vector<std::int64_t>{2, 4, 6}));
  EXPECT_EQ(table.trials[0].message, "died");
  EXPECT_EQ(table.trials[0].scenario, "E_B");
  EXPECT_EQ(table.trials[0].identity.size(), 32U);
  EXPECT_EQ(table.trials[1].outcome, "invalid");
  // What was handed out and not recorded waits again.
  OpenSweep again(study, request_for(folder));
  EXPECT_EQ(again.summary().before, 3);
  given.clear();
  while (const auto job = again.next()) given.push_back(job->trial);
  EXPECT_EQ(given, (std::vector<std::int64_t>{1, 3, 5}));
}

TEST(OpenSweep, BetweenManyThatContradictThemselvesItsCallerMayDoSomethingElse) {
  const TemporaryFolder folder;
  const auto study = study_from(
      "scenario: E_B\nset: {planner.tf_max: 8}\naxes:\n"
      "  - {key: loop.tex, range: {from: 9, to: 9.5, count: 250}}\n");
  OpenSweep sweep(study, request_for(folder));
  for (const std::int64_t done : {100, 200}) {
    const auto job = sweep.next();
    ASSERT_TRUE(job);
    EXPECT_EQ(job->trial, 0);
    EXPECT_EQ(sweep.summary().done, done);
  }
  EXPECT_FALSE(sweep.next());
  EXPECT_EQ(sweep.summary().done, 250);
}

TEST(OpenSweep, KeepsToItsLimitAndItsShard) {
  const TemporaryFolder folder;
  const auto study = six_trials();
  auto request = request_for(folder, 2, 3);
  request.limit = 1;
  {
    OpenSweep sweep(study, request);
    EXPECT_EQ(sweep.summary().total, 2);
    EXPECT_EQ(sweep.next()->trial, 2);
    EXPECT_FALSE(sweep.next());
    EXPECT_THROW(OpenSweep(study, request), Error);  // one at a time
  }
  EXPECT_NO_THROW(OpenSweep(study, request));
}

TEST(OpenSweep, TheTableOfAllStoresIsInOrderAndHasEachTrialOnce) {
  const TemporaryFolder folder;
  const auto study = six_trials();
  for (int shard : {2, 1}) {
    OpenSweep sweep(study, request_for(folder, shard, 2));
    while (const auto job = sweep.next()) sweep.record_failed(job->trial, "shard");
    sweep.finish();
  }
  EXPECT_EQ(numbers(read_sweep(folder.path())), (std::vector<std::int64_t>{1, 2, 3, 4, 5, 6}));
  const auto text = test::read(folder / "trials.csv");
  EXPECT_EQ(text, trials_csv(folder.path()));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 7);
  // Merged into itself, and with a folder that overlaps: nothing is doubled, nothing lost.
  const TemporaryFolder other;
  {
    OpenSweep sweep(study, request_for(other));
    sweep.record_failed(sweep.next()->trial, "other");
  }
  for (const bool force : {false, true}) {
    const auto merged = merge_sweeps({folder.path(), other.path()}, folder.path(), force);
    EXPECT_EQ(merged.trials, 6);
    EXPECT_EQ(test::read(folder / "trials.csv"), text);
  }
}

TEST(OpenSweep, WhatIsNoAnswerIsNotRecorded) {
  const TemporaryFolder folder;
  const auto study = six_trials();
  OpenSweep sweep(study, request_for(folder));
  const auto job = sweep.next();
  auto figures = to_line(TrialAnswer{});
  for (const std::string& line : {std::string(), std::string("no answer at all"), std::string("{}"),
                                  std::string("[1]"), std::string("{\"not_written\": 1}"), figures})
    EXPECT_THROW(sweep.record(job->trial, line), Error) << line;
  TrialAnswer negative;
  negative.record.outcome = "goal";
  negative.record.cycles = -1;
  EXPECT_THROW(sweep.record(job->trial, to_line(negative)), Error);
  EXPECT_EQ(sweep.summary().done, 0);
}

}  // namespace
}  // namespace slalom::sweep
