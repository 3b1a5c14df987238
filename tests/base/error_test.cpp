#include "slalom/base/error.hpp"

#include <gtest/gtest.h>

namespace slalom {
namespace {

TEST(InvalidValue, SaysWhereWhatAndTheRule) {
  const InvalidValue error("E_C.yaml:12:3", "radius = -1", "a number > 0");
  EXPECT_STREQ(error.what(), "E_C.yaml:12:3: found radius = -1, expected a number > 0");
  EXPECT_EQ(error.where(), "E_C.yaml:12:3");
  EXPECT_EQ(error.found(), "radius = -1");
  EXPECT_EQ(error.expected(), "a number > 0");
}

TEST(InvalidValue, KeysCountFromTheOutermostPart) {
  EXPECT_TRUE(InvalidValue("a", "b", "c").keys().empty());
  try {
    check_within("scene", [] {
      check_within("goal", [] { throw InvalidValue("a", "b", "c", {"x", "sigma"}); });
    });
    FAIL() << "nothing thrown";
  } catch (const InvalidValue& error) {
    EXPECT_EQ(error.keys(), (std::vector<std::string>{"scene.goal.x", "scene.goal.sigma"}));
    EXPECT_STREQ(error.what(), "a: found b, expected c");
  }
}

TEST(InvalidValue, IsAnErrorAndARuntimeError) {
  EXPECT_THROW(throw InvalidValue("a", "b", "c"), Error);
  EXPECT_THROW(throw Error("text"), std::runtime_error);
}

}  // namespace
}  // namespace slalom
