// The answer does not depend on the units of length, time, mass and money.

#include "slalom/ocp/scaling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "slalom/base/error.hpp"
#include "slalom/ocp/errors.hpp"
#include "slalom/ocp/guess.hpp"
#include "slalom/ocp/refine.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {
namespace {

/// How many of a unit there are in the SI's: 1000 for lengths in millimetres.
struct Units {
  double length = 1, time = 1, mass = 1, cost = 1;
};
const std::vector<Units> kUnits = {{1e3, 1, 1, 1},       {1e-3, 1, 1e3, 1},   {1, 1e3, 1, 1e-6},
                                   {1e-4, 1e-3, 1, 1e4}, {1e3, 1e3, 1e-3, 1}, {1, 1, 1, 1e-9}};

/// A problem stated in some units, and what turns its states and controls back into SI.
struct Stated {
  Problem problem;
  std::vector<double> states, controls;  ///< in the problem's numbers for one of the SI's
  double time, cost;
  std::string name = {};
};

/// Fastest slide down a wire (Bryson & Ho 1975, section 2.7).
Stated brachistochrone(Units n) {
  Problem p("brachistochrone");
  const double speed = n.length / n.time;
  const Expr x = p.state("x"), y = p.state("y"), v = p.state("v"), a = p.control("a", {0, 3});
  p.dynamics(x, v * sin(a));
  p.dynamics(y, -v * cos(a));
  p.dynamics(v, 9.81 * n.length / (n.time * n.time) * cos(a));
  p.initial_bounds(x, Bounds::equal(0));
  p.initial_bounds(y, Bounds::equal(10 * n.length));
  p.initial_bounds(v, Bounds::equal(0));
  p.final_bounds(x, Bounds::equal(10 * n.length));
  p.final_bounds(y, Bounds::equal(5 * n.length));
  p.final_time({0.1 * n.time, 10 * n.time}, n.time);
  p.mayer("duration", p.final_time() * (n.cost / n.time));
  return {p, {n.length, n.length, speed}, {1}, n.time, n.cost};
}

/// A sled pushed along with nothing known of its speed or push but where it goes.
Stated sled(Units n) {
  Problem p("sled");
  const double force = n.mass * n.length / (n.time * n.time), speed = n.length / n.time;
  const Expr x = p.state("x"), v = p.state("v"), u = p.control("u");
  const double mass = 20 * n.mass, drag = 3 * n.mass / n.length;
  p.dynamics(x, v);
  p.dynamics(v, (u - drag * v * v) / mass);
  p.lagrange("effort", square(u) * (n.cost / (force * force * n.time)));
  p.path("power", u * v, Bounds::at_most(500 * force * speed));
  p.initial_bounds(x, Bounds::equal(0));
  p.initial_bounds(v, Bounds::equal(0));
  p.final_bounds(x, Bounds::equal(8 * n.length));
  p.final_bounds(v, Bounds::equal(0));
  p.final_time(Bounds::equal(4 * n.time), 4 * n.time);
  return {p, {n.length, speed}, {force}, n.time, n.cost};
}

TEST(AutomaticScales, MakeTheAnswerIndependentOfUnits) {
  for (const auto state : {brachistochrone, sled})
    for (const Scheme& scheme : {hermite_simpson(), lgr(4), trapezoidal()}) {
      const SolveSettings settings{.mesh = Mesh::uniform(20), .scheme = scheme};
      const Stated si = state({});
      const Solution expected = solve(si.problem, settings);
      ASSERT_TRUE(expected.solved()) << si.problem.name();
      for (const Units& units : kUnits) {
        const Stated other = state(units);
        SCOPED_TRACE(other.problem.name() + " by " + scheme.name + " with a metre of " +
                     std::to_string(units.length) + ", a second of " + std::to_string(units.time) +
                     ", costs times " + std::to_string(units.cost));
        const Solution solution = solve(other.problem, settings);
        ASSERT_EQ(solution.status, nlp::Status::solved);
        EXPECT_NEAR(solution.objective / (other.cost * expected.objective), 1, 1e-6);
        EXPECT_NEAR(solution.tf() / (other.time * expected.tf()), 1, 1e-6);
        const auto same = [&](const auto& rows, const auto& want, const std::vector<double>& unit) {
          for (std::size_t i = 0; i < unit.size(); ++i) {
            double size = 0;
            for (const auto& row : want) size = std::max(size, std::fabs(row[i]));
            for (std::size_t k = 0; k < rows.size(); ++k)
              EXPECT_NEAR(rows[k][i] / unit[i], want[k][i], 1e-6 * size) << i << " at " << k;
          }
        };
        same(solution.trajectory.states, expected.trajectory.states, other.states);
        const double error = estimate_errors(other.problem, solution).largest;
        EXPECT_NEAR(error / estimate_errors(si.problem, expected).largest, 1, 1e-2);
      }
    }
}

TEST(AutomaticScales, ComeFromTheGuessTheEndsTheBoundsAndTheDynamics) {
  Problem p("sizes");
  const Expr guessed = p.state("guessed"), ended = p.state("ended");
  const Expr bounded = p.state("bounded", {-300, 20}), given = p.state("given", {}, 7);
  const Expr driven = p.state("driven"), twice = p.state("twice"), nothing = p.state("nothing");
  const Expr u = p.control("u", {-5, 2}), push = p.control("push");
  const Expr q = p.static_parameter("q", {0, 50}, 0);
  p.dynamics(guessed, u);
  p.dynamics(ended, u);
  p.dynamics(bounded, u);
  p.dynamics(given, u);
  p.dynamics(driven, 3 * u + q);
  p.dynamics(twice, driven + 0.01 * push);
  p.dynamics(nothing, 0 * square(nothing));
  p.final_bounds(ended, Bounds::at_most(-40));
  p.final_time({1, 20}, 2);
  Trajectory guess;
  guess.tf = 2;
  guess.tau = {0, 1};
  guess.states = {{0, 0, 0, 0, 0, 0, 0}, {-90, 0, 0, 0, 0, 0, 0}};
  guess.controls = {{0, 0}, {0, 0}};
  const Problem scaled = with_scales(p, guess);
  std::vector<double> units;
  for (const auto& state : scaled.states()) units.push_back(state.unit());
  EXPECT_EQ(units, (std::vector<double>{90, 40, 300, 7, 2 * 3 * 5, 2 * 30, 1}));
  EXPECT_EQ(scaled.controls()[0].unit(), 5);
  EXPECT_NEAR(scaled.controls()[1].unit(), 60 / (0.01 * 2), 1e-9);
  EXPECT_EQ(scaled.static_parameters()[0].unit(), 50);
  EXPECT_EQ(scaled.tf().unit(), 2);
}

TEST(AutomaticScales, OfParametersAndIntegralsComeFromTheGuessToo) {
  Problem p("sizes");
  const Expr x = p.state("x"), k = p.static_parameter("k", {}, 3);
  (void)p.static_parameter("untold", {}, 7);
  (void)p.integral("way", 2 * k * x);
  (void)p.integral("told", x);
  (void)p.integral("bounded", x, Bounds::at_most(9));
  p.dynamics(x, k);
  Trajectory guess{0, 4, {0, 1}, {{0}, {5}}, {{}, {}}, {}, {}};
  EXPECT_EQ(with_scales(p, guess).static_parameters()[0].unit(), 3);
  guess.static_parameters = {500, 1e-12};
  guess.integrals = {0, 11, 0};
  const Problem scaled = with_scales(p, guess);
  EXPECT_EQ(scaled.static_parameters()[0].unit(), 500);
  EXPECT_NEAR(scaled.static_parameters()[1].unit(), 0.07, 1e-12) << "rounding is no size";
  EXPECT_EQ(scaled.integrals()[0].unit(), 4 * 2 * 500 * 5);
  EXPECT_EQ(scaled.integrals()[1].unit(), 11);
  EXPECT_EQ(scaled.integrals()[2].unit(), 9);
}

/// The rates of a reaction fitted to its course, in units in which they are as small as 1e-18 and
/// as large as 1e8, and without a guess, where the rate back moves nothing: 0 times a state of 0
/// (Bellman, Jacquez, Kalaba & Schwimmer, Math. Biosci. 1, 1967).
TEST(AutomaticScales, OfParametersWithoutAGuessComeFromWhatTheyMove) {
  const auto fit = [](double unit) {
    Problem p("fit");
    const Expr y = p.state("y");
    const Expr forward = p.static_parameter("forward", Bounds::at_least(0), 0);
    const Expr back = p.static_parameter("back", Bounds::at_least(0), 0);
    p.dynamics(y, unit * (forward * (126.2 - y) * square(91.9 - y) - back * square(y)));
    p.initial_bounds(y, Bounds::equal(0));
    p.final_time(Bounds::equal(39), 39);
    const std::pair<double, double> course[] = {
        {1, 1.4}, {2, 6.3},   {3, 10.5},  {4, 14.2},  {5, 17.6},  {6, 21.4},  {7, 23},
        {9, 27},  {11, 30.5}, {14, 34.4}, {19, 38.8}, {24, 41.6}, {29, 43.5}, {39, 45.3}};
    for (const auto& [t, measured] : course)
      p.cost_at("at " + std::to_string(t), square(y - measured), Moment::time(t));
    return solve(p);
  };
  const Solution one = fit(1);
  ASSERT_TRUE(one.solved()) << nlp::to_string(one.status);
  EXPECT_NEAR(one.objective, 21.867, 1e-3);
  for (const double unit : {1e-12, 1e-6, 1e-3, 1e3, 1e6, 1e9, 1e12}) {
    SCOPED_TRACE(unit);
    const Solution other = fit(unit);
    ASSERT_TRUE(other.solved()) << nlp::to_string(other.status);
    EXPECT_NEAR(other.objective, one.objective, 1e-6);
    EXPECT_NEAR(other.static_parameter("forward") * unit, one.static_parameter("forward"), 1e-10);
    EXPECT_NEAR(other.static_parameter("back") * unit, one.static_parameter("back"), 1e-8);
    EXPECT_LE(other.iterations, 2 * one.iterations);
  }
}

TEST(AutomaticScales, LeaveWhatWasGivenByHand) {
  Problem p("by hand");
  const Expr x = p.state("x", {-3, 3});
  p.set_scale(x, 0.5);
  p.set_scale(p.final_time(), 4);
  Trajectory guess;
  guess.tau = {0, 1};
  guess.states = {{2}, {2}};
  guess.controls = {{}, {}};
  p.dynamics(x, 1.0);
  EXPECT_EQ(with_scales(p, guess).states()[0].unit(), 0.5);
  EXPECT_EQ(with_scales(p, guess).tf().unit(), 4);
  EXPECT_THROW(p.set_scale(x, -1), InvalidValue);
  EXPECT_THROW(p.set_scale(Expr::symbol("x"), 1), InvalidValue);
}

TEST(AutomaticScales, LetAnAnswerStartASolveThatIsScaledOtherwise) {
  const Stated si = sled({});
  SolveSettings settings{.mesh = Mesh::uniform(20)};
  const Solution cold = solve(si.problem, settings);
  settings.warm_start = cold.point;
  settings.guess = cold.trajectory;  // other sizes than the first guess
  const Solution warm = solve(si.problem, settings);
  ASSERT_TRUE(warm.solved());
  EXPECT_LT(warm.iterations, cold.iterations / 2);
  EXPECT_NEAR(warm.objective / cold.objective, 1, 1e-8);
}

/// A cart and a pendulum, moved by 1 in 2 s.
Problem cart_with_pendulum(double to) {
  Problem p("cart");
  const Expr x = p.state("x"), v = p.state("v"), a = p.state("a"), w = p.state("w");
  const Expr u = p.control("u", {-30, 30});
  const Expr rate =
      (u + 0.3 * sin(a) * (0.5 * square(w) - 9.81 * cos(a))) / (1 + 0.3 * square(sin(a)));
  p.dynamics(x, v);
  p.dynamics(v, rate);
  p.dynamics(a, w);
  p.dynamics(w, (-rate * cos(a) - 9.81 * sin(a)) / 0.5);
  p.fix(x, 0, to);
  for (const Expr& state : {v, a, w}) p.fix(state, 0, 0);
  p.lagrange("effort", square(u));
  p.final_time(Bounds::equal(2), 2);
  return p;
}

TEST(Scaling, RoundingInAGuessIsNoSize) {
  const Problem problem = cart_with_pendulum(1);
  const double right = solve(problem).objective;
  EXPECT_NEAR(right, 0.979856, 1e-6);
  for (const double dust : {1e-16, 1e-12, 1e-9, 1e-6, 1e-3}) {
    SCOPED_TRACE(dust);
    const Solution tiny = solve(cart_with_pendulum(dust));
    ASSERT_TRUE(tiny.solved());
    const Solution solution = solve(problem, {.guess = tiny.trajectory});
    EXPECT_TRUE(solution.solved()) << nlp::to_string(solution.status);
    EXPECT_NEAR(solution.objective, right, 1e-6);
    EXPECT_LE(solution.iterations, 50);
  }
}

/// A car past a disc: what its guess leaves at rest is found from its controls' bounds.
TEST(Scaling, RoundingInAGuessIsNoSizeWhereEndsSayNothing) {
  Problem p("car");
  const Expr x = p.state("x"), y = p.state("y"), th = p.state("th");
  const Expr w = p.control("w", {-1, 1}), v = p.control("v", {0, 2});
  p.dynamics(x, v * cos(th));
  p.dynamics(y, v * sin(th));
  p.dynamics(th, w);
  p.fix(x, 0, 10);
  p.fix(y, 0, 0);
  p.initial_bounds(th, Bounds::equal(0));
  p.final_time({1, 30}, 8);
  p.mayer("duration", p.final_time());
  p.lagrange("effort", 0.1 * square(w));
  p.path("keep out", square(x - 5) + square(y - 0.1), Bounds::at_least(1));
  for (const double dust : {0.0, 1e-16, 1e-10, 1e-6, 1e-3}) {
    SCOPED_TRACE(dust);
    const Solution solution =
        solve(p, {.guess = Guess(p).line("y", 0, dust).constant("v", 1.5).trajectory()});
    EXPECT_TRUE(solution.solved()) << nlp::to_string(solution.status);
    EXPECT_NEAR(solution.objective, 5.11030, 1e-5);
    const Solution all_dust = solve(p, {.guess = Guess(p)
                                                     .line("y", 0, dust)
                                                     .line("th", 0, -dust)
                                                     .constant("w", dust / 10)
                                                     .constant("v", 1.5)
                                                     .trajectory()});
    EXPECT_TRUE(all_dust.solved()) << nlp::to_string(all_dust.status);
  }
}

/// Where the clock stands does not matter.
TEST(Scaling, TimesHaveTheSizeOfTheDuration) {
  for (const double begin : {0.0, 42.758, -1e3, 1e4, 1e6, 1.76e9}) {
    SCOPED_TRACE(begin);
    Problem p("late");
    const Expr x = p.state("x"), v = p.state("v"), u = p.control("u");
    p.initial_time(Bounds::equal(begin), begin);
    p.final_time({begin + 0.1, begin + 100}, begin + 1);
    p.dynamics(x, v);
    p.dynamics(v, u + 0.3 * sin(p.time() - begin));
    p.fix(x, 0, 1);
    p.fix(v, 0, 0);
    p.lagrange("cost", square(u) + 1);
    const Solution solution = solve(p);
    EXPECT_TRUE(solution.solved()) << nlp::to_string(solution.status);
    EXPECT_NEAR(solution.objective, 3.5427278, 1e-6);
    EXPECT_NEAR(solution.tf() - begin, 2.64337, 1e-5);
    EXPECT_EQ(solution.scales[3], std::pair(std::string("t0"), 1.0));
    EXPECT_EQ(solution.scales[4].second, 1);
  }
}

/// From the Earth's orbit to that of Mars, in days; `unit`: how many of the unit of length are a
/// metre.
Problem transfer(double unit) {
  const double au = 1.495978707e11 * unit, mu = 1.32712440018e20 * std::pow(unit, 3);
  Problem p("transfer");
  const Expr r = p.state("r", {0.5 * au, 3 * au}), th = p.state("th"), vr = p.state("vr"),
             vt = p.state("vt"), b = p.control("b");
  p.dynamics(r, vr);
  p.dynamics(th, vt / r);
  p.dynamics(vr, square(vt) / r - mu / square(r) + 1e-3 * unit * sin(b));
  p.dynamics(vt, -vr * vt / r + 1e-3 * unit * cos(b));
  p.fix(r, au, 1.524 * au);
  p.initial_bounds(th, Bounds::equal(0));
  p.fix(vr, 0, 0);
  p.fix(vt, std::sqrt(mu / au), std::sqrt(mu / (1.524 * au)));
  p.final_time({1e6, 1e8}, 2e7);
  p.mayer("duration", p.final_time() / 86400);
  return p;
}

/// Of 1.5e11 m the rounding is 3e-5 m: no tolerance of 1e-6 m can be asked for.
TEST(Scaling, ToleranceIsNotAskedForBelowRounding) {
  for (const double unit : {1.0, 1e-3, 1 / 1.495978707e11})  // metres, kilometres, their distance
    for (const std::string& backend : nlp::backends()) {
      SCOPED_TRACE(backend + ", a metre is " + std::to_string(unit));
      const Problem problem = transfer(unit);
      SolveSettings settings{.backend = backend,
                             .guess = Guess(problem).line("b", 1, -1).trajectory()};
      const Solution solution = solve(problem, settings);
      EXPECT_TRUE(solution.solved()) << nlp::to_string(solution.status);
      EXPECT_NEAR(solution.objective, 189.2124, 1e-4);
      const Refined refined = refine(problem, settings);
      EXPECT_EQ(refined.status, RefineStatus::converged);
      EXPECT_NEAR(refined.solution.objective, 189.2125, 1e-4);
    }
}

/// At a floor too, where answers are judged in the user's units alone.
TEST(Scaling, ToleranceIsNotAskedForBelowRoundingAtAFloor) {
  for (const double unit : {1.0, 1e-3}) {
    const Problem problem = transfer(unit);
    SolveSettings settings{.guess = Guess(problem).line("b", 1, -1).trajectory()};
    settings.options.floor = 1e-3;
    const Solution solution = solve(problem, settings);
    EXPECT_TRUE(solution.solved()) << nlp::to_string(solution.status);
    EXPECT_NEAR(solution.objective, 189.2124, 1e-4);
  }
}

/// Where the slope at the answer asks for another scale, both solves are within the limit.
TEST(Scaling, ASecondSolveHasTheIterationsThatAreLeft) {
  Problem p("steep");
  const Expr x = p.state("x"), u = p.control("u", {-10, 10});
  p.dynamics(x, u);
  p.initial_bounds(x, Bounds::equal(0));
  p.lagrange("cost", exp(u));
  int calls = 0;
  SolveSettings settings;
  settings.options.on_iteration = [](const nlp::IterationInfo&, void* data) {
    ++*static_cast<int*>(data);
  };
  settings.options.on_iteration_data = &calls;
  const Solution whole = solve(p, settings);
  ASSERT_TRUE(whole.solved());
  EXPECT_EQ(whole.iterations, calls);
  settings.options.max_iterations = calls - 1;
  calls = 0;
  EXPECT_TRUE(solve(p, settings).solved());
  EXPECT_LE(calls, settings.options.max_iterations);
}

}  // namespace
}  // namespace slalom::ocp
