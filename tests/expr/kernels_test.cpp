#include "slalom/base/kernels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "expr/op_cases.hpp"
#include "expr/reference.hpp"
#include "support/kernel_sets.hpp"

namespace slalom::expr {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

class Kernels : public OnKernelSet {
 protected:
  static std::vector<double> run(const OpCase& c, const std::vector<double>& x) {
    const auto symbols = c.symbols();
    const Function f(symbols, {}, {c.build(symbols)});
    std::vector<double> y(x.size() / symbols.size());
    f.evaluate(y.size(), x, {}, {}, {}, y, {}, {});
    return y;
  }
};

/// std's value of one operation.
double expected(Op op, double a, double b, double c) {
  return op == Op::pow ? std::pow(a, b) : reference::apply(op, a, b, c);
}

TEST_P(Kernels, EveryOperationIsWithinTwoUlpOfStd) {
  std::mt19937_64 random(2);
  for (const auto& c : op_cases()) {
    const std::size_t lanes = 500, n = c.range.size();
    std::vector<double> x(n * lanes);
    for (std::size_t l = 0; l < lanes; ++l) {
      const auto point = c.point(random);
      for (std::size_t i = 0; i < n; ++i) x[i * lanes + l] = point[i];
    }
    const auto y = run(c, x);
    for (std::size_t l = 0; l < lanes; ++l) {
      const double want =
          expected(c.op, x[l], n > 1 ? x[lanes + l] : 0, n > 2 ? x[2 * lanes + l] : 0);
      ASSERT_LE(reference::ulps(y[l], want), 2) << c.name << " at " << x[l] << ": " << y[l];
    }
  }
}

TEST_P(Kernels, EdgesOfTheDomainAreAsInStd) {
  const std::vector<double> edges = {0,    -0.0,  1,    -1,     2,     0.5,   -3,
                                     kInf, -kInf, kNaN, 1e-310, 1e300, -1e300};
  for (const auto& c : op_cases()) {
    const std::size_t n = c.range.size();
    std::vector<std::vector<double>> points{{}};
    for (std::size_t i = 0; i < n; ++i) {
      std::vector<std::vector<double>> longer;
      for (const auto& point : points)
        for (double edge : edges) {
          longer.push_back(point);
          longer.back().push_back(edge);
        }
      points = longer;
    }
    std::vector<double> x(n * points.size());
    for (std::size_t l = 0; l < points.size(); ++l)
      for (std::size_t i = 0; i < n; ++i) x[i * points.size() + l] = points[l][i];
    const auto y = run(c, x);
    for (std::size_t l = 0; l < points.size(); ++l) {
      const auto& p = points[l];
      double want = expected(c.op, p[0], n > 1 ? p[1] : 0, n > 2 ? p[2] : 0);
      if (c.op == Op::sign && std::isnan(p[0])) want = kNaN;
      ASSERT_LE(reference::ulps(y[l], want), 4)
          << c.name << " at " << p[0] << ", " << (n > 1 ? p[1] : 0) << ": " << y[l] << " not "
          << want;
    }
  }
}

/// A lane's bits are its own, however wild the neighbours in its vector are.
TEST_P(Kernels, NeighboursDoNotTouchALane) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> exponent(-300, 300);
  for (const auto& c : op_cases()) {
    const std::size_t lanes = 40'000, n = c.range.size();  // a difference is rare
    std::vector<double> calm(n * lanes), mixed(n * lanes);
    for (std::size_t l = 0; l < lanes; ++l) {
      const auto point = c.point(random);
      for (std::size_t i = 0; i < n; ++i) {
        calm[i * lanes + l] = mixed[i * lanes + l] = point[i];
        if (l % 2 != 0) mixed[i * lanes + l] = l % 8 == 1 ? kNaN : std::pow(10, exponent(random));
      }
    }
    const auto alone = run(c, calm), beside = run(c, mixed);
    for (std::size_t l = 0; l < lanes; l += 2)
      ASSERT_EQ(std::bit_cast<std::uint64_t>(alone[l]), std::bit_cast<std::uint64_t>(beside[l]))
          << c.name << " at " << calm[l];
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, Kernels, each_kernel_set(), name_of_set);

}  // namespace
}  // namespace slalom::expr
