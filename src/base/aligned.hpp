#pragma once

#include <cstddef>
#include <memory>
#include <new>

namespace slalom {

struct FreeAligned {
  void operator()(double* p) const { operator delete[](p, std::align_val_t{64}); }
};
/// Doubles that start on a cache line.
using AlignedDoubles = std::unique_ptr<double[], FreeAligned>;

inline AlignedDoubles aligned_doubles(std::size_t count) {
  return AlignedDoubles(new (std::align_val_t{64}) double[count]);
}

}  // namespace slalom
