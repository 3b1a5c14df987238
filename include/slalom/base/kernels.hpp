#pragma once

#include <string>

namespace slalom {

/// Instruction sets an evaluation can run on. One set gives the same bits on every run and on any
/// number of threads; two sets may differ in the last place.
enum class KernelSet { baseline, avx2 };

/// The best set this processor has.
KernelSet best_kernels();
/// The set in use: the best one unless select_kernels chose another.
KernelSet current_kernels();
/// Throws Error when this processor lacks `set`. Not to be called while another thread evaluates.
void select_kernels(KernelSet set);
/// "baseline" or "avx2".
const char* to_string(KernelSet set);
/// The set of that name; throws InvalidValue for another name.
KernelSet kernel_set(const std::string& name);

}  // namespace slalom
