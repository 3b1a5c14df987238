#include "../../src/io/number.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../../src/io/csv.hpp"
#include "io/files.hpp"
#include "slalom/base/error.hpp"
#include "slalom/io/scenario_file.hpp"

namespace slalom::io {
namespace {

constexpr double kInfinity = HUGE_VAL;

struct Spelling {
  const char* text;
  std::optional<double> number;
};

const Spelling kSpellings[] = {{"5", 5},
                               {"+5", 5},
                               {"-5", -5},
                               {".5", 0.5},
                               {"5.", 5},
                               {"-0", -0.0},
                               {"5e-1", 0.5},
                               {"+1E+2", 100},
                               {"1e400", kInfinity},
                               {"-1e400", -kInfinity},
                               {"1e-400", 0},
                               {"-1e-400", -0.0},
                               {"1e-99999999999999999999", 0},
                               {"1e99999999999999999999", kInfinity},
                               {"0.000001e-320", 0},
                               {"1000000e305", kInfinity},
                               {"0e999", 0},
                               {".inf", kInfinity},
                               {"-.Inf", -kInfinity},
                               {"9007199254740993", 9007199254740992.0},
                               {"", {}},
                               {"+", {}},
                               {"-", {}},
                               {"+-5", {}},
                               {"-+5", {}},
                               {"--5", {}},
                               {"++5", {}},
                               {"5 ", {}},
                               {"0x10", {}},
                               {"1,5", {}},
                               {"1_000", {}},
                               {"5m", {}},
                               {"e5", {}},
                               {"soon", {}}};

/// By a setting of a scenario, infinite ones and what is none refused.
std::optional<double> by_setting(const std::string& text) {
  try {
    return parse_scenario("start: {x: " + text + ", y: 0}\ngoal: {x: 0, y: 100}\n", "text")
        .start[vehicle::X];
  } catch (const InvalidValue&) {
    return std::nullopt;
  }
}

/// By a column of a road's file.
std::optional<double> by_table(const std::string& text) {
  const test::TemporaryFolder folder;
  test::write(folder / "road.csv",
              "x_m,y_m,w_tr_right_m,w_tr_left_m\n" + text + ",-2000,5,5\n0,90,5,5\n0,200,5,5\n");
  try {
    const auto scenario =
        parse_scenario("start: {x: 0, y: 100}\ngoal: {x: 0, y: 150}\nroad: {file: " +
                           (folder / "road.csv").string() + "}\n",
                       "text");
    return scenario.road->points().front().x;
  } catch (const InvalidValue& error) {
    EXPECT_NE(std::string(error.what()).find("finite number"), std::string::npos) << error.what();
    return std::nullopt;
  }
}

TEST(Number, IsReadByOneRuleWhereverItStands) {
  for (const auto& [text, number] : kSpellings) {
    SCOPED_TRACE(text);
    EXPECT_EQ(read_number(text), number);
    if (number) EXPECT_EQ(std::signbit(*read_number(text)), std::signbit(*number));
    const auto finite = number && std::isfinite(*number) ? number : std::nullopt;
    EXPECT_EQ(csv_number(text), finite);
    const std::string cell = text;
    // Blanks, commas and nothing are no part of a value; what is a number need not be a good place.
    if (cell == "5 " || cell == "1,5" || (finite && std::fabs(*finite) > 1e3)) continue;
    EXPECT_EQ(by_table(text), finite);
    if (!cell.empty()) EXPECT_EQ(by_setting(text), finite);
  }
  EXPECT_TRUE(std::isnan(read_number(".nan").value()));
}

TEST(Number, RowsOfAFileAreReadByOneRule) {
  CsvRows rows("\xEF\xBB\xBF# a, b\n\n 1 ,\t2\r\n  \r\n\"x, y\",3");
  using Cells = std::vector<std::string>;
  EXPECT_EQ(rows.next(), (Cells{"a", "b"}));
  EXPECT_EQ(rows.next(), (Cells{"1", "2"}));
  EXPECT_EQ(rows.line(), 3);
  EXPECT_EQ(rows.next(), (Cells{"x, y", "3"}));
  EXPECT_EQ(rows.line(), 5);
  EXPECT_EQ(rows.next(), std::nullopt);
}

}  // namespace
}  // namespace slalom::io
