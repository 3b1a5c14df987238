// Families whose members have numbers of their own at each point of the mesh.

#include <gtest/gtest.h>

#include "../../src/ocp/point_functions.hpp"
#include "ocp/messages.hpp"
#include "slalom/ocp/errors.hpp"
#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/refine.hpp"
#include "slalom/ocp/solve.hpp"
#include "slalom/ocp/transcription.hpp"

namespace slalom::ocp {
namespace {

using test::refusal;

/// x' = u, and walls a to the left of x, b times as thick.
struct Walls {
  Problem problem{"walls"};
  Expr x = problem.state("x", {-10, 10});
  Expr u = problem.control("u", {-1, 1});
  Expr a = Expr::symbol("a"), b = Expr::symbol("b");
  ConstraintId walls = problem.path_family("wall", {a, b}, x - a * b, Bounds::at_least(0));
  Walls() { problem.dynamics(x, u); }

  /// The values of a member's rows at x = 5.
  static std::vector<double> rows(Transcription& t, const std::string& member) {
    const Trajectory guess{0, 1, {0, 1}, {{5}, {5}}, {{0}, {0}}, {}, {}};
    nlp::Evaluation at;
    EXPECT_FALSE(t.evaluate(t.point(guess), 1, {}, {.values = true}, at));
    std::vector<double> values;
    for (std::size_t r = 0; r < t.structure().rows; ++r)
      if (t.row_name(r).find("wall[" + member + "]") != std::string::npos)
        values.push_back(at.rows[r] / t.structure().row_scale[r]);
    return values;
  }
};

TEST(FamilyPoints, EachPointHasItsOwnNumbers) {
  for (const Scheme& scheme : {trapezoidal(), hermite_simpson()}) {
    Walls w;
    w.problem.set_members(w.walls, {"same", "other"}, {{1, 1}, {2, 2}});
    Transcription t(w.problem, Mesh::uniform(2), scheme);
    const std::size_t points = Walls::rows(t, "same").size();
    ASSERT_GE(points, 3u);
    std::vector<double> numbers, expected;
    for (std::size_t k = 0; k < points; ++k) {
      numbers.insert(numbers.end(), {static_cast<double>(k), 0.5});
      expected.push_back(5 - 0.5 * static_cast<double>(k));
    }
    w.problem.set_members(w.walls, {"same", "other"}, {{1, 1}, numbers});
    t.update(w.problem);
    EXPECT_EQ(Walls::rows(t, "same"), std::vector<double>(points, 4));
    EXPECT_EQ(Walls::rows(t, "other"), expected);
    Transcription fresh(w.problem, Mesh::uniform(2), scheme);
    EXPECT_EQ(Walls::rows(fresh, "other"), expected);
  }
}

TEST(FamilyPoints, AsManyAsTheMeshHas) {
  Walls w;
  w.problem.set_members(w.walls, {"wall"}, {{1, 1, 2, 2}});
  EXPECT_EQ(
      refusal([&] { Transcription(w.problem, Mesh::uniform(2), trapezoidal()); }),
      "walls: family wall[wall]: found numbers for 2 points, expected one for each symbol, or "
      "for each of the mesh's 3 points");
  w.problem.set_members(w.walls, {"wall"}, {{1, 1, 2, 2, 3, 3}});
  EXPECT_EQ(refusal([&] { Transcription(w.problem, Mesh::uniform(2), trapezoidal()); }),
            "accepted");
}

TEST(FamilyPoints, AreNotKnownBetweenPoints) {
  Walls w;
  w.problem.set_members(w.walls, {"wall"}, {{1, 1, 2, 2, 3, 3}});
  const Trajectory at{0, 1, {0, 1}, {{5}, {5}}, {{0}, {0}}, {}, {}};
  EXPECT_EQ(refusal([&] { (void)PointFunctions(w.problem, at).rows(); }),
            "walls: family wall: found numbers at the points of a mesh, expected numbers that hold "
            "between points too");
  std::vector<double> rates(1);
  const std::vector<double> x{5}, u{0};
  PointFunctions(w.problem, at).rates(0.5, x, u, rates);  // which need none
}

TEST(FamilyPoints, DoNotHinderErrorEstimates) {
  Walls w;
  w.problem.set_members(w.walls, {"wall"}, {{1, 1, 2, 1, 1, 1}});
  w.problem.path("low", w.x, Bounds::at_most(4));
  w.problem.initial_bounds(w.x, Bounds::equal(1.8));
  w.problem.lagrange("effort", square(w.u));
  const SolveSettings start{.mesh = Mesh::uniform(2), .scheme = trapezoidal()};
  const Solution solution = solve(w.problem, start);
  ASSERT_TRUE(solution.solved());
  EXPECT_EQ(estimate_errors(w.problem, solution).interval.size(), 2u);
  EXPECT_EQ(refine(w.problem, start, {.max_meshes = 1}).status, RefineStatus::mesh_limit);
}

}  // namespace
}  // namespace slalom::ocp
