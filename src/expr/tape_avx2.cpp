#include "tape_block.hpp"

#ifdef __AVX2__
#include <sleef.h>

#include "../base/simd.hpp"

namespace slalom::expr {
namespace {

/// Four lanes: AVX2 with FMA.
struct Vector : simd::Vec {
  static type exp(type v) { return Sleef_finz_expd4_u10avx2(v); }
  static type log(type v) { return Sleef_finz_logd4_u10avx2(v); }
  static type sin(type v) { return Sleef_finz_sind4_u10avx2(v); }
  static type cos(type v) { return Sleef_finz_cosd4_u10avx2(v); }
  static type tan(type v) { return Sleef_finz_tand4_u10avx2(v); }
  static type asin(type v) { return Sleef_finz_asind4_u10avx2(v); }
  static type acos(type v) { return Sleef_finz_acosd4_u10avx2(v); }
  static type atan(type v) { return Sleef_finz_atand4_u10avx2(v); }
  static type sinh(type v) { return Sleef_finz_sinhd4_u10avx2(v); }
  static type cosh(type v) { return Sleef_finz_coshd4_u10avx2(v); }
  static type tanh(type v) { return Sleef_finz_tanhd4_u10avx2(v); }
  static type pow(type a, type b) { return Sleef_finz_powd4_u10avx2(a, b); }
  static type atan2(type y, type x) { return Sleef_finz_atan2d4_u10avx2(y, x); }
  static type product_plus(type a, type b, type c) { return _mm256_fmadd_pd(a, b, c); }
  static type product_minus(type a, type b, type c) { return _mm256_fmsub_pd(a, b, c); }
  static type minus_product(type a, type b, type c) { return _mm256_fnmadd_pd(a, b, c); }
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

void run_block_avx2(const Tape& tape, double* const* rows, std::size_t width) {
  run_block<Vector>(tape, rows, width);
}

}  // namespace slalom::expr

#else  // a processor of another kind, on which no one calls this

namespace slalom::expr {

void run_block_avx2(const Tape& tape, double* const* rows, std::size_t width) {
  run_block_baseline(tape, rows, width);
}

}  // namespace slalom::expr

#endif
