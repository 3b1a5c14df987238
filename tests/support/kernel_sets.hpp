#pragma once

#include <gtest/gtest.h>

#include <string>

#include "slalom/base/kernels.hpp"

namespace slalom {

/// Runs each test on every instruction set that this processor has:
///   INSTANTIATE_TEST_SUITE_P(Sets, Suite, each_kernel_set(), name_of_set);
class OnKernelSet : public testing::TestWithParam<KernelSet> {
 protected:
  void SetUp() override {
    if (!has_kernels(GetParam())) GTEST_SKIP() << "this processor has no " << to_string(GetParam());
    select_kernels(GetParam());
  }
  void TearDown() override { select_kernels(best_kernels()); }
};

inline auto each_kernel_set() {
  return testing::ValuesIn(kKernelSets);
}
inline std::string name_of_set(const testing::TestParamInfo<KernelSet>& set) {
  return to_string(set.param);
}

}  // namespace slalom
