// Rows that keep the vehicle off obstacles: of numbers that change along the mesh, too.

#include "../../src/planner/obstacle_rows.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "../../src/planner/obstacle_view.hpp"
#include "slalom/expr/function.hpp"
#include "slalom/planner/planner.hpp"

namespace slalom::planner {
namespace {

using ocp::Expr;
using world::BeyondEnd;
using world::Footprint;
using world::Obstacle;
using Kind = ObstacleRows::Kind;

Obstacle box(double length, double width) {
  Obstacle o{"box", 20, -3};
  o.outline = std::make_shared<world::Polygon>(world::Polygon::rectangle(length, width));
  o.a = o.b = o.outline->reach();
  o.psi = 0.4;
  return o;
}

Obstacle by_table(Obstacle o) {
  o.trajectory = std::make_shared<world::TableTrajectory>(
      std::vector<world::TrajectoryRow>{{0, 0, 0, 0}, {2, 10, 1, 0.5}, {4, 16, 8, 1.4}},
      BeyondEnd::stands, BeyondEnd::absent, "table");
  return o;
}

Footprint footprint(vehicle::FootprintKind kind) {
  vehicle::Parameters vehicle;
  vehicle.footprint = kind;
  return Footprint(vehicle);
}

/// The rows of a footprint as functions of the front axle's pose, the time and their numbers.
struct Rows {
  const Footprint footprint;
  const ObstacleRows rows;

  explicit Rows(vehicle::FootprintKind kind, double least_margin = 0.3)
      : footprint(planner::footprint(kind)), rows(footprint, least_margin, true) {}

  double operator()(const Obstacle& o, const vehicle::State& at, double t, double margin,
                    const ObstacleRows::Moment& moment) const {
    const Kind kind = ObstacleRows::kind_of(o);
    const Expr x = Expr::symbol("x"), y = Expr::symbol("y"), psi = Expr::symbol("psi"),
               time = Expr::symbol("t"), sm = Expr::symbol("sm");
    std::vector<Expr> in = {x, y, psi, time, sm};
    const auto symbols = rows.symbols(kind, true);
    in.insert(in.end(), symbols.begin(), symbols.end());
    const expr::Function row(
        in, {}, {rows.outside(kind, x - rows.x_at(time), y - rows.y_at(time), psi, sm, time)});
    std::vector<double> values = {at[0], at[1], at[vehicle::PSI], t, margin};
    const auto numbers = rows.numbers(o, moment, true);
    EXPECT_EQ(numbers.size(), symbols.size());
    EXPECT_EQ(rows.nowhere(kind, true).size(), symbols.size());
    EXPECT_EQ(rows.numbers(o, moment, false).size(), rows.symbols(kind, false).size());
    values.insert(values.end(), numbers.begin(), numbers.end());
    std::array<double, 1> out{};
    row(values, {}, out);
    return out[0];
  }
};

std::vector<Obstacle> bodies(const Footprint& footprint) {
  Obstacle egg{"egg", 2, 3, 2, 1};
  egg.psi = 0.6;
  Obstacle rock{"rock", -3, 4};
  rock.outline = std::make_shared<world::Polygon>(
      std::vector<world::Point>{{-1, -1}, {2, 0}, {0, 1.5}}, "rock");
  rock.a = rock.b = rock.outline->reach();
  Obstacle grown = box(3, 2).grown(0.4);
  return stand_ins({}, footprint,
                   {box(12, 1.8),
                    box(4.5, 1.8),
                    box(0.4, 0.4),
                    egg,
                    rock,
                    grown,
                    {"disc", 1, 2, 1.5, 1.5},
                    by_table(box(4.5, 1.8)),
                    by_table(egg)});
}

// At random poses and times, a row that is kept keeps the exact distance. Where it is asked about
// the moment itself, and of what goes straight at any other.
TEST(ObstacleRows, WhatKeepsThemKeepsTheDistance) {
  std::mt19937 draw(3);
  std::uniform_real_distribution<double> near(-6, 6), turn(-4, 4), when(0, 4), more(0, 2);
  for (const auto kind : {vehicle::FootprintKind::point, vehicle::FootprintKind::rectangle}) {
    const Rows rows(kind);
    for (auto o : bodies(rows.footprint)) {
      o.margin_start = 0.1;
      o.margin_rate = 0.2;
      int kept = 0, not_kept = 0;
      for (int k = 0; k < 400; ++k) {
        const double t = when(draw), margin = 0.3 + more(draw);
        const auto pose = o.pose_at(t);
        vehicle::State at{};
        at[0] = pose.x + near(draw);
        at[1] = pose.y + near(draw);
        at[vehicle::PSI] = turn(draw);
        const double row = rows(o, at, t, margin, {.t = t});
        const double d = rows.footprint.distance(o, at, t) - o.margin(t) - margin;
        if (row >= 0) {
          ++kept;
          EXPECT_GE(d, -1e-6) << o.name << " " << t;
        } else {
          ++not_kept;
          EXPECT_LE(d, 1) << o.name;
        }
      }
      EXPECT_GT(kept, 20) << o.name;
      EXPECT_GT(not_kept, 20) << o.name;
    }
  }
}

TEST(ObstacleRows, AboutAMomentABodyGoesOnAndTurns) {
  const vehicle::State at = {12, 1, 0, 0, 0.3};
  for (const auto kind : {vehicle::FootprintKind::point, vehicle::FootprintKind::rectangle}) {
    const Rows rows(kind);
    const auto o = by_table(box(4.5, 1.8));
    const double t = 1.3, dt = 1e-3;
    const double here = rows(o, at, t, 0.5, {.t = t});
    const double soon = rows(o, at, t + dt, 0.5, {.t = t + dt});
    const double from_here = rows(o, at, t + dt, 0.5, {.t = t});
    EXPECT_NEAR(from_here, soon, 1e-2 * std::fabs(soon - here)) << "to first order";
    EXPECT_GT(std::fabs(soon - here), 1e-5);
    EXPECT_NEAR(rows(o, at, t + 5, 0.5, {.t = t, .held = true}), here, 1e-12);
  }
}

TEST(ObstacleRows, WhatIsAbsentIsNotInTheWay) {
  const Rows rows(vehicle::FootprintKind::rectangle);
  const auto o = by_table(box(4.5, 1.8));
  const auto pose = o.pose_at(4);
  const vehicle::State at = {pose.x, pose.y};
  EXPECT_LT(rows(o, at, 4, 0.5, {.t = 4}), -0.5);
  EXPECT_GT(rows(o, at, 4.5, 0.5, {.t = 4.5}), 10);
  EXPECT_LT(rows(o, at, 4.5, 0.5, {.t = 4.5, .around = 0.6}), -0.5)
      << "it goes within the interval";
}

TEST(ObstacleRows, StandInsAreNoMoreThanTheyNeedBe) {
  const auto point = footprint(vehicle::FootprintKind::point);
  const auto car = footprint(vehicle::FootprintKind::rectangle);
  const Obstacle ellipse{"ellipse", 0, 0, 2, 1};
  const auto of = [](const Footprint& footprint, const Obstacle& o) {
    return stand_ins({}, footprint, {o});
  };
  EXPECT_EQ(ObstacleRows::kind_of(of(point, ellipse)[0]), Kind::round);
  EXPECT_TRUE(of(car, ellipse)[0].outline) << "the rectangle about it";
  EXPECT_FALSE(of(point, box(0.5, 0.5))[0].outline) << "a circle";
  Settings exact;  // it sticks out by .1 m
  exact.cover_excess = 0.05;
  EXPECT_TRUE(stand_ins(exact, point, {box(0.5, 0.5)})[0].outline);
  EXPECT_EQ(of(point, box(4.5, 1.8)).size(), 5u);
  EXPECT_EQ(of(point, box(8.5, 8.5)).size(), 2u);
  EXPECT_EQ(of(car, box(20, 1.8)).size(), 1u);
  EXPECT_EQ(ObstacleRows::counts(stand_ins({}, car, {ellipse, box(0.5, 0.5), box(9, 2)})),
            (ObstacleRows::Counts{1, 2, 0}));
  EXPECT_EQ(ObstacleRows::counts({by_table(box(9, 2))}), (ObstacleRows::Counts{0, 1, 1}));
}

}  // namespace
}  // namespace slalom::planner
