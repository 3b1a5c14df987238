#include "lane_runs.hpp"
#include "../base/kernel_choice.hpp"
#include "set_up_watch.hpp"

namespace slalom::ocp {

const LaneKernels& lane_kernels() {
  return in_use(kLaneBaseline, kLaneAvx2, kLaneAvx512);
}

LaneRuns::LaneRuns(const std::vector<Scatter>& list, std::vector<char>* written) {
  const auto step = [](std::uint32_t from, std::uint32_t to) {
    return static_cast<std::int32_t>(to) - static_cast<std::int32_t>(from);
  };
  const auto is_fresh = [&](std::size_t t) {
    return written != nullptr && !(*written)[list[t].target];
  };
  for (std::size_t t = 0; t < list.size();) {
    SetUpWatch::poll();
    const bool fresh = is_fresh(t);
    Run run{list[t].source, list[t].target, 1, 1, 1, static_cast<std::uint32_t>(t), true, fresh};
    std::size_t next = t + 1;
    if (next < list.size() && is_fresh(next) == fresh) {
      run.source_step = step(list[t].source, list[next].source);
      run.target_step = step(list[t].target, list[next].target);
      while (next < list.size() &&
             step(list[next - 1].source, list[next].source) == run.source_step &&
             step(list[next - 1].target, list[next].target) == run.target_step &&
             is_fresh(next) == fresh)
        ++next;
    }
    run.count = static_cast<std::uint32_t>(next - t);
    for (; t < next; ++t) {
      if (written != nullptr) (*written)[list[t].target] = 1;
      coefficients_.push_back(list[t].coefficient);
      run.ones = run.ones && list[t].coefficient == 1;
    }
    runs_.push_back(run);
  }
}

void LaneRuns::scatter(std::span<const double> from, std::span<double> to) const {
  lane_kernels().scatter(runs_.data(), runs_.size(), coefficients_.data(), from.data(), to.data());
}

void LaneRuns::gather(std::span<const double> from, std::span<double> to) const {
  lane_kernels().gather(runs_.data(), runs_.size(), coefficients_.data(), from.data(), to.data());
}

void LaneRuns::add_to_sources(double number, std::span<double> to) const {
  for (const Run& run : runs_)
    for (std::uint32_t i = 0; i < run.count; ++i)
      to[static_cast<std::size_t>(static_cast<std::int64_t>(run.source) +
                                  static_cast<std::int64_t>(i) * run.source_step)] +=
          coefficients_[run.first + i] * number;
}

}  // namespace slalom::ocp
