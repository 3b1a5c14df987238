// Nine to sixteen variables; 117 stands beside its dual 86. The whole library.

#include <algorithm>
#include <cmath>
#include <iterator>

#include "nlp/hock_schittkowski/problems.hpp"

namespace slalom::nlp {
namespace {

using expr::Expr;

HockSchittkowski problem_109() {
  HockSchittkowski p(109, 5362.06928);
  p.note = "the last row has the sign of its constant with which the published x* is feasible";
  const auto x = p.variables(9, 0);
  p.lower({0, 0, -0.55, -0.55, 196, 196, 196, -400, -400});
  p.upper({kInf, kInf, 0.55, 0.55, 252, 252, 252, 800, 800});
  const double a = 50.176, b = std::sin(0.25), c = std::cos(0.25);
  const Expr x56 = x[5] * x[6], x57 = x[5] * x[7], x67 = x[6] * x[7];
  p.minimise(3 * x[1] + 1e-6 * pow(x[1], 3) + 2 * x[2] + 0.522074e-6 * pow(x[2], 3));
  p.nonnegative(x[4] - x[3] + 0.55);
  p.nonnegative(x[3] - x[4] + 0.55);
  p.nonnegative(2250000 - square(x[1]) - square(x[8]));
  p.nonnegative(2250000 - square(x[2]) - square(x[9]));
  p.zero(x56 * sin(-x[3] - 0.25) + x57 * sin(-x[4] - 0.25) + 2 * b * square(x[5]) - a * x[1] +
         400 * a);
  p.zero(x56 * sin(x[3] - 0.25) + x67 * sin(x[3] - x[4] - 0.25) + 2 * b * square(x[6]) - a * x[2] +
         400 * a);
  p.zero(x57 * sin(x[4] - 0.25) + x67 * sin(x[4] - x[3] - 0.25) + 2 * b * square(x[7]) +
         881.779 * a);
  const double shunt = 0.7533e-3 * a - 2 * c;
  p.zero(a * x[8] + x56 * cos(-x[3] - 0.25) + x57 * cos(-x[4] - 0.25) - 200 * a +
         shunt * square(x[5]));
  p.zero(a * x[9] + x56 * cos(x[3] - 0.25) + x67 * cos(x[3] - x[4] - 0.25) - 200 * a +
         shunt * square(x[6]));
  p.zero(x57 * cos(x[4] - 0.25) + x67 * cos(x[4] - x[3] - 0.25) - 22.938 * a +
         shunt * square(x[7]));
  return p;
}

HockSchittkowski problem_110() {
  HockSchittkowski p(110, -45.77846971);
  const auto x = p.variables(10, 9);
  p.lower({2.001});
  p.upper({9.999});
  Expr sum = 0, product = 1;
  for (const Expr& each : x.list()) {
    sum += square(log(each - 2)) + square(log(10 - each));
    product *= each;
  }
  p.minimise(sum - pow(product, 0.2));
  return p;
}

/// Chemical equilibrium (111 and 112) from the logarithms and the values of ten mole numbers.
void chemical_equilibrium(HockSchittkowski& p, const std::vector<Expr>& logs,
                          const std::vector<Expr>& moles) {
  const double c[] = {-6.089,  -17.164, -34.054, -5.914,  -24.721,
                      -14.986, -24.100, -10.708, -26.662, -22.179};
  Expr total = 0, energy = 0;
  for (const Expr& each : moles) total += each;
  for (std::size_t j = 0; j < 10; ++j) energy += moles[j] * (c[j] + logs[j] - log(total));
  p.minimise(energy);
  const Variables m(moles);
  p.zero(m[1] + 2 * m[2] + 2 * m[3] + m[6] + m[10] - 2);
  p.zero(m[4] + 2 * m[5] + m[6] + m[7] - 1);
  p.zero(m[3] + m[7] + m[8] + 2 * m[9] + m[10] - 1);
}

HockSchittkowski problem_111() {
  HockSchittkowski p(111, -47.76109026);
  const auto x = p.variables(10, -2.3);
  p.lower({-100});
  p.upper({100});
  std::vector<Expr> moles;
  for (const Expr& each : x.list()) moles.push_back(exp(each));
  chemical_equilibrium(p, x.list(), moles);
  return p;
}

HockSchittkowski problem_112() {
  HockSchittkowski p(112, -47.707579);
  p.others = {-47.76109086};
  p.note = "the published value is not the optimum: 111 is the same problem in logarithms";
  const auto x = p.variables(10, 0.1);
  p.lower({1e-6});
  std::vector<Expr> logs;
  for (const Expr& each : x.list()) logs.push_back(log(each));
  chemical_equilibrium(p, logs, x.list());
  return p;
}

HockSchittkowski problem_113() {
  HockSchittkowski p(113, 24.3062091);
  const auto x = p.variables({2, 3, 5, 5, 1, 2, 7, 3, 6, 10});
  p.minimise(square(x[1]) + square(x[2]) + x[1] * x[2] - 14 * x[1] - 16 * x[2] + square(x[3] - 10) +
             4 * square(x[4] - 5) + square(x[5] - 3) + 2 * square(x[6] - 1) + 5 * square(x[7]) +
             7 * square(x[8] - 11) + 2 * square(x[9] - 10) + square(x[10] - 7) + 45);
  p.nonnegative(105 - 4 * x[1] - 5 * x[2] + 3 * x[7] - 9 * x[8]);
  p.nonnegative(-10 * x[1] + 8 * x[2] + 17 * x[7] - 2 * x[8]);
  p.nonnegative(8 * x[1] - 2 * x[2] - 5 * x[9] + 2 * x[10] + 12);
  p.nonnegative(-3 * square(x[1] - 2) - 4 * square(x[2] - 3) - 2 * square(x[3]) + 7 * x[4] + 120);
  p.nonnegative(-5 * square(x[1]) - 8 * x[2] - square(x[3] - 6) + 2 * x[4] + 40);
  p.nonnegative(-0.5 * square(x[1] - 8) - 2 * square(x[2] - 4) - 3 * square(x[5]) + x[6] + 30);
  p.nonnegative(-square(x[1]) - 2 * square(x[2] - 2) + 2 * x[1] * x[2] - 14 * x[5] + 6 * x[6]);
  p.nonnegative(3 * x[1] - 6 * x[2] - 12 * square(x[9] - 8) + 7 * x[10]);
  return p;
}

HockSchittkowski problem_114() {
  HockSchittkowski p(114, -1768.80696);
  const auto x = p.variables({1745, 12000, 110, 3048, 1974, 89.2, 92.8, 8, 3.6, 145});
  p.lower({1e-5, 1e-5, 1e-5, 1e-5, 1e-5, 85, 90, 3, 1.2, 145});
  p.upper({2000, 16000, 120, 5000, 2000, 93, 95, 12, 4, 162});
  const double a = 0.99, b = 0.9;
  const Expr g1 = 35.82 - 0.222 * x[10] - b * x[9];
  const Expr g2 = -133 + 3 * x[7] - a * x[10];
  const Expr g5 = 1.12 * x[1] + 0.13167 * x[1] * x[8] - 0.00667 * x[1] * square(x[8]) - a * x[4];
  const Expr g6 = 57.425 + 1.098 * x[8] - 0.038 * square(x[8]) + 0.325 * x[6] - a * x[7];
  p.minimise(5.04 * x[1] + 0.035 * x[2] + 10 * x[3] + 3.36 * x[5] - 0.063 * x[4] * x[7]);
  p.nonnegative(g1);
  p.nonnegative(g2);
  p.nonnegative(-g1 + x[9] * (1 / b - b));
  p.nonnegative(-g2 + (1 / a - a) * x[10]);
  p.nonnegative(g5);
  p.nonnegative(g6);
  p.nonnegative(-g5 + (1 / a - a) * x[4]);
  p.nonnegative(-g6 + (1 / a - a) * x[7]);
  p.zero(1.22 * x[4] - x[1] - x[5]);
  p.zero(98000 * x[3] / (x[4] * x[9] + 1000 * x[3]) - x[6]);
  p.zero((x[2] + x[5]) / x[1] - x[8]);
  return p;
}

HockSchittkowski problem_116() {
  HockSchittkowski p(116, 97.588409);
  p.others = {97.58750956};
  p.note = "the published value is not quite the optimum";
  const auto x = p.variables({0.5, 0.8, 0.9, 0.1, 0.14, 0.5, 489, 80, 650, 450, 150, 150, 150});
  p.lower({0.1, 0.1, 0.1, 1e-4, 0.1, 0.1, 0.1, 0.1, 500, 0.1, 1, 1e-4, 1e-4});
  p.upper({1, 1, 1, 0.1, 0.9, 0.9, 1000, 1000, 1000, 500, 150, 150, 150});
  const double a = 0.002, b = 1.262626, c = 1.231059, d = 0.03475, e = 0.975, f = 0.00975;
  const Expr sum = x[11] + x[12] + x[13];
  p.minimise(sum);
  p.nonnegative(x[3] - x[2]);
  p.nonnegative(x[2] - x[1]);
  p.nonnegative(1 - a * x[7] + a * x[8]);
  p.between(50, sum, 250);
  p.nonnegative(x[13] - b * x[10] + c * x[3] * x[10]);
  p.nonnegative(x[5] - d * x[2] - e * x[2] * x[5] + f * square(x[2]));
  p.nonnegative(x[6] - d * x[3] - e * x[3] * x[6] + f * square(x[3]));
  p.nonnegative(x[4] - d * x[1] - e * x[1] * x[4] + f * square(x[1]));
  p.nonnegative(x[12] - b * x[9] + c * x[2] * x[9]);
  p.nonnegative(x[11] - b * x[8] + c * x[1] * x[8]);
  p.nonnegative(x[5] * x[7] - x[1] * x[8] - x[4] * x[7] + x[4] * x[8]);
  p.nonnegative(1 - a * (x[2] * x[9] + x[5] * x[8] - x[1] * x[8] - x[6] * x[9]) - x[5] - x[6]);
  p.nonnegative(x[2] * x[9] - x[3] * x[10] - x[6] * x[9] - 500 * x[2] + 500 * x[6] + x[2] * x[10]);
  p.nonnegative(x[2] - 0.9 - a * (x[2] * x[10] - x[3] * x[10]));
  return p;
}

HockSchittkowski problem_118() {
  HockSchittkowski p(118, 664.82045);
  const auto x = p.variables({20, 55, 15, 20, 60, 20, 20, 60, 20, 20, 60, 20, 20, 60, 20});
  p.lower({8, 43, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  p.upper({21, 57, 16, 90, 120, 60, 90, 120, 60, 90, 120, 60, 90, 120, 60});
  const double least[] = {60, 50, 70, 85, 100}, most_change[] = {6, 7, 6};
  const double linear[] = {2.3, 1.7, 2.2}, quadratic[] = {1e-4, 1e-4, 1.5e-4};
  Expr cost = 0;
  for (std::size_t k = 0; k < 5; ++k) {
    Expr sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Expr& now = x[3 * k + i + 1];
      cost += linear[i] * now + quadratic[i] * square(now);
      sum += now;
      if (k > 0) p.between(-7, now - x[3 * k + i - 2], most_change[i]);
    }
    p.nonnegative(sum - least[k]);
  }
  p.minimise(cost);
  return p;
}

HockSchittkowski problem_119() {
  HockSchittkowski p(119, 244.899698);
  const auto x = p.variables(16, 10);
  p.lower({0});
  p.upper({5});
  const std::vector<std::size_t> pairs[] = {{1, 4, 7, 8, 16},
                                            {2, 3, 7, 10},
                                            {3, 7, 9, 10, 14},
                                            {4, 7, 11, 15},
                                            {5, 6, 10, 12, 16},
                                            {6, 8, 15},
                                            {7, 11, 13},
                                            {8, 10, 15},
                                            {9, 12, 16},
                                            {10, 14},
                                            {11, 13},
                                            {12, 14},
                                            {13, 14},
                                            {14},
                                            {15},
                                            {16}};
  const double b[8][8] = {{0.22, 0.20, 0.19, 0.25, 0.15, 0.11, 0.12, 0.13},
                          {-1.46, 0, -1.30, 1.82, -1.15, 0, 0.80, 0},
                          {1.29, -0.89, 0, 0, -1.16, -0.96, 0, -0.49},
                          {-1.10, -1.06, 0.95, -0.54, 0, -1.78, -0.41, 0},
                          {0, 0, 0, -1.43, 1.51, 0.59, -0.33, -0.43},
                          {0, -1.72, -0.33, 0, 1.62, 1.24, 0.21, -0.26},
                          {1.12, 0, 0, 0.31, 0, 0, 1.12, 0},
                          {0, 0.45, 0.26, -1.10, 0.58, 0, -1.03, 0.10}};
  const double c[] = {2.5, 1.1, -3.1, -3.5, 1.3, 2.1, 2.3, -1.5};
  const auto factor = [&](std::size_t i) { return square(x[i]) + x[i] + 1; };
  Expr sum = 0;
  for (std::size_t i = 1; i <= 16; ++i)
    for (const std::size_t j : pairs[i - 1]) sum += factor(i) * factor(j);
  p.minimise(sum);
  for (std::size_t i = 0; i < 8; ++i) {
    Expr row = x[9 + i] - c[i];
    if (i == 6) row -= 0.36 * x[9];
    for (std::size_t j = 0; j < 8; ++j) row += b[i][j] * x[j + 1];
    p.zero(row);
  }
  return p;
}

}  // namespace

std::vector<HockSchittkowski> problems_109_to_119() {
  return {problem_109(), problem_110(), problem_111(), problem_112(), problem_113(),
          problem_114(), problem_116(), problem_118(), problem_119()};
}

std::vector<HockSchittkowski> hock_schittkowski() {
  std::vector<HockSchittkowski> all;
  for (const auto part : {problems_1_to_23, problems_24_to_49, problems_50_to_70, problems_71_to_92,
                          problems_93_to_108, problems_109_to_119}) {
    auto problems = part();
    std::move(problems.begin(), problems.end(), std::back_inserter(all));
  }
  std::sort(all.begin(), all.end(),
            [](const auto& a, const auto& b) { return a.number < b.number; });
  return all;
}

const std::map<int, std::string>& hock_schittkowski_excluded() {
  static const std::map<int, std::string> excluded{
      {58, "no problem has this number"},
      {82, "no problem has this number"},
      {87, "the objective is discontinuous, at x1 = 300, x2 = 100 and x2 = 200"},
      {94, "no problem has this number"},
      {115, "no problem has this number"},
  };
  return excluded;
}

}  // namespace slalom::nlp
