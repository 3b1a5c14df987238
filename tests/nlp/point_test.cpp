// A point of the interior-point method evaluates what it does not know, and no more.

#include "../../src/nlp/interior_point/point.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "../../src/nlp/interior_point/elastic_form.hpp"
#include "nlp/small_problems.hpp"

namespace slalom::nlp::ipm {
namespace {

/// Notes which parts it is asked for.
class Asked final : public SmallProblem {
 public:
  explicit Asked(SmallProblem problem) : SmallProblem(std::move(problem)) {}
  Fault evaluate(std::span<const double> x, double sigma, std::span<const double> y, Parts parts,
                 Evaluation& out) override {
    asked_ += parts.values ? "v" : "";
    asked_ += parts.derivatives ? "d" : "";
    asked_ += parts.hessian ? "h" : "";
    return SmallProblem::evaluate(x, sigma, y, parts, out);
  }
  /// Those since the last call: v(alues), d(erivatives), h(essian).
  std::string asked() { return std::exchange(asked_, {}); }

 private:
  std::string asked_;
};

class PointTest : public testing::Test {
 protected:
  /// What completing the point asks the problem for.
  std::string missing(Point& point) {
    EXPECT_TRUE(point.complete());
    return problem_.asked();
  }
  /// A point within the bounds, complete.
  Point complete(SlackForm& form) {
    const Vector inside{2, 3, 3, 2, 30};  // the last: slack of the inequality
    Point point(form);
    std::copy(inside.begin(), inside.end(), point.change_w().begin());
    EXPECT_TRUE(point.complete());
    problem_.asked();
    return point;
  }

  Asked problem_{hs071()};
  SlackForm form_{problem_};
};

TEST_F(PointTest, EvaluatesAllOnce) {
  Point point(form_);
  EXPECT_EQ(missing(point), "vdh");
  EXPECT_EQ(missing(point), "");
}

TEST_F(PointTest, EvaluatesWhatWasLeftOut) {
  Point point(form_);
  ASSERT_TRUE(point.evaluate({.values = true}));
  EXPECT_EQ(problem_.asked(), "v");
  ASSERT_TRUE(point.complete({.values = true, .derivatives = true}));
  EXPECT_EQ(problem_.asked(), "d");
  EXPECT_EQ(missing(point), "h");
}

TEST_F(PointTest, VariablesChangeEverything) {
  Point point = complete(form_);
  const double residual = point.residuals()[1], logs = point.log_slacks(),
               reciprocal = point.bounded().over_upper[0];
  point.change_w()[0] = 3;
  EXPECT_EQ(missing(point), "vdh");
  EXPECT_DOUBLE_EQ(point.residuals()[1] - residual, 5);  // of x1^2
  EXPECT_NE(point.log_slacks(), logs);
  EXPECT_NE(point.bounded().over_upper[0], reciprocal);
}

TEST_F(PointTest, SlacksChangeResidualsAlone) {
  Point point = complete(form_);
  const double residual = point.residuals()[0], violation = point.violation(),
               logs = point.log_slacks(), reciprocal = point.bounded().over_lower[4];
  point.change_slacks()[0] = 40;
  EXPECT_EQ(missing(point), "");
  EXPECT_DOUBLE_EQ(point.residuals()[0], residual - 10);
  EXPECT_NE(point.violation(), violation);
  EXPECT_NE(point.log_slacks(), logs);
  EXPECT_DOUBLE_EQ(1 / point.bounded().over_lower[4], 1 / reciprocal + 10);
}

TEST_F(PointTest, RowMultipliersChangeTheHessianAlone) {
  Point point = complete(form_);
  point.change_y()[0] = 2;
  EXPECT_EQ(missing(point), "h");
}

TEST_F(PointTest, BoundMultipliersChangeNothing) {
  Point point = complete(form_);
  point.change_zl()[0] = 2;
  point.change_zu()[0] = 2;
  EXPECT_EQ(missing(point), "");
}

TEST_F(PointTest, AnotherScaleChangesEverything) {
  Point point = complete(form_);
  const double residual = point.residuals()[1];
  form_.set_scale(1, std::vector<double>{1, 1});
  EXPECT_EQ(missing(point), "") << "the same scale";
  form_.set_scale(1, std::vector<double>{1, 0.5});
  EXPECT_EQ(missing(point), "vdh");
  EXPECT_DOUBLE_EQ(point.residuals()[1], residual / 2);
  form_.set_scale(3, std::vector<double>{1, 0.5});
  EXPECT_EQ(missing(point), "vdh");
}

TEST_F(PointTest, OtherLimitsChangeEverything) {
  Point point = complete(form_);
  const double logs = point.log_slacks(), reciprocal = point.bounded().over_lower[0];
  problem_.bounds.xl[0] = 0.5;
  problem_.finish();
  form_.refresh(problem_);
  EXPECT_NE(point.log_slacks(), logs);
  EXPECT_DOUBLE_EQ(1 / point.bounded().over_lower[0], 1 / reciprocal + 0.5);
  EXPECT_EQ(missing(point), "vdh");
}

TEST_F(PointTest, NothingIsKnownAfterAFault) {
  Point point = complete(form_);
  problem_.fault = [](const Vector&) { return Fault{"the objective", "", ""}; };
  EXPECT_FALSE(point.evaluate({.values = true}));
  problem_.fault = [](const Vector&) { return Fault{}; };
  problem_.asked();
  EXPECT_EQ(missing(point), "vdh");
}

TEST_F(PointTest, WhatIsKnownGoesAlong) {
  Point point = complete(form_), other(form_);
  Step step;
  step.resize(form_.primal(), form_.rows());
  step.w[0] = 2;
  other.change_zl()[0] = 7;
  other.set_along(point, step, 0.5, 0.5);
  EXPECT_DOUBLE_EQ(other.at().w[0], 3);
  EXPECT_EQ(missing(other), "vdh");
  point.swap_all_but_bounds(other);
  EXPECT_DOUBLE_EQ(point.at().w[0], 3);
  EXPECT_DOUBLE_EQ(point.at().zl[0], 0) << "its own";
  EXPECT_EQ(missing(point) + missing(other), "");
}

TEST_F(PointTest, TheWeightsOfAnElasticFormChangeItsObjectiveAlone) {
  ElasticForm form(problem_);
  form.set_violation_weight(1000);
  Point point = complete(form);
  const Vector reference{2, 3, 3, 4};
  form.set_reference(reference);
  form.set_proximity_weight(4);
  EXPECT_EQ(missing(point), "vd");
  EXPECT_DOUBLE_EQ(point.functions().objective, 0.5 * 4 * 4 / 16);  // D = 1 / 4
  EXPECT_DOUBLE_EQ(point.functions().gradient[3], -2.0 * 4 / 16);
}

}  // namespace
}  // namespace slalom::nlp::ipm
