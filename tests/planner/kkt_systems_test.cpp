// The stage-structured factorisation against the generic one on systems of the planner's own OCP.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "planner/transcribed.hpp"
#include "slalom/base/kernels.hpp"
#include "slalom/kkt/condensed_hessian.hpp"
#include "slalom/kkt/row_blocks.hpp"
#include "slalom/kkt/system.hpp"
#include "support/kernel_sets.hpp"

namespace slalom::planner {
namespace {

/// The KKT systems of a scene's OCP at its straight-on guess.
class PlannerSystem {
 public:
  explicit PlannerSystem(const Scene& scene, bool in_range = false) : scene_(scene, in_range) {
    const auto& shape = scene_.nlp->structure();
    const auto& limits = scene_.nlp->limits();
    inequality_.resize(shape.rows);
    for (std::size_t r = 0; r < shape.rows; ++r) inequality_[r] = limits.gl[r] != limits.gu[r];
    rows_.emplace(shape.rows, shape.jacobian_row, shape.jacobian_col, inequality_);
    condensed_.emplace(shape.hessian_row, shape.hessian_col, *rows_, inequality_);
    make_pattern();
    auto guess = scene_.straight_on(scene_.scene.first);
    guess.x.resize(shape.variables);
    const auto fault =
        scene_.nlp->evaluate(guess.x, 1, std::vector<double>(shape.rows, 0.1),
                             {.values = true, .derivatives = true, .hessian = true}, at_);
    EXPECT_FALSE(fault);
  }

  const kkt::Pattern& pattern() const { return pattern_; }
  std::size_t size() const { return pattern_.variables + pattern_.equations; }

  /// Barrier weights 10^(-spread ... spread) of rows and bounds, as late iterations have them.
  kkt::Values values(std::mt19937& random, double spread, double flexibility) {
    std::uniform_real_distribution<double> exponent(-spread, spread);
    const auto weight = [&] { return std::pow(10, exponent(random)); };
    std::vector<double> weights(inequality_.size(), 0.0);
    for (std::size_t r = 0; r < weights.size(); ++r)
      if (inequality_[r]) weights[r] = weight();
    hessian_.resize(pattern_.hessian.size());
    condensed_->sum(at_.hessian, at_.jacobian, weights, hessian_);
    diagonal_.assign(pattern_.variables, 0.0);
    for (double& d : diagonal_) d = 1e-3 + weight();
    flexibility_.assign(pattern_.equations, flexibility);
    return {hessian_, diagonal_, at_.jacobian, flexibility_};
  }

  std::vector<double> multiply(const kkt::Values& v, const std::vector<double>& x) const {
    std::vector<double> y(size(), 0.0);
    const std::size_t n = pattern_.variables;
    const auto add = [&](std::size_t i, std::size_t j, double a) {
      y[i] += a * x[j];
      if (i != j) y[j] += a * x[i];
    };
    for (std::size_t t = 0; t < pattern_.hessian.size(); ++t)
      add(pattern_.hessian[t].row, pattern_.hessian[t].col, v.hessian[t]);
    for (std::size_t i = 0; i < n; ++i) add(i, i, v.diagonal[i]);
    for (const auto& entry : pattern_.jacobian)
      add(n + entry.equation, entry.variable, v.jacobian[entry.source]);
    for (std::size_t e = 0; e < pattern_.equations; ++e) add(n + e, n + e, -v.flexibility[e]);
    return y;
  }

 private:
  void make_pattern() {
    const auto& shape = scene_.nlp->structure();
    std::vector<std::uint32_t> number(shape.rows, 0);
    pattern_.variables = shape.variables;
    pattern_.stages = shape.stages;
    pattern_.variable_stage = shape.variable_stage;
    pattern_.fixed.assign(shape.variables, 0);
    for (std::size_t i = 0; i < shape.variables; ++i)
      pattern_.fixed[i] = scene_.nlp->limits().xl[i] == scene_.nlp->limits().xu[i];
    for (std::size_t r = 0; r < shape.rows; ++r) {
      if (inequality_[r]) continue;
      number[r] = static_cast<std::uint32_t>(pattern_.equations++);
      pattern_.equation_stage.push_back(shape.row_stage[r]);
    }
    pattern_.hessian = condensed_->places();
    for (std::uint32_t t = 0; t < shape.jacobian_row.size(); ++t)
      if (!inequality_[shape.jacobian_row[t]])
        pattern_.jacobian.push_back({t, number[shape.jacobian_row[t]], shape.jacobian_col[t]});
  }

  TranscribedScene scene_;
  std::vector<char> inequality_;
  std::optional<kkt::RowBlocks> rows_;
  std::optional<kkt::CondensedHessian> condensed_;
  kkt::Pattern pattern_;
  nlp::Evaluation at_;
  std::vector<double> hessian_, diagonal_, flexibility_;
};

/// Largest error of a refined solution, relative to the largest entry of the solution sought.
double error_of(const PlannerSystem& system, kkt::Backend& backend, const kkt::Values& values,
                const std::vector<double>& sought) {
  const auto rhs = system.multiply(values, sought);
  std::vector<double> x(rhs.size(), 0.0);
  for (int round = 0; round < 3; ++round) {
    auto r = system.multiply(values, x);
    for (std::size_t i = 0; i < r.size(); ++i) r[i] = rhs[i] - r[i];
    backend.solve(r);
    for (std::size_t i = 0; i < r.size(); ++i) x[i] += r[i];
  }
  double most = 0, size = 0;
  const auto remaining = system.multiply(values, x);
  for (std::size_t i = 0; i < rhs.size(); ++i) {
    if (i < system.pattern().variables && system.pattern().fixed[i]) continue;
    most = std::max(most, std::fabs(remaining[i] - rhs[i]));
    size = std::max(size, std::fabs(rhs[i]));
  }
  return most / size;
}

class PlannerSystems : public OnKernelSet {};

TEST_P(PlannerSystems, BothFactorisationsAgree) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (auto* scene : {&E_B, &E_C})
    for (const bool in_range : {false, true}) {
      PlannerSystem system(scene(), in_range);
      const auto stage = kkt::make_stage_ldlt(system.pattern());
      const auto sparse = kkt::make_sparse_ldlt(system.pattern());
      for (const double spread : {0.0, 2.0, 5.0})
        for (const double flexibility : {0.0, 1e-8, 1.0})
          for (int repeat = 0; repeat < 4; ++repeat) {
            SCOPED_TRACE(testing::Message() << "weights 10^+-" << spread << ", c " << flexibility
                                            << ", in range " << in_range);
            const auto values = system.values(random, spread, flexibility);
            std::vector<double> sought(system.size());
            for (std::size_t i = 0; i < sought.size(); ++i)
              if (i >= system.pattern().variables || !system.pattern().fixed[i])
                sought[i] = unit(random);
            const auto inertia = stage->factorize(values);
            EXPECT_EQ(inertia, sparse->factorize(values));
            EXPECT_EQ(inertia.zero, 0u);
            EXPECT_LT(error_of(system, *stage, values, sought), 1e-12);
            EXPECT_LT(error_of(system, *sparse, values, sought), 1e-12);
          }
    }
}

INSTANTIATE_TEST_SUITE_P(Sets, PlannerSystems, each_kernel_set(), name_of_set);

}  // namespace
}  // namespace slalom::planner
