#pragma once

// The loops of lane_runs.hpp over vectors V; included once for each instruction set.

#include "../base/simd.hpp"
#include "lane_runs.hpp"

namespace slalom::ocp {
namespace {

template <class V>
class LaneLoops {
 public:
  static void scatter(const LaneRuns::Run* runs, std::size_t count, const double* coefficients,
                      const double* from, double* to) {
    for (std::size_t k = 0; k < count; ++k) {
      const auto& r = runs[k];
      const double* c = coefficients + r.first;
      if (r.sets && r.source_step == 1 && r.target_step == 1)
        set(r, c, from + r.source, to + r.target);
      else
        add(r, c, from + r.source, r.source_step, to + r.target, r.target_step, r.sets);
    }
  }
  static void gather(const LaneRuns::Run* runs, std::size_t count, const double* coefficients,
                     const double* from, double* to) {
    for (std::size_t k = 0; k < count; ++k) {
      const auto& r = runs[k];
      add(r, coefficients + r.first, from + r.target, r.target_step, to + r.source, r.source_step,
          false);
    }
  }
  static bool all_finite(const double* numbers, std::size_t count) {
    const T zero{};
    T sum{}, sum1{};  // 0 * finite is 0; 0 * inf and 0 * NaN are NaN
    std::size_t i = 0;
    for (; i + 2 * V::size <= count; i += 2 * V::size) {
      sum = V::fma(zero, V::load(numbers + i), sum);
      sum1 = V::fma(zero, V::load(numbers + i + V::size), sum1);
    }
    double rest = 0;
    for (; i < count; ++i) rest += 0 * numbers[i];
    return V::sum(sum) + V::sum(sum1) + rest == 0;
  }

 private:
  using T = typename V::type;

  static void set(const LaneRuns::Run& run, const double* c, const double* from, double* to) {
    if (run.ones)
      simd::for_vectors<V>(
          run.count, [&](std::size_t i, auto load, auto store) { store(to + i, load(from + i)); });
    else
      simd::for_vectors<V>(run.count, [&](std::size_t i, auto load, auto store) {
        store(to + i, load(c + i) * load(from + i));
      });
  }

  static void add(const LaneRuns::Run& run, const double* c, const double* from,
                  std::int32_t from_step, double* to, std::int32_t to_step, bool clear) {
    const std::size_t n = run.count;
    for (std::size_t i = 0; clear && i < n; ++i) to[static_cast<std::ptrdiff_t>(i) * to_step] = 0;
    if (to_step == 1 && from_step == 1) {
      if (run.ones)
        simd::for_vectors<V>(n, [&](std::size_t i, auto load, auto store) {
          store(to + i, load(to + i) + load(from + i));
        });
      else
        simd::for_vectors<V>(n, [&](std::size_t i, auto load, auto store) {
          store(to + i, V::fma(load(c + i), load(from + i), load(to + i)));
        });
    } else if (to_step == 1 && from_step == 0) {
      const T value = V::all(*from);
      simd::for_vectors<V>(n, [&](std::size_t i, auto load, auto store) {
        store(to + i, V::fma(load(c + i), value, load(to + i)));
      });
    } else if (to_step == 0 && from_step == 1) {
      T sum{};
      if (run.ones)
        simd::for_vectors<V>(n,
                             [&](std::size_t i, auto load, auto) { sum = sum + load(from + i); });
      else
        simd::for_vectors<V>(n, [&](std::size_t i, auto load, auto) {
          sum = V::fma(load(c + i), load(from + i), sum);
        });
      *to += V::sum(sum);
    } else {
      for (std::size_t i = 0; i < n; ++i)
        to[static_cast<std::ptrdiff_t>(i) * to_step] +=
            c[i] * from[static_cast<std::ptrdiff_t>(i) * from_step];
    }
  }
};

using VecLaneLoops = LaneLoops<simd::Vec>;

}  // namespace
}  // namespace slalom::ocp
