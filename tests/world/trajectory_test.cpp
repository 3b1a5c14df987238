#include "slalom/world/trajectory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <random>

#include "slalom/base/error.hpp"

namespace slalom::world {
namespace {

constexpr double kPi = std::numbers::pi;

TableTrajectory table(std::vector<TrajectoryRow> rows, BeyondEnd before = BeyondEnd::stands,
                      BeyondEnd after = BeyondEnd::goes_on) {
  return {std::move(rows), before, after, "there"};
}

/// Turns, brakes, stands and goes on, at times unevenly spaced.
TableTrajectory winding() {
  return table({{1, 0, 0, 3},
                {1.3, 2, 0.1, 3.1},
                {2.5, 9, 1, -3.1},
                {3, 10, 3, -2.5},
                {4, 10, 3, -2.5},
                {6, 10, 3, -2.5},
                {6.5, 8, 2, -2.8},
                {8, 0, 0, -3}});
}

/// What `fastest` says is not exceeded, and velocities are the rates of places.
void expect_consistent(const Trajectory& trajectory, double begin, double end) {
  std::mt19937 draw(3);
  std::uniform_real_distribution<double> within(begin, end);
  for (int i = 0; i < 300; ++i) {
    const double t0 = within(draw), t1 = t0 + 0.3 * (within(draw) - begin) / (end - begin);
    const Rates most = trajectory.fastest(t0, t1);
    for (double share = 0; share <= 1; share += 0.125) {
      const double t = t0 + share * (t1 - t0);
      const Pose pose = trajectory.at(t);
      EXPECT_LE(std::hypot(pose.vx, pose.vy), most.speed + 1e-12) << t;
      EXPECT_LE(std::fabs(pose.omega), most.omega + 1e-12) << t;
    }
    // Nor by the way that is gone.
    const Pose a = trajectory.at(t0), b = trajectory.at(t1);
    EXPECT_LE(std::hypot(b.x - a.x, b.y - a.y), most.speed * (t1 - t0) + 1e-9);
    EXPECT_LE(std::fabs(b.psi - a.psi), most.omega * (t1 - t0) + 1e-9);
  }
}

void expect_rates_of_places(const Trajectory& trajectory, double t) {
  const double h = 1e-6;
  const Pose before = trajectory.at(t - h), pose = trajectory.at(t), after = trajectory.at(t + h);
  EXPECT_NEAR(pose.vx, (after.x - before.x) / (2 * h), 1e-4) << t;
  EXPECT_NEAR(pose.vy, (after.y - before.y) / (2 * h), 1e-4) << t;
  EXPECT_NEAR(pose.omega, (after.psi - before.psi) / (2 * h), 1e-4) << t;
}

TEST(TableTrajectory, IsAtItsRowsAndSmoothThere) {
  const auto t = winding();
  for (const auto& row : t.rows()) {
    const Pose pose = t.at(row.t);
    EXPECT_NEAR(pose.x, row.x, 1e-13);
    EXPECT_NEAR(pose.y, row.y, 1e-13);
    EXPECT_NEAR(pose.psi, row.psi, 1e-13);
    if (row.t > 1 && row.t < 8) expect_rates_of_places(t, row.t);
  }
  for (const double at : {1.1, 2.2, 2.9, 3.7, 6.2, 7.4, 9.5}) expect_rates_of_places(t, at);
  // Headings go the short way round.
  EXPECT_NEAR(t.at(2.5).psi, 2 * kPi - 3.1, 1e-12);
  expect_consistent(t, 0, 10);
}

TEST(TableTrajectory, DoesNotOvershootWhereItComesToRest) {
  const auto t = table({{0, 0, 0}, {1, 5, 0}, {2, 8, 0}, {3, 8, 0}, {4, 8, 0}, {5, 8, 0}});
  for (double at = 0; at < 2; at += 0.01) EXPECT_LE(t.at(at).x, t.at(at + 0.01).x + 1e-15);
  for (double at = 2; at < 5; at += 0.01) {
    EXPECT_EQ(t.at(at).x, 8) << at;
    EXPECT_EQ(t.at(at).vx, 0) << at;
  }
  EXPECT_EQ(t.fastest(2.5, 5).speed, 0);
}

void expect_still(const TableTrajectory& t, double begin, double end, double x) {
  for (double at = begin; at <= end; at += (end - begin) / 16) {
    EXPECT_NEAR(t.at(at).x, x, 1e-12) << at;
    EXPECT_EQ(t.at(at).vx, 0) << at;
    EXPECT_EQ(t.at(at).omega, 0) << at;
  }
  EXPECT_EQ(t.fastest(begin + 1e-6, end - 1e-6).speed, 0);
  EXPECT_EQ(t.fastest(begin + 1e-6, end - 1e-6).omega, 0);
}

TEST(TableTrajectory, StandsBetweenTwoRowsAtOnePlace) {
  const auto waits = table({{0, 0, 0, 0}, {10, 100, 0, 1}, {60, 100, 0, 1}, {70, 200, 0, 2}});
  expect_still(waits, 10, 60, 100);
  for (double at = 0; at < 70; at += 0.5) EXPECT_LE(waits.at(at).x, waits.at(at + 0.5).x + 1e-12);
  const auto both = table({{0, 5, 0}, {10, 5, 0}, {20, 100, 0}, {30, 200, 0}, {40, 200, 0}},
                          BeyondEnd::goes_on, BeyondEnd::goes_on);
  expect_still(both, 0, 10, 5);
  expect_still(both, 30, 40, 200);
  EXPECT_EQ(both.at(-7).x, 5) << "what stands goes on standing";
  EXPECT_EQ(both.at(60).x, 200);
  EXPECT_EQ(both.fastest(41, 60).speed, 0);
  expect_consistent(waits, -5, 80);
}

TEST(TableTrajectory, TurnsWhereItStands) {
  const auto t = table({{0, 0, 0, 0}, {1, 5, 5, 0}, {3, 5, 5, 1}, {4, 9, 9, 1}});
  EXPECT_NEAR(t.at(2).x, 5, 1e-12);
  EXPECT_EQ(t.at(2).vy, 0);
  EXPECT_GT(t.at(2).omega, 0.3);
  expect_consistent(t, 0, 4);
}

TEST(TableTrajectory, AStraightOneAtConstantVelocityIsThat) {
  const auto t = table({{0, 1, 2, 0.5}, {1, 3, 1, 0.5}, {3, 7, -1, 0.5}}, BeyondEnd::goes_on);
  for (const double at : {-2., 0., 0.7, 1., 2.2, 3., 11.}) {
    EXPECT_NEAR(t.at(at).x, 1 + 2 * at, 1e-12);
    EXPECT_NEAR(t.at(at).y, 2 - at, 1e-12);
    EXPECT_NEAR(t.at(at).vx, 2, 1e-12);
    EXPECT_NEAR(t.at(at).psi, 0.5, 1e-12);
  }
  EXPECT_NEAR(t.fastest(-1, 5).speed, std::sqrt(5), 1e-12);
}

TEST(TableTrajectory, BeyondItsEnds) {
  const std::vector<TrajectoryRow> rows = {{1, 0, 0}, {2, 3, 0}};
  const auto stands = table(rows, BeyondEnd::stands, BeyondEnd::stands);
  EXPECT_EQ(stands.at(0).x, 0);
  EXPECT_EQ(stands.at(0).vx, 0);
  EXPECT_EQ(stands.at(9).x, 3);
  EXPECT_EQ(stands.fastest(3, 9).speed, 0);
  EXPECT_TRUE(stands.present(-5, -4));
  const auto absent = table(rows, BeyondEnd::absent, BeyondEnd::absent);
  EXPECT_FALSE(absent.present(0, 0.9));
  EXPECT_TRUE(absent.present(0, 1));
  EXPECT_TRUE(absent.present(1.5, 1.5));
  EXPECT_TRUE(absent.present(2, 3));
  EXPECT_FALSE(absent.present(2.1, 3));
  const auto goes_on = table(rows, BeyondEnd::goes_on, BeyondEnd::goes_on);
  EXPECT_NEAR(goes_on.at(0).x, -3, 1e-12);
  EXPECT_NEAR(goes_on.at(4).x, 9, 1e-12);
  EXPECT_NEAR(goes_on.fastest(5, 6).speed, 3, 1e-12);
}

TEST(PathTrajectory, GoesAlongTheLineAndTurnsAboutItsCorners) {
  const PathTrajectory path({{0, 0}, {6, 0}, {6, 20}}, 2, 0, "there");
  EXPECT_EQ(path.at(-1).x, 0);
  EXPECT_EQ(path.at(-1).vx, 0);
  EXPECT_NEAR(path.at(1.5).x, 3, 1e-12);
  EXPECT_NEAR(path.at(4).y, 2, 1e-12);
  EXPECT_NEAR(path.at(4).vy, 2, 1e-12);
  // A quarter of 6 m before the corner it begins to turn, and has done so as far after it.
  EXPECT_NEAR(path.at(2.2).psi, 0, 1e-12);
  EXPECT_NEAR(path.at(3).psi, kPi / 4, 1e-12);
  EXPECT_NEAR(path.at(3.8).psi, kPi / 2, 1e-12);
  EXPECT_NEAR(path.at(3).omega, kPi / 2 / 1.5, 1e-12);
  // It stands at the end.
  EXPECT_EQ(path.at(100).y, 20);
  EXPECT_EQ(path.at(100).vy, 0);
  EXPECT_EQ(path.fastest(13.5, 20).speed, 0);
  EXPECT_EQ(path.fastest(12.5, 20).speed, 2);
  expect_consistent(path, -1, 15);
}

TEST(PathTrajectory, AcceleratesAndBrakesToAStand) {
  const PathTrajectory brakes({{0, 0}, {100, 0}}, 4, -1, "there");
  EXPECT_NEAR(brakes.at(2).x, 6, 1e-12);
  EXPECT_NEAR(brakes.at(2).vx, 2, 1e-12);
  EXPECT_NEAR(brakes.at(4).x, 8, 1e-12);
  EXPECT_NEAR(brakes.at(9).x, 8, 1e-12);
  expect_consistent(brakes, -1, 6);
  const PathTrajectory starts({{0, 0}, {0, 8}}, 0, 1, "there");
  EXPECT_NEAR(starts.at(4).y, 8, 1e-12);
  // It is fastest just before it stops at the end.
  EXPECT_NEAR(starts.fastest(3, 5).speed, 4, 1e-12);
  expect_consistent(starts, -1, 6);
}

TEST(OffsetTrajectory, IsAPointOfTheBody) {
  const auto base = std::make_shared<TableTrajectory>(winding());
  const OffsetTrajectory point(base, {-2, 1});
  for (const double t : {1.2, 2.2, 2.8, 5., 7., 9.}) {
    const Pose body = base->at(t), at = point.at(t);
    const Point place = body.to_world({-2, 1});
    EXPECT_NEAR(at.x, place.x, 1e-12);
    EXPECT_NEAR(at.y, place.y, 1e-12);
    EXPECT_EQ(at.psi, body.psi);
    expect_rates_of_places(point, t);
  }
  expect_consistent(point, 0, 10);
  const auto gone = std::make_shared<TableTrajectory>(
      table({{1, 0, 0}, {2, 1, 0}}, BeyondEnd::absent, BeyondEnd::absent));
  EXPECT_FALSE(OffsetTrajectory(gone, {1, 0}).present(3, 4));
}

TEST(TurningTrajectory, IsACircleOrALine) {
  const TurningTrajectory circle(2, {10, 0, kPi / 2, 0, 5, 0.5});  // radius 10 about the origin
  for (const double t : {-1., 2., 3.7, 2 + 4 * kPi}) {
    const double angle = 0.5 * (t - 2);
    EXPECT_NEAR(circle.at(t).x, 10 * std::cos(angle), 1e-12);
    EXPECT_NEAR(circle.at(t).y, 10 * std::sin(angle), 1e-12);
    EXPECT_NEAR(circle.at(t).psi, kPi / 2 + angle, 1e-12);
    expect_rates_of_places(circle, t);
  }
  expect_consistent(circle, 0, 5);
  const TurningTrajectory line(2, {10, 0, 0, 3, 5, 0});
  EXPECT_DOUBLE_EQ(line.at(4).x, 16);
  EXPECT_DOUBLE_EQ(line.at(4).y, 10);
}

template <class Make>
std::string refusal(const Make& make) {
  try {
    (void)make();
  } catch (const InvalidValue& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Trajectories, WhatIsNoneIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto of = [](std::vector<TrajectoryRow> rows) {
    return refusal([&] { return table(std::move(rows)); });
  };
  EXPECT_EQ(of({}),
            "there: found a table with 0 rows, expected two or more; an obstacle that stands needs "
            "no table");
  EXPECT_EQ(of({{1, 0, 0}}),
            "there: found a table with 1 row, expected two or more; an obstacle that stands needs "
            "no table");
  EXPECT_EQ(of({{0, 0, 0}, {1, 0, 0}, {1, 2, 0}}),
            "there: row 3: found t = 1 after 1, expected times that rise");
  EXPECT_EQ(of({{0, 0, 0}, {1, 0, 0}, {0.5, 2, 0}}),
            "there: row 3: found t = 0.5 after 1, expected times that rise");
  EXPECT_EQ(of({{0, 0, 0}, {1, nan, 0}}),
            "there: row 2: found NaN or infinity, expected finite numbers");
  const auto path = [](std::vector<Point> points, double speed, double acceleration) {
    return refusal([&] { return PathTrajectory(std::move(points), speed, acceleration, "there"); });
  };
  EXPECT_EQ(path({{0, 0}}, 1, 0), "there: found a path of 1 point, expected two or more");
  EXPECT_EQ(path({{0, 0}, {1, 1}, {1, 1}}, 1, 0),
            "there: found a path with points 2 and 3 at one place, expected places that differ");
  EXPECT_EQ(path({{0, 0}, {1, 1}}, 0, 0),
            "there: found a path at 0 m/s and 0 m/s^2, expected a speed, or an acceleration from "
            "rest");
  EXPECT_EQ(path({{0, 0}, {1, nan}}, 1, 0),
            "there: found NaN or infinity, expected finite numbers");
}

}  // namespace
}  // namespace slalom::world
