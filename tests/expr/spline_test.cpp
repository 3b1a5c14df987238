#include "slalom/expr/spline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "slalom/base/error.hpp"
#include "slalom/expr/function.hpp"

namespace slalom::expr {
namespace {

/// Value, slope and second derivative of the spline at a number.
struct Point {
  double value = 0, slope = 0, curvature = 0;
};

class Spline {
 public:
  Spline(const std::vector<double>& knots, const std::vector<double>& values) {
    const Expr x = Expr::symbol("x");
    f_ = Function({x}, {}, {cubic_spline(x, knots, values)});
  }
  Point at(double number) const {
    Point point;
    const std::vector<double> one{1};
    f_.evaluate(1, {&number, 1}, {}, one, {.values = true, .jacobian = true, .hessian = true},
                {&point.value, 1}, {&point.slope, 1},
                {&point.curvature, f_.hessian_pattern().size()});
    return point;
  }

 private:
  Function f_;
};

Point at(const std::vector<double>& knots, const std::vector<double>& values, double number) {
  return Spline(knots, values).at(number);
}

const std::vector<double> kKnots = {-1, 0, 0.5, 2, 2.25, 4}, kValues = {3, -1, 2, 2, 0, 5};

TEST(Splines, PassThroughTheirKnotsTwiceSmoothly) {
  for (std::size_t i = 0; i < kKnots.size(); ++i) {
    const double gap = 1e-9, x = kKnots[i];
    const Point before = at(kKnots, kValues, x - gap), here = at(kKnots, kValues, x),
                after = at(kKnots, kValues, x + gap);
    EXPECT_NEAR(here.value, kValues[i], 1e-12);
    EXPECT_NEAR(before.value, after.value, 1e-6);
    EXPECT_NEAR(before.slope, after.slope, 1e-5);
    EXPECT_NEAR(before.curvature, after.curvature, 1e-5);
  }
  EXPECT_NEAR(at(kKnots, kValues, -1 + 1e-9).curvature, 0, 1e-5);
  EXPECT_NEAR(at(kKnots, kValues, 4 - 1e-9).curvature, 0, 1e-5);
}

TEST(Splines, AreLinesBeyondTheirEndsAndWhereTheDataAre) {
  const Point left = at(kKnots, kValues, -3);
  EXPECT_NEAR(left.value, 3 - 2 * at(kKnots, kValues, -1).slope, 1e-12);
  EXPECT_EQ(left.curvature, 0);
  EXPECT_NEAR(at(kKnots, kValues, 6).value, 5 + 2 * at(kKnots, kValues, 4).slope, 1e-12);
  for (const double x : {-1.0, 0.0, 0.3, 1.0, 5.0}) {
    EXPECT_NEAR(at({0, 1}, {2, 5}, x).value, 2 + 3 * x, 1e-14);
    EXPECT_NEAR(at({0, 0.2, 0.7, 1}, {2, 2.6, 4.1, 5}, x).slope, 3, 1e-13);
  }
}

TEST(Splines, ApproachASmoothFunctionByTheFourthPowerOfTheStep) {
  const auto error = [](int n) {
    std::vector<double> knots, values;
    for (int i = 0; i <= n; ++i) {
      knots.push_back(2 * M_PI * i / n);
      values.push_back(std::sin(knots.back()));  // its second derivative is 0 at both ends
    }
    const Spline spline(knots, values);
    double worst = 0;
    for (int i = 0; i < 200; ++i) {
      const double x = 2 * M_PI * (i + 0.5) / 200;
      worst = std::max(worst, std::fabs(spline.at(x).value - std::sin(x)));
    }
    return worst;
  };
  EXPECT_NEAR(std::log2(error(16) / error(32)), 4, 0.2);
  EXPECT_LT(error(300), 1e-8);  // deep within one another
}

TEST(Splines, RefuseTablesThatAreNone) {
  const auto message = [](const std::vector<double>& knots, const std::vector<double>& values) {
    try {
      (void)cubic_spline(Expr::symbol("x"), knots, values);
    } catch (const InvalidValue& e) {
      return std::string(e.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(message({1}, {1}), "spline: found 1 knots, expected at least 2");
  EXPECT_EQ(message({1, 2}, {1}), "spline: found 1 values, expected 2, one for each knot");
  EXPECT_EQ(message({1, 2, 2}, {1, 2, 3}),
            "spline: found knot 2 = 2 after 2, expected strictly increasing knots");
  EXPECT_EQ(message({1, 2}, {1, std::nan("")}),
            "spline: found nan at knot 1, expected finite numbers");
}

TEST(Splines, OfExpressionsAreThoseOfTheirNumbers) {
  const std::vector<double> knots{-1, 0.5, 1, 2.5, 4}, values{3, -2, 0.5, 7, 1};
  const Expr x = Expr::symbol("x");
  std::vector<Expr> inputs{x}, symbols;
  for (std::size_t i = 0; i < values.size(); ++i)
    symbols.push_back(Expr::symbol("v" + std::to_string(i)));
  inputs.insert(inputs.end(), symbols.begin(), symbols.end());
  const Function f(inputs, {}, {cubic_spline(x, knots, symbols)});
  for (const double number : {-3.0, -1.0, 0.1, 0.75, 1.9, 2.5, 3.3, 6.0}) {
    std::vector<double> in{number};
    in.insert(in.end(), values.begin(), values.end());
    double value = 0;
    f(in, {}, {&value, 1});
    EXPECT_NEAR(value, at(knots, values, number).value, 1e-13) << number;
  }
  EXPECT_THROW((void)cubic_spline(x, {1, 2}, std::vector<Expr>{x}), InvalidValue);
}

TEST(Spline, HoldsBeyondItsEndsWhereAskedTo) {
  const Expr x = Expr::symbol("x");
  const Function f({x}, {},
                   {cubic_spline(x, {0, 1, 3}, std::vector{1.0, 2.0, -1.0}, Beyond::hold)});
  const auto at = [&f](double number) {
    double value = 0, slope = 0;
    f.evaluate(1, {&number, 1}, {}, {}, {.values = true, .jacobian = true}, {&value, 1},
               {&slope, 1}, {});
    return std::pair(value, slope);
  };
  EXPECT_EQ(at(-2), std::pair(1.0, 0.0));
  EXPECT_DOUBLE_EQ(at(5).first, -1);
  EXPECT_EQ(at(5).second, 0);
  EXPECT_DOUBLE_EQ(at(1).first, 2);
}

TEST(Spline, ATableOfManyKnotsIsLookedUpWithTheSameAnswers) {
  std::vector<double> knots, values;
  for (int k = 0; k < 200; ++k) {
    knots.push_back(k + 0.3 * std::sin(k));
    values.push_back(std::cos(0.7 * k));
  }
  const Expr x = Expr::symbol("x"), y = Expr::symbol("y");
  const std::vector<Expr> outputs{cubic_spline(x * y, knots, values),
                                  y * cubic_spline(y, knots, values)};
  const Function looked_up({x, y}, {}, outputs), chosen({x, y}, {}, without_lookups(outputs));
  EXPECT_LT(20 * looked_up.instructions({.values = true}), chosen.instructions({.values = true}));
  for (const double at : {-3.0, 0.0, knots[1], 7.2, knots[150], 150.1, 198.0, 230.0}) {
    const std::vector<double> point{2, at}, weights{0.3, 1.7};
    const auto results = [&](const Function& f) {
      std::vector<double> v(2), j(f.jacobian_pattern().size()), h(f.hessian_pattern().size());
      f.evaluate(1, point, {}, weights, {.values = true, .jacobian = true, .hessian = true}, v, j,
                 h);
      v.insert(v.end(), j.begin(), j.end());
      v.insert(v.end(), h.begin(), h.end());
      return v;
    };
    const auto one = results(looked_up), other = results(chosen);
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t i = 0; i < one.size(); ++i)
      EXPECT_NEAR(one[i], other[i], 1e-12 * (1 + std::fabs(other[i]))) << at << " " << i;
  }
}

TEST(Spline, TablesInAGraphSayHowMuchRoomTheyHave) {
  const Expr x = Expr::symbol("x"), y = Expr::symbol("y");
  const Expr one = cubic_spline(x * x, {1, 2}, std::vector{0.0, 1.0});
  const Expr two = cubic_spline(one + y, {0, 4}, std::vector{0.0, 1.0});
  const Expr held = cubic_spline(y, {0, 4}, std::vector{0.0, 1.0}, Beyond::hold);
  const auto rooms = room_in_tables({sin(two) + one, select(x, y, 2 * y), held});
  ASSERT_EQ(rooms.size(), 2u);
  const Function room({x, y}, {}, rooms);
  const auto at = [&room](double a, double b) {
    std::vector<double> values(2);
    room.evaluate(1, std::vector{a, b}, {}, {}, {.values = true}, values, {}, {});
    return values;
  };
  EXPECT_EQ(at(2, 0), (std::vector{-2.0, 1.0}));  // x^2 = 4 and 3 + 0: beyond by 2, inside by 1
  // What tells a table costs nothing: the function is that of the spline alone.
  const Expr wave = sin(x);
  EXPECT_EQ(simplified({select(x, wave, wave)}).front().node()->op(), Op::sin);
}

/// The guess at where x lies is no more than one: as a search through all steps has it.
TEST(StepFunctions, GiveTheStepThatASearchFinds) {
  std::mt19937 random(5);
  for (const bool even : {true, false}) {
    for (const std::size_t count : {1u, 2u, 3u, 4u, 5u, 80u}) {
      Steps steps;
      double begin = -3;
      for (std::size_t k = 0; k < count; ++k) {
        steps.begins.push_back(begin);
        steps.values.push_back(static_cast<double>(k));
        begin += even ? 0.7 : 1e-3 * std::pow(1.1, static_cast<double>(random() % 100));
      }
      std::vector<double> places = {-1e300, -4, 1e300, begin};
      for (const double at : steps.begins)
        for (const double x : {at, std::nextafter(at, -1e9), std::nextafter(at, 1e9)})
          places.push_back(x);
      for (int k = 0; k < 200; ++k)
        places.push_back(-3 + (begin + 3) * static_cast<double>(random() % 1000) / 999);
      for (const double x : places) {
        std::size_t k = 0;
        while (k + 1 < count && steps.begins[k + 1] < x) ++k;
        ASSERT_EQ(steps.at(x), static_cast<double>(k)) << count << " steps at " << x;
      }
    }
  }
}

}  // namespace
}  // namespace slalom::expr
