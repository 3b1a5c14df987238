#include "slalom/sweep/worker_pool.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "io/files.hpp"
#include "slalom/base/error.hpp"

namespace slalom::sweep {
namespace {

/// A worker in shell: answers "ok N", crashes on "crash", hangs on "hang", leaves on "leave".
PoolSettings shell(int workers) {
  PoolSettings settings;
  settings.command = {"/bin/sh", "-c",
                      "echo ready; while read -r line; do case \"$line\" in "
                      "crash) echo oh dear >&2; kill -SEGV $$;; hang) sleep 1000;; "
                      "KILL|TERM|INT|HUP|QUIT) kill -s $line $$; sleep 1000;; "
                      "leave) echo enough >&2; exit 7;; *) echo \"ok $line\";; esac; done"};
  settings.workers = workers;
  settings.retries = 1;
  settings.time_limit = 30;
  return settings;
}

/// Runs jobs and gathers what became of them.
struct PoolRun {
  std::map<std::int64_t, std::string> done, failed;
  std::map<std::int64_t, int> attempts;
  std::set<std::int64_t> left;
  std::set<int> processes;
  bool finished = false;

  PoolRun(const PoolSettings& settings, const std::vector<std::string>& jobs,
          const std::function<bool(const PoolRun&)>& interrupted = {}) {
    std::size_t next = 0;
    PoolHooks hooks;
    hooks.next = [&]() -> std::optional<PoolJob> {
      if (next == jobs.size()) return std::nullopt;
      const auto id = static_cast<std::int64_t>(next);
      return PoolJob{id, jobs[next++]};
    };
    hooks.started = [&](std::int64_t id, int process, int) {
      ++attempts[id];
      processes.insert(process);
    };
    hooks.done = [&](std::int64_t id, const std::string& answer) {
      EXPECT_TRUE(done.emplace(id, answer).second) << "answered twice";
    };
    hooks.failed = [&](std::int64_t id, const std::string& reason) {
      EXPECT_TRUE(failed.emplace(id, reason).second) << "failed twice";
    };
    hooks.left = [&](std::int64_t id) { EXPECT_TRUE(left.insert(id).second) << "left twice"; };
    if (interrupted) hooks.interrupted = [&, interrupted] { return interrupted(*this); };
    finished = run_pool(settings, hooks);
  }
};

std::vector<std::string> numbers(int count) {
  std::vector<std::string> jobs;
  for (int i = 0; i < count; ++i) jobs.push_back(std::to_string(i));
  return jobs;
}

TEST(WorkerPool, EveryJobIsAnsweredOnce) {
  for (const int workers : {1, 3}) {
    const PoolRun run(shell(workers), numbers(200));
    EXPECT_TRUE(run.finished);
    ASSERT_EQ(run.done.size(), 200U);
    for (const auto& [id, answer] : run.done) EXPECT_EQ(answer, "ok " + std::to_string(id));
    // A worker that is slow to start may find nothing left to do.
    EXPECT_LE(run.processes.size(), static_cast<std::size_t>(workers));
    EXPECT_GE(run.processes.size(), 1U);
    EXPECT_TRUE(run.failed.empty());
  }
}

TEST(WorkerPool, NoJobsNeedNoWorkers) {
  const PoolRun run(shell(2), {});
  EXPECT_TRUE(run.finished);
  EXPECT_TRUE(run.processes.empty());
}

TEST(WorkerPool, AWorkerThatDiesCostsItsJobOnly) {
  const PoolRun run(shell(2), {"a", "crash", "b", "leave", "c"});
  EXPECT_TRUE(run.finished);
  EXPECT_EQ(run.done, (std::map<std::int64_t, std::string>{{0, "ok a"}, {2, "ok b"}, {4, "ok c"}}));
  ASSERT_EQ(run.failed.size(), 2U);
  EXPECT_EQ(run.failed.at(1),
            "2 attempts; the last: the worker was killed by signal 11 (Segmentation fault): "
            "oh dear");
  EXPECT_EQ(run.failed.at(3), "2 attempts; the last: the worker ended with exit code 7: enough");
  for (const std::int64_t id : {1, 3}) EXPECT_EQ(run.attempts.at(id), 2);
}

// The short limit is for jobs that hang alone: another might take as long on a busy machine.
TEST(WorkerPool, AWorkerThatHangsCostsItsJobOnly) {
  auto settings = shell(1);
  settings.time_limit = 0.5;
  const PoolRun run(settings, {"hang", "hang"});
  EXPECT_TRUE(run.finished);
  for (const std::int64_t id : {0, 1}) {
    EXPECT_EQ(run.failed.at(id), "2 attempts; the last: no answer within 0.5 s");
    EXPECT_EQ(run.attempts.at(id), 2);
  }
}

TEST(WorkerPool, AKillByOthersIsNoFailure) {
  const PoolRun run(shell(2), {"a", "KILL", "b", "TERM", "INT", "HUP", "QUIT", "c"});
  EXPECT_TRUE(run.finished);
  EXPECT_EQ(run.done.size(), 3U);
  EXPECT_TRUE(run.failed.empty());
  EXPECT_EQ(run.left, (std::set<std::int64_t>{1, 3, 4, 5, 6}));
  for (const std::int64_t id : run.left) EXPECT_EQ(run.attempts.at(id), 2);
}

/// A worker that ends by the signals of a job, one for each attempt: "SEGV KILL SEGV".
PoolSettings by_turns(const test::TemporaryFolder& folder) {
  auto settings = shell(1);
  settings.command[2] = "cd " + folder.path().string() +
                        "; echo ready; read -r line; echo >> tries; set -- $line; "
                        "shift $(($(wc -l < tries) - 1)); kill -s $1 $$; sleep 1000";
  return settings;
}

TEST(WorkerPool, KillsByOthersDoNotCountAgainstAJobNorItsFaultsAmongTheKills) {
  {
    const test::TemporaryFolder folder;
    const PoolRun run(by_turns(folder), {"KILL SEGV SEGV"});
    EXPECT_EQ(run.attempts.at(0), 3);
    EXPECT_EQ(run.failed.at(0),
              "2 attempts; the last: the worker was killed by signal 11 (Segmentation fault)");
  }
  const test::TemporaryFolder folder;
  const PoolRun run(by_turns(folder), {"SEGV KILL KILL"});
  EXPECT_EQ(run.attempts.at(0), 3);
  EXPECT_EQ(run.left, std::set<std::int64_t>{0});
  EXPECT_TRUE(run.failed.empty());
}

TEST(WorkerPool, AsksAgainWhereWhatIsNextIsNotKnownYet) {
  for (const int workers : {1, 3}) {
    int asked = 0;
    std::set<std::int64_t> done;
    PoolHooks hooks;
    hooks.next = [&]() -> std::optional<PoolJob> {
      ++asked;
      if (asked > 60) return std::nullopt;
      return asked % 3 == 0 ? PoolJob{asked, "job"} : PoolJob{};
    };
    hooks.done = [&](std::int64_t id, const std::string&) { done.insert(id); };
    EXPECT_TRUE(run_pool(shell(workers), hooks));
    EXPECT_EQ(done.size(), 20U);
    EXPECT_EQ(asked, 61);
    asked = 0;
    hooks.next = [] { return PoolJob{}; };
    hooks.interrupted = [&] { return ++asked > 5; };
    EXPECT_FALSE(run_pool(shell(workers), hooks));
  }
}

TEST(WorkerPool, LongLinesPassWhole) {
  const std::string line(3 << 20, 'x');
  auto settings = shell(1);
  settings.time_limit = 60;
  settings.command = {"/bin/sh", "-c", "echo ready; exec cat"};
  const PoolRun run(settings, {line, "y"});
  EXPECT_EQ(run.done.at(0), line);
  EXPECT_EQ(run.done.at(1), "y");
}

TEST(WorkerPool, AnInterruptionEndsItAtOnce) {
  auto settings = shell(2);
  settings.time_limit = 600;
  const PoolRun run(settings, {"a", "hang", "hang", "b"},
                    [](const PoolRun& so_far) { return so_far.attempts.size() == 3; });
  EXPECT_FALSE(run.finished);
  EXPECT_EQ(run.done.count(3), 0U);
  EXPECT_TRUE(run.failed.empty());
}

TEST(WorkerPool, AnErrorInAHookPassesOn) {
  PoolHooks hooks;
  hooks.next = [] { return PoolJob{1, "x"}; };
  hooks.done = [](std::int64_t, const std::string&) { throw Error("disk full"); };
  EXPECT_THROW((void)run_pool(shell(2), hooks), Error);
}

TEST(WorkerPool, WorkersThatCannotStartAreNoFaultOfTheJobs) {
  for (const char* program : {"/nonexistent", "/bin/false"}) {
    auto settings = shell(2);
    settings.command = {program};
    try {
      const PoolRun run(settings, numbers(5));
      FAIL() << "no error";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("workers do not start"), std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace slalom::sweep
