#include "vector_kernels.hpp"

#include "slalom/base/kernels.hpp"

namespace slalom::nlp::ipm {

const VectorKernels& vector_kernels() {
  return current_kernels() == KernelSet::avx2 ? kVectorAvx2 : kVectorBaseline;
}

}  // namespace slalom::nlp::ipm
