#pragma once

// A vector of doubles for the instruction set a file is compiled for; included by the files
// *_baseline.cpp, *_avx2.cpp and *_avx512.cpp alone. All is local to the file: a function of the
// same name compiled for another set must never stand in for it.

#ifdef __x86_64__
#include <immintrin.h>
#endif

#include <cstddef>
#include <cstring>

namespace slalom::simd {
namespace {

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)

/// Eight lanes: AVX-512 with its doubleword and vector-length extensions.
struct Vec {
  using type = __m512d;
  static constexpr std::size_t size = 8;
  static type load(const double* p) { return _mm512_loadu_pd(p); }
  static void store(double* p, type v) { _mm512_storeu_pd(p, v); }
  /// The first n < size lanes; the others 0 or untouched.
  static type load_part(const double* p, std::size_t n) {
    return _mm512_maskz_loadu_pd(first_lanes(n), p);
  }
  static void store_part(double* p, std::size_t n, type v) {
    _mm512_mask_storeu_pd(p, first_lanes(n), v);
  }
  static type all(double v) { return _mm512_set1_pd(v); }
  static type fma(type a, type b, type c) { return _mm512_fmadd_pd(a, b, c); }    ///< c + a b
  static type fnma(type a, type b, type c) { return _mm512_fnmadd_pd(a, b, c); }  ///< c - a b
  static type max(type a, type b) { return _mm512_max_pd(a, b); }
  static type min(type a, type b) { return _mm512_min_pd(a, b); }
  static type sqrt(type v) { return _mm512_sqrt_pd(v); }
  static type abs(type v) { return _mm512_abs_pd(v); }
  static double sum(type v) {
    const __m256d half = _mm256_add_pd(low(v), high(v));
    const __m128d pair = _mm_add_pd(_mm256_castpd256_pd128(half), _mm256_extractf128_pd(half, 1));
    return _mm_cvtsd_f64(_mm_add_sd(pair, _mm_unpackhi_pd(pair, pair)));
  }
  static double largest(type v) {
    const __m256d half = _mm256_max_pd(low(v), high(v));
    const __m128d pair = _mm_max_pd(_mm256_castpd256_pd128(half), _mm256_extractf128_pd(half, 1));
    return _mm_cvtsd_f64(_mm_max_sd(pair, _mm_unpackhi_pd(pair, pair)));
  }
  /// Of positive normal numbers: the exponent's bits, and the mantissa in [1, 2).
  using ints = __m512i;
  static ints exponents(type v) { return _mm512_srli_epi64(_mm512_castpd_si512(v), 52); }
  static ints plus(ints a, ints b) { return _mm512_add_epi64(a, b); }
  static type mantissas(type v) {
    const type kept = _mm512_and_pd(v, _mm512_castsi512_pd(_mm512_set1_epi64(0xFFFFFFFFFFFFF)));
    return _mm512_or_pd(kept, _mm512_set1_pd(1.0));
  }
  /// v with its first n < size lanes 0.
  static type without_first(type v, std::size_t n) {
    return _mm512_mask_mov_pd(v, first_lanes(n), _mm512_setzero_pd());
  }
  /// The first n < size lanes of v, then those of `other`.
  static type first_of(std::size_t n, type v, type other) {
    return _mm512_mask_mov_pd(other, first_lanes(n), v);
  }
  static void store_four(double* p, double a, double b, double c, double d) {
    _mm256_storeu_pd(p, _mm256_set_pd(d, c, b, a));
  }

 private:
  static __mmask8 first_lanes(std::size_t n) { return static_cast<__mmask8>((1U << n) - 1); }
  static __m256d low(type v) { return _mm512_castpd512_pd256(v); }
  static __m256d high(type v) { return _mm512_extractf64x4_pd(v, 1); }
};

#elif defined(__AVX2__) && defined(__FMA__)

/// Four lanes: AVX2 with FMA.
struct Vec {
  using type = __m256d;
  static constexpr std::size_t size = 4;
  static type load(const double* p) { return _mm256_loadu_pd(p); }
  static void store(double* p, type v) { _mm256_storeu_pd(p, v); }
  /// The first n < size lanes; the others 0 or untouched.
  static type load_part(const double* p, std::size_t n) {
    return _mm256_maskload_pd(p, first_lanes(n));
  }
  static void store_part(double* p, std::size_t n, type v) {
    _mm256_maskstore_pd(p, first_lanes(n), v);
  }
  static type all(double v) { return _mm256_set1_pd(v); }
  static type fma(type a, type b, type c) { return _mm256_fmadd_pd(a, b, c); }    ///< c + a b
  static type fnma(type a, type b, type c) { return _mm256_fnmadd_pd(a, b, c); }  ///< c - a b
  static type max(type a, type b) { return _mm256_max_pd(a, b); }
  static type min(type a, type b) { return _mm256_min_pd(a, b); }
  static type sqrt(type v) { return _mm256_sqrt_pd(v); }
  static type abs(type v) { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), v); }
  static double sum(type v) {
    const __m128d half = _mm_add_pd(_mm256_castpd256_pd128(v), _mm256_extractf128_pd(v, 1));
    return _mm_cvtsd_f64(_mm_add_sd(half, _mm_unpackhi_pd(half, half)));
  }
  static double largest(type v) {
    const __m128d half = _mm_max_pd(_mm256_castpd256_pd128(v), _mm256_extractf128_pd(v, 1));
    return _mm_cvtsd_f64(_mm_max_sd(half, _mm_unpackhi_pd(half, half)));
  }
  /// Of positive normal numbers: the exponent's bits, and the mantissa in [1, 2).
  using ints = __m256i;
  static ints exponents(type v) { return _mm256_srli_epi64(_mm256_castpd_si256(v), 52); }
  static ints plus(ints a, ints b) { return _mm256_add_epi64(a, b); }
  static type mantissas(type v) {
    const type kept = _mm256_and_pd(v, _mm256_castsi256_pd(_mm256_set1_epi64x(0xFFFFFFFFFFFFF)));
    return _mm256_or_pd(kept, _mm256_set1_pd(1.0));
  }
  /// v with its first n < size lanes 0.
  static type without_first(type v, std::size_t n) {
    return _mm256_andnot_pd(_mm256_castsi256_pd(first_lanes(n)), v);
  }
  /// The first n < size lanes of v, then those of `other`.
  static type first_of(std::size_t n, type v, type other) {
    return _mm256_blendv_pd(other, v, _mm256_castsi256_pd(first_lanes(n)));
  }
  static void store_four(double* p, double a, double b, double c, double d) {
    _mm256_storeu_pd(p, _mm256_set_pd(d, c, b, a));
  }
  static __m256i first_lanes(std::size_t n) {
    const __m256i lane = _mm256_set_epi64x(3, 2, 1, 0);
    return _mm256_cmpgt_epi64(_mm256_set1_epi64x(static_cast<long long>(n)), lane);
  }
};

#elif defined(__x86_64__)

/// Two lanes: SSE2, which every x86-64 processor has.
struct Vec {
  using type = __m128d;
  static constexpr std::size_t size = 2;
  static type load(const double* p) { return _mm_loadu_pd(p); }
  static void store(double* p, type v) { _mm_storeu_pd(p, v); }
  /// The first n < size lanes; the others 0 or untouched.
  static type load_part(const double* p, std::size_t) { return _mm_load_sd(p); }
  static void store_part(double* p, std::size_t, type v) { _mm_store_sd(p, v); }
  static type all(double v) { return _mm_set1_pd(v); }
  static type fma(type a, type b, type c) { return c + a * b; }
  static type fnma(type a, type b, type c) { return c - a * b; }
  static type max(type a, type b) { return _mm_max_pd(a, b); }
  static type min(type a, type b) { return _mm_min_pd(a, b); }
  static type sqrt(type v) { return _mm_sqrt_pd(v); }
  static type abs(type v) { return _mm_andnot_pd(_mm_set1_pd(-0.0), v); }
  static double sum(type v) { return _mm_cvtsd_f64(_mm_add_sd(v, _mm_unpackhi_pd(v, v))); }
  static double largest(type v) { return _mm_cvtsd_f64(_mm_max_sd(v, _mm_unpackhi_pd(v, v))); }
  static type without_first(type v, std::size_t n) {
    return n == 0 ? v : _mm_unpackhi_pd(_mm_setzero_pd(), v);
  }
  /// The first n < size lanes of v, then those of `other`.
  static type first_of(std::size_t n, type v, type other) {
    return n == 0 ? other : _mm_shuffle_pd(v, other, 2);
  }
  static void store_four(double* p, double a, double b, double c, double d) {
    _mm_storeu_pd(p, _mm_set_pd(b, a));
    _mm_storeu_pd(p + 2, _mm_set_pd(d, c));
  }
  using ints = __m128i;
  static ints exponents(type v) { return _mm_srli_epi64(_mm_castpd_si128(v), 52); }
  static ints plus(ints a, ints b) { return _mm_add_epi64(a, b); }
  static type mantissas(type v) {
    const type kept = _mm_and_pd(v, _mm_castsi128_pd(_mm_set1_epi64x(0xFFFFFFFFFFFFF)));
    return _mm_or_pd(kept, _mm_set1_pd(1.0));
  }
};

#else

/// Two lanes by the compiler's own vectors (NEON on aarch64), with the same bits as SSE2's.
struct Vec {
  using type = double __attribute__((vector_size(16)));
  using ints = long long __attribute__((vector_size(16)));
  static constexpr std::size_t size = 2;
  static type load(const double* p) {
    type v;
    std::memcpy(&v, p, sizeof v);
    return v;
  }
  static void store(double* p, type v) { std::memcpy(p, &v, sizeof v); }
  /// The first n < size lanes; the others 0 or untouched.
  static type load_part(const double* p, std::size_t) { return type{*p, 0.0}; }
  static void store_part(double* p, std::size_t, type v) { *p = v[0]; }
  static type all(double v) { return type{v, v}; }
  static type fma(type a, type b, type c) { return c + a * b; }
  static type fnma(type a, type b, type c) { return c - a * b; }
  static type max(type a, type b) { return a > b ? a : b; }
  static type min(type a, type b) { return a < b ? a : b; }
  static type sqrt(type v) { return type{__builtin_sqrt(v[0]), __builtin_sqrt(v[1])}; }
  static type abs(type v) { return with_bits(bits_of(v) & 0x7FFFFFFFFFFFFFFF); }
  static double sum(type v) { return v[0] + v[1]; }
  static double largest(type v) { return v[0] > v[1] ? v[0] : v[1]; }
  static type without_first(type v, std::size_t n) { return n == 0 ? v : type{0.0, v[1]}; }
  /// The first n < size lanes of v, then those of `other`.
  static type first_of(std::size_t n, type v, type other) {
    return n == 0 ? other : type{v[0], other[1]};
  }
  static void store_four(double* p, double a, double b, double c, double d) {
    store(p, type{a, b});
    store(p + 2, type{c, d});
  }
  static ints exponents(type v) { return (bits_of(v) >> 52) & 0xFFF; }
  static ints plus(ints a, ints b) { return a + b; }
  static type mantissas(type v) {
    return with_bits((bits_of(v) & 0xFFFFFFFFFFFFF) | bits_of(all(1.0)));
  }

 private:
  static ints bits_of(type v) {
    ints bits;
    std::memcpy(&bits, &v, sizeof v);
    return bits;
  }
  static type with_bits(ints bits) {
    type v;
    std::memcpy(&v, &bits, sizeof v);
    return v;
  }
};

#endif

/// How a vector is read and written: whole, or its first lanes only. only() leaves 0, only_or() a
/// given number in the lanes that are none.
template <class V>
struct Whole {
  using T = typename V::type;
  T operator()(const double* p) const { return V::load(p); }
  void operator()(double* p, T v) const { V::store(p, v); }
  T only(T v) const { return v; }
  T only_or(T v, double) const { return v; }
};
template <class V>
struct FirstLanes {
  using T = typename V::type;
  std::size_t n;
  T operator()(const double* p) const { return V::load_part(p, n); }
  void operator()(double* p, T v) const { V::store_part(p, n, v); }
  T only(T v) const { return only_or(v, 0.0); }
  T only_or(T v, double other) const { return V::first_of(n, v, V::all(other)); }
};

/// Calls f(offset, load, store) for each vector of n numbers; the last one in part.
template <class V, class F>
inline void for_vectors(std::size_t n, F f) {
  std::size_t i = 0;
  for (; i + V::size <= n; i += V::size) f(i, Whole<V>{}, Whole<V>{});
  if (i < n) f(i, FirstLanes<V>{n - i}, FirstLanes<V>{n - i});
}

}  // namespace
}  // namespace slalom::simd
