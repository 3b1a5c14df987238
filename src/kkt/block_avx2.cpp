#include "block_loops.hpp"

namespace slalom::kkt {

const BlockKernels kBlockAvx2 = kVecKernels;

}  // namespace slalom::kkt
