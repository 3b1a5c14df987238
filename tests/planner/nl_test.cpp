// The planner's problem handed to another solver as a .nl file.

#include <gtest/gtest.h>

#include <cmath>

#include "nl_solver/nl_solver.hpp"
#include "planner/transcribed.hpp"
#include "slalom/nlp/check.hpp"

namespace slalom::planner {
namespace {

void expect_same_answer(const Scene& scene, const nlp::Options& options) {
  TranscribedScene transcribed(scene);
  const auto start = transcribed.straight_on(scene.first);
  const auto ours = nlp::make_solver()->solve(*transcribed.nlp, start, options);
  nlp::Options through = options;
  through.nl_solver = nl_solver();
  const auto theirs = nlp::make_solver("nl")->solve(*transcribed.nlp, start, through);
  ASSERT_EQ(ours.status, nlp::Status::solved);
  ASSERT_EQ(theirs.status, nlp::Status::solved) << theirs.message;
  EXPECT_NEAR(theirs.objective, ours.objective, 1e-6 * std::fabs(ours.objective));
  for (std::size_t i = 0; i < ours.point.x.size(); ++i)
    EXPECT_NEAR(theirs.point.x[i], ours.point.x[i], 3e-6 * (1 + std::fabs(ours.point.x[i])))
        << transcribed.nlp->variable_name(i);
  const auto residuals = nlp::check(*transcribed.nlp, theirs.point, options);
  EXPECT_TRUE(residuals.solved(options))
      << residuals.stationarity << " " << residuals.complementarity << " " << residuals.violation;
}

TEST(Nl, PlansAsByOurOwnMethod) {
  SLALOM_NEEDS_NL_SOLVER();
  for (const Scene& scene : {E_A(), E_C()}) expect_same_answer(scene, {});
}

TEST(NlFloor, PlansAtTheFloorAsByOurOwnMethod) {
  SLALOM_NEEDS_NL_SOLVER();
  nlp::Options options;
  options.floor = 0.9;
  options.dual_tol = 1e-6;
  options.floor_tol = 1e-7;
  for (const Scene& scene : {E_A(), E_C()}) expect_same_answer(scene, options);
}

}  // namespace
}  // namespace slalom::planner
