#include "vector_loops.hpp"

namespace slalom::nlp::ipm {

const VectorKernels kVectorBaseline = {VecVectorLoops::reciprocals,
                                       VecVectorLoops::barrier,
                                       VecVectorLoops::complementarity,
                                       VecVectorLoops::dual_step,
                                       VecVectorLoops::log_slacks,
                                       VecVectorLoops::move_duals,
                                       VecVectorLoops::combine,
                                       VecVectorLoops::multiply_add,
                                       VecVectorLoops::dot,
                                       VecVectorLoops::sum_magnitudes,
                                       VecVectorLoops::largest_magnitude,
                                       VecVectorLoops::most_outside};

}  // namespace slalom::nlp::ipm
