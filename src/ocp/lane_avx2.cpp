#include "lane_loops.hpp"

namespace slalom::ocp {

const LaneKernels kLaneAvx2 = {VecLaneLoops::scatter, VecLaneLoops::gather,
                               VecLaneLoops::all_finite};

}  // namespace slalom::ocp
