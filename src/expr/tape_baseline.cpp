#include <sleef.h>

#include "../base/simd.hpp"
#include "tape_block.hpp"

namespace slalom::expr {
namespace {

#ifdef __x86_64__
#define SLALOM_SLEEF(function) Sleef_cinz_##function##d2_u10sse2
#else  // the same bits
#define SLALOM_SLEEF(function) Sleef_cinz_##function##d2_u10advsimdnofma
#endif

/// Two lanes, which every processor has.
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
  static type product_plus(type a, type b, type c) { return a * b + c; }
  static type product_minus(type a, type b, type c) { return a * b - c; }
  static type minus_product(type a, type b, type c) { return c - a * b; }
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

void run_block_baseline(const Tape& tape, double* const* rows, std::size_t width) {
  run_block<Vector>(tape, rows, width);
}

}  // namespace slalom::expr
