#include "block_loops.hpp"

namespace slalom::kkt {

const BlockKernels kBlockAvx2 = {VecLoops::factor, VecLoops::forward, VecLoops::backward};

}  // namespace slalom::kkt
