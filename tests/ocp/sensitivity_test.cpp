// How answers move with the numbers of their problems: by closed forms, and by differences of
// answers to problems with other numbers.

#include "slalom/ocp/sensitivity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "ocp/closed_forms.hpp"
#include "ocp/everything.hpp"
#include "ocp/messages.hpp"

namespace slalom::ocp {
namespace {

using test::refusal;

nlp::Options tight(double floor = 0) {
  nlp::Options options;
  options.floor = floor;
  options.tol = options.constraint_tol = 1e-10;
  options.dual_tol = floor > 0 ? 1e-9 : 1e-5;
  options.floor_tol = 1e-9;
  return options;
}

TEST(Sensitivity, IsKnownOfEveryBackEndsAnswers) {
  const auto form = bryson_denham(1.0 / 9);
  for (const std::string& backend : nlp::backends()) {
    SCOPED_TRACE(backend);
    const Solution s = solve(form.problem, {.backend = backend});
    EXPECT_NEAR(Sensitivities(form.problem, s)("upper x").objective, -36, 0.2);
  }
}

TEST(Sensitivity, OfTheLinearRegulatorToItsStart) {
  const auto form = regulator();
  const Solution s = solve(form.problem, {.options = tight()});
  const Sensitivity by_start = Sensitivities(form.problem, s)("initial x");
  EXPECT_NEAR(by_start.objective, std::tanh(1), 1e-7);
  for (std::size_t k = 0; k < s.time().size(); ++k) {
    const double t = s.time()[k];
    EXPECT_NEAR(by_start.state("x")[k], std::cosh(1 - t) / std::cosh(1), 1e-7);
    EXPECT_NEAR(by_start.control("u")[k], -std::sinh(1 - t) / std::cosh(1), 1e-4);
    EXPECT_NEAR(by_start.control("u")[k], s.control("u")[k], 1e-8);  // all is linear in x(0) = 1
  }
  EXPECT_EQ(by_start.tf(), 0);
  EXPECT_EQ(by_start.number, "initial x");
}

/// J = 4 / (9 l), also by the envelope theorem: minus the sum of the bound's multipliers.
TEST(Sensitivity, OfBrysonDenhamToItsBound) {
  const double l = 1.0 / 9;
  const auto form = bryson_denham(l);
  const Solution s = solve(form.problem, {.mesh = Mesh::uniform(90), .options = tight()});
  const Sensitivity by_bound = Sensitivities(form.problem, s)("upper x");
  EXPECT_NEAR(by_bound.objective, -4 / (9 * l * l), 0.01);
  double envelope = 0;
  for (const double each : s.multiplier("x").values) envelope -= each;
  const auto& fixed = s.multiplier("x").values;  // of the ends: not of this bound
  envelope += fixed.front() + fixed.back();
  EXPECT_NEAR(by_bound.objective, envelope, 1e-5 * std::fabs(envelope));
  for (std::size_t k = 1; k + 1 < s.time().size(); ++k)
    if (s.multiplier("x").values[k] > 1) EXPECT_NEAR(by_bound.state("x")[k], 1, 1e-5) << k;
}

/// tf = 2 sqrt(X), of whatever mesh: the discretised problem scales alike.
TEST(Sensitivity, OfTheLeastTimeToTheWay) {
  const auto form = least_time();
  for (const auto& scheme : {hermite_simpson(), lgr(4), backward_euler()}) {
    const Solution s = solve(form.problem, {.scheme = scheme, .options = tight()});
    const Sensitivity by_way = Sensitivities(form.problem, s)("final x");
    EXPECT_NEAR(by_way.tf(), s.tf() / 2, 1e-6);
    EXPECT_NEAR(by_way.objective, by_way.tf(), 1e-12);
    EXPECT_NEAR(by_way.state("x").back(), 1, 1e-12);
    EXPECT_NEAR(by_way.control("u").front(), 0, 1e-6);  // on its bound
    const Sensitivity by_most = Sensitivities(form.problem, s)("upper u");
    EXPECT_NEAR(by_most.control("u").front(), 1, 0.02);  // where the multiplier is small, less
    EXPECT_LT(by_most.tf(), 0);
  }
}

/// Compares with central differences of the answers to problems with other numbers.
class Differences {
 public:
  Differences(Problem problem, SolveSettings settings, double step, double tolerance)
      : problem_(std::move(problem)),
        settings_(std::move(settings)),
        step_(step),
        tolerance_(tolerance),
        answer_(solved(problem_, {})),
        sensitivities_(problem_, answer_) {}

  void compare(const Change& change) const {
    SCOPED_TRACE(change.number);
    const Sensitivity s = sensitivities_(change.number);
    const Solution low = beside(change, -step_), high = beside(change, step_);
    close("objective", s.objective, low.objective, high.objective);
    const auto &r = s.trajectory, &a = low.trajectory, &b = high.trajectory;
    close("t0", r.t0, a.t0, b.t0);
    close("tf", r.tf, a.tf, b.tf);
    for (std::size_t k = 0; k < r.tau.size(); ++k) {
      const std::string at = " at " + std::to_string(k);
      close("states" + at, r.states[k], a.states[k], b.states[k]);
      close("controls" + at, r.controls[k], a.controls[k], b.controls[k]);
    }
    close("static parameters", r.static_parameters, a.static_parameters, b.static_parameters);
    close("slacks", r.slacks, a.slacks, b.slacks);
    close("integrals", r.integrals, a.integrals, b.integrals);
    for (std::size_t m = 0; m < s.multipliers.size(); ++m)
      close("multiplier of " + s.multipliers[m].name, s.multipliers[m].values,
            low.multipliers[m].values, high.multipliers[m].values);
  }

 private:
  Solution solved(const Problem& problem, const nlp::Start& warm) const {
    SolveSettings settings = settings_;
    settings.warm_start = warm;
    Solution solution = solve(problem, settings);
    EXPECT_TRUE(solution.solved()) << nlp::to_string(solution.status);
    return solution;
  }
  Solution beside(const Change& change, double by) const {
    Problem moved = problem_;
    change.add(moved, by);
    return solved(moved, answer_.point);
  }
  void close(const std::string& what, double rate, double low, double high) const {
    EXPECT_NEAR(rate, (high - low) / (2 * step_), tolerance_ * (1 + std::fabs(rate))) << what;
  }
  void close(const std::string& what, const std::vector<double>& rate,
             const std::vector<double>& low, const std::vector<double>& high) const {
    for (std::size_t i = 0; i < rate.size(); ++i)
      close(what + "[" + std::to_string(i) + "]", rate[i], low[i], high[i]);
  }

  Problem problem_;
  SolveSettings settings_;
  double step_, tolerance_;
  Solution answer_;
  Sensitivities sensitivities_;
};

TEST(Sensitivity, AgreesWithDifferencesAtAFloor) {
  const Everything everything;
  for (const auto& scheme : {trapezoidal(), backward_euler(), hermite_simpson(),
                             hermite_simpson_compressed(), lgr(3), lgl(4)}) {
    SCOPED_TRACE(scheme.name);
    const Differences differences(
        everything.problem, {.mesh = Mesh::uniform(6), .scheme = scheme, .options = tight(0.01)},
        1e-4, 3e-5);
    for (const auto& change : everything.changes()) differences.compare(change);
  }
}

TEST(Sensitivity, AgreesWithDifferencesOfOptima) {
  const Everything everything;
  for (const auto& scheme : {trapezoidal(), hermite_simpson(), lgr(3)}) {
    SCOPED_TRACE(scheme.name);
    const Differences differences(everything.problem,
                                  {.mesh = Mesh::uniform(6), .scheme = scheme, .options = tight()},
                                  1e-5, 2e-3);
    for (const auto& change : everything.changes()) differences.compare(change);
  }
}

/// Without a bound that becomes active or lets go, a prediction's error falls with the square of
/// the change; at a floor always.
TEST(Sensitivity, PredictsToSecondOrder) {
  const Everything everything;
  for (const double floor : {0.0, 0.01}) {
    SCOPED_TRACE(floor);
    const SolveSettings settings{.mesh = Mesh::uniform(6), .options = tight(floor)};
    const Solution s = solve(everything.problem, settings);
    const Sensitivities known(everything.problem, s);
    double errors[2];
    for (const int halved : {0, 1}) {
      const double by = halved == 0 ? 4e-3 : 2e-3;
      const Problem changed =
          with_numbers(everything.problem,
                       {{"mass", 1.2 + by}, {"initial x", 0.1 - by}, {"disc[one].a", 0.2 + by}});
      const Solution predicted = known.predict(changed);
      EXPECT_EQ(predicted.status, nlp::Status::iteration_limit);
      EXPECT_LT(predicted.residuals.violation, 1e-3);
      EXPECT_EQ(predicted.state("x").front(), 0.1 - by);
      const Solution exact = solve(changed, settings);
      ASSERT_TRUE(exact.solved());
      errors[halved] = std::fabs(predicted.tf() - exact.tf());
      for (std::size_t k = 0; k < s.time().size(); ++k)
        errors[halved] += std::fabs(predicted.state("v")[k] - exact.state("v")[k]);
      for (const char* name : {"arrival", "v", "power"})
        for (std::size_t k = 0; k < s.multiplier(name).values.size(); ++k)
          errors[halved] +=
              std::fabs(predicted.multiplier(name).values[k] - exact.multiplier(name).values[k]);
      SolveSettings warm = settings;
      warm.warm_start = predicted.point;
      EXPECT_TRUE(solve(changed, warm).solved());
    }
    EXPECT_GT(errors[0], 1e-7);
    EXPECT_NEAR(errors[0] / errors[1], 4, 0.3);
    EXPECT_TRUE(known.predict(everything.problem).solved());
  }
}

TEST(Sensitivity, PredictsForOtherNumbersAlone) {
  const Everything everything;
  const Solution s = solve(everything.problem, {.mesh = Mesh::uniform(6)});
  const Sensitivities known(everything.problem, s);
  Problem other = everything.problem;
  other.enable(everything.limit, false);
  EXPECT_NE(refusal([&] { (void)known.predict(other); }).find("power switched"), std::string::npos);
  EXPECT_NE(refusal([&] {
              (void)with_numbers(other, {{"upper v", 1}});
            }).find("upper v: found 1, expected a number that may be set"),
            std::string::npos);
  EXPECT_NE(refusal([&] {
              (void)with_numbers(other, {{"mess", 1}});
            }).find("perhaps 'mass'"),
            std::string::npos);
  other = with_numbers(everything.problem, {{"weight of wall", 3},
                                            {"upper tf", 7},
                                            {"lower final v", -0.3},
                                            {"disc[two].b", 0.7},
                                            {"t0", -0.5}});
  const auto numbers = sensitivity_numbers(other);
  const auto value = [&](const std::string& name) {
    for (const auto& [known_name, number] : numbers)
      if (known_name == name) return number;
    return std::nan("");
  };
  EXPECT_EQ(value("weight of wall"), 3);
  EXPECT_EQ(value("upper tf"), 7);
  EXPECT_EQ(value("lower tf"), 0.5);
  EXPECT_EQ(value("lower final v"), -0.3);
  EXPECT_EQ(value("disc[two].b"), 0.7);
  EXPECT_EQ(value("t0"), -0.5);
}

TEST(Sensitivity, ListsTheNumbersOfAProblem) {
  const Everything everything;
  std::vector<std::string> names;
  for (const auto& [name, value] : sensitivity_numbers(everything.problem)) names.push_back(name);
  const std::vector<std::string> expected = {"mass",
                                             "drag",
                                             "initial x",
                                             "initial v",
                                             "lower final v",
                                             "upper final v",
                                             "t0",
                                             "lower tf",
                                             "upper tf",
                                             "lower x",
                                             "upper x",
                                             "upper v",
                                             "lower u",
                                             "upper u",
                                             "lower gain",
                                             "upper gain",
                                             "lower late",
                                             "upper work",
                                             "arrival",
                                             "lower disc",
                                             "upper disc",
                                             "disc[one].a",
                                             "disc[one].b",
                                             "disc[two].a",
                                             "disc[two].b",
                                             "upper power",
                                             "upper wall",
                                             "weight of wall",
                                             "lower fence",
                                             "upper fence",
                                             "weight of fence",
                                             "upper half"};
  EXPECT_EQ(names, expected);
  EXPECT_EQ(sensitivity_numbers(everything.problem)[5].second, 0.05);
}

TEST(Sensitivity, RefusesWhatHasNone) {
  const auto form = regulator();
  const Solution s = solve(form.problem, {});
  const Sensitivities known(form.problem, s);
  EXPECT_EQ(refusal([&] { (void)known("inital x"); }),
            "linear regulator: sensitivities: found no number 'inital x', expected perhaps "
            "'initial x'");
  EXPECT_EQ(refusal([&] { (void)known("initial x").state("y"); }),
            "solution: found no state 'y', expected one of x");
  nlp::Options few;
  few.max_iterations = 0;
  const Solution cut = solve(form.problem, {.options = few});
  EXPECT_EQ(refusal([&] { Sensitivities(form.problem, cut); }),
            "linear regulator: sensitivities: found an answer that is not solved: "
            "iteration_limit, expected one that is");
  Problem other = form.problem;
  other.initial_bounds(other.states()[0].symbol, Bounds::equal(2));
  EXPECT_EQ(refusal([&] { Sensitivities(other, s); }),
            "linear regulator: sensitivities: found an answer to other numbers than the "
            "problem's, expected the problem as it was solved");
}

TEST(Sensitivity, RefusesADerivativeThatIsNotFinite) {
  Problem p = regulator().problem;
  const Expr k = p.parameter("k", 0), j = p.parameter("j", 2);
  p.mayer("root", sqrt(k) * p.final(p.states()[0].symbol) + square(j));
  const Solution s = solve(p, {});
  const Sensitivities known(p, s);
  EXPECT_NE(refusal([&] { (void)known("k"); }).find("sensitivity to k: found derivatives by it"),
            std::string::npos);
  EXPECT_NEAR(known("j").objective, 4, 1e-12);
}

TEST(Sensitivity, NamesWhatNothingDetermines) {
  Problem p = regulator().problem;
  (void)p.control("idle");
  const Solution s = solve(p, {});
  ASSERT_TRUE(s.solved());
  EXPECT_NE(refusal([&] { Sensitivities(p, s); }).find("least determined at idle at"),
            std::string::npos);
}

/// A row at a time keeps its node there, where the mesh has it at a share of the horizon.
TEST(Sensitivity, RefusesEndsThatWouldMoveTheMesh) {
  Problem p = regulator().problem;
  const Expr x = p.states()[0].symbol;
  const Solution before = solve(p, {.options = tight()});
  const double by_end = Sensitivities(p, before)("tf").objective;
  EXPECT_NEAR(by_end, 1 / (2 * std::cosh(1) * std::cosh(1)), 1e-7);  // of tanh(tf) / 2
  p.path_at("early", x, Moment::time(0.3), Bounds::at_most(0.7));
  const Solution s = solve(p, {});
  const Sensitivities known(p, s);
  EXPECT_NE(refusal([&] { (void)known("tf"); }).find("a breakpoint at a time"), std::string::npos);
  EXPECT_LT(known("upper early").objective, 0);
}

}  // namespace
}  // namespace slalom::ocp
