// One front's LDL' by a known order of pivots: the library's kernel on one matrix after the other,
// against as many matrices interleaved as a vector has lanes, one lane each; a line of JSON a size.
//
//   bench_interleaved [--size 18,28,38] [--share 0.65]
//
// Says what could be won by solving several problems of one structure together. The interleaved
// loops are as good as we could write them: two pivots by two columns in registers, and the same
// test of each pivot. Both leave the same numbers.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>
#include <vector>

#include "base/simd.hpp"
#include "kkt/block.hpp"
#include "slalom/base/kernels.hpp"

namespace {

using namespace slalom;

using V = simd::Vec;
using T = V::type;
constexpr int kRepeats = 3000;

/// Entry r of a column of interleaved numbers.
T get(const double* column, std::size_t r) {
  return V::load(column + V::size * r);
}
void put(double* column, std::size_t r, T value) {
  V::store(column + V::size * r, value);
}

/// Lower triangles, column-major without padding; `rows`: room for two columns. False where a
/// lane's pivot is not stable.
bool factor_interleaved(double* a, std::size_t size, std::size_t eliminated, double* inverse,
                        double* rows) {
  const std::size_t ld = V::size * size;
  double *row0 = rows, *row1 = rows + ld;
  for (std::size_t p = 0; p < eliminated; p += 2) {
    const std::size_t pivots = std::min<std::size_t>(2, eliminated - p);
    for (std::size_t k = 0; k < pivots; ++k) {
      const std::size_t q = p + k;
      double *column = a + q * ld, *row = k == 0 ? row0 : row1;
      if (k == 1)
        for (std::size_t r = q; r < size; ++r)
          put(column, r, V::fnma(get(a + p * ld, r), get(row0, q), get(column, r)));
      T largest{};
      for (std::size_t r = q + 1; r < size; ++r) {
        const T value = get(column, r);
        put(row, r, value);
        largest = V::max(largest, V::abs(value));
      }
      const T pivot = get(column, q), one = V::all(1);
      if (V::largest(V::all(kkt::kLeastRatio) * largest - V::abs(pivot)) > 0) return false;
      const T over = one / pivot;
      put(inverse, q, over);
      for (std::size_t r = q + 1; r < size; ++r) put(column, r, get(column, r) * over);
    }
    const double *l0 = a + p * ld, *l1 = l0 + ld;
    std::size_t c = p + pivots;
    for (; pivots == 2 && c + 1 < size; c += 2) {
      double *to = a + c * ld, *next = to + ld;
      const T f0 = get(row0, c), f1 = get(row1, c);
      const T g0 = get(row0, c + 1), g1 = get(row1, c + 1);
      for (std::size_t r = c; r < size; ++r) {
        const T x = get(l0, r), y = get(l1, r);
        put(to, r, V::fnma(y, f1, V::fnma(x, f0, get(to, r))));
        put(next, r, V::fnma(y, g1, V::fnma(x, g0, get(next, r))));
      }
    }
    for (; c < size; ++c) {
      double* to = a + c * ld;
      for (std::size_t r = c; r < size; ++r) {
        put(to, r, V::fnma(get(l0, r), get(row0, c), get(to, r)));
        if (pivots == 2) put(to, r, V::fnma(get(l1, r), get(row1, c), get(to, r)));
      }
    }
  }
  return true;
}

/// Least nanoseconds of `call`, each after `reset`.
template <class Reset, class Call>
double least_ns(Reset reset, Call call) {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kRepeats; ++k) {
    reset();
    const auto begin = std::chrono::steady_clock::now();
    call();
    const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - begin;
    least = std::min(least, took.count());
  }
  return least;
}

nlohmann::json measure(std::size_t size, std::size_t eliminated) {
  const std::size_t ld = (size + kkt::kMostLanes - 1) / kkt::kMostLanes * kkt::kMostLanes;
  std::vector<double> one(ld * size, 0.0), panel(4 * ld), inverse(2 * size + 2);
  std::vector<double> four(V::size * size * size), inverses(V::size * size);
  std::vector<double> rows(2 * V::size * size);
  std::mt19937 random(1);
  for (std::size_t c = 0; c < size; ++c)
    for (std::size_t r = c; r < size; ++r) {
      double value = static_cast<double>(random()) / 4294967296.0 - 0.5;
      // Signs of pivots as a stage's variables and equations have them.
      if (r == c) value = (c % 5 == 4 ? -1.0 : 1.0) * static_cast<double>(size);
      one[c * ld + r] = value;
      put(four.data() + V::size * size * c, r, V::all(value));
    }
  const std::vector<double> first = one;
  const std::vector<double> first_four = four;
  const std::vector<std::uint8_t> order(size, 1);
  kkt::Inertia inertia;
  bool stable = true;
  const double single = least_ns([&] { one = first; },
                                 [&] {
                                   const kkt::Block block{one.data(),   ld,
                                                          size,         eliminated,
                                                          order.data(), inverse.data(),
                                                          panel.data(), kkt::kLeastRatio};
                                   stable = kkt::block_kernels().factor(block, inertia) && stable;
                                 });
  const double together = least_ns([&] { four = first_four; },
                                   [&] {
                                     stable = factor_interleaved(four.data(), size, eliminated,
                                                                 inverses.data(), rows.data()) &&
                                              stable;
                                   });
  double apart = 0;
  for (std::size_t c = 0; c < size; ++c)
    for (std::size_t r = c + 1; r < size; ++r)
      apart = std::max(apart, std::fabs(one[c * ld + r] - four[V::size * (c * size + r + 1) - 1]));
  if (!stable || apart > 1e-12) throw std::runtime_error("the two factorisations differ");
  return {{"size", size},
          {"eliminated", eliminated},
          {"lanes", V::size},
          {"one_ns", single},
          {"together_ns", together}};
}

}  // namespace

int main(int argc, char** argv) try {
  std::vector<std::size_t> sizes = {18, 28, 38};
  double share = 0.65;
  CLI::App app("Times fronts factorised one by one and interleaved.");
  app.add_option("--size", sizes, "rows of a front")->delimiter(',');
  app.add_option("--share", share, "of the rows that are eliminated")->check(CLI::Range(0.1, 1.0));
  CLI11_PARSE(app, argc, argv);
  select_kernels(KernelSet::avx2);
  nlohmann::json all = nlohmann::json::array();
  for (const std::size_t size : sizes)
    all.push_back(measure(size, static_cast<std::size_t>(share * static_cast<double>(size))));
  std::cout << all.dump() << "\n";
  return 0;
} catch (const std::exception& error) {
  std::cerr << "bench_interleaved: " << error.what() << "\n";
  return 1;
}
