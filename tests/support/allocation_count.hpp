#pragma once

#include <cstddef>
#include <string>

namespace slalom {

/// Counts what this thread allocates while it lives: by malloc itself, and so by operator new,
/// std::vector and any library. Works in every build but those with sanitizers, which have their
/// own malloc. One at a time in a thread.
class AllocationCount {
 public:
  static bool available();

  AllocationCount();
  ~AllocationCount();
  AllocationCount(const AllocationCount&) = delete;
  AllocationCount& operator=(const AllocationCount&) = delete;

  std::size_t allocations() const;
  /// Calls that led to the first allocation, innermost first; "" for none. Counting is over then.
  std::string first();
};

}  // namespace slalom
