// The stage-structured factorisation against the dense one, and both against their residual.

#include "slalom/kkt/system.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace slalom::kkt {
namespace {

/// How a random system is made.
struct Shape {
  std::vector<std::size_t> variables;  ///< by stage
  std::vector<std::size_t> defects;    ///< equations coupling each stage with the next
  std::size_t local_equations = 0, inequalities = 0, globals = 0, border_rows = 0;
  double hessian = 4;  ///< size of W's diagonal; 0: no Hessian at all
};

struct System {
  Pattern pattern;
  std::vector<double> hessian, diagonal, jacobian, row_diagonal;

  Values values() const { return {hessian, diagonal, jacobian, row_diagonal}; }
  std::size_t equations() const {
    return static_cast<std::size_t>(
        std::count(pattern.equation.begin(), pattern.equation.end(), 1));
  }
};

class Maker {
 public:
  explicit Maker(unsigned seed) : random_(seed) {}

  System make(const Shape& shape) {
    System s;
    Pattern& p = s.pattern;
    for (auto n : shape.variables) {
      p.stage_begin.push_back(p.variables);
      p.variables += n;
    }
    p.stage_begin.push_back(p.variables);
    p.variables += shape.globals;
    p.fixed.assign(p.variables, 0);
    p.row_begin.push_back(0);
    const auto stage = [&](std::size_t k) {
      std::vector<std::size_t> list;
      for (auto i = p.stage_begin[k]; i < p.stage_begin[k + 1]; ++i) list.push_back(i);
      return list;
    };
    std::vector<std::size_t> globals;
    for (auto i = p.stage_begin.back(); i < p.variables; ++i) globals.push_back(i);
    for (std::size_t k = 0; k < p.stages(); ++k) {
      add_hessian(s, stage(k), globals, shape.hessian);
      auto touched = stage(k);
      touched.insert(touched.end(), globals.begin(), globals.end());
      for (std::size_t r = 0; r < shape.local_equations; ++r) add_row(s, k, touched, true, false);
      for (std::size_t r = 0; r < shape.inequalities; ++r) add_row(s, k, touched, false, false);
      if (k + 1 == p.stages()) continue;
      const auto next = stage(k + 1);
      touched.insert(touched.begin() + static_cast<std::ptrdiff_t>(stage(k).size()), next.begin(),
                     next.end());
      for (std::size_t r = 0; r < shape.defects[k]; ++r) add_row(s, k, touched, true, false);
    }
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < p.variables; ++i) all.push_back(i);
    for (std::size_t r = 0; r < shape.border_rows; ++r) add_row(s, 0, all, true, true);
    for (std::size_t i = p.stage_begin.back(); i < p.variables; ++i)
      add_entry(s, i, i, shape.hessian);
    s.diagonal.assign(p.variables, 0.0);
    return s;
  }

  double number() { return uniform_(random_); }

 private:
  void add_entry(System& s, std::size_t row, std::size_t col, double value) {
    s.pattern.hessian_row.push_back(row);
    s.pattern.hessian_col.push_back(col);
    s.hessian.push_back(value);
  }
  void add_hessian(System& s, const std::vector<std::size_t>& own,
                   const std::vector<std::size_t>& globals, double size) {
    if (size == 0) return;
    for (auto i : own) {
      for (auto j : own)
        if (j <= i) add_entry(s, i, j, i == j ? size : 0.3 * number());
      for (auto g : globals) add_entry(s, g, i, 0.3 * number());
    }
  }
  void add_row(System& s, std::size_t stage, std::vector<std::size_t> touched, bool equation,
               bool border) {
    std::sort(touched.begin(), touched.end());
    for (auto i : touched) {
      s.pattern.col.push_back(i);
      s.jacobian.push_back(number());
    }
    s.pattern.row_begin.push_back(s.pattern.col.size());
    s.pattern.equation.push_back(equation);
    s.pattern.border.push_back(border);
    s.pattern.row_stage.push_back(stage);
    s.row_diagonal.push_back(equation ? 0 : 1 + number());
  }

  std::mt19937 random_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

/// Largest entry of rhs - K solution, from the sparse parts.
double residual(const System& s, const std::vector<double>& a, const std::vector<double>& b,
                const std::vector<double>& dx, const std::vector<double>& dy) {
  const Pattern& p = s.pattern;
  auto ra = a, rb = b;
  for (std::size_t e = 0; e < p.hessian_row.size(); ++e) {
    const auto i = p.hessian_row[e], j = p.hessian_col[e];
    ra[i] -= s.hessian[e] * dx[j];
    if (i != j) ra[j] -= s.hessian[e] * dx[i];
  }
  for (std::size_t i = 0; i < p.variables; ++i) ra[i] -= s.diagonal[i] * dx[i];
  for (std::size_t r = 0; r < p.rows(); ++r) {
    double product = 0;
    for (auto e = p.row_begin[r]; e < p.row_begin[r + 1]; ++e)
      product += s.jacobian[e] * dx[p.col[e]];
    const double y = p.equation[r] ? dy[r] : s.row_diagonal[r] * product;
    for (auto e = p.row_begin[r]; e < p.row_begin[r + 1]; ++e) ra[p.col[e]] -= s.jacobian[e] * y;
    rb[r] = p.equation[r] ? rb[r] - product + s.row_diagonal[r] * dy[r] : 0;
  }
  double largest = 0;
  for (std::size_t i = 0; i < ra.size(); ++i)
    if (!p.fixed[i]) largest = std::max(largest, std::fabs(ra[i]));
  for (double r : rb) largest = std::max(largest, std::fabs(r));
  return largest;
}

/// Factorises by both, checks inertia against the expected one and both residuals.
void expect_solved(const System& s, Maker& maker, bool regular_inertia) {
  std::vector<double> a(s.pattern.variables), b(s.pattern.rows());
  for (double& v : a) v = maker.number();
  for (double& v : b) v = maker.number();
  Inertia inertia[2];
  int which = 0;
  for (const auto& backend : {make_stage_ldlt(s.pattern), make_dense_ldlt(s.pattern)}) {
    inertia[which++] = backend->factorize(s.values());
    auto dx = a, dy = b;
    backend->solve(dx, dy);
    EXPECT_LT(residual(s, a, b, dx, dy), 1e-8) << backend->name();
  }
  EXPECT_EQ(inertia[0], inertia[1]);
  EXPECT_EQ(inertia[0].zero, 0u);
  if (regular_inertia) {
    const auto fixed =
        static_cast<std::size_t>(std::count(s.pattern.fixed.begin(), s.pattern.fixed.end(), 1));
    EXPECT_EQ(inertia[0].positive, s.pattern.variables - fixed);
    EXPECT_EQ(inertia[0].negative, s.equations());
  }
}

TEST(StageLdlt, AgreesWithTheDenseOneOnUglySizes) {
  const std::vector<Shape> shapes = {
      {{3, 3, 3}, {2, 2}, 0, 2, 1, 0},
      {{1}, {}, 0, 0, 0, 0},
      {{4, 0, 4}, {0, 0}, 0, 1, 1, 0},
      {{30, 2, 17, 5}, {2, 2, 5}, 1, 7, 3, 0},
      {{5, 5, 5, 5, 5}, {3, 3, 3, 3}, 0, 4, 0, 2},
      {{2, 9, 2, 9}, {2, 2, 2}, 0, 0, 2, 1},
  };
  unsigned seed = 1;
  for (const auto& shape : shapes)
    for (int repeat = 0; repeat < 20; ++repeat) {
      Maker maker(seed++);
      expect_solved(maker.make(shape), maker, true);
    }
}

TEST(StageLdlt, PassesOnWhatHasNoPivotInItsStage) {
  // x(0) fixed and a square chain of equations: the first stage has multipliers and nothing else.
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Maker maker(seed);
    System s = maker.make({{3, 3, 3, 3}, {3, 3, 3}, 0, 0, 0, 0, 0});
    for (std::size_t i = 0; i < 3; ++i) s.pattern.fixed[i] = 1;
    expect_solved(s, maker, true);
  }
}

TEST(StageLdlt, TakesTheFinalStateFixedInsteadOfTheFirst) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Maker maker(seed);
    System s = maker.make({{3, 3, 3, 3}, {3, 3, 3}, 0, 0, 0, 0, 0});
    for (std::size_t i = 9; i < 12; ++i) s.pattern.fixed[i] = 1;
    expect_solved(s, maker, true);
  }
}

TEST(StageLdlt, TakesAGlobalAsTheOnlyFreedom) {
  // Both ends fixed but for what one global must bring about: tf as the only freedom.
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Maker maker(seed);
    System s = maker.make({{2, 2, 2, 2}, {2, 2, 2}, 0, 0, 1, 0, 0});
    for (std::size_t i : {0, 1, 6}) s.pattern.fixed[i] = 1;
    s.pattern.hessian_row.clear();
    s.pattern.hessian_col.clear();
    s.hessian.clear();
    expect_solved(s, maker, true);
  }
}

TEST(StageLdlt, TakesASingularBlockOfTheStep) {
  // I - h/2 A singular: the next stage's block of the defects has a zero column.
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Maker maker(seed);
    System s = maker.make({{3, 3, 3}, {2, 2}, 0, 0, 0, 0, 4});
    for (std::size_t e = 0; e < s.pattern.col.size(); ++e)
      if (s.pattern.col[e] == 3) s.jacobian[e] = 0;
    expect_solved(s, maker, true);
  }
}

TEST(StageLdlt, SaysSingularWhereTheSystemIs) {
  Maker maker(7);
  System s = maker.make({{2, 2}, {1}, 0, 0, 0, 0, 0});  // no Hessian, one equation, four unknowns
  EXPECT_GT(make_stage_ldlt(s.pattern)->factorize(s.values()).zero, 0u);
  EXPECT_GT(make_dense_ldlt(s.pattern)->factorize(s.values()).zero, 0u);
}

TEST(StageLdlt, CountsNegativeCurvature) {
  Maker maker(8);
  System s = maker.make({{3, 3}, {0}, 0, 0, 0, 0, 4});
  s.diagonal[1] = -10;
  const auto inertia = make_stage_ldlt(s.pattern)->factorize(s.values());
  EXPECT_EQ(inertia, (Inertia{5, 1, 0}));
}

TEST(StageLdlt, RefusesARowAcrossDistantStages) {
  Maker maker(9);
  System s = maker.make({{2, 2, 2}, {1, 1}, 0, 0, 0, 0});
  s.pattern.col[1] = 5;  // the first defect now reaches the third stage
  EXPECT_ANY_THROW(make_stage_ldlt(s.pattern));
}

}  // namespace
}  // namespace slalom::kkt
