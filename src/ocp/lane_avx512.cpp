#include "lane_loops.hpp"

namespace slalom::ocp {

const LaneKernels kLaneAvx512 = {VecLaneLoops::scatter, VecLaneLoops::gather,
                                 VecLaneLoops::all_finite};

}  // namespace slalom::ocp
