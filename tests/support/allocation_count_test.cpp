// The guard of the solves' allocations is tripped by every way to allocate, and by nothing else.

#include "support/allocation_count.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <new>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace slalom {
namespace {

class AllocationCountTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!AllocationCount::available()) GTEST_SKIP() << "sanitizers have their own malloc";
  }
};

/// Keeps the compiler from leaving out an allocation that nobody reads.
void* volatile kept;
void release(void* p) {
  kept = p;
  std::free(p);
}

TEST_F(AllocationCountTest, SeesEveryWayToAllocate) {
  const std::vector<std::pair<const char*, std::function<void()>>> ways = {
      {"malloc", [] { release(std::malloc(8)); }},
      {"calloc", [] { release(std::calloc(2, 8)); }},
      {"realloc", [] { release(std::realloc(nullptr, 8)); }},
      {"aligned_alloc", [] { release(std::aligned_alloc(64, 64)); }},
      {"posix_memalign",
       [] {
         void* p = nullptr;
         if (posix_memalign(&p, 64, 8) == 0) release(p);
       }},
      {"new",
       [] {
         auto* p = new int(1);
         kept = p;
         delete p;
       }},
      {"new, aligned",
       [] {
         kept = ::operator new (64, std::align_val_t{64});
         ::operator delete (kept, std::align_val_t{64});
       }},
      {"vector", [] { kept = std::vector<double>(9).data(); }},
      {"string", [] { kept = std::string(40, 'x').data(); }},
  };
  for (const auto& [name, allocate] : ways) {
    AllocationCount count;
    EXPECT_EQ(count.allocations(), 0u) << name;
    allocate();
    EXPECT_EQ(count.allocations(), 1u) << name;
  }
}

TEST_F(AllocationCountTest, SaysWhereTheFirstOneWas) {
  AllocationCount count;
  release(std::malloc(8));
  const std::string where = count.first();
  EXPECT_NE(where.find("+0x"), std::string::npos) << where;
  release(std::malloc(8));
  EXPECT_EQ(count.allocations(), 1u);  // counting is over
}

TEST_F(AllocationCountTest, SeesNeitherFreeNorWhatWasBefore) {
  void* before = std::malloc(8);
  AllocationCount count;
  std::free(before);
  EXPECT_EQ(count.allocations(), 0u);
  EXPECT_EQ(count.first(), "");
}

TEST_F(AllocationCountTest, SeesItsOwnThreadAlone) {
  AllocationCount count;
  std::thread other([] { release(std::malloc(8)); });
  const std::size_t own = count.allocations();  // the thread object is made by this one
  other.join();
  EXPECT_EQ(count.allocations(), own);
}

}  // namespace
}  // namespace slalom
