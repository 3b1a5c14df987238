// The loops over one dense block against a plain L D L', on every kernel set.

#include "../../src/kkt/block.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "../../src/base/aligned.hpp"
#include "slalom/base/kernels.hpp"
#include "support/kernel_sets.hpp"

namespace slalom::kkt {
namespace {

std::size_t padded(std::size_t n) {
  return (n + kMostLanes - 1) / kMostLanes * kMostLanes;
}

/// A block with its memory. Diagonals are large, but for pivots of order 2, which have none.
struct Sample {
  std::size_t size, eliminated, ld;
  std::vector<std::uint8_t> order;
  std::vector<double> dense;  ///< the whole matrix, size x size
  AlignedDoubles a, panel;
  std::vector<double> inverse;

  Sample(std::size_t n, std::size_t pivots, unsigned seed)
      : size(n),
        eliminated(pivots),
        ld(padded(n)),
        dense(n * n),
        a(aligned_doubles(ld * (n + 1))),
        panel(aligned_doubles(4 * ld)),
        inverse(2 * n + 2) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (std::size_t p = 0; p < pivots; ++p) {
      const bool two = p + 1 < pivots && random() % 3 == 0;
      order.push_back(two ? 2 : 1);
      if (two) {
        order.push_back(0);
        ++p;
      }
    }
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j <= i; ++j) set(i, j, 0.3 * uniform(random));
    for (std::size_t i = 0; i < n; ++i) set(i, i, random() % 2 == 0 ? 3.0 : -3.0);
    for (std::size_t p = 0; p < pivots; ++p)
      if (order[p] == 2) {
        set(p, p, 0);
        set(p + 1, p + 1, 0.1);
        set(p + 1, p, 3);
      }
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < ld; ++i) a[j * ld + i] = i >= j && i < n ? dense[i * n + j] : 0;
  }
  void set(std::size_t i, std::size_t j, double v) {
    dense[i * size + j] = dense[j * size + i] = v;
  }
  Block block() {
    return {a.get(), ld, size, eliminated, order.data(), inverse.data(), panel.get(), kLeastRatio};
  }

  /// Eliminates rows one by one (pivots of order 2 as 2 x 2 blocks) in the dense matrix; counts.
  Inertia eliminate() {
    Inertia inertia;
    for (std::size_t p = 0; p < eliminated; p += order[p]) {
      const auto at = [&](std::size_t i, std::size_t j) { return dense[i * size + j]; };
      if (order[p] == 1) {
        ++(at(p, p) > 0 ? inertia.positive : inertia.negative);
        for (std::size_t i = p + 1; i < size; ++i)
          for (std::size_t j = p + 1; j < size; ++j)
            dense[i * size + j] -= at(i, p) * at(p, j) / at(p, p);
        continue;
      }
      const double x = at(p, p), y = at(p + 1, p), z = at(p + 1, p + 1), det = x * z - y * y;
      EXPECT_LT(det, 0);
      ++inertia.positive;
      ++inertia.negative;
      for (std::size_t i = p + 2; i < size; ++i)
        for (std::size_t j = p + 2; j < size; ++j)
          dense[i * size + j] -= (at(i, p) * (z * at(p, j) - y * at(p + 1, j)) +
                                  at(i, p + 1) * (x * at(p + 1, j) - y * at(p, j))) /
                                 det;
    }
    return inertia;
  }
};

class BlockLoops : public OnKernelSet {};

TEST_P(BlockLoops, FactorLeavesTheSchurComplementAndCountsSigns) {
  for (std::size_t size = 1; size <= 19; ++size)
    for (std::size_t pivots = 0; pivots <= size; ++pivots) {
      Sample s(size, pivots, static_cast<unsigned>(100 * size + pivots));
      Inertia inertia;
      ASSERT_TRUE(block_kernels().factor(s.block(), inertia)) << size << ", " << pivots;
      EXPECT_EQ(inertia, s.eliminate()) << size << ", " << pivots;
      for (std::size_t j = pivots; j < size; ++j)
        for (std::size_t i = j; i < size; ++i)
          ASSERT_NEAR(s.a[j * s.ld + i], s.dense[i * size + j], 1e-12) << size << ", " << pivots;
    }
}

TEST_P(BlockLoops, SolvesWhenAllIsEliminated) {
  for (std::size_t size = 1; size <= 33; ++size) {
    Sample s(size, size, static_cast<unsigned>(size));
    std::vector<double> sought(size), y(s.ld, 0.0);
    for (std::size_t i = 0; i < size; ++i) sought[i] = std::sin(static_cast<double>(i) + 1);
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j < size; ++j) y[i] += s.dense[i * size + j] * sought[j];
    Inertia inertia;
    ASSERT_TRUE(block_kernels().factor(s.block(), inertia));
    block_kernels().forward(s.block(), y.data());
    block_kernels().backward(s.block(), y.data());
    for (std::size_t i = 0; i < size; ++i) ASSERT_NEAR(y[i], sought[i], 1e-10) << size;
  }
}

TEST_P(BlockLoops, RefusesUnstableTinyAndNanPivots) {
  for (const double pivot : {0.0, 1e-30, 1e-9, std::numeric_limits<double>::quiet_NaN()})
    for (const std::size_t where : {0u, 2u, 5u}) {
      Sample s(9, 6, 5);
      s.order.assign(6, 1);
      for (std::size_t j = 0; j < 9; ++j)
        for (std::size_t i = j; i < 9; ++i) s.a[j * s.ld + i] = i == j ? 2 : 0;
      s.a[where * s.ld + where] = pivot;
      s.a[where * s.ld + 7] = 1;
      Inertia inertia;
      EXPECT_FALSE(block_kernels().factor(s.block(), inertia)) << pivot << " at " << where;
    }
}

INSTANTIATE_TEST_SUITE_P(Sets, BlockLoops, each_kernel_set(), name_of_set);

}  // namespace
}  // namespace slalom::kkt
