// How far bodies are apart, in one smooth number: on the safe side of the exact distance, and close
// to it.

#include "../../src/planner/separation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "slalom/expr/derivative_check.hpp"
#include "slalom/world/obstacle.hpp"

namespace slalom::planner {
namespace {

using ocp::Expr;
using world::Point;
using world::Pose;

world::Obstacle body(const HalfSides& half, Outline outline = Outline::rectangle) {
  world::Obstacle o{.name = "body", .a = half.length, .b = half.width};
  if (outline == Outline::rectangle)
    o.outline = std::make_shared<world::Polygon>(
        world::Polygon::rectangle(2 * half.length, 2 * half.width));
  return o;
}

std::vector<Point> corners(const HalfSides& half, const Pose& pose) {
  return {pose.to_world({half.length, -half.width}), pose.to_world({half.length, half.width}),
          pose.to_world({-half.length, half.width}), pose.to_world({-half.length, -half.width})};
}

/// n^2 of a rectangle in a frame and a place, or another one in its own.
struct Norms {
  std::vector<Expr> in;
  expr::Function place, pair;

  Norms() : in(symbols()), place(in, {}, {of_place()}), pair(in, {}, {of_pair()}) {}

  static std::vector<Expr> symbols() {
    std::vector<Expr> result;
    for (const char* name : {"x", "y", "psi", "length", "width", "x2", "y2", "psi2", "length2",
                             "width2", "margin", "half"})
      result.push_back(Expr::symbol(name));
    return result;
  }
  Expr of_place() const {
    return square_of_shares(in[5] - in[0], in[6] - in[1], cos(in[2]), sin(in[2]), in[3] + in[10],
                            in[4] + in[10], in[11]);
  }
  Expr of_pair() const {
    return square_of_shares({in[0], in[1], cos(in[2]), sin(in[2])}, {in[3], in[4]},
                            {in[5], in[6], cos(in[7]), sin(in[7])}, {in[8], in[9]}, in[10], in[11]);
  }
  double operator()(const Separation& s, const HalfSides& one, const Pose& at_one,
                    const HalfSides& other, const Pose& at_other, double margin) const {
    const std::array<double, 12> x = {at_one.x,     at_one.y,    at_one.psi, one.length,
                                      one.width,    at_other.x,  at_other.y, at_other.psi,
                                      other.length, other.width, margin,     s.exponent / 2};
    std::array<double, 1> out{};
    (other.is_place() ? place : pair)(x, {}, out);
    return std::sqrt(out[0]);
  }
};

struct Case {
  HalfSides one, other;
  double margin;
  Outline outline = Outline::rectangle;
  double most_excess;  ///< that is found for it [m], and documented
};

const std::vector<Case> kCases = {
    {{0.4, 0.4}, {}, 2.5, Outline::rectangle, 0.15},
    {{4.25, 4.25}, {}, 2.5, Outline::rectangle, 0.13},
    {{2.3, 0.9}, {}, 2.5, Outline::rectangle, 0.2},
    {{2.3, 0.9}, {}, 0.3, Outline::rectangle, 0.06},
    {{6, 1.25}, {}, 2.5, Outline::rectangle, 0.42},
    {{3, 1}, {}, 2.5, Outline::ellipse, 0.2},
    {{3, 1}, {}, 0.1, Outline::ellipse, 0.12},
    {{2.3, 0.9}, {2.3, 1}, 0.3, Outline::rectangle, 0.1},
    {{2.3, 0.9}, {2.3, 1}, 0.05, Outline::rectangle, 0.1},
    {{2.3, 0.9}, {2.3, 1}, 0, Outline::rectangle, 0.12},
    {{2.3, 0.9}, {2.3, 1}, 2.5, Outline::rectangle, 0.55},
    {{6, 1.25}, {2.3, 1}, 0.3, Outline::rectangle, 0.13},
    {{0.5, 0.05}, {2.3, 1}, 0.3, Outline::rectangle, 0.1},
    {{10, 0.1}, {2.3, 1}, 0.3, Outline::rectangle, 0.16},
};

/// Near the edge of what is kept: at a random turn, by a step from where n = most.
TEST(Separation, KeepsTheMarginAndLittleMore) {
  const Norms norms;
  std::mt19937 draw(11);
  std::uniform_real_distribution<double> any(-M_PI, M_PI), near(-0.2, 0.2);
  for (const auto& c : kCases) {
    const Separation s = separate(c.one, c.other, c.margin, c.outline);
    EXPECT_LE(s.excess, c.most_excess) << c.one.length << " " << c.other.length << " " << c.margin;
    const auto obstacle = body(c.one, c.outline);
    int kept = 0;
    double most = 0;
    for (int k = 0; k < 4000; ++k) {
      // More than asked for at the least margin, as a plan asks at its end.
      const double margin = c.margin + (k % 2) * 0.7 * std::fabs(near(draw)) * 5;
      const Pose at_one{near(draw), near(draw), any(draw)};
      const double away = any(draw);
      Pose at_other{at_one.x + std::cos(away), at_one.y + std::sin(away),
                    k % 3 ? any(draw) : at_one.psi + near(draw) / 10};
      const double out = s.most / norms(s, c.one, at_one, c.other, at_other, margin);
      const double stretched = out * (1 + near(draw) / 10);
      at_other.x = at_one.x + stretched * std::cos(away);
      at_other.y = at_one.y + stretched * std::sin(away);
      const double n = norms(s, c.one, at_one, c.other, at_other, margin);
      auto placed = obstacle;
      placed.x = at_one.x;
      placed.y = at_one.y;
      placed.psi = at_one.psi;
      if (c.outline == Outline::ellipse) placed.trajectory = nullptr;
      const double d = c.other.is_place() ? world::distance(placed, at_other.x, at_other.y, 0)
                                          : world::distance(placed, corners(c.other, at_other), 0);
      if (n >= s.most) {
        ++kept;
        ASSERT_GE(d, margin - 1e-6) << c.one.length << " " << c.margin;
      } else if (margin == c.margin) {
        most = std::max(most, d - margin);
      }
    }
    EXPECT_GT(kept, 1000);
    // Between the directions and turns by which it was found.
    EXPECT_LE(most, s.excess + 0.04) << c.one.length << " " << c.other.length << " " << c.margin;
    EXPECT_GE(most, s.excess / 4);
  }
}

TEST(Separation, GrowsInProportionFromTheMiddle) {
  const Norms norms;
  const HalfSides one{2, 1}, other{2.3, 1};
  const Separation s = separate(one, other, 0.3);
  const double far = norms(s, one, {0, 0, 0.3}, other, {8, 3, 1}, 0.3);
  for (const double share : {0.5, 0.1, 0.01})
    EXPECT_NEAR(norms(s, one, {0, 0, 0.3}, other, {8 * share, 3 * share, 1}, 0.3), far * share,
                1e-4);
}

TEST(Separation, ACircleOverASmallBoxAndAnEllipseAreOfExponent2) {
  EXPECT_LE(separate({0.1, 0.1}, {}, 2.5).exponent, 2.5);
  EXPECT_EQ(separate({1, 1}, {}, 2.5, Outline::ellipse).exponent, 2);
  EXPECT_NEAR(separate({1, 1}, {}, 2.5, Outline::ellipse).most, 1, 0.002);
}

TEST(Separation, ItsDerivativesAreThoseOfItsValues) {
  // Of what an OCP varies: the other's pose, as the vehicle's.
  const auto in = Norms::symbols();
  const std::vector<Expr> varied = {in[5], in[6], in[7]};
  const std::vector<Expr> given = {in[0], in[1], in[2], in[3], in[4], in[8], in[9], in[10], in[11]};
  const Norms norms;
  const expr::Function place(varied, given, norms.place(in, {})),
      pair(varied, given, norms.pair(in, {}));
  std::mt19937 draw(5);
  std::uniform_real_distribution<double> any(-3, 3), size(0.5, 3), half(1, 32);
  for (int k = 0; k < 40; ++k) {
    const std::array<double, 9> numbers = {any(draw),  any(draw),  any(draw),
                                           size(draw), size(draw), size(draw),
                                           size(draw), 0.3,        half(draw)};
    const std::vector<std::vector<double>> at = {{any(draw), any(draw), any(draw)}};
    for (const auto* function : {&place, &pair}) {
      expr::DerivativeCheckOptions options;
      options.tolerance = 1e-5;
      const auto report = expr::check_derivatives(*function, at, numbers, options);
      EXPECT_TRUE(report.passed) << expr::to_string(report);
    }
  }
}

TEST(Separation, ItsDerivativesAreFiniteInTheMiddleAndFarAway) {
  const Norms norms;
  for (const auto* function : {&norms.place, &norms.pair})
    for (const double away : {0., 1e-7, 1e-3, 300., 1e5})
      for (const double half : {1., 3., 32.}) {
        const std::array<double, 12> x = {1,        2,   0.3, 2,    0.1, 1 + away,
                                          2 - away, 0.3, 2,   0.05, 0.3, half};
        std::vector<double> value(1), jacobian(function->jacobian_pattern().size()),
            hessian(function->hessian_pattern().size());
        const double weight = 1;
        function->evaluate(1, x, {}, {&weight, 1}, {true, true, true}, value, jacobian, hessian);
        for (const auto& all : {value, jacobian, hessian})
          for (const double entry : all) EXPECT_TRUE(std::isfinite(entry)) << away << " " << half;
      }
}

}  // namespace
}  // namespace slalom::planner
