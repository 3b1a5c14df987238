#include "vector_loops.hpp"

namespace slalom::nlp::ipm {

const VectorKernels kVectorAvx2 = kVecKernels;

}  // namespace slalom::nlp::ipm
