#pragma once

// What the interpreter's loops run on: simd::Vec with SLEEF's functions for it, which the including
// file names, SLALOM_SLEEF(exp) and so on. Of SLEEF only the deterministic variants (cinz, finz)
// will do: in the others a lane's last bit depends on how large its neighbours are.

#include <sleef.h>

#include "../base/simd.hpp"

namespace slalom::expr {
namespace {

struct Vector : simd::Vec {
  static type exp(type v) { return SLALOM_SLEEF(exp)(v); }
  static type log(type v) { return SLALOM_SLEEF(log)(v); }
  static type sin(type v) { return SLALOM_SLEEF(sin)(v); }
  static type cos(type v) { return SLALOM_SLEEF(cos)(v); }
  static type tan(type v) { return SLALOM_SLEEF(tan)(v); }
  static type asin(type v) { return SLALOM_SLEEF(asin)(v); }
  static type acos(type v) { return SLALOM_SLEEF(acos)(v); }
  static type atan(type v) { return SLALOM_SLEEF(atan)(v); }
  static type sinh(type v) { return SLALOM_SLEEF(sinh)(v); }
  static type cosh(type v) { return SLALOM_SLEEF(cosh)(v); }
  static type tanh(type v) { return SLALOM_SLEEF(tanh)(v); }
  static type pow(type a, type b) { return SLALOM_SLEEF(pow)(a, b); }
  static type atan2(type y, type x) { return SLALOM_SLEEF(atan2)(y, x); }
  static type product_plus(type a, type b, type c) { return fma(a, b, c); }
  static type product_minus(type a, type b, type c) { return fma(a, b, -c); }
  static type minus_product(type a, type b, type c) { return fnma(a, b, c); }
  template <class Mask>
  static type pick(Mask mask, type yes, type no) {
    return mask ? yes : no;
  }
  static type sign(type v) {
    const type zero{}, one = zero + 1.0;
    return pick(v > zero, one, pick(v < zero, -one, v != v ? v : zero));
  }
};

}  // namespace
}  // namespace slalom::expr
