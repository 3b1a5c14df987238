#pragma once

#include <cstddef>
#include <vector>

#include "slalom/sim/drive.hpp"

namespace slalom::report {

/// Which of `count` entries are kept of at most `most`: evenly, the first and last among them.
std::vector<std::size_t> kept_evenly(std::size_t count, std::size_t most);

/// Which samples are kept of at most `most`, in order: all if they are no more; else the first and
/// last, each signal's least and greatest, those nearest to the times `marked`, in each of even
/// stretches of time the first and the least wheel load and clearance, and then, one after the
/// other, the one that is farthest beside a straight line between those kept.
std::vector<std::size_t> kept_samples(const std::vector<sim::PlantSample>& plant,
                                      const std::vector<double>& marked, std::size_t most);

/// All cycles, those first that a page is to have rather than others: the first, the last and the
/// worst; then in turns two of those that failed or at whose times `marked` something is marked,
/// one of those in which something changes, and one of the others. Any beginning of each is even in
/// time.
std::vector<std::size_t> by_weight(const std::vector<sim::Cycle>& cycles,
                                   const std::vector<double>& marked);

}  // namespace slalom::report
