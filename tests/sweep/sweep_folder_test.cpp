#include "../../src/sweep/sweep_folder.hpp"

#include <gtest/gtest.h>

#include "../../src/sweep/sweep_files.hpp"
#include "../../src/sweep/trial_message.hpp"
#include "io/files.hpp"
#include "slalom/base/error.hpp"
#include "slalom/base/kernels.hpp"
#include "slalom/sweep/open_sweep.hpp"
#include "sweep/six_trials.hpp"

namespace slalom::sweep {
namespace {

namespace fs = std::filesystem;
using test::numbers;
using test::request_for;
using test::six_trials;
using test::TemporaryFolder;

constexpr const char* kMarks = "wheel_load speed";

/// Runs what waits of a shard; every trial "arrives", or fails.
void run(const TemporaryFolder& folder, bool arrives, int shard = 1, int shards = 1) {
  const auto study = six_trials();
  OpenSweep sweep(study, request_for(folder, shard, shards));
  TrialAnswer answer;
  answer.record.outcome = "goal";
  answer.record.marks = kMarks;
  while (const auto job = sweep.next()) {
    if (arrives)
      sweep.record(job->trial, to_line(answer));
    else
      sweep.record_failed(job->trial, "died");
  }
  sweep.finish();
}

std::string outcomes(const fs::path& folder) {
  std::string text;
  for (const auto& record : read_sweep(folder).trials) text += record.outcome + " ";
  return text;
}

constexpr const char* kArrived = "goal goal goal invalid goal invalid ";
constexpr const char* kFailed = "failed failed failed invalid failed invalid ";

TEST(Merge, OfTwoRecordsOfATrialThatWhichCameToAnEndCounts) {
  const TemporaryFolder failed, arrived, out;
  run(failed, false);
  run(arrived, true);
  EXPECT_EQ(merge_sweeps({failed.path()}, out.path(), false).trials, 6);
  EXPECT_EQ(outcomes(out.path()), kFailed);
  for (const bool first : {true, false}) {  // whichever comes first
    const auto& a = first ? failed : arrived;
    const auto& b = first ? arrived : failed;
    EXPECT_EQ(merge_sweeps({a.path(), b.path()}, out.path(), false).trials, 6);
    EXPECT_EQ(outcomes(out.path()), kArrived);
  }
  EXPECT_EQ(test::read(out / "trials.csv"), trials_csv(arrived.path()));
  merge_sweeps({failed.path(), arrived.path()}, failed.path(), false);
  EXPECT_EQ(outcomes(failed.path()), kArrived);
}

TEST(Merge, IntoAFolderOfShardsThatFailed) {
  const TemporaryFolder shards, arrived;
  for (const int shard : {1, 2}) run(shards, false, shard, 2);
  run(arrived, true);
  merge_sweeps({shards.path(), arrived.path()}, shards.path(), false);
  EXPECT_EQ(store_files(shards.path()).size(), 3U);
  EXPECT_EQ(outcomes(shards.path()), kArrived);
}

TEST(Merge, SaysOfAFolderWithoutASweepThatItIsBadInput) {
  const TemporaryFolder empty, out;
  EXPECT_THROW((void)merge_sweeps({empty.path()}, out / "m", false), InvalidValue);
  EXPECT_THROW((void)merge_sweeps({empty / "none"}, out / "m", false), InvalidValue);
  EXPECT_FALSE(fs::exists(out / "m"));
}

/// Files of a drive, with what a run at work has aside.
void write_drive(const fs::path& folder, const std::string& page) {
  fs::create_directories(folder / "figures");
  test::write(folder / "plant.csv", std::string(200'000, 'p'));
  test::write(folder / "figures/path.svg", "<svg/>");
  test::write(folder / ".plans.csv.00ff.aside", "half");
  if (!page.empty()) test::write(folder / "report.html", page);
}

TEST(CopyDrives, TakesWholeDrivesThatAreMissingAndNothingElse) {
  const TemporaryFolder from, out;
  write_drive(from / "drives/000001", "one");
  write_drive(from / "drives/000002", "");  // at work
  write_drive(from / "drives/notes", "mine");
  fs::create_symlink("gone", from / "drives/000001/vanished.csv");
  write_drive(from / "drives/000003", "other");
  write_drive(out / "drives/000003", "three");
  // As a copy that was killed leaves it.
  fs::create_directories(out / "drives/000001");
  test::write(out / "drives/000001/plant.csv", "pp");
  copy_drives(from.path(), out.path());
  EXPECT_EQ(test::count(out / "drives"), 2U);
  EXPECT_EQ(test::count(out / "drives/000001"), 3U);
  EXPECT_EQ(test::read(out / "drives/000001/plant.csv"), std::string(200'000, 'p'));
  EXPECT_EQ(test::read(out / "drives/000001/figures/path.svg"), "<svg/>");
  EXPECT_EQ(test::read(out / "drives/000001/report.html"), "one");
  EXPECT_EQ(test::read(out / "drives/000003/report.html"), "three");
  copy_drives(out.path(), out.path());
  copy_drives(from / "none", out.path());
  EXPECT_EQ(test::count(out / "drives"), 2U);
}

TEST(ClearSweep, TakesWhatASweepLeftAndNothingElse) {
  const TemporaryFolder folder;
  run(folder, true);
  write_drive(folder / "drives/000001", "one");
  write_drive(folder / "drives/notes", "mine");
  fs::create_directories(folder / "figures");
  for (const char* name : {"figures/map.svg", "index.html", "trials-wal", "trials.sqlite-wal",
                           "figures/mine.png", "trials-old.sqlite", "trials.sqlite.bak",
                           "trials-2-of-1.sqlite", "trials-01-of-2.sqlite", "my.lock"})
    test::write(folder / name, "x");
  EXPECT_EQ(foreign_entry(folder.path(), OtherFiles::pass), "");
  clear_sweep(folder.path());
  EXPECT_EQ(foreign_entry(folder.path(), OtherFiles::pass), "drives");
  for (const char* name :
       {"drives/notes/plant.csv", "figures/mine.png", "trials-old.sqlite", "trials.sqlite.bak",
        "trials-2-of-1.sqlite", "trials-01-of-2.sqlite", "my.lock", "trials-wal"})
    EXPECT_TRUE(fs::exists(folder / name)) << name;
  for (const char* name : {"drives/000001", "figures/map.svg", "index.html", "trials.csv",
                           "trials.sqlite", "trials.sqlite-wal"})
    EXPECT_FALSE(fs::exists(folder / name)) << name;
}

TEST(ClearSweep, LeavesAFolderWithoutAStoreAsItIs) {
  const TemporaryFolder folder;
  write_drive(folder / "drives/000001", "one");
  test::write(folder / "index.html", "mine");
  clear_sweep(folder.path());
  EXPECT_TRUE(fs::exists(folder / "index.html"));
  EXPECT_TRUE(fs::exists(folder / "drives/000001/report.html"));
  const auto study = six_trials();
  auto request = request_for(folder);
  for (const bool force : {false, true}) {
    request.force = force;
    EXPECT_THROW(OpenSweep(study, request), Error);
    EXPECT_EQ(test::read(folder / "index.html"), "mine");
  }
}

TEST(Force, OfOneShardLeavesTheFinishedTrialsOfOthersOfItsStudy) {
  const TemporaryFolder folder;
  for (const int shard : {1, 2}) run(folder, true, shard, 2);
  for (const int trial : {1, 2}) write_drive(drive_folder(folder.path(), trial), "kept");
  write_drive(folder / "drives/000002x", "mine");  // no trial's, whatever its number begins with
  const auto study = six_trials();
  auto request = request_for(folder, 2, 2);
  request.force = true;
  {
    const OpenSweep sweep(study, request);
    EXPECT_EQ(numbers(read_sweep(folder.path())), (std::vector<std::int64_t>{1, 3, 5}));
  }
  EXPECT_TRUE(fs::exists(folder / "drives/000001/report.html"));
  EXPECT_FALSE(fs::exists(folder / "drives/000002"));
  EXPECT_TRUE(fs::exists(folder / "drives/000002x"));
  // Of another study all goes, by a shard too.
  const auto other = test::study_from("scenario: E_B\n");
  request.shard = 1;
  const OpenSweep sweep(other, request);
  EXPECT_EQ(store_files(folder.path()).size(), 1U);
  EXPECT_TRUE(read_sweep(folder.path()).trials.empty());
}

TEST(Store, OfTheFormatBeforeIsReadAndGoneOnWith) {
  const TemporaryFolder folder;
  run(folder, true, 1, 2);
  fs::rename(folder / "trials-1-of-2.sqlite", folder / "trials.sqlite");
  Database(folder / "trials.sqlite", Database::Mode::write)
      .execute("ALTER TABLE study DROP COLUMN stated; UPDATE study SET format = 4");
  EXPECT_EQ(outcomes(folder.path()), "goal goal goal ");
  run(folder, true);
  EXPECT_EQ(outcomes(folder.path()), kArrived);
}

TEST(Store, WithoutMarksIsReadMergedAndGoneOnWith) {
  const TemporaryFolder folder, out;
  run(folder, true, 1, 2);
  fs::rename(folder / "trials-1-of-2.sqlite", folder / "trials.sqlite");
  Database(folder / "trials.sqlite", Database::Mode::write)
      .execute("ALTER TABLE trials DROP COLUMN marks");
  EXPECT_EQ(outcomes(folder.path()), "goal goal goal ");
  EXPECT_EQ(merge_sweeps({folder.path()}, out.path(), false).trials, 3);
  run(folder, true);
  EXPECT_EQ(outcomes(folder.path()), kArrived);
  const auto trials = read_sweep(folder.path()).trials;
  EXPECT_EQ(trials[0].marks, "");
  EXPECT_EQ(trials[1].marks, kMarks);
}

TEST(TrialRecord, HasTheKindsOfTheDrivesMarks) {
  const sim::Scenario scenario;
  sim::Drive drive;
  drive.plant.resize(1);
  drive.plant[0].state = scenario.start;
  drive.plant[0].wheel_loads.fill(scenario.vehicle.Fz_min);
  EXPECT_EQ(record_of(scenario, drive).marks, "");
  drive.plant[0].wheel_loads[2] -= 1000;
  drive.plant[0].state[vehicle::UX] = 100;
  EXPECT_EQ(record_of(scenario, drive).marks, "wheel_load speed");
}

TEST(CheckKernels, RefusesTheSetsThatThisProcessorLacks) {
  for (const auto set : kKernelSets) {
    const std::string name = to_string(set);
    if (has_kernels(set)) {
      EXPECT_NO_THROW(check_kernels(name));
    } else {
      EXPECT_THROW(check_kernels(name), InvalidValue) << name;
    }
  }
}

}  // namespace
}  // namespace slalom::sweep
