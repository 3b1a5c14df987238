#include "vector_kernels.hpp"
#include "../../base/kernel_choice.hpp"

namespace slalom::nlp::ipm {

const VectorKernels& vector_kernels() {
  return in_use(kVectorBaseline, kVectorAvx2, kVectorAvx512);
}

}  // namespace slalom::nlp::ipm
