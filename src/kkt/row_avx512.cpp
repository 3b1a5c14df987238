#include "row_loops.hpp"

namespace slalom::kkt {

const RowKernels kRowAvx512 = {VecRowLoops::multiply, VecRowLoops::transposed,
                               VecRowLoops::symmetric, VecRowLoops::condense};

}  // namespace slalom::kkt
