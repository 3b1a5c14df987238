#include "slalom/world/ellipse.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace slalom::world {
namespace {

/// Distance by search along the edge: a scan, then golden sections around the best angle.
double distance_by_search(double dx, double dy, double a, double b) {
  const auto at = [&](double angle) {
    return std::hypot(a * std::cos(angle) - dx, b * std::sin(angle) - dy);
  };
  constexpr int kPoints = 20000;
  double best = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2 * std::numbers::pi * i / kPoints;
    if (at(angle) < at(best)) best = angle;
  }
  double lo = best - 1e-3, hi = best + 1e-3;
  for (int i = 0; i < 100; ++i) {
    const double third = (hi - lo) / 3;
    (at(lo + third) < at(hi - third) ? hi : lo) += at(lo + third) < at(hi - third) ? -third : third;
  }
  return at(lo);
}

TEST(Ellipse, ClosedForms) {
  EXPECT_DOUBLE_EQ(signed_distance_to_ellipse(3, 4, 2, 2), 3);       // circle, outside
  EXPECT_DOUBLE_EQ(signed_distance_to_ellipse(.3, .4, 2, 2), -1.5);  // circle, inside
  EXPECT_DOUBLE_EQ(signed_distance_to_ellipse(7, 0, 4, 1), 3);       // on an axis, outside
  EXPECT_DOUBLE_EQ(signed_distance_to_ellipse(0, -5, 4, 1), 4);
  EXPECT_DOUBLE_EQ(signed_distance_to_ellipse(0, 0, 4, 1), -1);  // centre: nearer semi-axis
  EXPECT_DOUBLE_EQ(signed_distance_to_ellipse(0, 0, 1, 4), -1);
  EXPECT_NEAR(signed_distance_to_ellipse(-3.9, 0, 4, 1), -.1, 1e-15);  // beyond the evolute's cusp
  EXPECT_DOUBLE_EQ(signed_distance_to_ellipse(4, 0, 4, 1), 0);         // on the edge
  EXPECT_DOUBLE_EQ(signed_distance_to_ellipse(0, 1, 4, 1), 0);
}

TEST(Ellipse, AgreesWithASearchAlongTheEdge) {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> position(-8, 8), axis(.2, 6);
  for (int n = 0; n < 300; ++n) {
    const double dx = position(engine), dy = position(engine), a = axis(engine), b = axis(engine);
    const double inside = (dx / a) * (dx / a) + (dy / b) * (dy / b) < 1 ? -1 : 1;
    EXPECT_NEAR(signed_distance_to_ellipse(dx, dy, a, b), inside * distance_by_search(dx, dy, a, b),
                1e-7)
        << dx << ' ' << dy << ' ' << a << ' ' << b;
  }
}

TEST(Ellipse, ThinOnesAndNeighbourhoodsOfTheAxesAreExact) {
  // The foot of the point is known: start on the edge and go out along the normal.
  for (const double b : {1e-3, .1, 1., 50.})
    for (const double angle : {1e-9, 1e-4, .3, 1.2, std::numbers::pi / 2 - 1e-9})
      for (const double d : {1e-6, .5, 20.}) {
        const double a = 3, x = a * std::cos(angle), y = b * std::sin(angle);
        const double nx = x / (a * a), ny = y / (b * b), n = std::hypot(nx, ny);
        EXPECT_NEAR(signed_distance_to_ellipse(x + d * nx / n, y + d * ny / n, a, b), d, 1e-12 * 50)
            << b << ' ' << angle << ' ' << d;
      }
}

// Deep inside, where the nearest point is far from the axis that the point is all but on.
TEST(Ellipse, JustOffTheLongAxisIsAsOnIt) {
  for (const double x : {0., 0.1, 1.2, 1.49}) {
    const double on = signed_distance_to_ellipse(x, 0, 2, 1);
    for (const double y : {1e-320, 1e-300, 1e-20, 1e-17, 1e-15, 1e-12, 1e-8, 1e-5}) {
      EXPECT_NEAR(signed_distance_to_ellipse(x, y, 2, 1), on, y + 1e-14) << x << ' ' << y;
      EXPECT_NEAR(signed_distance_to_ellipse(-y, x, 1, 2), on, y + 1e-14) << x << ' ' << y;
    }
  }
}

TEST(Ellipse, NearlyACircleIsACircle) {
  EXPECT_NEAR(signed_distance_to_ellipse(1, 2, 2, 2 + 1e-12), std::sqrt(5.) - 2, 1e-11);
  EXPECT_NEAR(signed_distance_to_ellipse(.01, .02, 2, 2 + 1e-12), std::hypot(.01, .02) - 2, 1e-11);
}

}  // namespace
}  // namespace slalom::world
