// RowBlocks, SymmetricRuns and CondensedHessian against dense products, on every kernel set.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "slalom/base/kernels.hpp"
#include "slalom/kkt/condensed_hessian.hpp"
#include "slalom/kkt/row_blocks.hpp"
#include "support/kernel_sets.hpp"

namespace slalom::kkt {
namespace {

using Vector = std::vector<double>;

/// A sparse matrix in the order its entries are given in.
struct Matrix {
  std::size_t rows = 0, cols = 0;
  std::vector<std::uint32_t> row, col;
  std::vector<char> kind;  ///< of each row

  void add(std::size_t r, std::size_t c) {
    row.push_back(static_cast<std::uint32_t>(r));
    col.push_back(static_cast<std::uint32_t>(c));
  }
};

class Random {
 public:
  explicit Random(unsigned seed) : random_(seed) {}
  double number() { return uniform_(random_); }
  std::size_t below(std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_);
  }
  Vector vector(std::size_t n) {
    Vector v(n);
    for (double& x : v) x = number();
    return v;
  }
  void shuffle(Matrix& m) {
    std::vector<std::size_t> order(m.row.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::shuffle(order.begin(), order.end(), random_);
    const Matrix old = m;
    for (std::size_t i = 0; i < order.size(); ++i) {
      m.row[i] = old.row[order[i]];
      m.col[i] = old.col[order[i]];
    }
  }

 private:
  std::mt19937 random_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

/// Runs of every stride (0, 1, -1, 2) over `count` rows from `first` on, in columns of their own.
void add_runs(Matrix& m, std::size_t first, std::size_t count) {
  const std::size_t c = m.cols;
  for (std::size_t i = 0; i < count; ++i) m.add(first + i, c);
  for (std::size_t i = 0; i < count; ++i) m.add(first + i, c + 1 + i);
  for (std::size_t i = 0; i < count; ++i) m.add(first + i, c + 2 * count - i);
  for (std::size_t i = 0; i < count; ++i) m.add(first + i, c + 2 * count + 1 + 2 * i);
  m.cols = c + 4 * count + 1;
  m.rows = std::max(m.rows, first + count);
}

/// Matrices of every kind of runs, ending in every part of a vector.
std::vector<Matrix> matrices() {
  std::vector<Matrix> list;
  for (const std::size_t count : {1u, 2u, 3u, 4u, 5u, 8u, 15u, 33u}) {
    Matrix runs;
    add_runs(runs, 0, count);
    add_runs(runs, count / 2, count);  // overlaps half of the rows
    runs.kind.assign(runs.rows, 0);
    list.push_back(runs);
    for (std::size_t r = 0; r < runs.rows; ++r) runs.kind[r] = r % 5 < 2 ? 1 : 0;  // mixed kinds
    list.push_back(runs);
    Random(static_cast<unsigned>(count)).shuffle(runs);  // single entries
    list.push_back(runs);
  }
  Matrix empty_rows;
  empty_rows.rows = 7;
  empty_rows.cols = 3;
  empty_rows.add(4, 2);
  empty_rows.kind.assign(7, 1);
  list.push_back(empty_rows);
  list.push_back({3, 2, {}, {}, {0, 1, 0}});
  return list;
}

Vector dense(const Matrix& m, const Vector& values) {
  Vector a(m.rows * m.cols, 0.0);
  for (std::size_t t = 0; t < values.size(); ++t) a[m.row[t] * m.cols + m.col[t]] = values[t];
  return a;
}

void expect_near(const Vector& a, const Vector& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 1e-12) << "at " << i;
}

class Rows : public OnKernelSet {
 protected:
  Random random_{1};
};

TEST_P(Rows, ProductsAreThoseOfTheDenseMatrix) {
  for (const auto& m : matrices()) {
    const RowBlocks blocks(m.rows, m.row, m.col, m.kind);
    const Vector values = random_.vector(m.row.size()), a = dense(m, values);
    const Vector x = random_.vector(m.cols), y = random_.vector(m.rows),
                 y2 = random_.vector(m.rows);
    Vector product(m.rows, 0.0), out(m.rows, 99.0);
    Vector transposed = random_.vector(m.cols), transposed2 = random_.vector(m.cols);
    Vector add = transposed, add2 = transposed2, alone = transposed;
    for (std::size_t r = 0; r < m.rows; ++r)
      for (std::size_t c = 0; c < m.cols; ++c) {
        product[r] += a[r * m.cols + c] * x[c];
        transposed[c] += a[r * m.cols + c] * y[r];
        transposed2[c] += a[r * m.cols + c] * y2[r];
      }
    blocks.multiply(values, x, out);
    expect_near(out, product);
    blocks.add_transposed(values, y, y2, add, add2);
    expect_near(add, transposed);
    expect_near(add2, transposed2);
    blocks.add_transposed(values, y, alone);
    EXPECT_EQ(alone, add) << "one at a time and in one pass: the same bits";
  }
}

TEST_P(Rows, BlocksCoverEveryRowOnceAndMixNoKinds) {
  for (const auto& m : matrices()) {
    const RowBlocks blocks(m.rows, m.row, m.col, m.kind);
    std::size_t next = 0, entries = 0;
    for (const auto& block : blocks.blocks()) {
      EXPECT_EQ(block.row, next);
      next += block.count;
      entries += (block.end - block.begin) * block.count;
      for (std::size_t r = block.row; r < next; ++r) EXPECT_EQ(m.kind[r], m.kind[block.row]);
    }
    EXPECT_EQ(next, m.rows);
    EXPECT_EQ(entries, m.row.size());
  }
}

TEST_P(Rows, SymmetricProductsCountTheDiagonalOnce) {
  for (const std::size_t n : {1u, 2u, 5u, 9u, 34u})
    for (const bool shuffled : {false, true}) {
      Matrix m;
      m.rows = m.cols = 3 * n + 1;
      for (std::size_t i = 0; i < n; ++i) m.add(i, i);          // diagonal
      for (std::size_t i = 0; i < n; ++i) m.add(n + i, i);      // both step along
      for (std::size_t i = 0; i < n; ++i) m.add(3 * n, i);      // one row
      for (std::size_t i = 0; i < n; ++i) m.add(2 * n + i, 0);  // one column
      for (std::size_t i = 0; i + 1 < n; ++i) m.add(2 * n + i + 1, 2 * n - 1 - i);  // apart
      for (std::size_t i = 0; i < n; i += 2) m.add(n + i, n + i);                   // a stride of 2
      if (shuffled) random_.shuffle(m);
      const SymmetricRuns runs(m.row, m.col);
      const Vector values = random_.vector(m.row.size()), x = random_.vector(m.cols);
      Vector out = random_.vector(m.rows), sought = out;
      for (std::size_t t = 0; t < values.size(); ++t) {
        sought[m.row[t]] += values[t] * x[m.col[t]];
        if (m.row[t] != m.col[t]) sought[m.col[t]] += values[t] * x[m.row[t]];
      }
      runs.add_product(values, x, out);
      expect_near(out, sought);
    }
}

TEST_P(Rows, CondensedSumIsThatOfTheDenseProducts) {
  for (auto m : matrices()) {
    const RowBlocks blocks(m.rows, m.row, m.col, m.kind);
    Matrix h;  // the diagonal, and an entry of the upper triangle
    for (std::size_t i = 0; i < m.cols; i += 2) h.add(i, i);
    if (m.cols > 1) h.add(0, 1);
    const CondensedHessian condensed(h.row, h.col, blocks, m.kind);
    const Vector values = random_.vector(m.row.size()), a = dense(m, values);
    const Vector hessian = random_.vector(h.row.size());
    Vector weights = random_.vector(m.rows);
    for (double& w : weights) w = std::fabs(w);
    Vector out(condensed.places().size(), 99.0), sum(m.cols * m.cols, 0.0), got = sum;
    condensed.sum(hessian, values, weights, out);
    const auto both = [&](Vector& to, std::size_t i, std::size_t j, double v) {
      to[i * m.cols + j] += v;
      if (i != j) to[j * m.cols + i] += v;
    };
    for (std::size_t t = 0; t < h.row.size(); ++t) both(sum, h.row[t], h.col[t], hessian[t]);
    for (std::size_t r = 0; r < m.rows; ++r)
      for (std::size_t i = 0; m.kind[r] && i < m.cols; ++i)
        for (std::size_t j = 0; j < m.cols; ++j)
          sum[i * m.cols + j] += weights[r] * a[r * m.cols + i] * a[r * m.cols + j];
    for (std::size_t p = 0; p < out.size(); ++p)
      both(got, condensed.places()[p].row, condensed.places()[p].col, out[p]);
    expect_near(got, sum);
    for (std::size_t t = 0; t < h.row.size(); ++t)
      EXPECT_EQ(condensed.places()[t], (Pattern::Place{h.row[t], h.col[t]}));
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, Rows, each_kernel_set(), name_of_set);

}  // namespace
}  // namespace slalom::kkt
