// How answers move with the numbers of their problems: closed forms, differences of answers, and
// what has no sensitivities.

#include "slalom/nlp/sensitivity.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "nlp/small_problems.hpp"

namespace slalom::nlp {
namespace {

Options tight(double floor = 0) {
  Options options;
  options.floor = floor;
  options.tol = options.dual_tol = options.constraint_tol = 1e-10;
  options.floor_tol = 1e-9;
  return options;
}

Answer solved(SmallProblem& problem, const Options& options, const std::string& backend = "") {
  Answer answer = make_solver(backend)->solve(problem, problem.cold_start(), options);
  EXPECT_EQ(answer.status, Status::solved);
  return answer;
}

Sensitivity sensitivity(SmallProblem& problem, const Answer& answer, const Options& options,
                        const Dependence& dependence) {
  Sensitivities all(problem);
  EXPECT_EQ(all.factorize(answer.point, options), Regularity::regular);
  Sensitivity result;
  EXPECT_TRUE(all.solve(dependence, result));
  return result;
}

/// min c x + q/2 x^2 with x >= l at a floor: c + q x = mu / (x - l).
TEST(NlpSensitivity, OfACentralPointInClosedForm) {
  const double c = -1, q = 2, mu = 0.3, l = 0.4;
  auto problem = one_variable(c, q, l, kInf, 1);
  const auto answer = solved(problem, tight(mu));
  const double x = answer.point.x[0], curvature = q + mu / ((x - l) * (x - l));
  auto by_c = no_dependence(problem.structure());
  by_c.gradient[0] = 1;
  by_c.objective = x;
  const auto s = sensitivity(problem, answer, tight(mu), by_c);
  EXPECT_NEAR(s.point.x[0], -1 / curvature, 1e-8);
  EXPECT_NEAR(s.point.zl[0], mu / ((x - l) * (x - l)) / curvature, 1e-8);
  EXPECT_NEAR(s.objective, x - (c + q * x) / curvature, 1e-8);
  auto by_l = no_dependence(problem.structure());
  by_l.limits.xl[0] = 1;
  const auto t = sensitivity(problem, answer, tight(mu), by_l);
  EXPECT_NEAR(t.point.x[0], mu / ((x - l) * (x - l)) / curvature, 1e-8);
  EXPECT_NEAR(t.point.zl[0], q * t.point.x[0], 1e-8);  // z = c + q x
}

/// The same bound as a row, and both sides of a row.
TEST(NlpSensitivity, OfRowsAtAFloor) {
  const double c = -1, q = 2, mu = 0.3;
  for (const double upper : {kInf, 3.0}) {
    auto problem = one_variable(c, q, -kInf, kInf, 0.5, 2, 0.8, upper);  // 0.8 <= 2 x <= upper
    const auto answer = solved(problem, tight(mu));
    const double g = 2 * answer.point.x[0], below = mu / ((g - 0.8) * (g - 0.8)),
                 above = std::isinf(upper) ? 0 : mu / ((upper - g) * (upper - g));
    auto by_lower = no_dependence(problem.structure());
    by_lower.limits.gl[0] = 1;
    const auto s = sensitivity(problem, answer, tight(mu), by_lower);
    EXPECT_NEAR(s.point.x[0], 2 * below / (q + 4 * (below + above)), 1e-7);
    EXPECT_NEAR(s.point.y[0], -q / 2 * s.point.x[0], 1e-7);  // c + q x + 2 y = 0
    auto by_row = no_dependence(problem.structure());        // the row is 2 x + p
    by_row.rows[0] = 1;
    const auto t = sensitivity(problem, answer, tight(mu), by_row);
    EXPECT_NEAR(t.point.x[0], -2 * (below + above) / (q + 4 * (below + above)), 1e-7);
  }
}

/// A row's slack may be as small as what its value is known to: its multiplier says what it is.
TEST(NlpSensitivity, OfARowWhoseSlackIsHardlyKnown) {
  const double c = -1, q = 2, mu = 2e-6;
  for (const double lower : {-kInf, -1.0}) {
    auto problem = one_variable(c, q, -kInf, kInf, 0.1, 1, lower, 0.2);
    auto answer = solved(problem, tight(mu));  // the slack is mu / .6
    auto p = no_dependence(problem.structure());
    p.gradient[0] = 1;
    const double exact = sensitivity(problem, answer, tight(mu), p).point.x[0];
    answer.point.x[0] += 8e-7;
    Options loose;
    loose.floor = mu;
    EXPECT_NEAR(sensitivity(problem, answer, loose, p).point.x[0], exact, 1e-3 * std::fabs(exact));
  }
}

/// d objective/dp as the envelope theorem has it without a floor: of the Lagrangian, x and all
/// multipliers held (Fiacco 1983, section 3.4).
double envelope(const Dependence& p, const Start& at) {
  double slope = p.objective;
  for (std::size_t i = 0; i < at.x.size(); ++i)
    slope += at.zl[i] * p.limits.xl[i] - at.zu[i] * p.limits.xu[i];
  for (std::size_t r = 0; r < at.y.size(); ++r)
    slope += at.y[r] * (p.rows[r] - (at.y[r] < 0 ? p.limits.gl[r] : p.limits.gu[r]));
  return slope;
}

/// HS071's numbers, by differences of its answers.
class Hs071 {
 public:
  explicit Hs071(Options options, Vector variable_scale = {}, Vector row_scale = {})
      : options_(options),
        variable_scale_(std::move(variable_scale)),
        row_scale_(std::move(row_scale)) {}

  SmallProblem with(double product, double sum, double lower, double linear) const {
    auto problem = hs071();
    problem.bounds.gl = {product, sum};
    problem.bounds.gu[1] = sum;
    problem.bounds.xl[0] = lower;
    const auto plain = problem.objective;
    const auto slope = problem.gradient;
    problem.objective = [=](const Vector& x) { return plain(x) + linear * x[2]; };
    problem.gradient = [=](const Vector& x) {
      Vector g = slope(x);
      g[2] += linear;
      return g;
    };
    problem.finish(variable_scale_, row_scale_);
    return problem;
  }
  const Vector& variable_scale() const { return variable_scale_; }
  const Vector& row_scale() const { return row_scale_; }
  const Options& options() const { return options_; }

 private:
  Options options_;
  Vector variable_scale_, row_scale_;
};

void compare_with_differences(const Hs071& form) {
  const double base[] = {25, 40, 1, 0};
  auto problem = form.with(25, 40, 1, 0);
  const auto answer = solved(problem, form.options());
  for (int which = 0; which < 4; ++which) {
    SCOPED_TRACE(which);
    auto p = no_dependence(problem.structure());
    const double row = form.row_scale().empty() ? 1 : form.row_scale()[which % 2];
    const double variable = form.variable_scale().empty() ? 1 : form.variable_scale()[0];
    const double third = form.variable_scale().empty() ? 1 : form.variable_scale()[2];
    if (which == 0) p.limits.gl[0] = row;
    if (which == 1) p.limits.gl[1] = p.limits.gu[1] = row;
    if (which == 2) p.limits.xl[0] = 1 / variable;
    if (which == 3) {
      p.gradient[2] = third;
      p.objective = answer.point.x[2] * third;
    }
    const auto s = sensitivity(problem, answer, form.options(), p);
    constexpr double h = 1e-4;
    Answer at[2];
    for (const int side : {0, 1}) {
      double numbers[] = {base[0], base[1], base[2], base[3]};
      numbers[which] += side == 0 ? -h : h;
      auto moved = form.with(numbers[0], numbers[1], numbers[2], numbers[3]);
      at[side] = solved(moved, form.options());
    }
    const auto compare = [&](const Vector& rates, const Vector& low, const Vector& high) {
      for (std::size_t i = 0; i < rates.size(); ++i)
        EXPECT_NEAR(rates[i], (high[i] - low[i]) / (2 * h), 2e-5 * (1 + std::fabs(rates[i]))) << i;
    };
    compare(s.point.x, at[0].point.x, at[1].point.x);
    compare(s.point.y, at[0].point.y, at[1].point.y);
    compare(s.point.zl, at[0].point.zl, at[1].point.zl);
    compare(s.point.zu, at[0].point.zu, at[1].point.zu);
    EXPECT_NEAR(s.objective, (at[1].objective - at[0].objective) / (2 * h), 1e-5);
    if (form.options().floor == 0) EXPECT_NEAR(s.objective, envelope(p, answer.point), 1e-6);
  }
}

TEST(NlpSensitivity, AgreesWithDifferencesOfAnswers) {
  for (const double floor : {0.0, 0.01, 0.5}) {
    SCOPED_TRACE(floor);
    compare_with_differences(Hs071(tight(floor)));
    compare_with_differences(Hs071(tight(floor), {0.5, 20, 3, 0.1}, {0.04, 2}));
  }
}

TEST(NlpSensitivity, IsKnownOfEveryBackEndsAnswers) {
  auto problem = hs071();
  auto p = no_dependence(problem.structure());
  p.limits.gl[0] = 1;
  for (const auto& backend : backends()) {
    SCOPED_TRACE(backend);
    const auto answer = solved(problem, {}, backend);
    const auto s = sensitivity(problem, answer, {}, p);
    EXPECT_NEAR(s.objective, -answer.point.y[0], 1e-5);  // the envelope theorem
  }
}

/// x1 is fixed: the others follow it.
TEST(NlpSensitivity, OfFixedVariables) {
  auto problem = hs071();
  problem.bounds.xl[0] = problem.bounds.xu[0] = 1.1;
  problem.start[0] = 1.1;
  problem.finish();
  const auto answer = solved(problem, tight());
  auto p = no_dependence(problem.structure());
  p.limits.xl[0] = p.limits.xu[0] = 1;
  const auto s = sensitivity(problem, answer, tight(), p);
  constexpr double h = 1e-4;
  Answer at[2];
  for (const int side : {0, 1}) {
    auto moved = hs071();
    moved.bounds.xl[0] = moved.bounds.xu[0] = moved.start[0] = 1.1 + (side == 0 ? -h : h);
    moved.finish();
    at[side] = solved(moved, tight());
  }
  EXPECT_EQ(s.point.x[0], 1);
  for (std::size_t i = 1; i < 4; ++i)
    EXPECT_NEAR(s.point.x[i], (at[1].point.x[i] - at[0].point.x[i]) / (2 * h), 1e-5);
  EXPECT_NEAR(s.objective, (at[1].objective - at[0].objective) / (2 * h), 1e-5);
}

TEST(NlpSensitivity, NamesWhatIsNotDetermined) {
  SmallProblem problem;  // min (x1 - 1)^2; nothing is said of x2
  problem.objective = [](const Vector& x) { return (x[0] - 1) * (x[0] - 1); };
  problem.gradient = [](const Vector& x) { return Vector{2 * (x[0] - 1), 0}; };
  problem.hessian = [](const Vector&, double s, const Vector&) { return Vector{2 * s, 0, 0}; };
  problem.bounds = {{-kInf, -kInf}, {kInf, kInf}, {}, {}};
  problem.start = {0, 0};
  problem.finish();
  const auto answer = solved(problem, {});
  Sensitivities all(problem);
  EXPECT_EQ(all.factorize(answer.point, {}), Regularity::irregular);
  EXPECT_EQ(all.undetermined(), "x2");
}

TEST(NlpSensitivity, NamesRowsThatDependOnEachOther) {
  auto problem = one_variable(0, 1, -kInf, kInf, 0);
  problem.rows = [](const Vector& x) { return Vector{x[0], 2 * x[0]}; };
  problem.jacobian = [](const Vector&) { return Vector{1, 2}; };
  problem.bounds.gl = problem.bounds.gu = {1, 2};
  problem.finish();
  const auto answer = solved(problem, {});
  Sensitivities all(problem);
  EXPECT_EQ(all.factorize(answer.point, {}), Regularity::irregular);
  EXPECT_NE(all.undetermined().find("row"), std::string::npos);
}

TEST(NlpSensitivity, SaysWhereAPointIsNoMinimum) {
  auto problem = one_variable(0, -1, -1, 1, 0);
  Sensitivities all(problem);
  EXPECT_EQ(all.factorize({{0}, {}, {0}, {0}}, {}), Regularity::irregular);
  EXPECT_EQ(all.undetermined(), "x1");
}

}  // namespace
}  // namespace slalom::nlp
