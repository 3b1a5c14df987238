#include "slalom/base/kernels.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <thread>

#include "slalom/base/error.hpp"

namespace slalom {
namespace {

class KernelSetTest : public testing::Test {
 protected:
  void TearDown() override { select_kernels(best_kernels()); }
};

TEST_F(KernelSetTest, BestIsInUseUntilAnotherIsSelected) {
  EXPECT_EQ(current_kernels(), best_kernels());
  select_kernels(KernelSet::baseline);
  EXPECT_EQ(current_kernels(), KernelSet::baseline);
  select_kernels(best_kernels());
  EXPECT_EQ(current_kernels(), best_kernels());
}

TEST_F(KernelSetTest, SelectionHoldsForOtherThreads) {
  select_kernels(KernelSet::baseline);
  auto seen = best_kernels();
  std::thread([&] { seen = current_kernels(); }).join();
  EXPECT_EQ(seen, KernelSet::baseline);
}

TEST_F(KernelSetTest, ASetTheProcessorLacksIsRefusedAndTheOldOneKept) {
  if (has_kernels(kKernelSets.back())) GTEST_SKIP() << "this processor has all sets";
  const KernelSet before = current_kernels();
  EXPECT_THROW(select_kernels(kKernelSets.back()), Error);
  EXPECT_EQ(current_kernels(), before);
}

TEST_F(KernelSetTest, SetsAreThoseThatTheSystemSaysTheProcessorHas) {
  std::ifstream file("/proc/cpuinfo");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto has = [&](const char* flag) {
    return text.find(std::string(" ") + flag + " ") != std::string::npos;
  };
  EXPECT_TRUE(has_kernels(KernelSet::baseline));
  EXPECT_EQ(has_kernels(KernelSet::avx2), has("avx2") && has("fma"));
  EXPECT_EQ(has_kernels(KernelSet::avx512),
            has_kernels(KernelSet::avx2) && has("avx512f") && has("avx512dq") && has("avx512vl"));
}

TEST_F(KernelSetTest, EachSetHasItsName) {
  EXPECT_STREQ(to_string(KernelSet::baseline), "baseline");
  EXPECT_STREQ(to_string(KernelSet::avx2), "avx2");
  EXPECT_STREQ(to_string(KernelSet::avx512), "avx512");
  for (const auto set : kKernelSets) EXPECT_EQ(kernel_set(to_string(set)), set);
  EXPECT_THROW((void)kernel_set("best"), InvalidValue);
}

}  // namespace
}  // namespace slalom
