// The stage-structured factorisation against the generic one, and both against their residual.

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
  std::size_t local_equations = 0, globals = 0, border_rows = 0;
  double hessian = 4;  ///< size of W's diagonal; 0: no Hessian at all
};

struct System {
  Pattern pattern;
  std::vector<std::size_t> begin;  ///< first variable of each stage, then of the globals
  std::vector<double> hessian, diagonal, jacobian, flexibility;

  Values values() const { return {hessian, diagonal, jacobian, flexibility}; }
};

class Maker {
 public:
  explicit Maker(unsigned seed) : random_(seed) {}

  System make(const Shape& shape) {
    System s;
    Pattern& p = s.pattern;
    p.stages = shape.variables.size();
    for (std::size_t k = 0; k <= p.stages; ++k) {
      s.begin.push_back(p.variables);
      const std::size_t n = k < p.stages ? shape.variables[k] : shape.globals;
      p.variables += n;
      p.variable_stage.insert(p.variable_stage.end(), n, static_cast<std::uint32_t>(k));
    }
    s.begin.push_back(p.variables);
    p.fixed.assign(p.variables, 0);
    const auto stage = [&](std::size_t k) {
      std::vector<std::size_t> list;
      for (auto i = s.begin[k]; i < s.begin[k + 1]; ++i) list.push_back(i);
      return list;
    };
    const auto globals = stage(p.stages);
    for (std::size_t k = 0; k < p.stages; ++k) {
      add_hessian(s, stage(k), globals, shape.hessian);
      auto touched = stage(k);
      touched.insert(touched.end(), globals.begin(), globals.end());
      for (std::size_t r = 0; r < shape.local_equations; ++r) add_row(s, k, touched);
      if (k + 1 == p.stages) continue;
      const auto next = stage(k + 1);
      touched.insert(touched.end(), next.begin(), next.end());
      for (std::size_t r = 0; r < shape.defects[k]; ++r) add_row(s, k, touched);
    }
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < p.variables; ++i) all.push_back(i);
    for (std::size_t r = 0; r < shape.border_rows; ++r) add_row(s, p.stages, all);
    for (auto i : globals) add_entry(s, i, i, shape.hessian);
    s.diagonal.assign(p.variables, 0.0);
    return s;
  }

  double number() { return uniform_(random_); }

 private:
  void add_entry(System& s, std::size_t row, std::size_t col, double value) {
    s.pattern.hessian.push_back({static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(col)});
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
  void add_row(System& s, std::size_t stage, const std::vector<std::size_t>& touched) {
    Pattern& p = s.pattern;
    for (auto i : touched) {
      p.jacobian.push_back({static_cast<std::uint32_t>(s.jacobian.size()),
                            static_cast<std::uint32_t>(p.equations),
                            static_cast<std::uint32_t>(i)});
      s.jacobian.push_back(number());
    }
    p.equation_stage.push_back(static_cast<std::uint32_t>(stage));
    ++p.equations;
    s.flexibility.push_back(0);
  }

  std::mt19937 random_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

/// Largest entry of rhs - K solution, from the sparse parts.
double residual(const System& s, const std::vector<double>& rhs, const std::vector<double>& x) {
  const Pattern& p = s.pattern;
  auto r = rhs;
  for (std::size_t e = 0; e < p.hessian.size(); ++e) {
    const auto [i, j] = p.hessian[e];
    r[i] -= s.hessian[e] * x[j];
    if (i != j) r[j] -= s.hessian[e] * x[i];
  }
  for (std::size_t i = 0; i < p.variables; ++i) r[i] -= s.diagonal[i] * x[i];
  for (const auto& entry : p.jacobian) {
    const std::size_t row = p.variables + entry.equation;
    r[row] -= s.jacobian[entry.source] * x[entry.variable];
    r[entry.variable] -= s.jacobian[entry.source] * x[row];
  }
  for (std::size_t e = 0; e < p.equations; ++e)
    r[p.variables + e] += s.flexibility[e] * x[p.variables + e];
  double largest = 0;
  for (std::size_t i = 0; i < r.size(); ++i)
    if (i >= p.variables || !p.fixed[i]) largest = std::max(largest, std::fabs(r[i]));
  return largest;
}

std::size_t free_variables(const System& s) {
  return static_cast<std::size_t>(std::count(s.pattern.fixed.begin(), s.pattern.fixed.end(), 0));
}

std::vector<double> random_rhs(const System& s, Maker& maker) {
  std::vector<double> rhs(s.pattern.variables + s.pattern.equations);
  for (double& v : rhs) v = maker.number();
  return rhs;
}

/// Factorises by both, checks inertia against the expected one and both residuals.
void expect_solved(const System& s, Maker& maker) {
  const auto rhs = random_rhs(s, maker);
  for (const auto& backend : {make_stage_ldlt(s.pattern), make_sparse_ldlt(s.pattern)}) {
    const Inertia expected{free_variables(s), s.pattern.equations, 0};
    for (int again = 0; again < 2; ++again) {  // the second time by the order kept from the first
      EXPECT_EQ(backend->factorize(s.values()), expected) << backend->name();
      auto x = rhs;
      backend->solve(x);
      EXPECT_LT(residual(s, rhs, x), 1e-8) << backend->name();
    }
  }
}

TEST(StageLdlt, AgreesWithTheGenericOneOnUglySizes) {
  const std::vector<Shape> shapes = {
      {{3, 3, 3}, {2, 2}, 0, 1, 0},
      {{1}, {}, 0, 0, 0},
      {{4, 0, 4}, {0, 0}, 0, 1, 0},
      {{30, 2, 17, 5}, {2, 2, 5}, 1, 3, 0},
      {{5, 5, 5, 5, 5}, {3, 3, 3, 3}, 0, 0, 2},
      {{2, 9, 2, 9}, {2, 2, 2}, 0, 2, 1},
  };
  unsigned seed = 1;
  for (const auto& shape : shapes)
    for (int repeat = 0; repeat < 20; ++repeat) {
      Maker maker(seed++);
      expect_solved(maker.make(shape), maker);
    }
}

TEST(StageLdlt, PassesOnWhatHasNoPivotInItsStage) {
  // x(0) fixed and a square chain of equations: the first stage has multipliers and nothing else.
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Maker maker(seed);
    System s = maker.make({{3, 3, 3, 3}, {3, 3, 3}, 0, 0, 0, 0});
    for (std::size_t i = 0; i < 3; ++i) s.pattern.fixed[i] = 1;
    expect_solved(s, maker);
  }
}

TEST(StageLdlt, TakesTheFinalStateFixedInsteadOfTheFirst) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Maker maker(seed);
    System s = maker.make({{3, 3, 3, 3}, {3, 3, 3}, 0, 0, 0, 0});
    for (std::size_t i = 9; i < 12; ++i) s.pattern.fixed[i] = 1;
    expect_solved(s, maker);
  }
}

TEST(StageLdlt, TakesAGlobalAsTheOnlyFreedom) {
  // Both ends fixed but for what one global must bring about: tf as the only freedom.
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Maker maker(seed);
    System s = maker.make({{2, 2, 2, 2}, {2, 2, 2}, 0, 1, 0, 0});
    for (std::size_t i : {0, 1, 6}) s.pattern.fixed[i] = 1;
    s.pattern.hessian.clear();
    s.hessian.clear();
    expect_solved(s, maker);
  }
}

TEST(StageLdlt, TakesASingularBlockOfTheStep) {
  // I - h/2 A singular: the next stage's block of the defects has a zero column.
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Maker maker(seed);
    System s = maker.make({{3, 3, 3}, {2, 2}, 0, 0, 0, 4});
    for (const auto& entry : s.pattern.jacobian)
      if (entry.variable == 3) s.jacobian[entry.source] = 0;
    expect_solved(s, maker);
  }
}

TEST(StageLdlt, SaysSingularWhereTheSystemIs) {
  Maker maker(7);
  System s = maker.make({{2, 2}, {1}, 0, 0, 0, 0});  // no Hessian, one equation, four unknowns
  EXPECT_GT(make_stage_ldlt(s.pattern)->factorize(s.values()).zero, 0u);
  EXPECT_GT(make_sparse_ldlt(s.pattern)->factorize(s.values()).zero, 0u);
}

TEST(StageLdlt, CountsNegativeCurvature) {
  Maker maker(8);
  System s = maker.make({{3, 3}, {0}, 0, 0, 0, 4});
  s.diagonal[1] = -10;
  const auto inertia = make_stage_ldlt(s.pattern)->factorize(s.values());
  EXPECT_EQ(inertia, (Inertia{5, 1, 0}));
}

TEST(StageLdlt, SeesAMinimumThatALaterEquationMakes) {
  // -x0^2 / 2 + 3 x1^2 / 2 + 3 x2^2 / 2 along x0 + x1 + x2 = 0, the row known at the end alone.
  System s;
  s.pattern.variables = 3;
  s.pattern.equations = 1;
  s.pattern.stages = 3;
  s.pattern.variable_stage = {0, 1, 2};
  s.pattern.equation_stage = {3};
  s.pattern.fixed.assign(3, 0);
  for (std::uint32_t i = 0; i < 3; ++i) {
    s.pattern.hessian.push_back({i, i});
    s.pattern.jacobian.push_back({i, 0, i});
  }
  s.hessian = {-1, 3, 3};
  s.diagonal = {0, 0, 0};
  s.jacobian = {1, 1, 1};
  s.flexibility = {0};
  Values values = s.values();
  values.minimum_only = true;
  EXPECT_EQ(make_stage_ldlt(s.pattern)->factorize(values), (Inertia{3, 1, 0}));
}

TEST(StageLdlt, AsksDuringALongFactorisationWhetherToStop) {
  Shape shape;
  shape.variables.assign(400, 14);
  shape.defects.assign(399, 8);
  const System system = Maker(5).make(shape);
  const auto backend = make_stage_ldlt(system.pattern);
  struct Asked {
    int times = 0, stop_at = -1;
  } asked;
  Values values = system.values();
  values.stop = [](void* data) {
    auto& a = *static_cast<Asked*>(data);
    return ++a.times == a.stop_at;
  };
  values.stop_data = &asked;
  const Inertia whole = backend->factorize(values);
  EXPECT_EQ(whole.positive + whole.negative, system.pattern.variables + system.pattern.equations);
  const int times = asked.times;
  EXPECT_GT(times, 5);
  EXPECT_LT(times, 100) << "asking costs a system call";
  asked = {0, times / 2};
  const Inertia part = backend->factorize(values);
  EXPECT_EQ(asked.times, times / 2);
  EXPECT_LT(part.positive + part.negative, 2 * (whole.positive + whole.negative) / 3);
  EXPECT_EQ(backend->factorize(system.values()), whole);
}

TEST(StageLdlt, CarriesWhatCouplesDistantStages) {
  const std::vector<Shape> shapes = {{{3, 3, 3, 3, 3, 3}, {2, 2, 2, 2, 2}, 0, 3, 2},
                                     {{30, 2, 17, 5}, {2, 2, 5}, 1, 4, 1}};
  unsigned seed = 100;
  for (const auto& shape : shapes)
    for (int repeat = 0; repeat < 20; ++repeat) {
      Maker maker(seed++);
      System s = maker.make(shape);
      const auto stages = static_cast<std::uint32_t>(s.pattern.stages);
      std::uint32_t to = static_cast<std::uint32_t>(repeat) % stages;
      for (auto* list : {&s.pattern.variable_stage, &s.pattern.equation_stage})
        for (auto& stage : *list)  // what was the border's, to one stage after the other
          if (stage == stages) stage = to++ % stages;
      expect_solved(s, maker);
    }
}

/// Four phases of `length` stages, each with a final time of its own that all its defects know,
/// chained by their interfaces.
System phases(std::size_t length, Maker& maker) {
  Shape shape;
  shape.variables.assign(4 * length, 6);
  shape.defects.assign(4 * length - 1, 4);
  shape.globals = 4;
  System s = maker.make(shape);
  Pattern& p = s.pattern;
  const auto phase_of = [&](std::size_t id) {
    return (id < p.variables ? p.variable_stage[id] : p.equation_stage[id - p.variables]) / length;
  };
  const std::size_t first = s.begin[p.stages];
  const auto foreign = [&](std::size_t id, std::size_t variable) {
    return variable >= first && id != variable && phase_of(id) != variable - first;
  };
  for (std::size_t e = p.hessian.size(); e-- > 0;)
    if (foreign(p.hessian[e].col, p.hessian[e].row)) {
      p.hessian.erase(p.hessian.begin() + static_cast<std::ptrdiff_t>(e));
      s.hessian.erase(s.hessian.begin() + static_cast<std::ptrdiff_t>(e));
    }
  std::erase_if(p.jacobian, [&](const Pattern::JacobianEntry& entry) {
    return foreign(p.variables + entry.equation, entry.variable);
  });
  for (std::size_t k = 0; k < 4; ++k)
    p.variable_stage[first + k] = static_cast<std::uint32_t>((k + 1) * length - 1);
  return s;
}

TEST(StageLdlt, EliminatesAPhasesFinalTimeAtItsEnd) {
  Maker maker(31);
  for (const std::size_t length : {2, 3, 8}) expect_solved(phases(length, maker), maker);
}

}  // namespace
}  // namespace slalom::kkt
