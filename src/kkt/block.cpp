#include "block.hpp"

#include "slalom/base/kernels.hpp"

namespace slalom::kkt {

const BlockKernels& block_kernels() {
  return current_kernels() == KernelSet::avx2 ? kBlockAvx2 : kBlockBaseline;
}

}  // namespace slalom::kkt
