#include "tape_block.hpp"

#ifdef __AVX512F__
#include <sleef.h>

#include "../base/simd.hpp"

namespace slalom::expr {
namespace {

/// Eight lanes: AVX-512.
struct Vector : simd::Vec {
  static type exp(type v) { return Sleef_finz_expd8_u10avx512f(v); }
  static type log(type v) { return Sleef_finz_logd8_u10avx512f(v); }
  static type sin(type v) { return Sleef_finz_sind8_u10avx512f(v); }
  static type cos(type v) { return Sleef_finz_cosd8_u10avx512f(v); }
  static type tan(type v) { return Sleef_finz_tand8_u10avx512f(v); }
  static type asin(type v) { return Sleef_finz_asind8_u10avx512f(v); }
  static type acos(type v) { return Sleef_finz_acosd8_u10avx512f(v); }
  static type atan(type v) { return Sleef_finz_atand8_u10avx512f(v); }
  static type sinh(type v) { return Sleef_finz_sinhd8_u10avx512f(v); }
  static type cosh(type v) { return Sleef_finz_coshd8_u10avx512f(v); }
  static type tanh(type v) { return Sleef_finz_tanhd8_u10avx512f(v); }
  static type pow(type a, type b) { return Sleef_finz_powd8_u10avx512f(a, b); }
  static type atan2(type y, type x) { return Sleef_finz_atan2d8_u10avx512f(y, x); }
  static type product_plus(type a, type b, type c) { return _mm512_fmadd_pd(a, b, c); }
  static type product_minus(type a, type b, type c) { return _mm512_fmsub_pd(a, b, c); }
  static type minus_product(type a, type b, type c) { return _mm512_fnmadd_pd(a, b, c); }
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

void run_block_avx512(const Tape& tape, double* const* rows, std::size_t width) {
  if (width < Vector::size) return run_block_avx2(tape, rows, width);
  run_block<Vector>(tape, rows, width);
}

}  // namespace slalom::expr

#else  // a processor of another kind, on which no one calls this

namespace slalom::expr {

void run_block_avx512(const Tape& tape, double* const* rows, std::size_t width) {
  run_block_baseline(tape, rows, width);
}

}  // namespace slalom::expr

#endif
