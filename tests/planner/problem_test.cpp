// The OCP of section 3 itself: its published first solutions, and which rows and terms it has.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../../src/planner/trajectory_problem.hpp"
#include "planner/scenes.hpp"
#include "slalom/nlp/check.hpp"
#include "slalom/ocp/solve.hpp"
#include "slalom/ocp/transcription.hpp"

namespace slalom::planner {
namespace {

TrajectoryProblem problem_of(const Scene& scene, bool in_range) {
  TrajectoryProblem problem(scene, scene.obstacles, in_range);
  problem.update(scene.first);
  return problem;
}

/// Names of rows and cost terms on the scene's mesh.
struct Names {
  std::vector<std::string> rows, terms;

  Names(const Scene& scene, bool in_range) {
    const auto problem = problem_of(scene, in_range);
    ocp::Transcription t(problem.problem(), ocp::Mesh::uniform(scene.planner.N),
                         ocp::trapezoidal());
    for (std::size_t r = 0; r < t.structure().rows; ++r) rows.push_back(t.row_name(r));
    for (const auto& [name, value] : t.cost_terms(t.point(t.straight_guess())))
      terms.push_back(name);
  }
  std::size_t rows_with(const std::string& part) const {
    return static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), [&](const auto& row) {
      return row.find(part) != std::string::npos;
    }));
  }
  bool has_term(const std::string& name) const {
    return std::find(terms.begin(), terms.end(), name) != terms.end();
  }
};

struct Published {
  const char* name;
  Scene scene;
  double f, tf, x, y, phi;
};

// Section 6 of docs/formulation.md: two independent programs, solved to 1e-9.
TEST(FirstOcp, PublishedSolutionsToAllPrintedDigits) {
  const Published cases[] = {
      {"E_A P_B", E_A(), 271.6379, 2.515208, 196.49608, 53.46048, -157.7753},
      {"E_C P_D", E_C(), 909.7726, 4.179134, 7.68836, 88.55504, -1932.5254},
  };
  for (const auto& c : cases)
    for (const auto solver : solvers()) {
      const std::string backend = to_string(solver);
      SCOPED_TRACE(std::string(c.name) + " with " + backend);
      const auto problem = problem_of(c.scene, false);
      ocp::SolveSettings settings{.mesh = ocp::Mesh::uniform(c.scene.planner.N),
                                  .scheme = ocp::trapezoidal(),
                                  .backend = backend};
      settings.options.floor = 0.8;
      settings.options.dual_tol = 1e-8;
      settings.options.floor_tol = 1e-8;
      settings.options.constraint_tol = 1e-9;
      const State& X0p = c.scene.first.X0p;
      State end = X0p;
      end[vehicle::Y] += 40;
      settings.guess = {0,
                        3,
                        {0, 1},
                        {{X0p.begin(), X0p.end()}, {end.begin(), end.end()}},
                        {{0, 0}, {0, 0}},
                        {},
                        std::vector<double>(8, 0.004)};
      const ocp::Solution solution = ocp::solve(problem.problem(), settings);
      ASSERT_EQ(solution.status, nlp::Status::solved);
      EXPECT_NEAR(solution.objective, c.f, 0.6e-4);
      EXPECT_NEAR(solution.tf(), c.tf, 0.6e-6);
      EXPECT_NEAR(solution.state("x").back(), c.x, 0.6e-5);
      EXPECT_NEAR(solution.state("y").back(), c.y, 0.6e-5);
      EXPECT_NEAR(solution.residuals.phi, c.phi, 0.6e-4);
    }
}

TEST(Rows, OutOfTheGoalsRangeThereIsTheLidarsEdgeAndNoGoal) {
  const Names names(E_A(), false);
  EXPECT_EQ(names.rows_with("initial"), 16u + 2u);  // two a state; copies of initial(x), initial(y)
  EXPECT_EQ(names.rows_with("from below"), 8u);
  EXPECT_EQ(names.rows_with("ax above ax_min"), 11u) << "at every node, the first included";
  EXPECT_EQ(names.rows_with("ax below ax_max"), 11u);
  EXPECT_EQ(names.rows_with("wheel load"), 44u);
  EXPECT_EQ(names.rows_with("obstacle["), 30u) << "after the first node";
  EXPECT_EQ(names.rows_with("obstacle[O2] at node 0"), 0u);
  EXPECT_EQ(names.rows_with("LiDAR region"), 10u);
  EXPECT_EQ(names.rows_with("LiDAR edge"), 2u) << "the outer one beside the region's last row";
  EXPECT_EQ(names.rows_with("goal"), 0u);
  EXPECT_EQ(names.rows_with("defect"), 80u);
  EXPECT_EQ(names.rows.size(), 18u + 22 + 44 + 30 + 10 + 2 + 80);
}

TEST(Rows, WithinItsRangeThereIsTheGoalAndNoEdge) {
  const Names names(E_A(), true);
  EXPECT_EQ(names.rows_with("LiDAR region"), 10u);
  EXPECT_EQ(names.rows_with("LiDAR edge"), 0u);
  EXPECT_EQ(names.rows_with("goal"), 4u);
  EXPECT_EQ(names.rows.size(), 18u + 22 + 44 + 30 + 10 + 4 + 80);
}

TEST(Rows, OptionalOnesAreAbsentByDefault) {
  Scene scene = E_A();
  EXPECT_EQ(Names(scene, false).rows_with("tyre force"), 0u);
  scene.planner.tyre_force_limit = 7500;
  EXPECT_EQ(Names(scene, false).rows_with("tyre force"), 22u);
  scene.obstacles.clear();
  EXPECT_EQ(Names(scene, false).rows_with("obstacle"), 0u);
}

TEST(CostTerms, OfWeightZeroAreAbsent) {
  using Terms = std::vector<std::string>;
  Scene scene = E_A();
  EXPECT_EQ(Names(scene, false).terms,
            (Terms{"final_time", "goal", "wheel_load", "heading_area", "initial_slack"}));
  EXPECT_EQ(Names(scene, true).terms,
            (Terms{"final_time", "wheel_load", "heading_area", "initial_slack", "final_slack"}));
  scene.planner.w_t = 0;  // P_A
  EXPECT_FALSE(Names(scene, false).has_term("final_time"));
  scene.planner.w_ce = 1;
  EXPECT_TRUE(Names(scene, false).has_term("control_effort"));
  EXPECT_FALSE(Names(scene, false).has_term("acceleration"));
  scene.planner.w_ax = 0.1;
  scene.planner.w_psi = 0.1;
  EXPECT_TRUE(Names(scene, false).has_term("acceleration"));
  EXPECT_TRUE(Names(scene, false).has_term("heading"));
  scene.planner.w_g = scene.planner.w_Fz = scene.planner.w_haf = 0;
  for (const char* term : {"goal", "wheel_load", "heading_area"})
    EXPECT_FALSE(Names(scene, false).has_term(term)) << term;
}

/// The cost terms of section 3 written out a second time, at a straight plan of known states.
TEST(CostTerms, AreTheFormulationsOnes) {
  Scene scene = E_C();
  scene.planner.w_ax = 0.1;
  scene.planner.w_ic = 70;
  const auto problem = problem_of(scene, false);
  const int N = scene.planner.N;
  ocp::Transcription t(problem.problem(), ocp::Mesh::uniform(N), ocp::trapezoidal());
  const double tf = 4;
  const State from{6, 8, 0.2, 0.05, 1.5, 0.02, 17, 0.4}, to{9, 90, -0.1, 0.1, 1.7, -0.01, 20, 0.2};
  const std::vector<double> slack{.01, .02, .03, .004, .05, .006, .07, .08};
  const std::vector<double> u0{0.03, 1}, u1{-0.02, -2};
  const auto x = t.point(
      {0, tf, {0, 1}, {{from.begin(), from.end()}, {to.begin(), to.end()}}, {u0, u1}, {}, slack});
  const reference::HMMWV model;
  double effort = 0, load = 0, area = 0, ax = 0;
  for (int k = 0; k <= N; ++k) {
    const double s = static_cast<double>(k) / N, weight = tf / N * (k == 0 || k == N ? 0.5 : 1);
    State X{};
    for (std::size_t i = 0; i < 8; ++i) X[i] = from[i] + s * (to[i] - from[i]);
    const double sr = u0[0] + s * (u1[0] - u0[0]), jx = u0[1] + s * (u1[1] - u0[1]);
    const auto f = model.forces(X);
    effort += weight * (0.1 * X[5] * X[5] + sr * sr + 0.01 * jx * jx);
    load += weight * 0.5 * (std::tanh(-(f.rl - 1300) / 100) + std::tanh(-(f.rr - 1300) / 100));
    area += weight * (X[0] - 18) * (X[0] - 18);  // psi_g = pi/2
    ax += weight * 0.1 * X[7] * X[7];
  }
  const double w[] = {1, 1, 10, 10, 10, 2, 0.1, 0.1};
  double slacks = 0;
  for (std::size_t i = 0; i < 8; ++i) slacks += 70 * w[i] * slack[i];
  const double goal = 10 * (81 + 610 * 610) / (144 + 692 * 692 + 0.01);
  const std::pair<const char*, double> expected[] = {
      {"final_time", 400},      {"goal", goal},         {"control_effort", effort},
      {"wheel_load", load},     {"heading_area", area}, {"acceleration", ax},
      {"initial_slack", slacks}};
  const auto terms = t.cost_terms(x);
  ASSERT_EQ(terms.size(), std::size(expected));
  for (const auto& [name, value] : expected) {
    const auto it = std::find_if(terms.begin(), terms.end(),
                                 [&](const auto& term) { return name == term.first; });
    ASSERT_NE(it, terms.end()) << name;
    EXPECT_NEAR(it->second, value, 1e-9 * std::max(1.0, std::fabs(value))) << name;
  }
}

TEST(CostTerms, OfBeingOffTheGoalIsByItsWeight) {
  Scene scene = E_C();
  scene.planner.w_xf = 30;
  const auto problem = problem_of(scene, true);
  ocp::Transcription t(problem.problem(), ocp::Mesh::uniform(scene.planner.N), ocp::trapezoidal());
  const std::vector<double> slack{0, 0, 0, 0, 0, 0, 0, 0, 0.3, 0.4}, none(8, 0.), u{0, 0};
  const auto terms = t.cost_terms(t.point({0, 4, {0, 1}, {none, none}, {u, u}, {}, slack}));
  const auto found = std::find_if(terms.begin(), terms.end(),
                                  [](const auto& term) { return term.first == "final_slack"; });
  ASSERT_NE(found, terms.end());
  EXPECT_NEAR(found->second, 30 * 0.7, 1e-12);
}

}  // namespace
}  // namespace slalom::planner
