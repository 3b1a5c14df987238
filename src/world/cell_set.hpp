#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace slalom::world {

/// A set of keys above zero, in a table of open addressing that keeps its memory when cleared.
class CellSet {
 public:
  CellSet() { clear(); }

  std::size_t size() const { return keys_.size(); }
  void clear() {
    keys_.clear();
    resize(kLeast);
  }

  /// Whether the key is new.
  bool insert(std::uint64_t key) {
    if (!put(key)) return false;
    keys_.push_back(key);
    if (2 * keys_.size() > size_) {
      resize(4 * size_);
      for (const auto k : keys_) put(k);
    }
    return true;
  }

 private:
  static constexpr std::size_t kLeast = std::size_t{1} << 12;

  /// The table to `size` free slots, a power of two.
  void resize(std::size_t size) {
    size_ = size;
    if (slots_.size() < size) slots_.resize(size);
    std::fill_n(slots_.begin(), static_cast<std::ptrdiff_t>(size), 0);
  }

  bool put(std::uint64_t key) {
    // Fibonacci hashing (D. E. Knuth, The Art of Computer Programming 3, section 6.4).
    std::size_t at = (key * 0x9E3779B97F4A7C15U) >> 20;
    for (at &= size_ - 1; slots_[at] != 0; at = (at + 1) & (size_ - 1))
      if (slots_[at] == key) return false;
    slots_[at] = key;
    return true;
  }

  std::vector<std::uint64_t> keys_;   ///< in their order
  std::vector<std::uint64_t> slots_;  ///< the first size_ are in use; 0: free
  std::size_t size_ = 0;
};

}  // namespace slalom::world
