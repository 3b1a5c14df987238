#include "vector_loops.hpp"

namespace slalom::nlp::ipm {

const VectorKernels kVectorAvx512 = kVecKernels;

}  // namespace slalom::nlp::ipm
