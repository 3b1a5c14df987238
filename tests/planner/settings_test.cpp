#include "slalom/planner/settings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "slalom/base/error.hpp"
#include "slalom/nlp/solver.hpp"

namespace slalom::planner {
namespace {

TEST(Settings, EveryOptionHasAUnitADocAndADefaultWithinItsRange) {
  const Settings defaults;
  std::set<std::string> names;
  for (const auto& entry : setting_options().entries()) {
    EXPECT_TRUE(names.insert(entry.info.name).second) << entry.info.name << " registered twice";
    EXPECT_FALSE(entry.info.doc.empty()) << entry.info.name;
    const bool number =
        entry.info.kind == OptionKind::real || entry.info.kind == OptionKind::vector;
    EXPECT_TRUE(!number || !entry.info.unit.empty()) << entry.info.name;
    EXPECT_NO_THROW((void)entry.info.checked(entry.get(defaults), "defaults")) << entry.info.name;
  }
}

TEST(Settings, NoTwoOptionsShareAMember) {
  const auto& entries = setting_options().entries();
  for (const auto& entry : entries) {
    OptionValue value;
    if (entry.info.kind == OptionKind::real)
      value = 0.123456;
    else if (entry.info.kind == OptionKind::integer)
      value = std::int64_t{77};
    else if (entry.info.kind == OptionKind::choice)
      value = entry.info.choices.back();
    else if (entry.info.kind == OptionKind::vector)
      value = std::vector<double>(entry.info.length, 0.5432);
    else if (entry.info.kind == OptionKind::boolean)
      value = !std::get<bool>(entry.get(Settings{}));
    else
      value = std::string("another");
    Settings s;
    entry.set(s, value);
    for (const auto& other : entries)
      EXPECT_EQ(other.get(s), other.info.name == entry.info.name ? value : other.get(Settings{}))
          << other.info.name;
  }
}

TEST(Settings, ChoicesAreReadByName) {
  Settings s;
  const auto& table = setting_options();
  table.set(s, *table.find("scheme"), std::string("hermite_simpson"), "test");
  table.set(s, *table.find("wheel_load_cost"), std::string("shifted"), "test");
  EXPECT_EQ(s.scheme, SchemeChoice::hermite_simpson);
  EXPECT_EQ(s.wheel_load_cost, WheelLoadCost::shifted);
  EXPECT_THROW(table.set(s, *table.find("scheme"), std::string("euler"), "test"), InvalidValue);
}

std::string message(void (*change)(Settings&)) {
  Settings s;
  change(s);
  try {
    check(s, "P.yaml");
  } catch (const InvalidValue& e) {
    return e.what();
  }
  return "accepted";
}

TEST(Settings, ContradictionsAreRefusedWithPlaceAndRule) {
  EXPECT_EQ(message([](Settings&) {}), "accepted");
  EXPECT_EQ(message([](Settings& s) { s.floor = 0; }), "accepted");
  EXPECT_EQ(message([](Settings& s) { s.kappa = 50; }),
            "P.yaml: found L_range = 50, expected a number above kappa = 50");
  EXPECT_EQ(message([](Settings& s) { s.tf_min = 11; }),
            "P.yaml: found tf_min = 11, expected a number below tf_max = 10");
  EXPECT_EQ(message([](Settings& s) { s.N = 0; }),
            "P.yaml: found N = 0, expected a number >= 1 and <= 1000");
  EXPECT_NE(message([](Settings& s) { s.w_t = -1; }).find("w_t = -1"), std::string::npos);
  EXPECT_NE(message([](Settings& s) { s.X0_tol[3] = 0; }).find("X0_tol"), std::string::npos);
  EXPECT_NE(message([](Settings& s) {
              s.floor = std::numeric_limits<double>::quiet_NaN();
            }).find("floor = nan"),
            std::string::npos);
  EXPECT_NE(message([](Settings& s) {
              s.L_range = std::numeric_limits<double>::infinity();
            }).find("L_range = inf"),
            std::string::npos);
}

TEST(Settings, ASolverThatIsNotThereIsRefusedWithWhatToDo) {
  Settings settings;
  EXPECT_EQ(settings.solver, SolverChoice::interior_point);
  EXPECT_NO_THROW(check(settings, "my.yaml"));
  settings.solver = SolverChoice::ipopt;
  const auto have = nlp::backends();
  if (std::find(have.begin(), have.end(), "ipopt") != have.end()) {
    EXPECT_NO_THROW(check(settings, "my.yaml"));
    GTEST_SKIP() << "this machine has all solvers";
  }
  try {
    check(settings, "my.yaml");
    FAIL() << "accepted";
  } catch (const InvalidValue& e) {
    EXPECT_NE(std::string(e.what()).find("my.yaml: found solver = ipopt, expected interior_point: "
                                         "Ipopt's library (libipopt.so.1 or libipopt.so.3)"),
              std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace slalom::planner
