#include "slalom/ocp/scheme.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ocp/messages.hpp"

namespace slalom::ocp {
namespace {

using test::refusal;

TEST(Mesh, UniformAndGiven) {
  const Mesh mesh = Mesh::uniform(4);
  EXPECT_EQ(mesh.intervals(), 4u);
  EXPECT_EQ(mesh.breakpoints(), (std::vector<double>{0, 0.25, 0.5, 0.75, 1}));
  EXPECT_EQ(Mesh::uniform(1).breakpoints(), (std::vector<double>{0, 1}));
  EXPECT_EQ(Mesh({0, 0.1, 1}).intervals(), 2u);
  for (int n : {3, 7, 10, 49}) EXPECT_EQ(Mesh::uniform(n).breakpoints().back(), 1) << n;
}

TEST(Mesh, ErrorsSayWhatAndTheRule) {
  EXPECT_EQ(refusal([] { Mesh::uniform(0); }), "mesh: found 0 intervals, expected at least 1");
  EXPECT_EQ(refusal([] { Mesh::uniform(-3); }), "mesh: found -3 intervals, expected at least 1");
  EXPECT_EQ(refusal([] { Mesh({0}); }), "mesh: found 1 breakpoints, expected at least 2");
  EXPECT_EQ(refusal([] { Mesh(std::vector<double>{}); }),
            "mesh: found 0 breakpoints, expected at least 2");
  EXPECT_EQ(refusal([] {
              Mesh({0.1, 1});
            }),
            "mesh: found breakpoints from 0.1 to 1, expected from 0 to 1");
  EXPECT_EQ(refusal([] {
              Mesh({0, 0.5, 2});
            }),
            "mesh: found breakpoints from 0 to 2, expected from 0 to 1");
  EXPECT_EQ(refusal([] {
              Mesh({0, 0.5, 0.5, 1});
            }),
            "mesh: found breakpoint 2 = 0.5 after 0.5, expected strictly increasing breakpoints");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal([&] { Mesh({0, nan, 1}); }).find("breakpoint 1 = nan"), std::string::npos);
  EXPECT_NE(refusal([&] { Mesh({nan, 1}); }), "accepted");
}

class Tables : public testing::TestWithParam<const Scheme*> {};

TEST_P(Tables, AreWellFormed) {
  const Scheme& s = *GetParam();
  EXPECT_EQ(s.points.front(), 0);
  EXPECT_EQ(s.points.back(), 1);
  EXPECT_EQ(s.defects(), s.interior() + 1) << "one defect for each unknown state";
  EXPECT_EQ(s.state.size(), s.rate.size());
  EXPECT_EQ(s.weight.size(), s.points.size());
  for (std::size_t d = 0; d < s.defects(); ++d) {
    EXPECT_EQ(s.state[d].size(), s.points.size());
    EXPECT_EQ(s.rate[d].size(), s.points.size());
    double sum = 0;
    for (double a : s.state[d]) sum += a;
    EXPECT_NEAR(sum, 0, 1e-15) << "a constant state has no defect";
  }
}

// x = c^p, x' = p c^(p-1): no defect up to the degree of the scheme's order for its quadrature row;
// Hermite's interpolant (the midpoint's row) is exact for cubics.
TEST_P(Tables, AreExactForPolynomials) {
  const Scheme& s = *GetParam();
  for (std::size_t d = 0; d < s.defects(); ++d) {
    const bool last = d + 1 == s.defects();
    const int exact = last ? s.order : 3;
    for (int p = 0; p <= exact + 1; ++p) {
      double defect = 0;
      for (std::size_t j = 0; j < s.points.size(); ++j) {
        const double c = s.points[j];
        defect += s.state[d][j] * std::pow(c, p);
        if (p > 0) defect -= s.rate[d][j] * p * std::pow(c, p - 1);
      }
      if (p <= exact)
        EXPECT_NEAR(defect, 0, 1e-15) << s.name << " row " << d << " degree " << p;
      else
        EXPECT_GT(std::fabs(defect), 1e-3) << s.name << ": no better than it claims";
    }
  }
  for (int p = 0; p < s.order; ++p) {
    double integral = 0;
    for (std::size_t j = 0; j < s.points.size(); ++j)
      integral += s.weight[j] * std::pow(s.points[j], p);
    EXPECT_NEAR(integral, 1.0 / (p + 1), 1e-15) << s.name << " quadrature of degree " << p;
  }
}

INSTANTIATE_TEST_SUITE_P(Schemes, Tables, testing::Values(&trapezoidal(), &hermite_simpson()),
                         [](const auto& info) { return info.param->name; });

}  // namespace
}  // namespace slalom::ocp
