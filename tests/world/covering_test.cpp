// Discs that stand in for shapes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "slalom/world/obstacle.hpp"

namespace slalom::world {
namespace {

Obstacle box(double length, double width) {
  Obstacle o{"box", 3, -2};
  o.outline = std::make_shared<Polygon>(Polygon::rectangle(length, width));
  o.a = o.b = o.outline->reach();
  o.psi = 0.4;
  return o;
}

TEST(Covering, DiscsCoverABoxAndStickOutByTheExcess) {
  for (const auto& [length, width] : std::vector<std::pair<double, double>>{
           {4.5, 1.8}, {1.8, 4.5}, {12, 2.5}, {0.775, 0.775}, {2, 2}, {20, 0.3}})
    for (const double excess : {0.2, 0.35}) {
      const auto o = box(length, width);
      const auto discs = covering_discs(o, excess);
      ASSERT_LE(discs.size(), static_cast<std::size_t>(kMostDiscs));
      double most = 0;
      for (double x = -12; x <= 18; x += 0.05)
        for (double y = -12; y <= 8; y += 0.05) {
          const double d = distance(o, x, y, 0);
          double in_discs = INFINITY;
          for (const auto& disc : discs) in_discs = std::min(in_discs, distance(disc, x, y, 0));
          if (d <= 0) EXPECT_LE(in_discs, 1e-9) << x << " " << y;
          if (in_discs <= 0) most = std::max(most, d);
        }
      // 16 are too few for the last.
      EXPECT_LE(most, (length == 20 ? 0.6 : excess) + 1e-9) << length << " " << width;
    }
}

TEST(Covering, DiscsOfATableTurnWithIt) {
  auto o = box(6, 2);
  o.trajectory = std::make_shared<TurningTrajectory>(1, Pose{0, 0, 0.2, 3, 1, 0.7});
  for (const double t : {1., 2.3, 4.}) {
    const auto pose = o.pose_at(t);
    for (const auto& disc : covering_discs(o, 0.2)) {
      const auto now = disc.pose_at(t), soon = disc.pose_at(t + 1e-6);
      EXPECT_LT(distance(o, now.x, now.y, t), 0) << "its centre is inside";
      EXPECT_NEAR((soon.x - now.x) / 1e-6, now.vx, 1e-4);
      EXPECT_NEAR((soon.y - now.y) / 1e-6, now.vy, 1e-4);
      EXPECT_DOUBLE_EQ(now.psi, pose.psi);
    }
  }
}

TEST(Covering, ARectangleCoversAPolygonAsItMoves) {
  Obstacle rock{"rock", 3, -2};
  rock.outline = std::make_shared<Polygon>(std::vector<Point>{{-1, -1}, {2, 0}, {0, 1.5}}, "rock");
  rock.a = rock.b = rock.outline->reach();
  rock.psi = 0.7;
  for (const bool turns : {false, true}) {
    if (turns) rock.trajectory = std::make_shared<TurningTrajectory>(1, Pose{0, 0, 0.2, 3, 1, 0.7});
    const auto cover = covering_rectangles(rock)[0];
    EXPECT_NEAR(cover.a, std::hypot(1.5, 1.25), 1e-12);
    for (const double t : {1., 2.5})
      for (const Point& corner : rock.corners_at(t))
        EXPECT_NEAR(distance(cover, corner.x, corner.y, t), 0, 1e-9) << "it touches them all";
    const auto parts = covering_rectangles(rock, 3);
    ASSERT_EQ(parts.size(), 3u);
    for (const Point& corner : cover.corners_at(2)) {
      double least = INFINITY, area = 0;
      for (const auto& part : parts) {
        least = std::min(least, std::fabs(distance(part, corner.x, corner.y, 2)));
        area += part.outline->area();
      }
      EXPECT_NEAR(least, 0, 1e-9);
      EXPECT_NEAR(area, cover.outline->area(), 1e-9);
    }
  }
}

}  // namespace
}  // namespace slalom::world
