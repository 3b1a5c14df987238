#include "slalom/report/plot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>
#include <sstream>

#include "report/markup.hpp"

namespace slalom::report {
namespace {

TEST(Ticks, AreMultiplesOfOneTwoOrFive) {
  for (const auto& [lo, hi, count] :
       {std::tuple{0., 1., 5}, {-3.2, 7.9, 4}, {16.9, 19.7, 6}, {1e-5, 3e-5, 4}, {-7e6, 9e7, 5}}) {
    const auto ticks = nice_ticks(lo, hi, count);
    const double mantissa = ticks.step / std::pow(10., std::floor(std::log10(ticks.step) + 1e-9));
    EXPECT_TRUE(std::abs(mantissa - 1) < 1e-9 || std::abs(mantissa - 2) < 1e-9 ||
                std::abs(mantissa - 5) < 1e-9)
        << ticks.step;
    ASSERT_GE(ticks.at.size(), 2u);
    EXPECT_LE(ticks.at.size(), static_cast<std::size_t>(count) + 1);
    for (const double v : ticks.at) {
      EXPECT_NEAR(v / ticks.step, std::round(v / ticks.step), 1e-9);
      EXPECT_GE(v, lo - 1e-9 * ticks.step);
      EXPECT_LE(v, hi + 1e-9 * ticks.step);
    }
  }
}

TEST(Ticks, CoverTheRange) {
  const auto ticks = nice_ticks(0, 10, 5);
  EXPECT_DOUBLE_EQ(ticks.step, 2);
  EXPECT_EQ(ticks.at, (std::vector<double>{0, 2, 4, 6, 8, 10}));
}

TEST(Ticks, HaveEnoughDigitsToBeToldApart) {
  EXPECT_EQ(nice_ticks(0, 1, 5).digits(), 1);
  EXPECT_EQ(nice_ticks(0, .1, 4).digits(), 2);
  EXPECT_EQ(nice_ticks(0, 500, 5).digits(), 0);
}

TEST(Ticks, AreAtLeastTwo) {
  // Three ticks wanted of a step of 1 would leave 0 alone.
  EXPECT_EQ(nice_ticks(-.9, .95, 3).at, (std::vector<double>{-.5, 0, .5}));
  EXPECT_GE(nice_ticks(17.1, 18.9, 2).at.size(), 2u);
}

TEST(Ticks, OfAnEmptyRangeAreOne) {
  EXPECT_EQ(nice_ticks(3, 3, 5).at, std::vector<double>{3});
  EXPECT_EQ(nice_ticks(-1, 1, 0).at, std::vector<double>{0});
}

TEST(Svg, LinesKeepTheirShapeWithFewPoints) {
  Svg svg("name", 100, 100, "title");
  std::vector<Point> points;
  for (int i = 0; i <= 1000; ++i) {
    const double x = 0.1 * i;
    points.push_back({x, x < 50 ? 20 : 20 + 30 * std::sin((x - 50) / 10)});
  }
  svg.polyline(points, {colours::blue});
  const auto list = testing::parse_xml(svg.str()).get<std::string>("svg.polyline.<xmlattr>.points");
  std::stringstream text(list);
  std::vector<Point> kept;
  char comma = 0;
  for (Point p; text >> p.x >> comma >> p.y;) kept.push_back(p);
  ASSERT_GT(kept.size(), 20u);
  EXPECT_LT(kept.size(), 100u);
  for (const auto& p : points) {
    std::size_t k = 1;
    while (k + 1 < kept.size() && kept[k].x < p.x) ++k;
    const auto& a = kept[k - 1];
    const auto& b = kept[k];
    EXPECT_NEAR(a.y + (b.y - a.y) * (p.x - a.x) / (b.x - a.x), p.y, 0.2) << p.x;
  }
}

TEST(Svg, StandSideBySideAtTheirOwnSizes) {
  Svg one("one", 100, 50.5, "one <1>"), two("two", 200, 80, "two");
  one.text({1, 2}, "left", {});
  two.text({3, 4}, "right", {});
  const auto both = side_by_side("both & more", {one.str(), two.str()}, 10);
  const auto tree = testing::parse_xml(both);
  EXPECT_EQ(tree.get<std::string>("svg.<xmlattr>.width"), "310pt");
  EXPECT_EQ(tree.get<std::string>("svg.<xmlattr>.height"), "80pt");
  EXPECT_EQ(tree.get<std::string>("svg.title"), "both & more");
  std::string places;
  for (const auto& [name, child] : tree.get_child("svg"))
    if (name == "svg")
      places += child.get<std::string>("<xmlattr>.x") + "+" +
                child.get<std::string>("<xmlattr>.width") + " of " +
                child.get<std::string>("<xmlattr>.viewBox") + " " + child.get<std::string>("text") +
                "; ";
  EXPECT_EQ(places, "0+100 of 0 0 100 50.5 left; 110+200 of 0 0 200 80 right; ");
  EXPECT_NO_THROW(testing::parse_xml(side_by_side("none", {}, 10)));
  EXPECT_NO_THROW(testing::parse_xml(side_by_side("empty", {""}, 10)));
}

TEST(PlotSvg, ConstantsHaveShortTicks) {
  Plot plot{.x_label = "t [s]", .y_label = "ux [m/s]"};
  plot.series = {{"", {0, 1, 2}, {17, 17 + 1e-9, 17}, {colours::blue}}};
  const auto svg = plot_svg("name", "title", plot);
  EXPECT_EQ(testing::count(svg, ">17.0</text>"), 1) << svg;
}

TEST(PlotSvg, IsWellFormedAndEightCentimetresWide) {
  Plot plot{.x_label = "t [s]", .y_label = "<ux> & \"more\""};
  plot.series = {{"a & b", {0, 1, 2}, {1, 3, 2}, {colours::blue}, true, false}};
  plot.levels = {{2.5, "limit <1>"}};
  const auto svg = plot_svg("name", "A title < B", plot);
  const auto tree = testing::parse_xml(svg);
  EXPECT_EQ(tree.get<std::string>("svg.<xmlattr>.width"), "226.77pt");
  EXPECT_EQ(tree.get<std::string>("svg.title"), "A title < B");
  EXPECT_EQ(testing::count(svg, "<script"), 0);
}

TEST(PlotSvg, KeepsEveryNumberFinite) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Plot plot{.x_label = "t", .y_label = "y"};
  plot.series = {{"", {0, 1, 2, 3, 4}, {1, inf, NAN, -inf, 2}, {colours::blue}, true, false}};
  for (const bool log : {false, true}) {
    plot.log_y = log;
    const auto svg = plot_svg("name", "title", plot);
    EXPECT_NO_THROW(testing::parse_xml(svg));
    EXPECT_FALSE(std::regex_search(svg, std::regex("\"[^\"]*\\b(nan|inf)\\b"))) << svg;
  }
}

TEST(PlotSvg, OfNothingIsStillAPicture) {
  for (const bool log : {false, true}) {
    Plot plot{.x_label = "t", .y_label = "y"};
    plot.log_y = log;
    EXPECT_NO_THROW(testing::parse_xml(plot_svg("name", "title", plot)));
    plot.series = {{"", {1}, {log ? 0. : 5.}, {colours::blue}, true, false}};
    EXPECT_NO_THROW(testing::parse_xml(plot_svg("name", "title", plot)));
  }
  EXPECT_NO_THROW(testing::parse_xml(stacked_svg("name", "title", {})));
}

TEST(Svg, BreaksLinesAtMissingPoints) {
  Svg svg("name", 10, 10, "title");
  svg.polyline({{0, 0}, {1, 1}, {NAN, 0}, {2, 2}, {3, 3}, {NAN, NAN}, {4, 4}}, {colours::ink});
  EXPECT_EQ(testing::count(svg.str(), "<polyline"), 2);
}

TEST(Svg, KeepsIdsOfDocumentsApart) {
  Plot plot{.x_label = "t", .y_label = "y"};
  const auto a = plot_svg("first", "title", plot), b = plot_svg("second", "title", plot);
  EXPECT_GT(testing::count(a, "id=\"first-"), 0);
  EXPECT_GT(testing::count(b, "id=\"second-"), 0);
}

}  // namespace
}  // namespace slalom::report
