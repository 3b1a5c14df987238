#include "block_loops.hpp"

namespace slalom::kkt {

const BlockKernels kBlockBaseline = kVecKernels;

}  // namespace slalom::kkt
