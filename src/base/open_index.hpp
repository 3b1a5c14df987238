#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace slalom {

/// Finds things that are numbered 0, 1, 2, ... by keys, and leaves it to their owner to keep them.
/// By open addressing: nothing is allocated for each of them.
class OpenIndex {
 public:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  /// Among the things of that key, or of some others, the one for which is(number) holds.
  template <class Is>
  std::size_t find(std::uint64_t key, const Is& is) const {
    for (std::size_t at = first(key); slots_[at] != 0; at = next(at))
      if (is(std::size_t{slots_[at]} - 1)) return slots_[at] - 1;
    return kNone;
  }
  /// Adds the next number. key_of(number): the keys of it and of those that are there.
  template <class KeyOf>
  void add(const KeyOf& key_of) {
    if (2 * (size_ + 1) > slots_.size()) {
      slots_.assign(2 * slots_.size(), 0);
      for (std::size_t number = 0; number < size_; ++number) put(key_of(number), number);
    }
    put(key_of(size_), size_);
    ++size_;
  }

 private:
  std::size_t first(std::uint64_t key) const {
    return (key * 0x9E3779B97F4A7C15ull >> 32) & (slots_.size() - 1);
  }
  std::size_t next(std::size_t at) const { return (at + 1) & (slots_.size() - 1); }
  void put(std::uint64_t key, std::size_t number) {
    std::size_t at = first(key);
    while (slots_[at] != 0) at = next(at);
    slots_[at] = static_cast<std::uint32_t>(number + 1);
  }

  std::vector<std::uint32_t> slots_ = std::vector<std::uint32_t>(64, 0);  ///< number + 1, 0: none
  std::size_t size_ = 0;
};

}  // namespace slalom
