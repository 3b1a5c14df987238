// Two to five variables.

#include <cmath>
#include <numbers>

#include "nlp/hock_schittkowski/problems.hpp"

namespace slalom::nlp {
namespace {

using expr::Expr;
constexpr double kSqrt2 = std::numbers::sqrt2, kSqrt3 = std::numbers::sqrt3;

HockSchittkowski problem_24() {
  HockSchittkowski p(24, -1);
  const auto x = p.variables({1, 0.5});
  p.lower({0});
  p.minimise((square(x[1] - 3) - 9) * pow(x[2], 3) / (27 * kSqrt3));
  p.nonnegative(x[1] / kSqrt3 - x[2]);
  p.nonnegative(x[1] + kSqrt3 * x[2]);
  p.nonnegative(-x[1] - kSqrt3 * x[2] + 6);
  return p;
}

HockSchittkowski problem_25() {
  HockSchittkowski p(25, 0);
  const auto x = p.variables({100, 12.5, 3});
  p.lower({0.1, 0, 0});
  p.upper({100, 25.6, 5});
  Expr sum = 0;
  for (int i = 1; i <= 99; ++i) {
    const double u = 25 + std::pow(-50 * std::log(0.01 * i), 2.0 / 3);
    sum += square(-0.01 * i + exp(-pow(u - x[2], x[3]) / x[1]));
  }
  p.minimise(sum);
  return p;
}

HockSchittkowski problem_26() {
  HockSchittkowski p(26, 0);
  const auto x = p.variables({-2.6, 2, 2});
  p.minimise(square(x[1] - x[2]) + pow(x[2] - x[3], 4));
  p.zero((1 + square(x[2])) * x[1] + pow(x[3], 4) - 3);
  return p;
}

HockSchittkowski problem_27() {
  HockSchittkowski p(27, 0.04);
  const auto x = p.variables(3, 2);
  p.minimise(0.01 * square(x[1] - 1) + square(x[2] - square(x[1])));
  p.zero(x[1] + square(x[3]) + 1);
  return p;
}

HockSchittkowski problem_28() {
  HockSchittkowski p(28, 0);
  const auto x = p.variables({-4, 1, 1});
  p.minimise(square(x[1] + x[2]) + square(x[2] + x[3]));
  p.zero(x[1] + 2 * x[2] + 3 * x[3] - 1);
  return p;
}

HockSchittkowski problem_29() {
  HockSchittkowski p(29, -16 * kSqrt2);
  const auto x = p.variables(3, 1);
  p.minimise(-x[1] * x[2] * x[3]);
  p.nonnegative(-square(x[1]) - 2 * square(x[2]) - 4 * square(x[3]) + 48);
  return p;
}

HockSchittkowski problem_30() {
  HockSchittkowski p(30, 1);
  const auto x = p.variables(3, 1);
  p.lower({1, -10, -10});
  p.upper({10});
  p.minimise(square(x[1]) + square(x[2]) + square(x[3]));
  p.nonnegative(square(x[1]) + square(x[2]) - 1);
  return p;
}

HockSchittkowski problem_31() {
  HockSchittkowski p(31, 6);
  const auto x = p.variables(3, 1);
  p.lower({-10, 1, -10});
  p.upper({10, 10, 1});
  p.minimise(9 * square(x[1]) + square(x[2]) + 9 * square(x[3]));
  p.nonnegative(x[1] * x[2] - 1);
  return p;
}

HockSchittkowski problem_32() {
  HockSchittkowski p(32, 1);
  const auto x = p.variables({0.1, 0.7, 0.2});
  p.lower({0});
  p.minimise(square(x[1] + 3 * x[2] + x[3]) + 4 * square(x[1] - x[2]));
  p.nonnegative(6 * x[2] + 4 * x[3] - pow(x[1], 3) - 3);
  p.zero(1 - x[1] - x[2] - x[3]);
  return p;
}

HockSchittkowski problem_33() {
  HockSchittkowski p(33, kSqrt2 - 6);
  const auto x = p.variables({0, 0, 3});
  p.lower({0});
  p.upper({kInf, kInf, 5});
  p.minimise((x[1] - 1) * (x[1] - 2) * (x[1] - 3) + x[3]);
  p.nonnegative(square(x[3]) - square(x[2]) - square(x[1]));
  p.nonnegative(square(x[1]) + square(x[2]) + square(x[3]) - 4);
  return p;
}

/// Rows and bounds of problems 34 and 66.
Variables exponential_chain(HockSchittkowski& p) {
  auto x = p.variables({0, 1.05, 2.9});
  p.lower({0});
  p.upper({100, 100, 10});
  p.nonnegative(x[2] - exp(x[1]));
  p.nonnegative(x[3] - exp(x[2]));
  return x;
}

HockSchittkowski problem_34() {
  HockSchittkowski p(34, -std::log(std::log(10.0)));
  const auto x = exponential_chain(p);
  p.minimise(-x[1]);
  return p;
}

HockSchittkowski problem_66() {
  HockSchittkowski p(66, 0.5181632741);
  const auto x = exponential_chain(p);
  p.minimise(0.2 * x[3] - 0.8 * x[1]);
  return p;
}

HockSchittkowski problem_35() {
  HockSchittkowski p(35, 1.0 / 9);
  const auto x = p.variables(3, 0.5);
  p.lower({0});
  p.minimise(9 - 8 * x[1] - 6 * x[2] - 4 * x[3] + 2 * square(x[1]) + 2 * square(x[2]) +
             square(x[3]) + 2 * x[1] * x[2] + 2 * x[1] * x[3]);
  p.nonnegative(3 - x[1] - x[2] - 2 * x[3]);
  return p;
}

HockSchittkowski problem_36() {
  HockSchittkowski p(36, -3300);
  const auto x = p.variables(3, 10);
  p.lower({0});
  p.upper({20, 11, 42});
  p.minimise(-x[1] * x[2] * x[3]);
  p.nonnegative(72 - x[1] - 2 * x[2] - 2 * x[3]);
  return p;
}

HockSchittkowski problem_37() {
  HockSchittkowski p(37, -3456);
  const auto x = p.variables(3, 10);
  p.lower({0});
  p.upper({42});
  p.minimise(-x[1] * x[2] * x[3]);
  p.nonnegative(72 - x[1] - 2 * x[2] - 2 * x[3]);
  p.nonnegative(x[1] + 2 * x[2] + 2 * x[3]);
  return p;
}

HockSchittkowski problem_38() {
  HockSchittkowski p(38, 0);
  const auto x = p.variables({-3, -1, -3, -1});
  p.lower({-10});
  p.upper({10});
  p.minimise(100 * square(x[2] - square(x[1])) + square(1 - x[1]) +
             90 * square(x[4] - square(x[3])) + square(1 - x[3]) +
             10.1 * (square(x[2] - 1) + square(x[4] - 1)) + 19.8 * (x[2] - 1) * (x[4] - 1));
  return p;
}

HockSchittkowski problem_39() {
  HockSchittkowski p(39, -1);
  const auto x = p.variables(4, 2);
  p.minimise(-x[1]);
  p.zero(x[2] - pow(x[1], 3) - square(x[3]));
  p.zero(square(x[1]) - x[2] - square(x[4]));
  return p;
}

HockSchittkowski problem_40() {
  HockSchittkowski p(40, -0.25);
  const auto x = p.variables(4, 0.8);
  p.minimise(-x[1] * x[2] * x[3] * x[4]);
  p.zero(pow(x[1], 3) + square(x[2]) - 1);
  p.zero(square(x[1]) * x[4] - x[3]);
  p.zero(square(x[4]) - x[2]);
  return p;
}

HockSchittkowski problem_41() {
  HockSchittkowski p(41, 52.0 / 27);
  const auto x = p.variables(4, 2);
  p.lower({0});
  p.upper({1, 1, 1, 2});
  p.minimise(2 - x[1] * x[2] * x[3]);
  p.zero(x[1] + 2 * x[2] + 2 * x[3] - x[4]);
  return p;
}

HockSchittkowski problem_42() {
  HockSchittkowski p(42, 28 - 10 * kSqrt2);
  const auto x = p.variables(4, 1);
  p.minimise(square(x[1] - 1) + square(x[2] - 2) + square(x[3] - 3) + square(x[4] - 4));
  p.zero(x[1] - 2);
  p.zero(square(x[3]) + square(x[4]) - 2);
  return p;
}

HockSchittkowski problem_43() {
  HockSchittkowski p(43, -44);
  const auto x = p.variables(4, 0);
  p.minimise(square(x[1]) + square(x[2]) + 2 * square(x[3]) + square(x[4]) - 5 * x[1] - 5 * x[2] -
             21 * x[3] + 7 * x[4]);
  p.nonnegative(8 - square(x[1]) - square(x[2]) - square(x[3]) - square(x[4]) - x[1] + x[2] - x[3] +
                x[4]);
  p.nonnegative(10 - square(x[1]) - 2 * square(x[2]) - square(x[3]) - 2 * square(x[4]) + x[1] +
                x[4]);
  p.nonnegative(5 - 2 * square(x[1]) - square(x[2]) - square(x[3]) - 2 * x[1] + x[2] + x[4]);
  return p;
}

HockSchittkowski problem_44() {
  HockSchittkowski p(44, -15);
  p.others = {-13};
  p.note = "not convex: a second vertex is a local optimum";
  p.published_at = {0, 3, 0, 4};
  const auto x = p.variables(4, 0);
  p.lower({0});
  p.minimise(x[1] - x[2] - x[3] - x[1] * x[3] + x[1] * x[4] + x[2] * x[3] - x[2] * x[4]);
  p.nonnegative(8 - x[1] - 2 * x[2]);
  p.nonnegative(12 - 4 * x[1] - x[2]);
  p.nonnegative(12 - 3 * x[1] - 4 * x[2]);
  p.nonnegative(8 - 2 * x[3] - x[4]);
  p.nonnegative(8 - x[3] - 2 * x[4]);
  p.nonnegative(5 - x[3] - x[4]);
  return p;
}

HockSchittkowski problem_45() {
  HockSchittkowski p(45, 1);
  const auto x = p.variables(5, 2);
  p.lower({0});
  p.upper({1, 2, 3, 4, 5});
  p.minimise(2 - x[1] * x[2] * x[3] * x[4] * x[5] / 120);
  return p;
}

HockSchittkowski problem_46() {
  HockSchittkowski p(46, 0);
  const auto x = p.variables({kSqrt2 / 2, 1.75, 0.5, 2, 2});
  p.minimise(square(x[1] - x[2]) + square(x[3] - 1) + pow(x[4] - 1, 4) + pow(x[5] - 1, 6));
  p.zero(square(x[1]) * x[4] + sin(x[4] - x[5]) - 1);
  p.zero(x[2] + pow(x[3], 4) * square(x[4]) - 2);
  return p;
}

HockSchittkowski problem_47() {
  HockSchittkowski p(47, 0);
  const auto x = p.variables({2, kSqrt2, -1, 2 - kSqrt2, 0.5});
  p.minimise(square(x[1] - x[2]) + pow(x[2] - x[3], 3) + pow(x[3] - x[4], 4) + pow(x[4] - x[5], 4));
  p.zero(x[1] + square(x[2]) + pow(x[3], 3) - 3);
  p.zero(x[2] - square(x[3]) + x[4] - 1);
  p.zero(x[1] * x[5] - 1);
  return p;
}

HockSchittkowski problem_48() {
  HockSchittkowski p(48, 0);
  const auto x = p.variables({3, 5, -3, 2, -2});
  p.minimise(square(x[1] - 1) + square(x[2] - x[3]) + square(x[4] - x[5]));
  p.zero(x[1] + x[2] + x[3] + x[4] + x[5] - 5);
  p.zero(x[3] - 2 * (x[4] + x[5]) + 3);
  return p;
}

HockSchittkowski problem_49() {
  HockSchittkowski p(49, 0);
  const auto x = p.variables({10, 7, 2, -3, 0.8});
  p.minimise(square(x[1] - x[2]) + square(x[3] - 1) + pow(x[4] - 1, 4) + pow(x[5] - 1, 6));
  p.zero(x[1] + x[2] + x[3] + 4 * x[4] - 7);
  p.zero(x[3] + 5 * x[5] - 6);
  return p;
}

}  // namespace

std::vector<HockSchittkowski> problems_24_to_49() {
  return {problem_24(), problem_25(), problem_26(), problem_27(), problem_28(), problem_29(),
          problem_30(), problem_31(), problem_32(), problem_33(), problem_34(), problem_35(),
          problem_36(), problem_37(), problem_38(), problem_39(), problem_40(), problem_41(),
          problem_42(), problem_43(), problem_44(), problem_45(), problem_46(), problem_47(),
          problem_48(), problem_49(), problem_66()};
}

}  // namespace slalom::nlp
