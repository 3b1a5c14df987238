#include "../../src/planner/corridor_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "slalom/ocp/scheme.hpp"
#include "slalom/ocp/transcription.hpp"

namespace slalom::planner {
namespace {

using vehicle::State;

/// The value of the first row of the family at the first point after the begin, for a vehicle
/// there.
struct Rows {
  ocp::Problem problem{"rows"};
  ocp::Expr x, y, psi;
  CorridorRows rows;

  explicit Rows(const world::Footprint& footprint)
      : x(problem.state("x")),
        y(problem.state("y")),
        psi(problem.state("psi")),
        rows(problem, x, y, psi, footprint) {}

  double least(const world::Road& road, const State& guess, const State& at, double margin) {
    rows.set(problem, road, {guess, guess}, {0, 1}, margin);
    double least = 1e9;
    for (const auto& family : problem.constraints()) {
      if (family.name != "road edge") continue;
      for (std::size_t m = 0; m < family.members.size(); ++m) {
        const auto n = family.numbers_at(m, 1);
        const double ahead = n.size() > 6 ? n[6] : 0;
        const double dx = at[vehicle::X] + ahead * std::cos(at[vehicle::PSI]) - n[0];
        const double dy = at[vehicle::Y] + ahead * std::sin(at[vehicle::PSI]) - n[1];
        least = std::min(least, n[2] * dx + n[3] * dy - n[4] * (dx * dx + dy * dy) / 2 - n[5]);
      }
    }
    return least;
  }
};

world::Road ring() {
  std::vector<world::RoadPoint> line;
  for (int k = 0; k < 72; ++k)
    line.push_back({40 * std::cos(k * M_PI / 36), 40 * std::sin(k * M_PI / 36), 4, 3});
  return {line, true, {}, "ring"};
}

/// On the ring at an angle and a distance from its middle, along it.
State on_ring(double angle, double r) {
  State state{};
  state[vehicle::X] = r * std::cos(angle);
  state[vehicle::Y] = r * std::sin(angle);
  state[vehicle::PSI] = angle + M_PI / 2;
  return state;
}

TEST(CorridorRows, AreTheDistanceToTheEdgeForAPoint) {
  const auto road = ring();
  Rows rows{world::Footprint(vehicle::Parameters{})};
  for (const double r : {37.5, 38., 40., 43., 43.8})
    for (const double along : {-0.2, 0., 0.25}) {  // of the guess [rad]: up to 10 m
      const State at = on_ring(1 + along, r);
      const double exact = road.edge_distance(world::Point{at[vehicle::X], at[vehicle::Y]});
      // The circle is the edge's own; only the distance is to second order.
      EXPECT_NEAR(rows.least(road, on_ring(1, 40), at, 0), exact, exact * exact / 60 + 5e-3);
    }
  EXPECT_NEAR(rows.least(road, on_ring(1, 40), on_ring(1, 43.5), 0.5), 0, 1e-2);
}

TEST(CorridorRows, HoldAllOfTheBody) {
  const auto road = ring();
  vehicle::Parameters car;
  car.footprint = vehicle::FootprintKind::rectangle;
  const world::Footprint footprint(car);
  Rows rows{footprint};
  int kept = 0, refused = 0;
  for (double r = 36; r < 45; r += 0.05)
    for (const double turned : {-0.2, 0., 0.2}) {
      State at = on_ring(1.05, r);
      at[vehicle::PSI] += turned;
      const double inside = footprint.edge_distance(road, at);
      const bool keeps = rows.least(road, on_ring(1, 40), at, 0) >= 0;
      if (keeps) EXPECT_GT(inside, -0.03) << r << " " << turned;
      // Nor do they ask for more than is needed.
      if (!keeps) EXPECT_LT(inside, 0.3) << r << " " << turned;
      ++(keeps ? kept : refused);
    }
  EXPECT_GT(kept, 100);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace slalom::planner
