#include "block_loops.hpp"

namespace slalom::kkt {

const BlockKernels kBlockAvx512 = kVecKernels;

}  // namespace slalom::kkt
