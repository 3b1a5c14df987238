// Many random expressions: derivatives against complex step and differences, lanes
// against single evaluations, one instruction set against the other.

#include <gtest/gtest.h>

#include <cstring>
#include <unordered_map>

#include "../../src/expr/dag.hpp"
#include "../../src/expr/tape.hpp"
#include "expr/reference.hpp"
#include "slalom/base/kernels.hpp"
#include "support/sanitized.hpp"

namespace slalom::expr {
namespace {

/// Expressions a test draws. The sanitizers, which look at our code and not at values, see each
/// operation many times in the first few.
constexpr std::uint64_t draws = kSanitized ? 600 : 3000;

/// Smooth where differences are taken and inside every operation's domain by construction.
class Generator {
 public:
  explicit Generator(std::uint64_t seed) : random_(seed) {
    for (const char* name : {"x", "y", "z"}) symbols.push_back(Expr::symbol(name));
  }

  std::vector<Expr> symbols;

  std::vector<double> point(std::size_t n) {
    std::vector<double> x(n);
    for (double& v : x) v = std::uniform_real_distribution<double>(-2, 2)(random_);
    return x;
  }
  std::size_t below(std::size_t n) { return random_() % n; }

  /// Three outputs over a pool of shared subexpressions.
  std::vector<Expr> outputs() {
    pool_ = symbols;
    pool_.push_back(Expr(0.5));
    pool_.push_back(Expr(-3));
    const std::size_t size = 6 + below(12);
    while (pool_.size() < size) pool_.push_back(bounded(grow()));
    return {pool_[size - 1], pool_[size - 2] * symbols[below(3)] + pick(), grow()};
  }

 private:
  Expr pick() { return pool_[below(pool_.size())]; }
  /// Keeps values of order one, so that depth does not end in overflow.
  Expr bounded(const Expr& e) {
    switch (below(4)) {
      case 0:
        return sin(e);
      case 1:
        return 2 * tanh(0.5 * e);
      case 2:
        return atan(e) - 0.3;
      default:
        return e / (1 + 0.1 * square(e));
    }
  }
  Expr grow() {
    const Expr a = pick(), b = pick(), c = pick();
    switch (below(26)) {
      case 0:
        return -a;
      case 1:
        return square(a);
      case 2:
        return sqrt(1.2 + square(a));
      case 3:
        return exp(0.5 * sin(a));
      case 4:
        return log(1.5 + a * a);
      case 5:
        return cos(a);
      case 6:
        return tan(0.6 * sin(a));
      case 7:
        return asin(0.7 * sin(a));
      case 8:
        return acos(0.7 * cos(a));
      case 9:
        return sinh(sin(a));
      case 10:
        return cosh(sin(a + b));
      case 11:
        return abs(a);
      case 12:
        return sign(a) * b;
      case 13:
        return a + b;
      case 14:
        return a - b;
      case 15:
        return a * b;
      case 16:
        return a / (1.5 + square(b));
      case 17:
        return pow(1.1 + square(a), sin(b));
      case 18:
        return pow(a, static_cast<int>(below(5)));
      case 19:
        return atan2(a, 1.3 + square(b));
      case 20:
        return atan2(2 + sin(a), b);
      case 21:
        return min(a, b);
      case 22:
        return max(a, b);
      case 23:
        return select(a, b, c);
      case 24:
        return select(a - 0.5, sqrt(a - 0.5) * b, c);  // the branch not taken is undefined
      default:
        return pow(1.4 + cos(a), 1.5);
    }
  }

  std::mt19937_64 random_;
  std::vector<Expr> pool_;
};

/// How far the nearest kink below `outputs` is from x, in the value that switches.
double distance_to_kinks(const std::vector<Expr>& outputs, const std::vector<Expr>& symbols,
                         const std::vector<double>& x) {
  std::map<const Node*, double> known;
  for (std::size_t i = 0; i < x.size(); ++i) known.emplace(symbols[i].node(), x[i]);
  for (const auto& output : outputs) reference::evaluate(output.node(), known);
  double nearest = 1e300;
  for (const auto& [node, value] : known) {
    if (node->op() == Op::abs || node->op() == Op::sign || node->op() == Op::select)
      nearest = std::min(nearest, std::fabs(known.at(node->args()[0].node())));
    if (node->op() == Op::min || node->op() == Op::max) {
      const auto *a = node->args()[0].node(), *b = node->args()[1].node();
      if (a != b) nearest = std::min(nearest, std::fabs(known.at(a) - known.at(b)));
    }
  }
  return nearest;
}

TEST(RandomExpressions, DerivativesMatchComplexStepAndDifferences) {
  const std::vector<double> weights = {1.3, -0.6, 0.9};
  std::size_t tested = 0;
  for (std::uint64_t seed = 0; seed < draws; ++seed) {
    Generator g(seed);
    const auto outputs = g.outputs();
    auto x = g.point(3);
    for (int i = 0; i < 20 && distance_to_kinks(outputs, g.symbols, x) < 0.1; ++i) x = g.point(3);
    if (distance_to_kinks(outputs, g.symbols, x) < 0.1) continue;
    ++tested;
    double first = 0;
    const double both = reference::derivative_error(outputs, g.symbols, x, weights, &first);
    ASSERT_LE(first, 1e-10) << "seed " << seed;
    EXPECT_LE(both, 1e-7) << "seed " << seed;
  }
  EXPECT_GT(tested, draws * 2 / 3);
}

TEST(RandomExpressions, SimplificationKeepsValues) {
  for (std::uint64_t seed = 0; seed < draws; ++seed) {
    Generator g(seed);
    const auto outputs = g.outputs();
    const auto x = g.point(3);
    const Function f(g.symbols, {}, outputs);
    std::vector<double> got(3);
    f(x, {}, got);
    const auto want = reference::values(outputs, g.symbols, x);
    for (std::size_t k = 0; k < 3; ++k)
      ASSERT_NEAR(got[k], want[k], 1e-12 * std::max(1.0, std::fabs(want[k]))) << "seed " << seed;
  }
}

/// Function keeps the shorter of the two; here both are held against each other.
TEST(RandomExpressions, BothWaysToTheHessianAgree) {
  std::size_t pushed_shorter = 0, eliminated_shorter = 0;
  for (std::uint64_t seed = 0; seed < draws / 3; ++seed) {
    Generator g(seed);
    Dag dag;
    std::unordered_map<const Node*, std::size_t> input_of;
    for (std::size_t i = 0; i < 3; ++i) input_of.emplace(g.symbols[i].node(), i);
    const auto outputs = dag.import(g.outputs(), input_of);
    const std::vector<Dag::Id> weights = {dag.input(3), dag.input(4), dag.input(5)};
    const SparseDerivative ways[] = {
        hessian(dag, outputs, weights, 3),
        hessian_by_elimination(dag, jacobian(dag, outputs, 3), weights, 3)};
    const auto in = g.point(6);
    double full[2][9] = {};
    std::size_t length[2];
    for (int way = 0; way < 2; ++way) {
      const Tape tape = compile(dag, ways[way].values);
      length[way] = tape.code.size();
      std::vector<InputRow> inputs;
      for (const double& v : in) inputs.push_back({&v, true});
      std::vector<double*> results;
      for (const auto& [row, col] : ways[way].pattern) results.push_back(&full[way][row * 3 + col]);
      TapeSpace(tape, 1).run(tape, {1, inputs, results});
    }
    for (int k = 0; k < 9; ++k)
      ASSERT_NEAR(full[0][k], full[1][k], 1e-10 * std::max(1.0, std::fabs(full[0][k])))
          << "seed " << seed;
    pushed_shorter += length[0] < length[1];
    eliminated_shorter += length[1] < length[0];
  }
  EXPECT_GT(pushed_shorter, draws / 60);
  EXPECT_GT(eliminated_shorter, draws / 60);
}

struct Batch {
  std::vector<double> values, jacobian, hessian;
  Batch(const Function& f, std::size_t lanes, const std::vector<double>& x,
        const std::vector<double>& weights)
      : values(f.outputs() * lanes),
        jacobian(f.jacobian_pattern().size() * lanes),
        hessian(f.hessian_pattern().size() * lanes) {
    f.evaluate(lanes, x, {}, weights, {.values = true, .jacobian = true, .hessian = true}, values,
               jacobian, hessian);
  }
  std::vector<double> all() const {
    auto result = values;
    result.insert(result.end(), jacobian.begin(), jacobian.end());
    result.insert(result.end(), hessian.begin(), hessian.end());
    return result;
  }
};

std::vector<double> lane_of(const std::vector<double>& from, std::size_t lane, std::size_t lanes) {
  std::vector<double> picked;
  for (std::size_t i = lane; i < from.size(); i += lanes) picked.push_back(from[i]);
  return picked;
}

TEST(RandomExpressions, ALaneHasTheBitsOfASingleEvaluation) {
  for (std::uint64_t seed = 0; seed < draws * 2 / 3; ++seed) {
    Generator g(seed);
    const Function f(g.symbols, {}, g.outputs());
    const std::size_t lanes = 1 + seed % 200, lane = g.below(lanes);
    const auto x = g.point(3 * lanes), weights = g.point(3 * lanes);
    const auto batch = lane_of(Batch(f, lanes, x, weights).all(), lane, lanes);
    const auto single = Batch(f, 1, lane_of(x, lane, lanes), lane_of(weights, lane, lanes)).all();
    ASSERT_EQ(batch.size(), single.size());
    ASSERT_EQ(std::memcmp(batch.data(), single.data(), batch.size() * sizeof(double)), 0)
        << "seed " << seed << ", lane " << lane << " of " << lanes;
  }
}

TEST(RandomExpressions, InstructionSetsDifferByRoundingOnly) {
  for (std::uint64_t seed = 0; seed < draws / 3; ++seed) {
    Generator g(seed);
    const Function f(g.symbols, {}, g.outputs());
    const auto x = g.point(3 * 20), weights = g.point(3 * 20);
    select_kernels(KernelSet::baseline);
    const auto baseline = Batch(f, 20, x, weights).all();
    for (const auto set : kKernelSets) {
      if (!has_kernels(set)) continue;
      select_kernels(set);
      const auto other = Batch(f, 20, x, weights).all();
      for (std::size_t k = 0; k < other.size(); ++k)
        ASSERT_NEAR(other[k], baseline[k], 1e-11 * std::max(1.0, std::fabs(baseline[k])))
            << to_string(set) << ", seed " << seed;
    }
    select_kernels(best_kernels());
  }
}

}  // namespace
}  // namespace slalom::expr
