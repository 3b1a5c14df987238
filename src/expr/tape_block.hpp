#pragma once

// The interpreter's inner loops, included once for each instruction set with a policy V that
// wraps its vectors and SLEEF's functions for them. Of SLEEF only the deterministic variants (cinz,
// finz) will do: in the others a lane's last bit depends on how large its neighbours are.

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

template <class V, std::size_t Width>
void run_width(const Tape& tape, double* workspace) {
  using T = typename V::type;
  for (const Instruction& step : tape.code) {
    double* to = workspace + step.to * Width;
    const double* a = workspace + step.a * Width;
    const double* b = workspace + step.b * Width;
    switch (step.op) {
      case Op::constant:
      case Op::symbol:
        break;
      case Op::neg:
        map1<V, Width>(to, a, [](T x) { return -x; });
        break;
      case Op::square:
        map1<V, Width>(to, a, [](T x) { return x * x; });
        break;
      case Op::sqrt:
        map1<V, Width>(to, a, V::sqrt);
        break;
      case Op::exp:
        map1<V, Width>(to, a, V::exp);
        break;
      case Op::log:
        map1<V, Width>(to, a, V::log);
        break;
      case Op::sin:
        map1<V, Width>(to, a, V::sin);
        break;
      case Op::cos:
        map1<V, Width>(to, a, V::cos);
        break;
      case Op::tan:
        map1<V, Width>(to, a, V::tan);
        break;
      case Op::asin:
        map1<V, Width>(to, a, V::asin);
        break;
      case Op::acos:
        map1<V, Width>(to, a, V::acos);
        break;
      case Op::atan:
        map1<V, Width>(to, a, V::atan);
        break;
      case Op::sinh:
        map1<V, Width>(to, a, V::sinh);
        break;
      case Op::cosh:
        map1<V, Width>(to, a, V::cosh);
        break;
      case Op::tanh:
        map1<V, Width>(to, a, V::tanh);
        break;
      case Op::abs:
        map1<V, Width>(to, a, V::abs);
        break;
      case Op::sign:
        map1<V, Width>(to, a, V::sign);
        break;
      case Op::add:
        map2<V, Width>(to, a, b, [](T x, T y) { return x + y; });
        break;
      case Op::sub:
        map2<V, Width>(to, a, b, [](T x, T y) { return x - y; });
        break;
      case Op::mul:
        map2<V, Width>(to, a, b, [](T x, T y) { return x * y; });
        break;
      case Op::div:
        map2<V, Width>(to, a, b, [](T x, T y) { return x / y; });
        break;
      case Op::pow:
        map2<V, Width>(to, a, b, V::pow);
        break;
      case Op::atan2:
        map2<V, Width>(to, a, b, V::atan2);
        break;
      case Op::min:
        map2<V, Width>(to, a, b, [](T x, T y) { return V::pick(x < y, x, y); });
        break;
      case Op::max:
        map2<V, Width>(to, a, b, [](T x, T y) { return V::pick(x > y, x, y); });
        break;
      case Op::select: {
        const double* c = workspace + step.c * Width;
        for (std::size_t i = 0; i < Width; i += V::size)
          V::store(to + i, V::pick(V::load(a + i) > T{}, V::load(b + i), V::load(c + i)));
        break;
      }
    }
  }
}

template <class V>
void run_block(const Tape& tape, double* workspace, std::size_t width) {
  switch (width) {
    case 4:
      return run_width<V, 4>(tape, workspace);
    case 16:
      return run_width<V, 16>(tape, workspace);
    default:
      return run_width<V, 64>(tape, workspace);
  }
}

}  // namespace slalom::expr
