#include "slalom/base/kernels.hpp"

#include <atomic>

#include "slalom/base/error.hpp"

namespace slalom {
namespace {
std::atomic<KernelSet>& selected() {
  static std::atomic<KernelSet> set{best_kernels()};
  return set;
}
}  // namespace

KernelSet best_kernels() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return KernelSet::avx2;
#endif
  return KernelSet::baseline;
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
