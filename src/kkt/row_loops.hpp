#pragma once

// The loops of row_kernels.hpp over vectors V; included once for each instruction set.

#include "../base/simd.hpp"
#include "row_kernels.hpp"

namespace slalom::kkt {
namespace {

template <class V>
class RowLoops {
 public:
  static void multiply(const RowBlocks::Block* blocks, std::size_t count,
                       const RowBlocks::Entry* entries, const double* values, const double* x,
                       double* out) {
    for (std::size_t b = 0; b < count; ++b) {
      double* to = out + blocks[b].row;
      const std::size_t n = blocks[b].count;
      for (std::size_t i = 0; i < n; ++i) to[i] = 0;
      for (std::size_t e = blocks[b].begin; e < blocks[b].end; ++e)
        axpy(n, values + entries[e].value, x + entries[e].col, entries[e].stride, to);
    }
  }

  static void transposed(const RowBlocks::Block* blocks, std::size_t count,
                         const RowBlocks::Entry* entries, const double* values, const double* y,
                         const double* y2, double* out, double* out2) {
    for (std::size_t b = 0; b < count; ++b) {
      const std::size_t n = blocks[b].count, row = blocks[b].row;
      for (std::size_t e = blocks[b].begin; e < blocks[b].end; ++e) {
        const auto& entry = entries[e];
        add_column(n, values + entry.value, y + row, entry.stride, out + entry.col);
        if (y2 != nullptr)
          add_column(n, values + entry.value, y2 + row, entry.stride, out2 + entry.col);
      }
    }
  }

  static void symmetric(const SymmetricRuns::Run* runs, std::size_t count, const double* values,
                        const double* x, double* out) {
    for (std::size_t k = 0; k < count; ++k) {
      const auto& run = runs[k];
      both(run, values, x + run.col, run.col_stride, out + run.row, run.row_stride);
      if (!run.diagonal)
        both(run, values, x + run.row, run.row_stride, out + run.col, run.col_stride);
    }
  }

  static void condense(const CondensedHessian::Product* products, std::size_t count,
                       const std::uint32_t* index, const double* jacobian, const double* weights,
                       double* out) {
    for (std::size_t k = 0; k < count; ++k) {
      const auto& p = products[k];
      const double *w = weights + p.row, *a = jacobian + p.first, *b = jacobian + p.second;
      if (p.step == 0) {
        out[p.target] += dot3(p.count, w, a, b);
      } else if (p.step == 1) {
        add3(p.count, w, a, b, out + p.target);
      } else {
        for (std::size_t i = 0; i < p.count; ++i) out[index[p.target + i]] += w[i] * a[i] * b[i];
      }
    }
  }

 private:
  using T = typename V::type;

  /// out[i] += a[i] x[i stride]
  static void axpy(std::size_t n, const double* a, const double* x, std::int32_t stride,
                   double* out) {
    if (stride == 0) {
      const T value = V::all(*x);
      simd::for_vectors<V>(n, [&](std::size_t i, auto load, auto store) {
        store(out + i, V::fma(load(a + i), value, load(out + i)));
      });
    } else if (stride == 1) {
      simd::for_vectors<V>(n, [&](std::size_t i, auto load, auto store) {
        store(out + i, V::fma(load(a + i), load(x + i), load(out + i)));
      });
    } else {
      for (std::size_t i = 0; i < n; ++i)
        out[i] += a[i] * x[static_cast<std::ptrdiff_t>(i) * stride];
    }
  }

  /// out[i stride] += a[i] y[i]
  static void add_column(std::size_t n, const double* a, const double* y, std::int32_t stride,
                         double* out) {
    if (stride == 0) {
      T sum{};
      simd::for_vectors<V>(
          n, [&](std::size_t i, auto load, auto) { sum = V::fma(load(a + i), load(y + i), sum); });
      *out += V::sum(sum);
    } else if (stride == 1) {
      simd::for_vectors<V>(n, [&](std::size_t i, auto load, auto store) {
        store(out + i, V::fma(load(a + i), load(y + i), load(out + i)));
      });
    } else {
      for (std::size_t i = 0; i < n; ++i)
        out[static_cast<std::ptrdiff_t>(i) * stride] += a[i] * y[i];
    }
  }

  /// out[i to] += values[i] x[i from]
  static void both(const SymmetricRuns::Run& run, const double* values, const double* x,
                   std::int32_t from, double* out, std::int32_t to) {
    const double* a = values + run.value;
    if (to == 0 && from == 1) {
      add_column(run.count, a, x, 0, out);
    } else if (to == 1) {
      axpy(run.count, a, x, from, out);
    } else {
      for (std::size_t i = 0; i < run.count; ++i)
        out[static_cast<std::ptrdiff_t>(i) * to] += a[i] * x[static_cast<std::ptrdiff_t>(i) * from];
    }
  }

  static double dot3(std::size_t n, const double* w, const double* a, const double* b) {
    T sum{};
    simd::for_vectors<V>(n, [&](std::size_t i, auto load, auto) {
      sum = V::fma(load(w + i) * load(a + i), load(b + i), sum);
    });
    return V::sum(sum);
  }

  static void add3(std::size_t n, const double* w, const double* a, const double* b, double* out) {
    simd::for_vectors<V>(n, [&](std::size_t i, auto load, auto store) {
      store(out + i, V::fma(load(w + i) * load(a + i), load(b + i), load(out + i)));
    });
  }
};

using VecRowLoops = RowLoops<simd::Vec>;

}  // namespace
}  // namespace slalom::kkt
