// Derivatives of whole transcriptions against central differences of their values.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "ocp/kitchen_sink.hpp"

namespace slalom::ocp {
namespace {

using Vector = std::vector<double>;

struct Case {
  const char* name;
  Scheme scheme;
  Mesh mesh;
  std::vector<ControlForm> forms = {ControlForm::scheme, ControlForm::scheme};  // of u and w
  bool soft = false;
};

KitchenSink sink_of(const Case& c) {
  KitchenSink sink;
  sink.problem.control_form(sink.u, c.forms[0]);
  sink.problem.control_form(sink.w, c.forms[1]);
  if (!c.soft) return sink;
  sink.problem.soften(sink.wall, {Norm::l1, 3, 0.1});
  sink.problem.soften(sink.band, {Norm::l2, 0.5, 0});
  sink.problem.soften(sink.family, {Norm::l1, 2, 0});
  sink.problem.soften(sink.end, {Norm::l2, 7, 0.2});
  return sink;
}

class Derivatives : public testing::TestWithParam<Case> {
 protected:
  KitchenSink sink = sink_of(GetParam());
  Transcription transcription{sink.problem, GetParam().mesh, GetParam().scheme};
  Vector x = some_point(transcription);

  /// f(x + h e_i) - f(x - h e_i) over 2 h, fourth order by Richardson.
  template <class F>
  Vector difference(F f, std::size_t i) const {
    const auto central = [&](double h) {
      Vector up = x, down = x;
      up[i] += h;
      down[i] -= h;
      Vector a = f(up);
      const Vector b = f(down);
      for (std::size_t k = 0; k < a.size(); ++k) a[k] = (a[k] - b[k]) / (2 * h);
      return a;
    };
    Vector fine = central(5e-4);
    const Vector coarse = central(1e-3);
    for (std::size_t k = 0; k < fine.size(); ++k) fine[k] += (fine[k] - coarse[k]) / 3;
    return fine;
  }
};

void expect_close(double value, double expected, double size, const std::string& what) {
  EXPECT_NEAR(value, expected, 1e-7 * std::max(std::fabs(expected), size)) << what;
}

TEST_P(Derivatives, GradientAndJacobian) {
  const auto& shape = transcription.structure();
  nlp::Evaluation at;
  ASSERT_FALSE(transcription.evaluate(x, 1, {}, {.values = true, .derivatives = true}, at));
  const auto values = [&](const Vector& point) {
    nlp::Evaluation out;
    transcription.evaluate(point, 1, {}, {.values = true}, out);
    out.rows.push_back(out.objective);
    return out.rows;
  };
  for (std::size_t i = 0; i < shape.variables; ++i) {
    const Vector slope = difference(values, i);
    const std::string by = " by " + transcription.variable_name(i);
    expect_close(at.gradient[i], slope.back(), 1e-2, "objective" + by);
    for (std::size_t r = 0; r < shape.rows; ++r) {
      double entry = 0;
      for (std::size_t e = 0; e < at.jacobian.size(); ++e)
        if (shape.jacobian_row[e] == r && shape.jacobian_col[e] == i) entry += at.jacobian[e];
      expect_close(entry, slope[r], 1e-2, transcription.row_name(r) + by);
    }
  }
}

TEST_P(Derivatives, HessianOfTheLagrangian) {
  const auto& shape = transcription.structure();
  const double sigma = 1.7;
  Vector y(shape.rows);
  for (std::size_t r = 0; r < y.size(); ++r) y[r] = std::sin(1.0 + 3.0 * static_cast<double>(r));
  nlp::Evaluation at;
  ASSERT_FALSE(transcription.evaluate(x, sigma, y, {.hessian = true}, at));
  std::map<std::pair<std::size_t, std::size_t>, double> hessian;
  for (std::size_t e = 0; e < at.hessian.size(); ++e) {
    EXPECT_GE(shape.hessian_row[e], shape.hessian_col[e]) << "lower triangle";
    EXPECT_TRUE(
        hessian.insert({{shape.hessian_row[e], shape.hessian_col[e]}, at.hessian[e]}).second)
        << "each entry once";
  }
  const auto slope_of_lagrangian = [&](const Vector& point) {
    nlp::Evaluation out;
    transcription.evaluate(point, 1, {}, {.derivatives = true}, out);
    for (auto& g : out.gradient) g *= sigma;
    for (std::size_t e = 0; e < out.jacobian.size(); ++e)
      out.gradient[shape.jacobian_col[e]] += y[shape.jacobian_row[e]] * out.jacobian[e];
    return out.gradient;
  };
  for (std::size_t i = 0; i < shape.variables; ++i) {
    const Vector slope = difference(slope_of_lagrangian, i);
    for (std::size_t j = 0; j < shape.variables; ++j) {
      const auto it = hessian.find({std::max(i, j), std::min(i, j)});
      expect_close(it == hessian.end() ? 0 : it->second, slope[j], 1e-1,
                   transcription.variable_name(i) + ", " + transcription.variable_name(j));
    }
  }
}

TEST_P(Derivatives, PartsDoNotDisturbEachOther) {
  const Vector y(transcription.structure().rows, 0.3);
  nlp::Evaluation whole, parts;
  transcription.evaluate(x, 1, y, {.values = true, .derivatives = true, .hessian = true}, whole);
  transcription.evaluate(x, 1, y, {.hessian = true}, parts);
  transcription.evaluate(x, 1, y, {.derivatives = true}, parts);
  transcription.evaluate(x, 1, y, {.values = true}, parts);
  EXPECT_EQ(whole.objective, parts.objective);
  EXPECT_EQ(whole.rows, parts.rows);
  EXPECT_EQ(whole.gradient, parts.gradient);
  EXPECT_EQ(whole.jacobian, parts.jacobian);
  EXPECT_EQ(whole.hessian, parts.hessian);
}

constexpr ControlForm kScheme = ControlForm::scheme, kLinear = ControlForm::linear,
                      kConstant = ControlForm::constant;

INSTANTIATE_TEST_SUITE_P(
    Transcriptions, Derivatives,
    testing::Values(
        Case{"trapezoidal", trapezoidal(), Mesh::uniform(3)},
        Case{"trapezoidal_one_interval", trapezoidal(), Mesh::uniform(1)},
        Case{"trapezoidal_nonuniform", trapezoidal(), Mesh({0, 0.1, 0.45, 1})},
        Case{"trapezoidal_held", trapezoidal(), Mesh({0, 0.1, 0.45, 1}), {kConstant, kScheme}},
        Case{"hermite_simpson", hermite_simpson(), Mesh::uniform(3)},
        Case{"hermite_simpson_nonuniform", hermite_simpson(), Mesh({0, 0.3, 1})},
        Case{"compressed", hermite_simpson_compressed(), Mesh({0, 0.3, 0.7, 1})},
        Case{"compressed_held",
             hermite_simpson_compressed(),
             Mesh({0, 0.3, 1}),
             {kConstant, kLinear},
             true},
        Case{"soft", hermite_simpson(), Mesh({0, 0.3, 1}), {kScheme, kConstant}, true},
        Case{"lgr_soft", lgr(3), Mesh({0, 0.3, 1}), {kLinear, kConstant}, true}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace slalom::ocp
