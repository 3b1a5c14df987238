#include "../../src/base/open_index.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace slalom {
namespace {

TEST(OpenIndex, FindsWhatWasAddedAndNothingElse) {
  std::vector<std::uint64_t> keys;
  std::unordered_map<std::uint64_t, std::size_t> number;
  OpenIndex index;
  const auto find = [&](std::uint64_t key) {
    return index.find(key, [&](std::size_t k) { return keys[k] == key; });
  };
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const std::uint64_t key = i % 3 == 0 ? i : i << 40;  // that differ in few bits
    ASSERT_EQ(find(key), OpenIndex::kNone);
    number[key] = keys.size();
    keys.push_back(key);
    index.add([&](std::size_t k) { return keys[k]; });
  }
  for (const auto& [key, expected] : number) ASSERT_EQ(find(key), expected);
  for (std::uint64_t i = 1; i < 3000; i += 3) EXPECT_EQ(find(i), OpenIndex::kNone);
}

TEST(OpenIndex, OfOneKeyItFindsTheFirstThatIsMeant) {
  OpenIndex index;
  for (int i = 0; i < 200; ++i) index.add([](std::size_t) { return 7; });
  EXPECT_EQ(index.find(7, [](std::size_t) { return true; }), 0u);
  EXPECT_EQ(index.find(7, [](std::size_t k) { return k > 150; }), 151u);
  EXPECT_EQ(index.find(7, [](std::size_t k) { return k > 199; }), OpenIndex::kNone);
}

}  // namespace
}  // namespace slalom
