#include "block_loops.hpp"

namespace slalom::kkt {

const BlockKernels kBlockBaseline = {VecLoops::factor, VecLoops::forward, VecLoops::backward};

}  // namespace slalom::kkt
