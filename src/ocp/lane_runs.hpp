#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace slalom::ocp {

/// target += coefficient * source, for numbers of a batch that land in the NLP's arrays.
struct Scatter {
  std::uint32_t source, target;
  double coefficient;
};

/// Many Scatters as runs over lanes, in which source and target step along evenly.
class LaneRuns {
 public:
  LaneRuns() = default;
  /// `written`: by target, whether earlier scatters of the same pass write there; a run that is the
  /// first on all its targets sets them instead of adding. Without it all add.
  explicit LaneRuns(const std::vector<Scatter>& list, std::vector<char>* written = nullptr);

  /// to[target] += coefficient * from[source], or = where the run is the first
  void scatter(std::span<const double> from, std::span<double> to) const;
  /// to[source] += coefficient * from[target]
  void gather(std::span<const double> from, std::span<double> to) const;
  /// to[source] += coefficient * number
  void add_to_sources(double number, std::span<double> to) const;

  struct Run {
    std::uint32_t source, target, count;
    std::int32_t source_step, target_step;
    std::uint32_t first;  ///< of its coefficients, one for each lane
    bool ones;            ///< all coefficients are 1
    bool sets;            ///< scatter sets its targets
  };
  std::size_t runs() const { return runs_.size(); }
  /// Calls f(source, target, coefficient) for each scatter.
  template <class F>
  void for_each(F f) const {
    for (const auto& run : runs_)
      for (std::int64_t i = 0; i < run.count; ++i)
        f(static_cast<std::size_t>(run.source + i * run.source_step),
          static_cast<std::size_t>(run.target + i * run.target_step),
          run.ones ? 1.0 : coefficients_[run.first + static_cast<std::size_t>(i)]);
  }

 private:
  std::vector<Run> runs_;
  std::vector<double> coefficients_;
};

/// The loops, compiled for each instruction set: to[i step] += coefficients[i] * from[i step].
struct LaneKernels {
  void (*scatter)(const LaneRuns::Run* runs, std::size_t count, const double* coefficients,
                  const double* from, double* to);
  void (*gather)(const LaneRuns::Run* runs, std::size_t count, const double* coefficients,
                 const double* from, double* to);
  bool (*all_finite)(const double* numbers, std::size_t count);
};
extern const LaneKernels kLaneBaseline;
extern const LaneKernels kLaneAvx2;
extern const LaneKernels kLaneAvx512;
const LaneKernels& lane_kernels();  ///< of the kernel set in use

}  // namespace slalom::ocp
