#pragma once

#include <array>
#include <string>

namespace slalom {

/// Instruction sets an evaluation can run on: what every processor has, AVX2 with FMA, AVX-512 (F,
/// DQ, VL). One set gives the same bits on every run and on any number of threads; two sets may
/// differ in the last place.
enum class KernelSet { baseline, avx2, avx512 };
/// All of them, the plainest first.
inline constexpr std::array kKernelSets = {KernelSet::baseline, KernelSet::avx2, KernelSet::avx512};

/// Whether this processor has the set, and the system saves its registers.
bool has_kernels(KernelSet set);
/// The set to prefer on this processor: AVX2 where there is one. AVX-512 is for those who ask for
/// it: it makes a planning cycle 5 to 8 % faster, and gives other last places than most machines
/// do.
KernelSet best_kernels();
/// The set in use: the best one unless select_kernels chose another.
KernelSet current_kernels();
/// Throws Error when this processor lacks `set`. Not to be called while another thread evaluates.
void select_kernels(KernelSet set);
/// "baseline", "avx2" or "avx512".
const char* to_string(KernelSet set);
/// The set of that name; throws InvalidValue for another name.
KernelSet kernel_set(const std::string& name);

}  // namespace slalom
