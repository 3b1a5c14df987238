#include <immintrin.h>
#include <sleef.h>

#include "tape_block.hpp"

namespace slalom::expr {
namespace {

/// Two lanes: SSE2, which every x86-64 processor has.
struct Vector {
  using type = __m128d;
  static constexpr std::size_t size = 2;
  static type load(const double* p) { return _mm_loadu_pd(p); }
  static void store(double* p, type v) { _mm_storeu_pd(p, v); }
  static type sqrt(type v) { return _mm_sqrt_pd(v); }
  static type exp(type v) { return Sleef_cinz_expd2_u10sse2(v); }
  static type log(type v) { return Sleef_cinz_logd2_u10sse2(v); }
  static type sin(type v) { return Sleef_cinz_sind2_u10sse2(v); }
  static type cos(type v) { return Sleef_cinz_cosd2_u10sse2(v); }
  static type tan(type v) { return Sleef_cinz_tand2_u10sse2(v); }
  static type asin(type v) { return Sleef_cinz_asind2_u10sse2(v); }
  static type acos(type v) { return Sleef_cinz_acosd2_u10sse2(v); }
  static type atan(type v) { return Sleef_cinz_atand2_u10sse2(v); }
  static type sinh(type v) { return Sleef_cinz_sinhd2_u10sse2(v); }
  static type cosh(type v) { return Sleef_cinz_coshd2_u10sse2(v); }
  static type tanh(type v) { return Sleef_cinz_tanhd2_u10sse2(v); }
  static type pow(type a, type b) { return Sleef_cinz_powd2_u10sse2(a, b); }
  static type atan2(type y, type x) { return Sleef_cinz_atan2d2_u10sse2(y, x); }
  static type product_plus(type a, type b, type c) { return a * b + c; }
  static type product_minus(type a, type b, type c) { return a * b - c; }
  static type minus_product(type a, type b, type c) { return c - a * b; }
  template <class Mask>
  static type pick(Mask mask, type yes, type no) {
    return mask ? yes : no;
  }
  static type abs(type v) { return _mm_andnot_pd(_mm_set1_pd(-0.0), v); }
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
