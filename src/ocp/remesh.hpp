#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "slalom/ocp/errors.hpp"
#include "slalom/ocp/phases.hpp"
#include "slalom/ocp/refine.hpp"

namespace slalom::ocp {

/// Times the tolerance: what all errors together may make of the objective, relative to it.
constexpr double kObjectiveTolerance = 10;

/// What one phase's meshes so far tell of its intervals.
class History {
 public:
  /// Whether something in an interval steps or bends, which no polynomial follows: more points took
  /// little off its error, or did so in an interval around it (Liu, Hager & Rao, J. Franklin Inst.
  /// 352(10), 2015).
  bool bends(double begin, double end, int points, double error);
  /// To be called when the next mesh is known.
  void note(const Solution& solution, const ErrorEstimate& errors);

 private:
  struct Interval {
    int points = 0;
    double error = 0;
  };
  std::map<std::pair<double, double>, Interval> last_;
  std::vector<std::pair<double, double>> bent_;
};

/// What all phases' intervals make of the objective.
class Shares {
 public:
  /// `costs_beside`: the size of cost terms that are no phase's.
  Shares(const std::vector<ErrorEstimate>& phases, double costs_beside, const RefineRules& rules);

  double size() const { return size_; }
  /// Relative to that.
  double sum() const { return (sum_ + bounds_) / size_; }
  bool too_large() const { return largest_excess_ > 1; }
  /// An interval's share over what it may be; 0 where the sum is small enough, or the interval's
  /// errors are but the solver's.
  double excess(const ErrorEstimate& errors, std::size_t k) const;
  /// The same of what bounds that are violated between the points make of it.
  double bound_excess(const ErrorEstimate& errors, std::size_t k) const;

 private:
  double tolerance_, size_, bounds_ = 0, touched_ = 0, sum_ = 0, intervals_ = 0,
                            largest_excess_ = 0;
};

/// The mesh after a solution's, by its errors and how much of its control is not resolved.
PhasedTranscription::Grid next_grid(const Solution& solution, const ErrorEstimate& errors,
                                    const Shares& shares, const std::vector<double>& unresolved,
                                    History& history, const RefineRules& rules);

/// Cuts in two where it is 1.
PhasedTranscription::Grid halved(const PhasedTranscription::Grid& grid,
                                 const std::vector<char>& where);

std::size_t points(const PhasedTranscription::Grid& grid);

}  // namespace slalom::ocp
