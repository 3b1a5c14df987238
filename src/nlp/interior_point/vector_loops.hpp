#pragma once

// The loops of vector_kernels.hpp over vectors V; included once for each instruction set.

#include <cmath>
#include <limits>

#include "../../base/simd.hpp"
#include "vector_kernels.hpp"

namespace slalom::nlp::ipm {
namespace {

template <class V>
class VectorLoops {
 public:
  static void reciprocals(Segments segments, const BoundedVector& v, double* over_lower,
                          double* over_upper) {
    const T one = V::all(1);
    for_segments(segments, [&](auto lower, auto upper, std::size_t i, auto load, auto store) {
      const T w = load(v.w + i);
      if constexpr (lower) store(over_lower + i, one / (w - load(v.lower + i)));
      if constexpr (upper) store(over_upper + i, one / (load(v.upper + i) - w));
    });
  }

  static void barrier(Segments segments, const BoundedVector& v, double mu, double* sigma,
                      double* slope) {
    const T m = V::all(mu);
    for_segments(segments, [&](auto lower, auto upper, std::size_t i, auto load, auto store) {
      T weight{}, gradient{};
      if constexpr (lower) {
        const T over = load(v.over_lower + i);
        weight = load(v.zl + i) * over;
        gradient = V::fnma(m, over, gradient);
      }
      if constexpr (upper) {
        const T over = load(v.over_upper + i);
        weight = V::fma(load(v.zu + i), over, weight);
        gradient = V::fma(m, over, gradient);
      }
      store(sigma + i, weight);
      store(slope + i, gradient);
    });
  }

  static Complementarity complementarity(Segments segments, const BoundedVector& v, double mu) {
    const T m = V::all(mu);
    T gap{}, most{}, sum{}, least = V::all(-std::numeric_limits<double>::infinity());
    for_segments(segments, [&](auto lower, auto upper, std::size_t i, auto load, auto store) {
      const auto add = [&](T product) {
        gap = V::max(gap, store.only(V::abs(product - m)));
        most = V::max(most, store.only(product));
        least = V::max(least, store.only_or(-product, -std::numeric_limits<double>::infinity()));
        sum = sum + store.only(product);
      };
      const T w = load(v.w + i);
      if constexpr (lower) add((w - load(v.lower + i)) * load(v.zl + i));
      if constexpr (upper) add((load(v.upper + i) - w) * load(v.zu + i));
    });
    return {V::largest(gap), -V::largest(least), V::largest(most), V::sum(sum)};
  }

  static StepReach dual_step(Segments segments, const BoundedVector& v, double mu, const double* dw,
                             double* dzl, double* dzu) {
    const T m = V::all(mu);
    Reach reach;
    for_segments(segments, [&](auto lower, auto upper, std::size_t i, auto load, auto store) {
      const auto side = [&](T over, T z, T change, double* dz) {
        const T step = V::fma(m, over, T{} - z) - z * over * change;
        store(dz + i, step);
        reach.add(store, change, over, step, z);
      };
      const T d = load(dw + i);
      if constexpr (lower) side(load(v.over_lower + i), load(v.zl + i), d, dzl);
      if constexpr (upper) side(load(v.over_upper + i), load(v.zu + i), T{} - d, dzu);
    });
    return reach.whole();
  }

  static double products_after(Segments segments, const BoundedVector& v, double alpha_primal,
                               double alpha_dual, const double* dw, const double* dzl,
                               const double* dzu) {
    const T ap = V::all(alpha_primal), ad = V::all(alpha_dual);
    T sum{};
    for_segments(segments, [&](auto lower, auto upper, std::size_t i, auto load, auto store) {
      const T w = V::fma(ap, load(dw + i), load(v.w + i));
      const auto add = [&](T slack, T z, T dz) {
        sum = sum + store.only(slack * V::fma(ad, dz, z));
      };
      if constexpr (lower) add(w - load(v.lower + i), load(v.zl + i), load(dzl + i));
      if constexpr (upper) add(load(v.upper + i) - w, load(v.zu + i), load(dzu + i));
    });
    return V::sum(sum);
  }

  static void second_order(Segments segments, const BoundedVector& v, const double* dw,
                           const double* dzl, const double* dzu, double* cl, double* cu,
                           double* slope) {
    for_segments(segments, [&](auto lower, auto upper, std::size_t i, auto load, auto store) {
      const T d = load(dw + i);
      T added = load(slope + i);
      if constexpr (lower) {
        const T c = d * load(dzl + i) * load(v.over_lower + i);
        store(cl + i, c);
        added = added + c;
      }
      if constexpr (upper) {
        const T c = T{} - d * load(dzu + i) * load(v.over_upper + i);
        store(cu + i, c);
        added = added - c;
      }
      store(slope + i, added);
    });
  }

  static StepReach correct_duals(Segments segments, const BoundedVector& v, const double* dw,
                                 const double* cl, const double* cu, double* dzl, double* dzu) {
    Reach reach;
    for_segments(segments, [&](auto lower, auto upper, std::size_t i, auto load, auto store) {
      const auto side = [&](T over, T z, T change, const double* c, double* dz) {
        const T step = load(dz + i) - load(c + i);
        store(dz + i, step);
        reach.add(store, change, over, step, z);
      };
      const T d = load(dw + i);
      if constexpr (lower) side(load(v.over_lower + i), load(v.zl + i), d, cl, dzl);
      if constexpr (upper) side(load(v.over_upper + i), load(v.zu + i), T{} - d, cu, dzu);
    });
    return reach.whole();
  }

  static double log_slacks(Segments segments, const BoundedVector& v) {
    constexpr std::size_t kMost = 500;  // products of so many mantissas below 2 stay finite
    T product = V::all(1), least = V::all(-std::numeric_limits<double>::infinity());
    typename V::ints exponents{};
    std::size_t factors = 0, counted = 0;
    double sum = 0;
    const auto flush = [&] {
      double lanes[V::size];
      V::store(lanes, product);
      for (double lane : lanes) sum += std::log(lane);
      product = V::all(1);
      factors = 0;
    };
    for_segments(segments, [&](auto lower, auto upper, std::size_t i, auto load, auto store) {
      const auto add = [&](T slack) {
        const T s = store.only_or(slack, 1.0);
        least = V::max(least, T{} - s);
        product = product * V::mantissas(s);
        exponents = V::plus(exponents, V::exponents(s));
        ++counted;
        if (++factors == kMost) flush();
      };
      const T w = load(v.w + i);
      if constexpr (lower) add(w - load(v.lower + i));
      if constexpr (upper) add(load(v.upper + i) - w);
    });
    if (!(-V::largest(least) >= std::numeric_limits<double>::min()) && counted > 0)
      return -std::numeric_limits<double>::infinity();
    flush();
    alignas(32) long long lanes[V::size];
    __builtin_memcpy(lanes, &exponents, sizeof lanes);
    long long total = 0;
    for (long long lane : lanes) total += lane;
    const auto power =
        static_cast<double>(total - 1023 * static_cast<long long>(counted * V::size));
    return sum + power * 0.69314718055994530942;
  }

  static void move_duals(Segments segments, const BoundedVector& v, double mu, double alpha,
                         double kappa, const double* dzl, const double* dzu, double* zl,
                         double* zu) {
    const T a = V::all(alpha), low = V::all(mu / kappa), high = V::all(mu * kappa);
    for_segments(segments, [&](auto lower, auto upper, std::size_t i, auto load, auto store) {
      const auto side = [&](const double* dz, double* z, T over) {
        const T moved = V::fma(a, load(dz + i), load(z + i));
        store(z + i, V::max(low * over, V::min(high * over, moved)));
      };
      if constexpr (lower) side(dzl, zl, load(v.over_lower + i));
      if constexpr (upper) side(dzu, zu, load(v.over_upper + i));
    });
  }

  static void combine(std::size_t n, const double* a, double alpha, const double* b, double* to) {
    const T factor = V::all(alpha);
    simd::for_vectors<V>(n, [&](std::size_t i, auto load, auto store) {
      store(to + i, V::fma(factor, load(b + i), load(a + i)));
    });
  }
  static void multiply_add(std::size_t n, const double* a, const double* b, const double* c,
                           double* to) {
    simd::for_vectors<V>(n, [&](std::size_t i, auto load, auto store) {
      store(to + i, V::fma(load(a + i), load(b + i), load(c + i)));
    });
  }
  static double dot(std::size_t n, const double* a, const double* b) {
    T sum{};
    simd::for_vectors<V>(
        n, [&](std::size_t i, auto load, auto) { sum = V::fma(load(a + i), load(b + i), sum); });
    return V::sum(sum);
  }
  static double sum_magnitudes(std::size_t n, const double* a) {
    T sum{};
    simd::for_vectors<V>(n,
                         [&](std::size_t i, auto load, auto) { sum = sum + V::abs(load(a + i)); });
    return V::sum(sum);
  }
  /// NaN where any number is.
  static double largest_magnitude(std::size_t n, const double* a) {
    T most{}, finite{};
    simd::for_vectors<V>(n, [&](std::size_t i, auto load, auto) {
      const T value = load(a + i);
      most = V::max(most, V::abs(value));
      finite = V::fma(T{}, value, finite);
    });
    return V::largest(most) + V::sum(finite);
  }

  static double most_outside(std::size_t n, const double* a, const double* lower,
                             const double* upper, const double* scale, const double* unit) {
    T most{};
    simd::for_vectors<V>(n, [&](std::size_t i, auto load, auto) {
      const T value = load(a + i), factor = load(scale + i);
      const T outside = V::max(factor * load(lower + i) - value, value - factor * load(upper + i));
      most = V::max(outside * load(unit + i), most);  // NaN, of an absent lane, is let go
    });
    return V::largest(most);
  }

 private:
  using T = typename V::type;

  /// StepReach, lane by lane: `change` of slack 1 / over, `step` of multiplier z.
  struct Reach {
    T primal{}, dual{};
    template <class Store>
    void add(const Store& store, T change, T over, T step, T z) {
      primal = V::max(primal, store.only(T{} - change * over));
      dual = V::max(dual, store.only(T{} - step / z));
    }
    StepReach whole() const { return {V::largest(primal), V::largest(dual)}; }
  };
  struct Yes {
    constexpr operator bool() const { return true; }
  };
  struct No {
    constexpr operator bool() const { return false; }
  };
  /// f(has lower, has upper, index, load, store) for every vector of every segment.
  template <class F>
  static void for_segments(Segments segments, F f) {
    for (std::size_t k = 0; k < segments.count; ++k) {
      const Segment& s = segments.first[k];
      const auto each = [&](auto lower, auto upper) {
        simd::for_vectors<V>(s.end - s.begin, [&](std::size_t i, auto load, auto store) {
          f(lower, upper, s.begin + i, load, store);
        });
      };
      if (s.lower && s.upper)
        each(Yes{}, Yes{});
      else if (s.lower)
        each(Yes{}, No{});
      else
        each(No{}, Yes{});
    }
  }
};

using VecLoops = VectorLoops<simd::Vec>;
constexpr VectorKernels kVecKernels = {
    VecLoops::reciprocals,    VecLoops::barrier,           VecLoops::complementarity,
    VecLoops::dual_step,      VecLoops::products_after,    VecLoops::second_order,
    VecLoops::correct_duals,  VecLoops::log_slacks,        VecLoops::move_duals,
    VecLoops::combine,        VecLoops::multiply_add,      VecLoops::dot,
    VecLoops::sum_magnitudes, VecLoops::largest_magnitude, VecLoops::most_outside};

}  // namespace
}  // namespace slalom::nlp::ipm
