#include "slalom/base/kernels.hpp"

#ifdef __x86_64__
#include <cpuid.h>
#endif

#include <algorithm>
#include <atomic>

#include "slalom/base/error.hpp"

namespace slalom {
namespace {
std::atomic<KernelSet>& selected() {
  static std::atomic<KernelSet> set{best_kernels()};
  return set;
}

#ifdef __x86_64__
/// What the processor has and the system saves (Intel's manual, volume 1, sections 14.3 and 15.2).
/// The compiler's __builtin_cpu_supports is no help: with some libraries (zig's) nothing is ever
/// supported.
class Processor {
 public:
  Processor() {
    unsigned a = 0, b = 0, c = 0, d = 0, high = 0;
    if (__get_cpuid(1, &a, &b, &c, &d) == 0 || (c & bit_OSXSAVE) == 0) return;
    fma_ = (c & (bit_AVX | bit_FMA)) == (bit_AVX | bit_FMA);
    __asm__("xgetbv" : "=a"(saved_), "=d"(high) : "c"(0));
    if (__get_cpuid_count(7, 0, &a, &b, &c, &d) != 0) extended_ = b;
  }
  bool avx2() const { return saves(kVectors) && fma_ && (extended_ & bit_AVX2) != 0; }
  bool avx512() const {
    constexpr unsigned kWanted = bit_AVX512F | bit_AVX512DQ | bit_AVX512VL;
    return avx2() && saves(kVectors | kMasked) && (extended_ & kWanted) == kWanted;
  }

 private:
  static constexpr unsigned kVectors = 2 | 4;              ///< SSE's and AVX's registers
  static constexpr unsigned kMasked = 0x20 | 0x40 | 0x80;  ///< AVX-512's masks and vectors
  bool saves(unsigned registers) const { return (saved_ & registers) == registers; }

  bool fma_ = false;
  unsigned saved_ = 0, extended_ = 0;
};
#else
struct Processor {
  bool avx2() const { return false; }
  bool avx512() const { return false; }
};
#endif
}  // namespace

bool has_kernels(KernelSet set) {
  static const Processor processor;
  switch (set) {
    case KernelSet::avx512:
      return processor.avx512();
    case KernelSet::avx2:
      return processor.avx2();
    case KernelSet::baseline:
      break;
  }
  return true;
}

KernelSet best_kernels() {
  return has_kernels(KernelSet::avx2) ? KernelSet::avx2 : KernelSet::baseline;
}

KernelSet current_kernels() {
  return selected().load(std::memory_order_relaxed);
}

void select_kernels(KernelSet set) {
  if (!has_kernels(set))
    throw Error(std::string("kernel set ") + to_string(set) +
                ": this processor has no such instructions; use " + to_string(best_kernels()));
  selected().store(set, std::memory_order_relaxed);
}

const char* to_string(KernelSet set) {
  switch (set) {
    case KernelSet::avx512:
      return "avx512";
    case KernelSet::avx2:
      return "avx2";
    case KernelSet::baseline:
      break;
  }
  return "baseline";
}

KernelSet kernel_set(const std::string& name) {
  const auto set = std::find_if(kKernelSets.begin(), kKernelSets.end(),
                                [&](KernelSet known) { return name == to_string(known); });
  if (set == kKernelSets.end())
    throw InvalidValue("kernels", "instruction set '" + name + "'", "baseline, avx2 or avx512");
  return *set;
}

}  // namespace slalom
