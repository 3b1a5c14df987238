#include "slalom/planner/vehicle_cycle.hpp"

#include <gtest/gtest.h>

#include "slalom/problems/run.hpp"

namespace slalom::planner {
namespace {

TEST(VehicleCycle, ComesToItsKnownValueByALocalAndAGlobalScheme) {
  const auto entry = vehicle_cycle();
  for (const char* scheme : {"hermite_simpson", "lgr"}) {
    const auto result = problems::run(entry, {.scheme = scheme});
    EXPECT_TRUE(result.agrees) << scheme << ": " << to_string(result.status) << ", " << result.value
                               << " for " << entry.reference();
  }
}

}  // namespace
}  // namespace slalom::planner
