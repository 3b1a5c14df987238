#pragma once

// The loops of block.hpp over vectors V; included once for each instruction set.

#include "../base/simd.hpp"
#include "block.hpp"

namespace slalom::kkt {
namespace {

template <class V>
class Loops {
 public:
  static bool factor(const Block& b, Inertia& inertia) {
    std::size_t p = 0;
    while (p < b.eliminated) {
      const std::size_t end = panel_end(b, p);
      for (std::size_t q = p; q < end; q += b.order[q])
        if (!(b.order[q] == 1 ? pivot_one(b, p, q, inertia) : pivot_two(b, p, q, inertia)))
          return false;
      switch (end - p) {
        case 1:
          update<1>(b, p);
          break;
        case 2:
          update<2>(b, p);
          break;
        case 3:
          update<3>(b, p);
          break;
        default:
          update<4>(b, p);
      }
      p = end;
    }
    return true;
  }

  static void forward(const Block& b, double* y) {
    for (std::size_t p = 0; p < b.eliminated; ++p) {
      const T value = V::all(y[p]);
      const double* column = b.a + p * b.ld;
      for (std::size_t r = first(p); r < end(b); r += V::size)
        V::store(y + r, V::fnma(V::load(column + r), value, V::load(y + r)));
    }
  }

  static void backward(const Block& b, double* y) {
    scale(b, y);
    std::size_t p = b.eliminated;
    for (; p % 4 != 0; --p) y[p - 1] -= dot(b, p - 1, p - 1, y);
    for (; p > 0; p -= 4) four(b, p - 4, y);
  }

  static double largest(std::size_t n, const double* a) {
    T most{};
    simd::for_vectors<V>(n, [&](std::size_t i, auto load, auto) {
      most = V::max(V::abs(load(a + i)), most);  // NaN is let go
    });
    return V::largest(most);
  }
  static void subtract_one(std::size_t n, double f, const double* x, double* to) {
    const T factor = V::all(f);
    simd::for_vectors<V>(n, [&](std::size_t i, auto load, auto store) {
      store(to + i, V::fnma(factor, load(x + i), load(to + i)));
    });
  }
  static void subtract_two(std::size_t n, double f, const double* x, double g, const double* y,
                           double* to) {
    const T first = V::all(f), second = V::all(g);
    simd::for_vectors<V>(n, [&](std::size_t i, auto load, auto store) {
      const T part = V::fnma(first, load(x + i), load(to + i));
      store(to + i, V::fnma(second, load(y + i), part));
    });
  }

 private:
  using T = typename V::type;
  static constexpr double magnitude(double v) { return v < 0 ? -v : v; }
  static constexpr double larger(double a, double b) { return a > b ? a : b; }
  /// First row of the vector that holds row p: columns start there, zero above their diagonal.
  static constexpr std::size_t first(std::size_t p) { return p & ~(V::size - 1); }
  /// Behind the vector that holds the last row; rows there are zero.
  static constexpr std::size_t end(const Block& b) { return first(b.size + V::size - 1); }

  static std::size_t panel_end(const Block& b, std::size_t p) {
    std::size_t end = p + 4 < b.eliminated ? p + 4 : b.eliminated;
    if (end < b.eliminated && b.order[end] == 0) --end;  // not through a pivot of order 2
    return end;
  }

  // --- factorisation -----------------------------------------------------------------------
  // The panel keeps U = L D of its columns beside L, in b.panel.

  /// Applies the panel's earlier pivots p ... q - 1 to column c.
  static void catch_up(const Block& b, std::size_t p, std::size_t q, std::size_t c) {
    switch (q - p) {
      case 0:
        return;
      case 1:
        return subtract<1>(b, p, c);
      case 2:
        return subtract<2>(b, p, c);
      default:
        return subtract<3>(b, p, c);
    }
  }
  template <std::size_t Pivots>
  static void subtract(const Block& b, std::size_t p, std::size_t c) {
    double* column = b.a + c * b.ld;
    const double* l = b.a + p * b.ld;
    T factor[Pivots];
    for (std::size_t e = 0; e < Pivots; ++e) factor[e] = V::all(b.panel[e * b.ld + c]);
    for (std::size_t r = first(c); r < end(b); r += V::size) {
      T value = V::load(column + r);
      for (std::size_t e = 0; e < Pivots; ++e)
        value = V::fnma(V::load(l + e * b.ld + r), factor[e], value);
      V::store(column + r, value);
    }
  }

  /// Calls f(row, load) for the vectors of rows behind `head`: load gives 0 for rows up to head.
  template <class F>
  static void for_rows_behind(const Block& b, std::size_t head, F f) {
    const std::size_t begin = first(head + 1);
    if (begin >= end(b)) return;
    std::size_t r = begin;
    f(r, [skip = head + 1 - begin](const double* p) { return V::without_first(V::load(p), skip); });
    for (r += V::size; r < end(b); r += V::size) f(r, [](const double* p) { return V::load(p); });
  }
  /// Zeros in the vectors between the one of row q and the first behind `head`.
  static void clear_between(double* column, std::size_t q, std::size_t head) {
    for (std::size_t r = first(q); r < first(head + 1); ++r) column[r] = 0;
  }

  static bool pivot_one(const Block& b, std::size_t p, std::size_t q, Inertia& inertia) {
    catch_up(b, p, q, q);
    double* column = b.a + q * b.ld;
    double* u = b.panel + (q - p) * b.ld;
    const double d = column[q];
    const double over = 1 / d;
    const T inverse = V::all(over);
    T largest{};
    for_rows_behind(b, q, [&](std::size_t r, auto load) {
      const T value = load(column + r);
      largest = V::max(largest, V::abs(value));
      V::store(u + r, value);
      V::store(column + r, value * inverse);
    });
    clear_between(column, q, q);
    clear_between(u, q, q);
    const double size = magnitude(d);
    if (!(size > kTinyPivot && size >= b.least_ratio * V::largest(largest))) return false;
    b.inverse[2 * q] = over;
    b.inverse[2 * q + 1] = 0;
    ++(d > 0 ? inertia.positive : inertia.negative);
    return true;
  }

  static bool pivot_two(const Block& b, std::size_t p, std::size_t q, Inertia& inertia) {
    catch_up(b, p, q, q);
    catch_up(b, p, q, q + 1);
    double* first_column = b.a + q * b.ld;
    double* second_column = first_column + b.ld;
    double* u = b.panel + (q - p) * b.ld;
    double* v = u + b.ld;
    const double d0 = first_column[q], d1 = first_column[q + 1], d2 = second_column[q + 1];
    const double det = d0 * d2 - d1 * d1;
    const double i0 = d2 / det, i1 = -d1 / det, i2 = d0 / det;
    const T j0 = V::all(i0), j1 = V::all(i1), j2 = V::all(i2);
    T largest0{}, largest1{};
    for_rows_behind(b, q + 1, [&](std::size_t r, auto load) {
      const T x = load(first_column + r), y = load(second_column + r);
      largest0 = V::max(largest0, V::abs(x));
      largest1 = V::max(largest1, V::abs(y));
      V::store(u + r, x);
      V::store(v + r, y);
      V::store(first_column + r, V::fma(y, j1, x * j0));
      V::store(second_column + r, V::fma(y, j2, x * j1));
    });
    for (double* column : {first_column, second_column, u, v}) clear_between(column, q, q + 1);
    const double m0 = V::largest(largest0), m1 = V::largest(largest1), size = magnitude(det);
    const double bound = size / b.least_ratio;
    if (!(size > kTinyPivot * kTinyPivot && magnitude(d2) * m0 + magnitude(d1) * m1 <= bound &&
          magnitude(d1) * m0 + magnitude(d0) * m1 <= bound))
      return false;
    b.inverse[2 * q] = i0;
    b.inverse[2 * q + 1] = i1;
    b.inverse[2 * q + 2] = i2;
    b.inverse[2 * q + 3] = 0;
    if (det < 0) {
      ++inertia.positive;
      ++inertia.negative;
    } else {
      (d0 > 0 ? inertia.positive : inertia.negative) += 2;
    }
    return true;
  }

  /// Applies the `Pivots` of the panel at p to all columns behind it, two at a time.
  template <std::size_t Pivots>
  static void update(const Block& b, std::size_t p) {
    const double* l = b.a + p * b.ld;
    std::size_t c = p + Pivots;
    for (; c + 1 < b.size; c += 2) {
      T factor[Pivots], factor1[Pivots];
      for (std::size_t e = 0; e < Pivots; ++e) {
        factor[e] = V::all(b.panel[e * b.ld + c]);
        factor1[e] = V::all(b.panel[e * b.ld + c + 1]);
      }
      double* to = b.a + c * b.ld;
      for (std::size_t r = first(c); r < end(b); r += V::size) {
        T x = V::load(to + r), y = V::load(to + b.ld + r);
        for (std::size_t e = 0; e < Pivots; ++e) {
          const T value = V::load(l + e * b.ld + r);
          x = V::fnma(value, factor[e], x);
          y = V::fnma(value, factor1[e], y);
        }
        V::store(to + r, x);
        V::store(to + b.ld + r, y);
      }
    }
    for (; c < b.size; ++c) subtract<Pivots>(b, p, c);
  }

  // --- solution ----------------------------------------------------------------------------
  static void scale(const Block& b, double* y) {
    for (std::size_t p = 0; p < b.eliminated; ++p) {
      if (b.order[p] == 1) {
        y[p] *= b.inverse[2 * p];
      } else {
        const double x = y[p], z = y[p + 1];
        y[p] = b.inverse[2 * p] * x + b.inverse[2 * p + 1] * z;
        y[p + 1] = b.inverse[2 * p + 1] * x + b.inverse[2 * p + 2] * z;
        ++p;
      }
    }
  }

  static double dot(const Block& b, std::size_t column, std::size_t from, const double* y) {
    T sum{};
    for (std::size_t r = first(from); r < end(b); r += V::size)
      sum = V::fma(V::load(b.a + column * b.ld + r), V::load(y + r), sum);
    return V::sum(sum);
  }

  /// Rows p ... p + 3 at once (p a multiple of 4): what lies below them first, then each other.
  static void four(const Block& b, std::size_t p, double* y) {
    const double* l = b.a + p * b.ld;
    T sum[4] = {};
    for_rows_behind(b, p + 3, [&](std::size_t r, auto load) {
      const T value = load(y + r);
      for (std::size_t e = 0; e < 4; ++e) sum[e] = V::fma(V::load(l + e * b.ld + r), value, sum[e]);
    });
    const double y3 = y[p + 3] - V::sum(sum[3]);
    const double y2 = y[p + 2] - V::sum(sum[2]) - l[2 * b.ld + p + 3] * y3;
    const double y1 = y[p + 1] - V::sum(sum[1]) - l[b.ld + p + 2] * y2 - l[b.ld + p + 3] * y3;
    const double y0 = y[p] - V::sum(sum[0]) - l[p + 1] * y1 - l[p + 2] * y2 - l[p + 3] * y3;
    V::store_four(y + p, y0, y1, y2, y3);
  }
};

using VecLoops = Loops<simd::Vec>;
constexpr BlockKernels kVecKernels = {VecLoops::factor,       VecLoops::forward,
                                      VecLoops::backward,     VecLoops::largest,
                                      VecLoops::subtract_one, VecLoops::subtract_two};

}  // namespace
}  // namespace slalom::kkt
