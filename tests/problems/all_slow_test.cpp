#include <gtest/gtest.h>

#include <string>

#include "slalom/problems/run.hpp"

namespace slalom::problems {
namespace {

/// Every problem, refined, from its plain guess with default options, to its known value.
TEST(AllProblems, ComeToTheirKnownValuesByALocalAndAGlobalScheme) {
  for (const auto& entry : library())
    for (const char* scheme : {"hermite_simpson", "lgr"}) {
      const auto result = run(entry, {.scheme = scheme});
      EXPECT_TRUE(result.agrees) << entry.name << " by " << scheme << ": "
                                 << to_string(result.status) << ", " << result.value << " for "
                                 << entry.reference();
    }
}

}  // namespace
}  // namespace slalom::problems
