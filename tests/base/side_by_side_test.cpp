#include "../../src/base/side_by_side.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>

#include "support/sanitized.hpp"

namespace slalom {
namespace {

constexpr std::size_t kPieces = 5000;
constexpr int kThreads = 4000;

/// Does the pieces where there is room for a few threads' stacks alone; ends the process.
[[noreturn]] void run_in_little_memory() {
  rlimit room{};
  room.rlim_cur = room.rlim_max = rlim_t{1} << 30U;
  if (setrlimit(RLIMIT_AS, &room) != 0) std::exit(3);
  std::atomic<std::size_t> done = 0;
  SideBySide pieces("pieces", kPieces, kThreads, {});
  pieces.run([&]() -> SideBySide::Worker { return [&](std::size_t) { ++done; }; });
  std::exit(done == kPieces ? 0 : 4);
}

TEST(SideBySide, DoesAllPiecesOnTheThreadsThatThereAre) {
  if (kSanitized) GTEST_SKIP() << "sanitizers need more memory than the test leaves";
  EXPECT_EXIT(run_in_little_memory(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace slalom
