#include "slalom/base/kernels.hpp"

#ifdef __x86_64__
#include <cpuid.h>
#endif

#include <atomic>

#include "slalom/base/error.hpp"

namespace slalom {
namespace {
std::atomic<KernelSet>& selected() {
  static std::atomic<KernelSet> set{best_kernels()};
  return set;
}

/// Whether the processor has both, and the system saves their registers (Intel's manual, volume 1,
/// section 14.3). The compiler's __builtin_cpu_supports is no help: with some libraries (zig's)
/// nothing is ever supported.
bool has_avx2_with_fma() {
#ifdef __x86_64__
  unsigned a = 0, b = 0, c = 0, d = 0;
  constexpr unsigned kWanted = bit_OSXSAVE | bit_AVX | bit_FMA;
  if (__get_cpuid(1, &a, &b, &c, &d) == 0 || (c & kWanted) != kWanted) return false;
  unsigned saved = 0, high = 0;
  __asm__("xgetbv" : "=a"(saved), "=d"(high) : "c"(0));
  constexpr unsigned kVectors = 2 | 4;  // SSE's and AVX's registers
  if ((saved & kVectors) != kVectors) return false;
  return __get_cpuid_count(7, 0, &a, &b, &c, &d) != 0 && (b & bit_AVX2) != 0;
#else
  return false;
#endif
}
}  // namespace

KernelSet best_kernels() {
  return has_avx2_with_fma() ? KernelSet::avx2 : KernelSet::baseline;
}

KernelSet current_kernels() {
  return selected().load(std::memory_order_relaxed);
}

void select_kernels(KernelSet set) {
  if (set == KernelSet::avx2 && best_kernels() != KernelSet::avx2)
    throw Error("kernel set avx2: this processor has no AVX2 with FMA; use baseline");
  selected().store(set, std::memory_order_relaxed);
}

const char* to_string(KernelSet set) {
  return set == KernelSet::avx2 ? "avx2" : "baseline";
}

KernelSet kernel_set(const std::string& name) {
  for (const auto set : {KernelSet::baseline, KernelSet::avx2})
    if (name == to_string(set)) return set;
  throw InvalidValue("kernels", "instruction set '" + name + "'", "baseline or avx2");
}

}  // namespace slalom
