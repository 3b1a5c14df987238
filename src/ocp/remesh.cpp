#include "remesh.hpp"

#include <algorithm>
#include <cmath>

namespace slalom::ocp {
namespace {

/// Most pieces that one refinement cuts an interval into: errors far from the asymptotic regime
/// tell little.
constexpr int kMostPieces = 5;
/// Points that take off less than this factor of an interval's error are in vain.
constexpr double kLeastFall = 4;
/// Times the tolerance: what bounds violated between the points may make of it. A node more beside
/// where a bound is touched takes most of that away.
constexpr double kBoundTolerance = 2;
/// What an interval's errors are at least for their share of that to mean anything.
constexpr double kSolversError = 1e-10;

/// The n of lgr(n) and the like.
int points_of(const Scheme& scheme) {
  return static_cast<int>(scheme.points.size()) - (scheme.name == "lgl" ? 0 : 1);
}

/// What becomes of an interval: equal pieces, each by `scheme`.
struct Fate {
  int pieces = 1;
  Scheme scheme;
};

/// The error of an interval of length h falls as h^(order + 1).
Fate cut(const Scheme& scheme, double excess) {
  const double pieces = std::ceil(std::pow(excess, 1.0 / (scheme.order + 1)));
  return {std::clamp(pieces < kMostPieces ? static_cast<int>(pieces) : kMostPieces, 2, kMostPieces),
          scheme};
}

/// Patterson, Hager & Rao 2015, eq. 36 to 38: the error falls by the number of points for each
/// point more.
Fate raise(const Scheme& scheme, double excess, const RefineRules& rules) {
  const int now = points_of(scheme);
  const double more = std::max(1.0, std::ceil(std::log(excess) / std::log(std::max(now, 2))));
  if (now + more <= rules.max_points)
    return {1, ocp::scheme(scheme.name, now + static_cast<int>(more))};
  const double pieces = std::ceil(std::min(now + more, 1e3) / rules.min_points);
  return {std::clamp(static_cast<int>(pieces), 2, kMostPieces),
          ocp::scheme(scheme.name, rules.min_points)};
}

/// A control's error falls as h^2 (unresolved_controls).
Fate cut_for_control(const Scheme& scheme, double excess) {
  const double pieces = std::ceil(std::sqrt(excess));
  return {std::clamp(pieces < kMostPieces ? static_cast<int>(pieces) : kMostPieces, 2, kMostPieces),
          scheme};
}

}  // namespace

bool History::bends(double begin, double end, int points, double error) {
  for (const auto& [from, to] : bent_)
    if (from <= begin && end <= to) return true;
  const auto at = last_.find({begin, end});
  if (at == last_.end() || at->second.points >= points || error <= at->second.error / kLeastFall)
    return false;
  bent_.emplace_back(begin, end);
  return true;
}
void History::note(const Solution& solution, const ErrorEstimate& errors) {
  last_.clear();
  const auto& breaks = solution.mesh.breakpoints();
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k)
    last_[{breaks[k], breaks[k + 1]}] = {points_of(solution.scheme.of(k)), errors.interval[k]};
}

Shares::Shares(const std::vector<ErrorEstimate>& phases, double costs_beside,
               const RefineRules& rules)
    : tolerance_(rules.tolerance), size_(costs_beside) {
  for (const auto& errors : phases) {
    size_ += errors.objective_size;
    for (const double share : errors.objective_share) sum_ += std::fabs(share);
    intervals_ += static_cast<double>(errors.objective_share.size());
    for (const double share : errors.bound_share) {
      if (!rules.resolve_controls) break;
      bounds_ += share;
      touched_ += share > 0 ? 1 : 0;
    }
  }
  if (!(size_ > 0)) size_ = 1;
  for (const auto& errors : phases)
    for (std::size_t k = 0; k < errors.interval.size(); ++k)
      largest_excess_ = std::max({largest_excess_, excess(errors, k), bound_excess(errors, k)});
}

double Shares::excess(const ErrorEstimate& errors, std::size_t k) const {
  const double most = kObjectiveTolerance * tolerance_;
  if (sum_ <= most * size_ || errors.interval[k] <= kSolversError) return 0;
  return std::fabs(errors.objective_share[k]) / size_ * intervals_ / most;
}

double Shares::bound_excess(const ErrorEstimate& errors, std::size_t k) const {
  const double most = kBoundTolerance * tolerance_;
  return bounds_ <= most * size_ ? 0 : errors.bound_share[k] / size_ * touched_ / most;
}

PhasedTranscription::Grid next_grid(const Solution& solution, const ErrorEstimate& errors,
                                    const Shares& shares, const std::vector<double>& unresolved,
                                    History& history, const RefineRules& rules) {
  const auto& breaks = solution.mesh.breakpoints();
  std::vector<double> next{0};
  std::vector<Scheme> schemes;
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
    const Scheme& scheme = solution.scheme.of(k);
    const double excess = std::max(errors.interval[k] / rules.tolerance, shares.excess(errors, k));
    // An interval where a bound is missed is cut as one that does not follow its control.
    const double bends = std::max(unresolved[k] / rules.tolerance, shares.bound_excess(errors, k));
    const Fate fate =
        bends > 1                           ? cut_for_control(scheme, std::max(excess, bends))
        : excess <= 1                       ? Fate{1, scheme}
        : rules.refinement == Refinement::h ? cut(scheme, excess)
        : history.bends(breaks[k], breaks[k + 1], points_of(scheme), errors.interval[k])
            ? Fate{kMostPieces, ocp::scheme(scheme.name, rules.min_points)}
            : raise(scheme, excess, rules);
    for (int piece = 1; piece <= fate.pieces; ++piece) {
      const double share = static_cast<double>(piece) / fate.pieces;
      next.push_back(piece == fate.pieces ? breaks[k + 1]
                                          : breaks[k] + share * (breaks[k + 1] - breaks[k]));
      schemes.push_back(fate.scheme);
    }
  }
  return {Mesh(std::move(next)), Schemes(std::move(schemes))};
}

PhasedTranscription::Grid halved(const PhasedTranscription::Grid& grid,
                                 const std::vector<char>& where) {
  const auto& breaks = grid.mesh.breakpoints();
  std::vector<double> next{0};
  std::vector<Scheme> schemes;
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
    if (where[k] != 0) {
      next.push_back((breaks[k] + breaks[k + 1]) / 2);
      schemes.push_back(grid.schemes.of(k));
    }
    next.push_back(breaks[k + 1]);
    schemes.push_back(grid.schemes.of(k));
  }
  return {Mesh(std::move(next)), Schemes(std::move(schemes))};
}

std::size_t points(const PhasedTranscription::Grid& grid) {
  std::size_t count = 1;
  for (std::size_t k = 0; k < grid.mesh.intervals(); ++k)
    count += grid.schemes.of(k).points.size() - 1;
  return count;
}

}  // namespace slalom::ocp
