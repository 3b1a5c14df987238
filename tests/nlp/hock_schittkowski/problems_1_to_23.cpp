// Two variables.

#include <cmath>
#include <numbers>

#include "nlp/hock_schittkowski/problems.hpp"

namespace slalom::nlp {
namespace {

using expr::Expr;

/// Rosenbrock's function, the objective of eight of these problems.
Expr rosenbrock(const Variables& x) {
  return 100 * square(x[2] - square(x[1])) + square(1 - x[1]);
}

HockSchittkowski problem_1() {
  HockSchittkowski p(1, 0);
  const auto x = p.variables({-2, 1});
  p.lower({-kInf, -1.5});
  p.minimise(rosenbrock(x));
  return p;
}

HockSchittkowski problem_2() {
  HockSchittkowski p(2, 0.0504261879);
  p.others = {4.941229318};
  p.note = "two local optima on the bound x2 = 1.5";
  p.published_at = {1.224370749, 1.5};
  const auto x = p.variables({-2, 1});
  p.lower({-kInf, 1.5});
  p.minimise(rosenbrock(x));
  return p;
}

HockSchittkowski problem_3() {
  HockSchittkowski p(3, 0);
  const auto x = p.variables({10, 1});
  p.lower({-kInf, 0});
  p.minimise(x[2] + 1e-5 * square(x[2] - x[1]));
  return p;
}

HockSchittkowski problem_4() {
  HockSchittkowski p(4, 8.0 / 3);
  const auto x = p.variables({1.125, 0.125});
  p.lower({1, 0});
  p.minimise(pow(x[1] + 1, 3) / 3 + x[2]);
  return p;
}

HockSchittkowski problem_5() {
  HockSchittkowski p(5, -std::sqrt(3.0) / 2 - std::numbers::pi / 3);
  const auto x = p.variables(2, 0);
  p.lower({-1.5, -3});
  p.upper({4, 3});
  p.minimise(sin(x[1] + x[2]) + square(x[1] - x[2]) - 1.5 * x[1] + 2.5 * x[2] + 1);
  return p;
}

HockSchittkowski problem_6() {
  HockSchittkowski p(6, 0);
  const auto x = p.variables({-1.2, 1});
  p.minimise(square(1 - x[1]));
  p.zero(10 * (x[2] - square(x[1])));
  return p;
}

HockSchittkowski problem_7() {
  HockSchittkowski p(7, -std::sqrt(3.0));
  const auto x = p.variables(2, 2);
  p.minimise(log(1 + square(x[1])) - x[2]);
  p.zero(square(1 + square(x[1])) + square(x[2]) - 4);
  return p;
}

HockSchittkowski problem_8() {
  HockSchittkowski p(8, -1);
  const auto x = p.variables({2, 1});
  p.minimise(-1);
  p.zero(square(x[1]) + square(x[2]) - 25);
  p.zero(x[1] * x[2] - 9);
  return p;
}

HockSchittkowski problem_9() {
  HockSchittkowski p(9, -0.5);
  const auto x = p.variables(2, 0);
  p.minimise(sin(std::numbers::pi * x[1] / 12) * cos(std::numbers::pi * x[2] / 16));
  p.zero(4 * x[1] - 3 * x[2]);
  return p;
}

HockSchittkowski problem_10() {
  HockSchittkowski p(10, -1);
  const auto x = p.variables({-10, 10});
  p.minimise(x[1] - x[2]);
  p.nonnegative(-3 * square(x[1]) + 2 * x[1] * x[2] - square(x[2]) + 1);
  return p;
}

HockSchittkowski problem_11() {
  HockSchittkowski p(11, -8.498464223);
  const auto x = p.variables({4.9, 0.1});
  p.minimise(square(x[1] - 5) + square(x[2]) - 25);
  p.nonnegative(-square(x[1]) + x[2]);
  return p;
}

HockSchittkowski problem_12() {
  HockSchittkowski p(12, -30);
  const auto x = p.variables(2, 0);
  p.minimise(0.5 * square(x[1]) + square(x[2]) - x[1] * x[2] - 7 * x[1] - 7 * x[2]);
  p.nonnegative(25 - 4 * square(x[1]) - square(x[2]));
  return p;
}

HockSchittkowski problem_13() {
  HockSchittkowski p(13, 1);
  p.note = "no multipliers: the gradients of the rows active at (1, 0) cancel each other";
  const auto x = p.variables(2, -2);
  p.lower({0});
  p.minimise(square(x[1] - 2) + square(x[2]));
  p.nonnegative(pow(1 - x[1], 3) - x[2]);
  return p;
}

HockSchittkowski problem_14() {
  HockSchittkowski p(14, 9 - 2.875 * std::sqrt(7.0));
  const auto x = p.variables(2, 2);
  p.minimise(square(x[1] - 2) + square(x[2] - 1));
  p.nonnegative(-0.25 * square(x[1]) - square(x[2]) + 1);
  p.zero(x[1] - 2 * x[2] + 1);
  return p;
}

HockSchittkowski problem_15() {
  HockSchittkowski p(15, 306.5);
  p.others = {360.3797672};
  p.note = "a second local optimum at (-0.792, -1.262)";
  const auto x = p.variables({-2, 1});
  p.upper({0.5, kInf});
  p.minimise(rosenbrock(x));
  p.nonnegative(x[1] * x[2] - 1);
  p.nonnegative(x[1] + square(x[2]));
  return p;
}

HockSchittkowski problem_16() {
  HockSchittkowski p(16, 0.25);
  p.others = {23.14466095};
  p.note = "a second local optimum on the bound x1 = -0.5";
  p.published_at = {0.5, 0.25};
  const auto x = p.variables({-2, 1});
  p.lower({-0.5, -kInf});
  p.upper({0.5, 1});
  p.minimise(rosenbrock(x));
  p.nonnegative(x[1] + square(x[2]));
  p.nonnegative(square(x[1]) + x[2]);
  return p;
}

HockSchittkowski problem_17() {
  HockSchittkowski p(17, 1);
  const auto x = p.variables({-2, 1});
  p.lower({-0.5, -kInf});
  p.upper({0.5, 1});
  p.minimise(rosenbrock(x));
  p.nonnegative(square(x[2]) - x[1]);
  p.nonnegative(square(x[1]) - x[2]);
  return p;
}

HockSchittkowski problem_18() {
  HockSchittkowski p(18, 5);
  const auto x = p.variables(2, 2);
  p.lower({2, 0});
  p.upper({50});
  p.minimise(0.01 * square(x[1]) + square(x[2]));
  p.nonnegative(x[1] * x[2] - 25);
  p.nonnegative(square(x[1]) + square(x[2]) - 25);
  return p;
}

HockSchittkowski problem_19() {
  HockSchittkowski p(19, -6961.81381);
  const auto x = p.variables({20.1, 5.84});
  p.lower({13, 0});
  p.upper({100});
  p.minimise(pow(x[1] - 10, 3) + pow(x[2] - 20, 3));
  p.nonnegative(square(x[1] - 5) + square(x[2] - 5) - 100);
  p.nonnegative(-square(x[2] - 5) - square(x[1] - 6) + 82.81);
  return p;
}

HockSchittkowski problem_20() {
  HockSchittkowski p(20, 81.5 - 25 * std::sqrt(3.0));
  p.others = {83.5 - 25 * std::sqrt(3.0)};
  p.note = "a second local optimum at (-1/2, sqrt(3)/2)";
  p.published_at = {0.5, 0.8660254};
  const auto x = p.variables({-2, 1});
  p.lower({-0.5, -kInf});
  p.upper({0.5, kInf});
  p.minimise(rosenbrock(x));
  p.nonnegative(x[1] + square(x[2]));
  p.nonnegative(square(x[1]) + x[2]);
  p.nonnegative(square(x[1]) + square(x[2]) - 1);
  return p;
}

HockSchittkowski problem_21() {
  HockSchittkowski p(21, -99.96);
  const auto x = p.variables(2, -1);
  p.lower({2, -50});
  p.upper({50});
  p.minimise(0.01 * square(x[1]) + square(x[2]) - 100);
  p.nonnegative(10 * x[1] - x[2] - 10);
  return p;
}

HockSchittkowski problem_22() {
  HockSchittkowski p(22, 1);
  const auto x = p.variables(2, 2);
  p.minimise(square(x[1] - 2) + square(x[2] - 1));
  p.nonnegative(-x[1] - x[2] + 2);
  p.nonnegative(-square(x[1]) + x[2]);
  return p;
}

HockSchittkowski problem_23() {
  HockSchittkowski p(23, 2);
  const auto x = p.variables({3, 1});
  p.lower({-50});
  p.upper({50});
  p.minimise(square(x[1]) + square(x[2]));
  p.nonnegative(x[1] + x[2] - 1);
  p.nonnegative(square(x[1]) + square(x[2]) - 1);
  p.nonnegative(9 * square(x[1]) + square(x[2]) - 9);
  p.nonnegative(square(x[1]) - x[2]);
  p.nonnegative(square(x[2]) - x[1]);
  return p;
}

}  // namespace

std::vector<HockSchittkowski> problems_1_to_23() {
  return {problem_1(),  problem_2(),  problem_3(),  problem_4(),  problem_5(),  problem_6(),
          problem_7(),  problem_8(),  problem_9(),  problem_10(), problem_11(), problem_12(),
          problem_13(), problem_14(), problem_15(), problem_16(), problem_17(), problem_18(),
          problem_19(), problem_20(), problem_21(), problem_22(), problem_23()};
}

}  // namespace slalom::nlp
