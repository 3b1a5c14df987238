#include "slalom/ocp/scheme.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

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

/// Every scheme, those of any number of points with several.
std::vector<Scheme> all_schemes() {
  std::vector<Scheme> list = {backward_euler(), trapezoidal(), hermite_simpson(),
                              hermite_simpson_compressed()};
  for (const int n : {1, 2, 3, 5, 30}) {
    list.push_back(lgr(n));
    list.push_back(lgr_differential(n));
    list.push_back(lgr_flipped(n));
    if (n > 1) list.push_back(lgl(n));
  }
  return list;
}

class Tables : public testing::TestWithParam<Scheme> {};

TEST_P(Tables, AreWellFormed) {
  const Scheme& s = GetParam();
  EXPECT_EQ(s.points.front(), 0);
  EXPECT_EQ(s.points.back(), 1);
  EXPECT_EQ(s.defects(), (s.compressed ? 0 : s.interior()) + 1)
      << "one defect for each unknown state";
  EXPECT_EQ(s.state.size(), s.rate.size());
  EXPECT_EQ(s.weight.size(), s.points.size());
  for (std::size_t d = 0; d < s.defects(); ++d) {
    EXPECT_EQ(s.state[d].size(), s.points.size());
    EXPECT_EQ(s.rate[d].size(), s.points.size());
    double sum = 0, most = 0;
    for (double a : s.state[d]) {
      sum += a;
      most = std::max(most, std::fabs(a));
    }
    EXPECT_NEAR(sum, 0, 1e-14 * most) << "a constant state has no defect";
  }
}

/// Defect d of x = c^p.
double defect_of_power(const Scheme& s, std::size_t d, int p) {
  double defect = 0;
  for (std::size_t j = 0; j < s.points.size(); ++j) {
    const double c = s.points[j];
    defect += s.state[d][j] * std::pow(c, p);
    if (p > 0) defect -= s.rate[d][j] * p * std::pow(c, p - 1);
  }
  return defect;
}

// The state's polynomial has one degree for each collocated point; what leads to the end is exact
// to the order (in differentiation form no single row does).
TEST_P(Tables, AreExactForPolynomials) {
  const Scheme& s = GetParam();
  int collocated = 0;
  for (std::size_t j = 0; j < s.points.size(); ++j) collocated += s.collocates(j) ? 1 : 0;
  for (std::size_t d = 0; d < s.defects(); ++d) {
    const bool to_end = d + 1 == s.defects() && s.name != "lgr_differential";
    const int exact = to_end ? s.order : collocated;
    for (int p = 0; p <= exact; ++p)
      EXPECT_NEAR(defect_of_power(s, d, p), 0, s.name == "lgr_differential" ? 1e-11 : 1e-14)
          << s.name << " row " << d << " degree " << p;
    if (s.order < 12)
      EXPECT_GT(std::fabs(defect_of_power(s, d, exact + 1)), 1e-6) << "no better than it claims";
  }
  for (int p = 0; p < s.order; ++p) {
    double integral = 0;
    for (std::size_t j = 0; j < s.points.size(); ++j)
      integral += s.weight[j] * std::pow(s.points[j], p);
    EXPECT_NEAR(integral, 1.0 / (p + 1), 1e-14) << s.name << " quadrature of degree " << p;
  }
}

INSTANTIATE_TEST_SUITE_P(Schemes, Tables, testing::ValuesIn(all_schemes()), [](const auto& info) {
  return info.param.name + "_" + std::to_string(info.param.points.size());
});

TEST(Scheme, LobattoOfTwoAndThreePointsAreTheOldOnes) {
  EXPECT_EQ(lgl(2).rate, trapezoidal().rate);
  const Scheme simpson = lgl(3);
  for (std::size_t j = 0; j < 3; ++j)
    EXPECT_NEAR(simpson.rate[1][j], hermite_simpson().rate[1][j], 1e-15);
}

TEST(Scheme, FlippedRadauOfOnePointIsBackwardEulerAndOfMoreTheMirrorImage) {
  EXPECT_EQ(lgr_flipped(1).rate, backward_euler().rate);
  const Scheme ahead = lgr(4), back = lgr_flipped(4);
  for (std::size_t j = 0; j < 5; ++j) EXPECT_NEAR(back.points[j], 1 - ahead.points[4 - j], 1e-15);
  EXPECT_FALSE(back.collocates(0));
  EXPECT_TRUE(back.collocates(4));
}

TEST(Scheme, ByName) {
  for (const auto& name : scheme_names()) EXPECT_EQ(scheme(name, 3).name, name);
  for (const auto& name : scheme_names())
    EXPECT_EQ(has_choice_of_points(name), scheme(name, 3).points != scheme(name, 4).points) << name;
  EXPECT_EQ(scheme("lgl", 7).points.size(), 7u);
  EXPECT_EQ(refusal([] { (void)scheme("trapezodial"); }),
            "scheme: found 'trapezodial', expected perhaps 'trapezoidal'");
  EXPECT_EQ(refusal([] { (void)scheme("lgr", 0); }),
            "Legendre-Gauss-Radau rule: found 0 points, expected at least 1");
}

TEST(Schemes, OneForAllOrOneForEach) {
  const Mesh mesh = Mesh::uniform(3);
  EXPECT_EQ(Schemes(lgr(4)).most_points(), 5u);
  EXPECT_NO_THROW(Schemes({lgr(2), lgr(5), trapezoidal()}).check(mesh));
  EXPECT_EQ(refusal([&] {
              Schemes({lgr(2), lgr(5)}).check(mesh);
            }),
            "schemes: found 2, expected one, or one for each of 3 intervals");
  EXPECT_NE(refusal([] { Schemes(std::vector<Scheme>{}); }), "accepted");
}

}  // namespace
}  // namespace slalom::ocp
