#pragma once

#include "slalom/base/kernels.hpp"

namespace slalom {

/// Of things compiled for each instruction set, the one for the set in use.
template <class T>
const T& in_use(const T& baseline, const T& avx2, const T& avx512) {
  switch (current_kernels()) {
    case KernelSet::avx512:
      return avx512;
    case KernelSet::avx2:
      return avx2;
    case KernelSet::baseline:
      break;
  }
  return baseline;
}

}  // namespace slalom
