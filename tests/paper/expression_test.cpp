#include "../../src/paper/expression.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../../src/paper/evaluate.hpp"
#include "../../src/paper/intervals.hpp"
#include "slalom/base/error.hpp"

namespace slalom::paper {
namespace {

double value(const std::string& text) {
  return number_of(parse_expression(text, "here"), {});
}

TEST(Expression, BindsAsInArithmetic) {
  EXPECT_EQ(value("1 + 2 * 3 - 8 / 4"), 5);
  EXPECT_EQ(value("-(1 + 2) * 2"), -6);
  EXPECT_EQ(value("1 - 2 - 3"), -4);
  EXPECT_EQ(value("1 + 1 == 2 and 3 > 2"), 1);
  EXPECT_EQ(value("not 1 == 2 and 0 == 1"), 0);
  EXPECT_EQ(value("0 == 1 or 2 >= 2"), 1);
  EXPECT_EQ(value("abs(-2.5e-1)"), 0.25);
}

TEST(Expression, WordsNameDrivesAndTexts) {
  EXPECT_EQ(value("E_A-figure/P_A == E_A-figure/P_A"), 1);
  EXPECT_EQ(value("case-E/0.25 != case-E/0.1"), 1);
  EXPECT_EQ(parse_expression("a - b", "here").name, "-");
}

TEST(Expression, ListsGoItemByItem) {
  const std::map<std::string, Expression> none;
  std::vector<SweepTrial> trials;
  for (const double tex : {0.1, 0.2, 0.4})
    trials.push_back({"P_D", "goal", "", tex, 1, tex, tex, tex});
  const Context context{nullptr, &none, &trials, nullptr};
  const auto of = [&](const char* text) {
    return numbers_of(parse_expression(text, "here"), context);
  };
  EXPECT_EQ(of("tex_values() < 0.3"), (Numbers{1, 1, 0}));
  EXPECT_EQ(of("select(tex_values(), tex_values() > 0.1)"), (Numbers{0.2, 0.4}));
  EXPECT_EQ(of("by_tex(mean(trials(longest, planner == P_D)) / tex)"), (Numbers{1, 1, 1}));
  EXPECT_EQ(of("nearest(tex_values(), 0.22)"), (Numbers{0.2}));
}

TEST(Expression, SaysWhatIsWrong) {
  for (const char* text : {"", "1 +", "(1", "1 2", "time(E_A/P_A", "* 2", "1.2.3"})
    EXPECT_THROW(parse_expression(text, "here"), InvalidValue) << text;
  EXPECT_THROW(check_names(parse_expression("tiem(E_A/P_A)", "here"), "here"), InvalidValue);
  EXPECT_THROW(check_names(parse_expression("time()", "here"), "here"), InvalidValue);
  EXPECT_THROW(value("1 < some_word"), InvalidValue);
}

TEST(Intervals, HoldTheirMedian) {
  Numbers values;
  for (int i = 1; i <= 25; ++i) values.push_back(i);
  const auto median = median_interval(values);
  EXPECT_EQ(median.value, 13);
  EXPECT_EQ(median.lo, 8);  // binomial(25, 1/2): 8th and 18th
  EXPECT_EQ(median.hi, 18);
  Numbers once, twice;
  for (int i = 0; i < 30; ++i) {
    once.push_back(i % 3 + 1);
    twice.push_back(2 * (i % 3 + 1));
  }
  const auto ratio = ratio_interval(once, twice);
  EXPECT_EQ(ratio.value, 2);
  EXPECT_LE(ratio.lo, 2);
  EXPECT_GE(ratio.hi, 2);
  EXPECT_EQ(paired_interval({1, 2, 4}, {2, 4, 8, 100}).value, 2);
  EXPECT_TRUE(std::isnan(median_interval({}).value));
}

TEST(Intervals, AreNoneOfFewerThanSixValues) {
  const auto six = median_interval({1, 2, 3, 4, 5, 6});
  EXPECT_EQ(six.lo, 1);  // the median lies beyond all in 3.125 %
  EXPECT_EQ(six.hi, 6);
  const auto five = median_interval({1, 2, 3, 4, 5});
  EXPECT_EQ(five.value, 3);
  EXPECT_TRUE(std::isnan(five.lo) && std::isnan(five.hi)) << "6.25 %";
}

}  // namespace
}  // namespace slalom::paper
