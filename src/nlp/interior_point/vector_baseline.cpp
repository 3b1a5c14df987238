#include "vector_loops.hpp"

namespace slalom::nlp::ipm {

const VectorKernels kVectorBaseline = kVecKernels;

}  // namespace slalom::nlp::ipm
