#pragma once

// The interpreter's inner loops over vectors V (tape_vector.hpp); included once for each
// instruction set.

#include <cstddef>

#include "tape.hpp"

namespace slalom::expr {

template <class V, std::size_t Width, class F>
inline void map1(double* to, const double* a, F f) {
  for (std::size_t i = 0; i < Width; i += V::size) V::store(to + i, f(V::load(a + i)));
}

template <class V, std::size_t Width, class F>
inline void map2(double* to, const double* a, const double* b, F f) {
  for (std::size_t i = 0; i < Width; i += V::size)
    V::store(to + i, f(V::load(a + i), V::load(b + i)));
}

template <class V, std::size_t Width, class F>
inline void map3(double* to, const double* a, const double* b, const double* c, F f) {
  for (std::size_t i = 0; i < Width; i += V::size)
    V::store(to + i, f(V::load(a + i), V::load(b + i), V::load(c + i)));
}

template <class V, std::size_t Width>
void run_width(const Tape& tape, double* const* rows) {
  using T = typename V::type;
  for (const Instruction& step : tape.code) {
    double* to = rows[step.to];
    const double* a = rows[step.a];
    switch (step.code) {
      case code_of(Op::constant):
      case code_of(Op::symbol):
        break;
      case code_of(Op::neg):
        map1<V, Width>(to, a, [](T x) { return -x; });
        break;
      case code_of(Op::square):
        map1<V, Width>(to, a, [](T x) { return x * x; });
        break;
      case code_of(Op::sqrt):
        map1<V, Width>(to, a, V::sqrt);
        break;
      case code_of(Op::exp):
        map1<V, Width>(to, a, V::exp);
        break;
      case code_of(Op::log):
        map1<V, Width>(to, a, V::log);
        break;
      case code_of(Op::sin):
        map1<V, Width>(to, a, V::sin);
        break;
      case code_of(Op::cos):
        map1<V, Width>(to, a, V::cos);
        break;
      case code_of(Op::tan):
        map1<V, Width>(to, a, V::tan);
        break;
      case code_of(Op::asin):
        map1<V, Width>(to, a, V::asin);
        break;
      case code_of(Op::acos):
        map1<V, Width>(to, a, V::acos);
        break;
      case code_of(Op::atan):
        map1<V, Width>(to, a, V::atan);
        break;
      case code_of(Op::sinh):
        map1<V, Width>(to, a, V::sinh);
        break;
      case code_of(Op::cosh):
        map1<V, Width>(to, a, V::cosh);
        break;
      case code_of(Op::tanh):
        map1<V, Width>(to, a, V::tanh);
        break;
      case code_of(Op::abs):
        map1<V, Width>(to, a, V::abs);
        break;
      case code_of(Op::sign):
        map1<V, Width>(to, a, V::sign);
        break;
      case code_of(Op::lookup):
        for (std::size_t i = 0; i < Width; ++i) to[i] = tape.steps[step.steps]->at(a[i]);
        break;
      case code_of(Op::add):
        map2<V, Width>(to, a, rows[step.b], [](T x, T y) { return x + y; });
        break;
      case code_of(Op::sub):
        map2<V, Width>(to, a, rows[step.b], [](T x, T y) { return x - y; });
        break;
      case code_of(Op::mul):
        map2<V, Width>(to, a, rows[step.b], [](T x, T y) { return x * y; });
        break;
      case code_of(Op::div):
        map2<V, Width>(to, a, rows[step.b], [](T x, T y) { return x / y; });
        break;
      case code_of(Op::pow):
        map2<V, Width>(to, a, rows[step.b], V::pow);
        break;
      case code_of(Op::atan2):
        map2<V, Width>(to, a, rows[step.b], V::atan2);
        break;
      case code_of(Op::min):
        map2<V, Width>(to, a, rows[step.b], [](T x, T y) { return V::pick(x < y, x, y); });
        break;
      case code_of(Op::max):
        map2<V, Width>(to, a, rows[step.b], [](T x, T y) { return V::pick(x > y, x, y); });
        break;
      case code_of(Op::select):
        map3<V, Width>(to, a, rows[step.b], rows[step.c],
                       [](T x, T y, T z) { return V::pick(x > T{}, y, z); });
        break;
      case kProductPlus:
        map3<V, Width>(to, a, rows[step.b], rows[step.c], V::product_plus);
        break;
      case kProductMinus:
        map3<V, Width>(to, a, rows[step.b], rows[step.c], V::product_minus);
        break;
      case kMinusProduct:
        map3<V, Width>(to, a, rows[step.b], rows[step.c], V::minus_product);
        break;
    }
  }
}

template <class V>
void run_block(const Tape& tape, double* const* rows, std::size_t width) {
  switch (width) {
    case 4:
      if constexpr (V::size <= 4) return run_width<V, 4>(tape, rows);
      return;  // too narrow: the caller has it run on narrower vectors
    case 16:
      return run_width<V, 16>(tape, rows);
    default:
      return run_width<V, 64>(tape, rows);
  }
}

}  // namespace slalom::expr
