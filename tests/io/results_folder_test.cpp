#include "slalom/io/results_folder.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "io/files.hpp"
#include "slalom/base/error.hpp"

namespace slalom::io {
namespace {

std::string refusal(const std::filesystem::path& folder, bool force) {
  try {
    const ResultsFolder held(folder, force);
  } catch (const Error& error) {
    return error.what();
  }
  return "held";
}

TEST(ResultsFolder, OneAtATimeWritesToIt) {
  const test::TemporaryFolder scratch;
  const auto folder = scratch / "out";
  std::optional<ResultsFolder> first(std::in_place, folder, false);
  for (const bool force : {false, true})
    EXPECT_NE(refusal(folder, force).find("another process writes its results there"),
              std::string::npos);
  EXPECT_EQ(refusal(scratch / "other", false), "held");
  test::write(folder / "summary.json", "{}");
  first.reset();
  EXPECT_NE(refusal(folder, false).find("holds results already"), std::string::npos);
  EXPECT_EQ(refusal(folder, true), "held");
  EXPECT_EQ(test::count(folder), 1u) << "nothing of the lock is left";
}

TEST(ResultsFolder, MovesWithItsHold) {
  const test::TemporaryFolder scratch;
  ResultsFolder one;
  one = ResultsFolder(scratch / "out", false);
  EXPECT_NE(refusal(scratch / "out", false), "held");
  one = ResultsFolder();
  EXPECT_EQ(refusal(scratch / "out", false), "held");
}

}  // namespace
}  // namespace slalom::io
