// Two to seven variables; 66 stands beside its relative 34.

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

#include "nlp/hock_schittkowski/problems.hpp"

namespace slalom::nlp {
namespace {

using expr::Expr;
constexpr double kSqrt2 = std::numbers::sqrt2;

HockSchittkowski problem_50() {
  HockSchittkowski p(50, 0);
  const auto x = p.variables({35, -31, 11, 5, -5});
  p.minimise(square(x[1] - x[2]) + square(x[2] - x[3]) + pow(x[3] - x[4], 4) + square(x[4] - x[5]));
  p.zero(x[1] + 2 * x[2] + 3 * x[3] - 6);
  p.zero(x[2] + 2 * x[3] + 3 * x[4] - 6);
  p.zero(x[3] + 2 * x[4] + 3 * x[5] - 6);
  return p;
}

HockSchittkowski problem_51() {
  HockSchittkowski p(51, 0);
  const auto x = p.variables({2.5, 0.5, 2, -1, 0.5});
  p.minimise(square(x[1] - x[2]) + square(x[2] + x[3] - 2) + square(x[4] - 1) + square(x[5] - 1));
  p.zero(x[1] + 3 * x[2] - 4);
  p.zero(x[3] + x[4] - 2 * x[5]);
  p.zero(x[2] - x[5]);
  return p;
}

/// Rows of problems 52 and 53.
Variables homogeneous_rows(HockSchittkowski& p) {
  auto x = p.variables(5, 2);
  p.zero(x[1] + 3 * x[2]);
  p.zero(x[3] + x[4] - 2 * x[5]);
  p.zero(x[2] - x[5]);
  return x;
}

HockSchittkowski problem_52() {
  HockSchittkowski p(52, 1859.0 / 349);
  const auto x = homogeneous_rows(p);
  p.minimise(square(4 * x[1] - x[2]) + square(x[2] + x[3] - 2) + square(x[4] - 1) +
             square(x[5] - 1));
  return p;
}

HockSchittkowski problem_53() {
  HockSchittkowski p(53, 176.0 / 43);
  const auto x = homogeneous_rows(p);
  p.lower({-10});
  p.upper({10});
  p.minimise(square(x[1] - x[2]) + square(x[2] + x[3] - 2) + square(x[4] - 1) + square(x[5] - 1));
  return p;
}

HockSchittkowski problem_54() {
  HockSchittkowski p(54, -std::exp(-27.0 / 280));
  const auto x = p.variables({6e3, 1.5, 4e6, 2, 3e-3, 5e7});
  p.lower({0, -10, 0, 0, -1, 0});
  p.upper({2e4, 10, 1e7, 20, 1, 2e8});
  const Expr h =
      (square(x[1] - 1e4) / 6.4e7 + (x[1] - 1e4) * (x[2] - 1) / 2e4 + square(x[2] - 1)) / 0.96 +
      square(x[3] - 2e6) / 4.9e13 + square(x[4] - 10) / 2.5e3 + square(x[5] - 1e-3) / 2.5e-3 +
      square(x[6] - 1e8) / 2.5e17;
  p.minimise(-exp(-h / 2));
  p.zero(x[1] + 4e3 * x[2] - 1.76e4);
  return p;
}

HockSchittkowski problem_55() {
  HockSchittkowski p(55, 19.0 / 3);
  p.others = {20.0 / 3};
  p.note = "the feasible set is a segment, each end a local optimum; the rows are dependent";
  p.published_at = {0, 4.0 / 3, 5.0 / 3, 1, 2.0 / 3, 1.0 / 3};
  const auto x = p.variables({1, 2, 0, 0, 0, 2});
  p.lower({0});
  p.upper({1, kInf, kInf, 1, kInf, kInf});
  p.minimise(x[1] + 2 * x[2] + 4 * x[5] + exp(x[1] * x[4]));
  p.zero(x[1] + 2 * x[2] + 5 * x[5] - 6);
  p.zero(x[1] + x[2] + x[3] - 3);
  p.zero(x[4] + x[5] + x[6] - 2);
  p.zero(x[1] + x[4] - 1);
  p.zero(x[2] + x[5] - 2);
  p.zero(x[3] + x[6] - 2);
  return p;
}

HockSchittkowski problem_56() {
  HockSchittkowski p(56, -3.456);
  const double a = std::asin(std::sqrt(1 / 4.2)), b = std::asin(std::sqrt(5 / 7.2));
  const auto x = p.variables({1, 1, 1, a, a, a, b});
  p.minimise(-x[1] * x[2] * x[3]);
  for (std::size_t i = 1; i <= 3; ++i) p.zero(x[i] - 4.2 * square(sin(x[i + 3])));
  p.zero(x[1] + 2 * x[2] + 2 * x[3] - 7.2 * square(sin(x[7])));
  return p;
}

HockSchittkowski problem_57() {
  HockSchittkowski p(57, 0.02845966972);
  p.others = {0.03064761905};
  p.note = "a plateau, where x2 is so large that all terms but the first two are constant";
  p.published_at = {0.419952675, 1.284845629};
  const auto x = p.variables({0.42, 5});
  p.lower({0.4, -4});
  const Vector a{8,  8,  10, 10, 10, 10, 12, 12, 12, 12, 14, 14, 14, 16, 16,
                 16, 18, 18, 20, 20, 20, 22, 22, 22, 24, 24, 24, 26, 26, 26,
                 28, 28, 30, 30, 30, 32, 32, 34, 36, 36, 38, 38, 40, 42};
  const Vector b{0.49, 0.49, 0.48, 0.47, 0.48, 0.47, 0.46, 0.46, 0.45, 0.43, 0.45,
                 0.43, 0.43, 0.44, 0.43, 0.43, 0.46, 0.45, 0.42, 0.42, 0.43, 0.41,
                 0.41, 0.40, 0.42, 0.40, 0.40, 0.41, 0.40, 0.41, 0.41, 0.40, 0.40,
                 0.40, 0.38, 0.41, 0.40, 0.40, 0.41, 0.38, 0.40, 0.40, 0.39, 0.39};
  Expr sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += square(b[i] - x[1] - (0.49 - x[1]) * exp(-x[2] * (a[i] - 8)));
  p.minimise(sum);
  p.nonnegative(0.49 * x[2] - x[1] * x[2] - 0.09);
  return p;
}

HockSchittkowski problem_59() {
  HockSchittkowski p(59, -7.804226324);
  p.others = {-7.802789469, -6.749505274};
  p.note = "with the published coefficients f(x*) is -7.80278; a second local optimum";
  const auto x = p.variables({90, 10});
  p.lower({0});
  p.upper({75, 65});
  const Expr &u = x[1], &v = x[2];
  p.minimise(-75.196 + 3.8112 * u - 0.12694 * pow(u, 2) + 0.0020567 * pow(u, 3) -
             1.0345e-5 * pow(u, 4) + 6.8306 * v - 0.030234 * u * v + 1.28134e-3 * v * pow(u, 2) -
             3.5256e-5 * v * pow(u, 3) + 2.266e-7 * v * pow(u, 4) - 0.25645 * pow(v, 2) +
             0.0034604 * pow(v, 3) - 1.3514e-5 * pow(v, 4) + 28.106 / (v + 1) +
             5.2375e-6 * pow(u, 2) * pow(v, 2) + 6.3e-8 * pow(u, 3) * pow(v, 2) -
             7e-10 * pow(u, 3) * pow(v, 3) - 3.405e-4 * u * pow(v, 2) + 1.6638e-6 * u * pow(v, 3) +
             2.8673 * exp(0.0005 * u * v));
  p.nonnegative(u * v - 700);
  p.nonnegative(v - square(u) / 125);
  p.nonnegative(square(v - 50) - 5 * (u - 55));
  return p;
}

HockSchittkowski problem_60() {
  HockSchittkowski p(60, 0.03256820025);
  const auto x = p.variables(3, 2);
  p.lower({-10});
  p.upper({10});
  p.minimise(square(x[1] - 1) + square(x[1] - x[2]) + pow(x[2] - x[3], 4));
  p.zero(x[1] * (1 + square(x[2])) + pow(x[3], 4) - 4 - 3 * kSqrt2);
  return p;
}

HockSchittkowski problem_61() {
  HockSchittkowski p(61, -143.6461422);
  const auto x = p.variables(3, 0);
  p.minimise(4 * square(x[1]) + 2 * square(x[2]) + 2 * square(x[3]) - 33 * x[1] + 16 * x[2] -
             24 * x[3]);
  p.zero(3 * x[1] - 2 * square(x[2]) - 7);
  p.zero(4 * x[1] - square(x[3]) - 11);
  return p;
}

HockSchittkowski problem_62() {
  HockSchittkowski p(62, -26272.51448);
  const auto x = p.variables({0.7, 0.2, 0.1});
  p.lower({0});
  p.upper({1});
  const Expr both = x[2] + x[3] + 0.03;
  p.minimise(-32.174 * (255 * log((x[1] + both) / (0.09 * x[1] + both)) +
                        280 * log(both / (0.07 * x[2] + x[3] + 0.03)) +
                        290 * log((x[3] + 0.03) / (0.13 * x[3] + 0.03))));
  p.zero(x[1] + x[2] + x[3] - 1);
  return p;
}

HockSchittkowski problem_63() {
  HockSchittkowski p(63, 961.7151721);
  const auto x = p.variables(3, 2);
  p.lower({0});
  p.minimise(1000 - square(x[1]) - 2 * square(x[2]) - square(x[3]) - x[1] * x[2] - x[1] * x[3]);
  p.zero(8 * x[1] + 14 * x[2] + 7 * x[3] - 56);
  p.zero(square(x[1]) + square(x[2]) + square(x[3]) - 25);
  return p;
}

HockSchittkowski problem_64() {
  HockSchittkowski p(64, 6299.842428);
  const auto x = p.variables(3, 1);
  p.lower({1e-5});
  p.minimise(5 * x[1] + 5e4 / x[1] + 20 * x[2] + 7.2e4 / x[2] + 10 * x[3] + 1.44e5 / x[3]);
  p.nonnegative(1 - 4 / x[1] - 32 / x[2] - 120 / x[3]);
  return p;
}

HockSchittkowski problem_65() {
  HockSchittkowski p(65, 0.9535288567);
  const auto x = p.variables({-5, 5, 0});
  p.lower({-4.5, -4.5, -5});
  p.upper({4.5, 4.5, 5});
  p.minimise(square(x[1] - x[2]) + square(x[1] + x[2] - 10) / 9 + square(x[3] - 5));
  p.nonnegative(48 - square(x[1]) - square(x[2]) - square(x[3]));
  return p;
}

/// The published y2 and y4 are limits of fixed-point iterations; here they are the roots of the
/// quadratic equations that those solve.
HockSchittkowski problem_67() {
  HockSchittkowski p(67, -1162.036507);
  p.others = {-1162.026980};
  p.note = "the published iteration ends at differences of 0.001 in y2 and y4, ours is exact";
  const auto x = p.variables({1745, 12000, 110});
  p.lower({1e-5});
  p.upper({2e3, 1.6e4, 1.2e2});
  // y6 = (x2 + 1.22 y2) / x1 - 1 with y2 = 0.01 x1 (112 + 13.167 y6 - 0.6667 y6^2)
  const double a = 0.0122 * 0.6667, b = 1 - 0.0122 * 13.167;
  const Expr c = x[2] / x[1] + 1.22 * 1.12 - 1;
  const Expr y6 = (sqrt(b * b + 4 * a * c) - b) / (2 * a);
  const Expr y2 = 0.01 * x[1] * (112 + 13.167 * y6 - 0.6667 * square(y6));
  const Expr y3 = 1.22 * y2 - x[1];
  // y4 = 98000 x3 / (y2 y7 + 1000 x3) with y7 = 35.82 - 0.222 (3 y5 - 133), y5 linear in y4
  const Expr y5_at_0 = 86.35 + 1.098 * y6 - 0.038 * square(y6) - 0.325 * 89;
  const double y7_by_y4 = 0.222 * 3 * 0.325;
  const Expr linear = y2 * (35.82 - 0.222 * (3 * y5_at_0 - 133)) + 1000 * x[3];
  const Expr y4 =
      2 * 98000 * x[3] / (linear + sqrt(square(linear) - 4 * y7_by_y4 * y2 * 98000 * x[3]));
  const Expr y5 = y5_at_0 + 0.325 * y4;
  const Expr y8 = 3 * y5 - 133;
  const Expr y7 = 35.82 - 0.222 * y8;
  p.minimise(-(0.063 * y2 * y5 - 5.04 * x[1] - 3.36 * y3 - 0.035 * x[2] - 10 * x[3]));
  const Expr y[] = {y2, y3, y4, y5, y6, y7, y8};
  const double least[] = {0, 0, 85, 90, 3, 0.01, 145};
  const double most[] = {5000, 2000, 93, 95, 12, 4, 162};
  for (std::size_t i = 0; i < 7; ++i) p.nonnegative(y[i] - least[i]);
  for (std::size_t i = 0; i < 7; ++i) p.nonnegative(most[i] - y[i]);
  return p;
}

/// The normal distribution function by quadrature from 0 to t (to rounding for |t| < 9, where 68
/// and 69 have their optima).
Expr normal_distribution(const Expr& t) {
  using Rule = boost::math::quadrature::gauss<double, 60>;
  Expr sum = 0;
  for (std::size_t i = 0; i < Rule::abscissa().size(); ++i)
    for (const double sign : {-1.0, 1.0}) {
      const double s = (1 + sign * Rule::abscissa()[i]) / 2;
      sum += Rule::weights()[i] / 2 * exp(-0.5 * s * s * square(t));
    }
  return 0.5 + t * sum / std::sqrt(2 * std::numbers::pi);
}

HockSchittkowski cost_optimal_inspection(int number, double published, double a, double b,
                                         double n) {
  HockSchittkowski p(number, published);
  const auto x = p.variables(4, 1);
  p.lower({1e-4, 0, 0, 0});
  p.upper({100, 100, 2, 2});
  const Expr growth = exp(x[1]) - 1;
  p.minimise((a * n - (b * growth - x[3]) / (growth + x[4]) * x[4]) / x[1]);
  p.zero(x[3] - 2 * normal_distribution(-x[2]));
  p.zero(x[4] - normal_distribution(-x[2] + std::sqrt(n)) -
         normal_distribution(-x[2] - std::sqrt(n)));
  return p;
}

HockSchittkowski problem_70() {
  HockSchittkowski p(70, 0.007498464);
  const auto x = p.variables({2, 4, 0.04, 2});
  p.lower({1e-5});
  p.upper({100, 100, 1, 100});
  const Vector c{0.1, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18};
  const Vector observed{0.00189, 0.1038, 0.268,  0.506,   0.577,  0.604, 0.725,
                        0.898,   0.947,  0.845,  0.702,   0.528,  0.385, 0.257,
                        0.159,   0.0869, 0.0453, 0.01509, 0.00189};
  const Expr b = x[3] + (1 - x[3]) * x[4];
  const auto density = [](const Expr& shape, const Expr& rate, double time) {
    const double t = time / 7.658;
    return pow(rate, shape) * sqrt(shape / 6.2832) * exp((shape - 1) * std::log(t)) *
           exp(shape - rate * t * shape) / (1 + 1 / (12 * shape));
  };
  Expr sum = 0;
  for (std::size_t i = 0; i < c.size(); ++i)
    sum += square(x[3] * density(x[2], b, c[i]) + (1 - x[3]) * density(x[1], b / x[4], c[i]) -
                  observed[i]);
  p.minimise(sum);
  p.nonnegative(x[3] + (1 - x[3]) * x[4]);
  return p;
}

}  // namespace

std::vector<HockSchittkowski> problems_50_to_70() {
  return {problem_50(),
          problem_51(),
          problem_52(),
          problem_53(),
          problem_54(),
          problem_55(),
          problem_56(),
          problem_57(),
          problem_59(),
          problem_60(),
          problem_61(),
          problem_62(),
          problem_63(),
          problem_64(),
          problem_65(),
          problem_67(),
          cost_optimal_inspection(68, -0.920425026, 0.0001, 1, 24),
          cost_optimal_inspection(69, -956.71288, 0.1, 1000, 4),
          problem_70()};
}

}  // namespace slalom::nlp
