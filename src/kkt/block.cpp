#include "block.hpp"
#include "../base/kernel_choice.hpp"

namespace slalom::kkt {

const BlockKernels& block_kernels() {
  return in_use(kBlockBaseline, kBlockAvx2, kBlockAvx512);
}

}  // namespace slalom::kkt
