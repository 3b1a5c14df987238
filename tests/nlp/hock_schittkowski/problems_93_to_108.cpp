// Six to nine variables.

#include <cmath>
#include <numbers>
#include <span>

#include "nlp/hock_schittkowski/problems.hpp"

namespace slalom::nlp {
namespace {

using expr::Expr;

HockSchittkowski problem_93() {
  HockSchittkowski p(93, 135.075961);
  const auto x = p.variables({5.54, 4.4, 12.02, 11.82, 0.702, 0.852});
  p.lower({0});
  const Expr first = x[1] * x[4] * (x[1] + x[2] + x[3]);
  const Expr second = x[2] * x[3] * (x[1] + 1.57 * x[2] + x[4]);
  p.minimise(0.0204 * first + 0.0187 * second + 0.0607 * first * square(x[5]) +
             0.0437 * second * square(x[6]));
  p.nonnegative(0.001 * x[1] * x[2] * x[3] * x[4] * x[5] * x[6] - 2.07);
  p.nonnegative(1 - 0.00062 * first * square(x[5]) - 0.00058 * second * square(x[6]));
  return p;
}

/// Problems 95 to 98 differ in the right-hand sides b.
HockSchittkowski bilinear_blend(int number, double published, const Vector& b) {
  HockSchittkowski p(number, published);
  const auto x = p.variables(6, 0);
  p.lower({0});
  p.upper({0.31, 0.046, 0.068, 0.042, 0.028, 0.0134});
  p.minimise(4.3 * x[1] + 31.8 * x[2] + 63.3 * x[3] + 15.8 * x[4] + 68.5 * x[5] + 4.7 * x[6]);
  p.nonnegative(17.1 * x[1] + 38.2 * x[2] + 204.2 * x[3] + 212.3 * x[4] + 623.4 * x[5] +
                1495.5 * x[6] - 169 * x[1] * x[3] - 3580 * x[3] * x[5] - 3810 * x[4] * x[5] -
                18500 * x[4] * x[6] - 24300 * x[5] * x[6] - b[0]);
  p.nonnegative(17.9 * x[1] + 36.8 * x[2] + 113.9 * x[3] + 169.7 * x[4] + 337.8 * x[5] +
                1385.2 * x[6] - 139 * x[1] * x[3] - 2450 * x[4] * x[5] - 16600 * x[4] * x[6] -
                17200 * x[5] * x[6] - b[1]);
  p.nonnegative(-273 * x[2] - 70 * x[4] - 819 * x[5] + 26000 * x[4] * x[5] - b[2]);
  p.nonnegative(159.9 * x[1] - 311 * x[2] + 587 * x[4] + 391 * x[5] + 2198 * x[6] -
                14000 * x[1] * x[6] - b[3]);
  return p;
}

HockSchittkowski with_second_optimum(HockSchittkowski p) {
  p.others = {4.071246372};
  p.note = "a second local optimum";
  p.published_at = {0.2685649, 0, 0, 0, 0.028, 0.0134};
  return p;
}

HockSchittkowski problem_99() {
  HockSchittkowski p(99, -831079892);
  const auto x = p.variables(7, 0.5);
  p.lower({0});
  p.upper({1.58});
  const double a[] = {0, 50, 50, 75, 75, 75, 100, 100}, t[] = {0, 25, 50, 100, 150, 200, 290, 380};
  const double b = 32;
  Expr r = 0, q = 0, s = 0;
  for (std::size_t i = 1; i < 8; ++i) {
    const double dt = t[i] - t[i - 1];
    const Expr rise = a[i] * sin(x[i]) - b;
    r += a[i] * dt * cos(x[i]);
    q += 0.5 * dt * dt * rise + dt * s;
    s += dt * rise;
  }
  p.minimise(-square(r));
  p.zero(q - 1e5);
  p.zero(s - 1e3);
  return p;
}

HockSchittkowski problem_100() {
  HockSchittkowski p(100, 680.6300573);
  const auto x = p.variables({1, 2, 0, 4, 0, 1, 1});
  p.minimise(square(x[1] - 10) + 5 * square(x[2] - 12) + pow(x[3], 4) + 3 * square(x[4] - 11) +
             10 * pow(x[5], 6) + 7 * square(x[6]) + pow(x[7], 4) - 4 * x[6] * x[7] - 10 * x[6] -
             8 * x[7]);
  p.nonnegative(127 - 2 * square(x[1]) - 3 * pow(x[2], 4) - x[3] - 4 * square(x[4]) - 5 * x[5]);
  p.nonnegative(282 - 7 * x[1] - 3 * x[2] - 10 * square(x[3]) - x[4] + x[5]);
  p.nonnegative(196 - 23 * x[1] - square(x[2]) - 6 * square(x[6]) + 8 * x[7]);
  p.nonnegative(-4 * square(x[1]) - square(x[2]) + 3 * x[1] * x[2] - 2 * square(x[3]) - 5 * x[6] +
                11 * x[7]);
  return p;
}

/// coefficient * x1^e1 ... x7^e7
struct Monomial {
  double coefficient;
  double exponent[7];
};

Expr posynomial(const Variables& x, std::span<const Monomial> terms) {
  Expr sum = 0;
  for (const Monomial& term : terms) {
    Expr product = term.coefficient;
    for (std::size_t i = 0; i < 7; ++i) product *= pow(x[i + 1], term.exponent[i]);
    sum += product;
  }
  return sum;
}

/// Problems 101 to 103: a geometric program, a the exponent of x7 in the first term.
HockSchittkowski geometric_program(int number, double published, double a) {
  HockSchittkowski p(number, published);
  const auto x = p.variables(7, 6);
  p.lower({0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.01});
  p.upper({10});
  constexpr double third = 1.0 / 3;
  const Monomial f[] = {{10, {1, -1, 0, 2, 0, -3, a}},
                        {15, {-1, -2, 1, 1, -1, 0, -0.5}},
                        {20, {-2, 1, 0, -1, -2, 1, 0}},
                        {25, {2, 2, -1, 0, 0.5, -2, 1}}};
  const Monomial g1[] = {{0.5, {0.5, 0, -1, 0, 0, -2, 1}},
                         {0.7, {3, 1, -2, 0, 0, 1, 0.5}},
                         {0.2, {0, -1, 1, -0.5, 0, 2 * third, 0.25}}};
  const Monomial g2[] = {{1.3, {-0.5, 1, -1, 0, -1, 1, 0}},
                         {0.8, {0, 0, 1, -1, -1, 2, 0}},
                         {3.1, {-1, 0.5, 0, -2, -1, third, 0}}};
  const Monomial g3[] = {{2, {1, 0, -1.5, 0, 1, -1, third}},
                         {0.1, {0, 1, -0.5, 0, 1, -1, -0.5}},
                         {1, {-1, 1, 0.5, 0, 1, 0, 0}},
                         {0.65, {0, -2, 1, 0, 1, -1, 1}}};
  const Monomial g4[] = {{0.2, {-2, 1, 0, -1, 0.5, 0, third}},
                         {0.3, {0.5, 2, 1, third, -2 * third, 0, 0.25}},
                         {0.4, {-3, -2, 1, 0, 1, 0, 0.75}},
                         {0.5, {0, 0, -2, 1, 0, 0, 0.5}}};
  const Expr objective = posynomial(x, f);
  p.minimise(objective);
  p.nonnegative(1 - posynomial(x, g1));
  p.nonnegative(1 - posynomial(x, g2));
  p.nonnegative(1 - posynomial(x, g3));
  p.nonnegative(1 - posynomial(x, g4));
  p.between(100, objective, 3000);
  return p;
}

HockSchittkowski problem_104() {
  HockSchittkowski p(104, 3.9511634396);
  const auto x = p.variables({6, 3, 0.4, 0.2, 6, 6, 1, 0.5});
  p.lower({0.1});
  p.upper({10});
  const Expr objective = 0.4 * pow(x[1], 0.67) * pow(x[7], -0.67) +
                         0.4 * pow(x[2], 0.67) * pow(x[8], -0.67) + 10 - x[1] - x[2];
  p.minimise(objective);
  p.nonnegative(1 - 0.0588 * x[5] * x[7] - 0.1 * x[1]);
  p.nonnegative(1 - 0.0588 * x[6] * x[8] - 0.1 * x[1] - 0.1 * x[2]);
  for (std::size_t i = 3; i <= 4; ++i)
    p.nonnegative(1 - 4 * x[i] / x[i + 2] - 2 * pow(x[i], -0.71) / x[i + 2] -
                  0.0588 * pow(x[i], -1.3) * x[i + 4]);
  p.between(1, objective, 4.2);
  return p;
}

HockSchittkowski problem_105() {
  HockSchittkowski p(105, 1138.416240);
  p.others = {1136.307304};
  p.note = "with the published sample f(x*) is 1136.670, and that not the optimum";
  const auto x = p.variables({0.1, 0.2, 100, 125, 175, 11.2, 13.2, 15.8});
  p.lower({0.001, 0.001, 100, 130, 170, 5, 5, 5});
  p.upper({0.499, 0.499, 180, 210, 240, 25, 25, 25});
  struct Count {
    double value;
    int times;
  };
  const Count sample[] = {{95, 1},   {105, 1},  {110, 4},  {115, 4},  {120, 15}, {125, 15},
                          {130, 15}, {135, 13}, {140, 21}, {145, 12}, {150, 17}, {155, 4},
                          {160, 20}, {165, 8},  {170, 17}, {175, 8},  {180, 6},  {185, 6},
                          {190, 7},  {195, 4},  {200, 3},  {205, 3},  {210, 8},  {215, 1},
                          {220, 6},  {230, 5},  {235, 1},  {240, 7},  {245, 1},  {250, 2}};
  const auto normal = [](const Expr& mean, const Expr& deviation, double y) {
    return exp(-square(y - mean) / (2 * square(deviation))) / deviation;
  };
  Expr sum = 0;
  for (const auto& [y, times] : sample)
    sum -= times * log((x[1] * normal(x[3], x[6], y) + x[2] * normal(x[4], x[7], y) +
                        (1 - x[2] - x[1]) * normal(x[5], x[8], y)) /
                       std::sqrt(2 * std::numbers::pi));
  p.minimise(sum);
  p.nonnegative(1 - x[1] - x[2]);
  return p;
}

HockSchittkowski problem_106() {
  HockSchittkowski p(106, 7049.330923);
  p.others = {7049.248020};
  p.note = "the published value is not quite the optimum";
  const auto x = p.variables({5000, 5000, 5000, 200, 350, 150, 225, 425});
  p.lower({100, 1000, 1000, 10, 10, 10, 10, 10});
  p.upper({10000, 10000, 10000, 1000, 1000, 1000, 1000, 1000});
  p.minimise(x[1] + x[2] + x[3]);
  p.nonnegative(1 - 0.0025 * (x[4] + x[6]));
  p.nonnegative(1 - 0.0025 * (x[5] + x[7] - x[4]));
  p.nonnegative(1 - 0.01 * (x[8] - x[5]));
  p.nonnegative(x[1] * x[6] - 833.33252 * x[4] - 100 * x[1] + 83333.333);
  p.nonnegative(x[2] * x[7] - 1250 * x[5] - x[2] * x[4] + 1250 * x[4]);
  p.nonnegative(x[3] * x[8] - 1250000 - x[3] * x[5] + 2500 * x[5]);
  return p;
}

HockSchittkowski problem_107() {
  HockSchittkowski p(107, 5055.011803);
  const auto x = p.variables({0.8, 0.8, 0.2, 0.2, 1.0454, 1.0454, 1.0454, 0, 0});
  p.lower({0, 0, -kInf, -kInf, 0.90909, 0.90909, 0.90909, -kInf, -kInf});
  p.upper({kInf, kInf, kInf, kInf, 1.0909, 1.0909, 1.0909, kInf, kInf});
  const double c = 48.4 / 50.176 * std::sin(0.25), d = 48.4 / 50.176 * std::cos(0.25);
  const Expr y1 = sin(x[8]), y2 = cos(x[8]), y3 = sin(x[9]), y4 = cos(x[9]);
  const Expr y5 = sin(x[8] - x[9]), y6 = cos(x[8] - x[9]);
  const Expr x56 = x[5] * x[6], x57 = x[5] * x[7], x67 = x[6] * x[7];
  p.minimise(3000 * x[1] + 1000 * pow(x[1], 3) + 2000 * x[2] + 666.667 * pow(x[2], 3));
  p.zero(0.4 - x[1] + 2 * c * square(x[5]) - x56 * (d * y1 + c * y2) - x57 * (d * y3 + c * y4));
  p.zero(0.4 - x[2] + 2 * c * square(x[6]) + x56 * (d * y1 - c * y2) + x67 * (d * y5 - c * y6));
  p.zero(0.8 + 2 * c * square(x[7]) + x57 * (d * y3 - c * y4) - x67 * (d * y5 + c * y6));
  p.zero(0.2 - x[3] + 2 * d * square(x[5]) + x56 * (c * y1 - d * y2) + x57 * (c * y3 - d * y4));
  p.zero(0.2 - x[4] + 2 * d * square(x[6]) - x56 * (c * y1 + d * y2) - x67 * (c * y5 + d * y6));
  p.zero(-0.337 + 2 * d * square(x[7]) - x57 * (c * y3 + d * y4) + x67 * (c * y5 - d * y6));
  return p;
}

HockSchittkowski problem_108() {
  HockSchittkowski p(108, -0.8660254038);
  p.others = {-0.6749814285, -0.5};
  p.note = "the largest hexagon of unit diameter: several local optima";
  const auto x = p.variables(9, 1);
  p.lower({-kInf, -kInf, -kInf, -kInf, -kInf, -kInf, -kInf, -kInf, 0});
  p.minimise(-0.5 *
             (x[1] * x[4] - x[2] * x[3] + x[3] * x[9] - x[5] * x[9] + x[5] * x[8] - x[6] * x[7]));
  p.nonnegative(1 - square(x[3]) - square(x[4]));
  p.nonnegative(1 - square(x[9]));
  p.nonnegative(1 - square(x[5]) - square(x[6]));
  p.nonnegative(1 - square(x[1]) - square(x[2] - x[9]));
  p.nonnegative(1 - square(x[1] - x[5]) - square(x[2] - x[6]));
  p.nonnegative(1 - square(x[1] - x[7]) - square(x[2] - x[8]));
  p.nonnegative(1 - square(x[3] - x[5]) - square(x[4] - x[6]));
  p.nonnegative(1 - square(x[3] - x[7]) - square(x[4] - x[8]));
  p.nonnegative(1 - square(x[7]) - square(x[8] - x[9]));
  p.nonnegative(x[1] * x[4] - x[2] * x[3]);
  p.nonnegative(x[3] * x[9]);
  p.nonnegative(-x[5] * x[9]);
  p.nonnegative(x[5] * x[8] - x[6] * x[7]);
  return p;
}

}  // namespace

std::vector<HockSchittkowski> problems_93_to_108() {
  return {problem_93(),
          bilinear_blend(95, 0.015619514, {4.97, -1.88, -29.08, -78.02}),
          bilinear_blend(96, 0.015619514, {4.97, -1.88, -69.08, -118.02}),
          with_second_optimum(bilinear_blend(97, 3.1358091, {32.97, 25.12, -29.08, -78.02})),
          with_second_optimum(bilinear_blend(98, 3.1358091, {32.97, 25.12, -124.08, -173.02})),
          problem_99(),
          problem_100(),
          geometric_program(101, 1809.76476, -0.25),
          geometric_program(102, 911.880571, 0.125),
          geometric_program(103, 543.667958, 0.5),
          problem_104(),
          problem_105(),
          problem_106(),
          problem_107(),
          problem_108()};
}

}  // namespace slalom::nlp
