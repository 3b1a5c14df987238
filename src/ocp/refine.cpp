#include "slalom/ocp/refine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "conflicts.hpp"
#include "slalom/base/error.hpp"
#include "solved.hpp"

namespace slalom::ocp {
namespace {

/// Most pieces that one refinement cuts an interval into: errors far from the asymptotic regime
/// tell little.
constexpr int kMostPieces = 5;
/// Points that take off less than this factor of an interval's error are in vain.
constexpr double kLeastFall = 4;
/// Times the tolerance: what all errors together may make of the objective, relative to it.
constexpr double kObjectiveTolerance = 10;
/// What an interval's errors are at least for their share of that to mean anything.
constexpr double kSolversError = 1e-10;

/// The n of lgr(n) and the like.
int points_of(const Scheme& scheme) {
  return static_cast<int>(scheme.points.size()) - (scheme.name == "lgl" ? 0 : 1);
}

void check(const std::string& problem, const RefineRules& rules,
           const std::vector<PhasedTranscription::Grid>& grids) {
  const std::string where = problem + ": refinement: ";
  const auto at_least = [&](const char* name, int value, int least) {
    if (value < least)
      throw InvalidValue(where + name, std::to_string(value), fmt::format("at least {}", least));
  };
  if (!(rules.tolerance > 0 && rules.tolerance < 1))
    throw InvalidValue(where + "tolerance", fmt::format("{}", rules.tolerance),
                       "a number > 0 and < 1");
  at_least("max_meshes", rules.max_meshes, 1);
  at_least("max_size", rules.max_size, 2);
  at_least("min_points", rules.min_points, 2);
  at_least("max_points", rules.max_points, rules.min_points);
  for (const auto& grid : grids) {
    grid.schemes.check(grid.mesh);
    for (std::size_t k = 0; k < grid.mesh.intervals() && rules.refinement == Refinement::hp; ++k)
      if (!has_choice_of_points(grid.schemes.of(k).name))
        throw InvalidValue(where + "hp", "the scheme " + grid.schemes.of(k).name,
                           "lgr, lgr_differential, lgr_flipped or lgl, which have degrees");
  }
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

/// What one phase's meshes so far tell of its intervals.
class History {
 public:
  /// Whether something in an interval steps or bends, which no polynomial follows: more points took
  /// little off its error, or did so in an interval around it (Liu, Hager & Rao, J. Franklin Inst.
  /// 352(10), 2015).
  bool bends(double begin, double end, int points, double error) {
    for (const auto& [from, to] : bent_)
      if (from <= begin && end <= to) return true;
    const auto at = last_.find({begin, end});
    if (at == last_.end() || at->second.points >= points || error <= at->second.error / kLeastFall)
      return false;
    bent_.emplace_back(begin, end);
    return true;
  }
  /// To be called when the next mesh is known.
  void note(const Solution& solution, const ErrorEstimate& errors) {
    last_.clear();
    const auto& breaks = solution.mesh.breakpoints();
    for (std::size_t k = 0; k + 1 < breaks.size(); ++k)
      last_[{breaks[k], breaks[k + 1]}] = {points_of(solution.scheme.of(k)), errors.interval[k]};
  }

 private:
  struct Interval {
    int points = 0;
    double error = 0;
  };
  std::map<std::pair<double, double>, Interval> last_;
  std::vector<std::pair<double, double>> bent_;
};

/// A control's error falls as h^2 (unresolved_controls).
Fate cut_for_control(const Scheme& scheme, double excess) {
  const double pieces = std::ceil(std::sqrt(excess));
  return {std::clamp(pieces < kMostPieces ? static_cast<int>(pieces) : kMostPieces, 2, kMostPieces),
          scheme};
}

/// What all phases' intervals make of the objective.
class Shares {
 public:
  Shares(const std::vector<ErrorEstimate>& phases, double tolerance) : tolerance_(tolerance) {
    for (const auto& errors : phases) {
      size_ += errors.objective_size;
      for (const double share : errors.objective_share) sum_ += std::fabs(share);
      intervals_ += static_cast<double>(errors.objective_share.size());
    }
    if (!(size_ > 0)) size_ = 1;
    for (const auto& errors : phases)
      for (std::size_t k = 0; k < errors.interval.size(); ++k)
        largest_excess_ = std::max(largest_excess_, excess(errors, k));
  }

  double size() const { return size_; }
  /// Relative to that.
  double sum() const { return sum_ / size_; }
  bool too_large() const { return largest_excess_ > 1; }
  /// An interval's share over what it may be; 0 where the sum is small enough, or the interval's
  /// errors are but the solver's.
  double excess(const ErrorEstimate& errors, std::size_t k) const {
    const double most = kObjectiveTolerance * tolerance_;
    if (sum() <= most || errors.interval[k] <= kSolversError) return 0;
    return std::fabs(errors.objective_share[k]) / size_ * intervals_ / most;
  }

 private:
  double tolerance_, size_ = 0, sum_ = 0, intervals_ = 0, largest_excess_ = 0;
};

PhasedTranscription::Grid next_grid(const Solution& solution, const ErrorEstimate& errors,
                                    const Shares& shares, const std::vector<double>& unresolved,
                                    History& history, const RefineRules& rules) {
  const auto& breaks = solution.mesh.breakpoints();
  std::vector<double> next{0};
  std::vector<Scheme> schemes;
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
    const Scheme& scheme = solution.scheme.of(k);
    const double excess = std::max(errors.interval[k] / rules.tolerance, shares.excess(errors, k));
    const Fate fate =
        unresolved[k] > rules.tolerance
            ? cut_for_control(scheme, std::max(excess, unresolved[k] / rules.tolerance))
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

std::size_t points(const PhasedTranscription::Grid& grid) {
  std::size_t count = 1;
  for (std::size_t k = 0; k < grid.mesh.intervals(); ++k)
    count += grid.schemes.of(k).points.size() - 1;
  return count;
}

/// One phase's solves.
class Single {
 public:
  using Answer = Solution;
  Single(const Problem& problem, SolveSettings settings)
      : problem_(problem), settings_(std::move(settings)) {}

  const std::string& name() const { return problem_.name(); }
  std::vector<PhasedTranscription::Grid> grids() const {
    return {{settings_.mesh, settings_.scheme}};
  }
  Solution solve() const { return ocp::solve(problem_, settings_); }
  static std::vector<const Solution*> phases(const Solution& solution) { return {&solution}; }
  const Problem& problem(std::size_t) const { return problem_; }
  std::string phase_name(std::size_t) const { return ""; }
  void next(std::vector<PhasedTranscription::Grid> grids, const Solution& previous) {
    settings_.mesh = std::move(grids[0].mesh);
    settings_.scheme = std::move(grids[0].schemes);
    settings_.previous = &previous;
  }
  /// Without the last mesh's multipliers.
  Solution solve_anew() const {
    SolveSettings settings = settings_;
    settings.guess = resampled(problem_, *settings.previous, {settings.mesh, settings.scheme});
    settings.previous = nullptr;
    return ocp::solve(problem_, settings);
  }

 private:
  const Problem& problem_;
  SolveSettings settings_;
};

/// Those of several phases.
class Several {
 public:
  using Answer = PhasedSolution;
  Several(const PhasedProblem& problem, PhasedSettings settings)
      : problem_(problem), settings_(std::move(settings)) {
    if (settings_.grids.empty()) settings_.grids.resize(problem.phases().size());
  }

  const std::string& name() const { return problem_.name(); }
  const std::vector<PhasedTranscription::Grid>& grids() const { return settings_.grids; }
  PhasedSolution solve() const { return ocp::solve(problem_, settings_); }
  static std::vector<const Solution*> phases(const PhasedSolution& solution) {
    std::vector<const Solution*> list;
    for (const auto& phase : solution.phases) list.push_back(&phase);
    return list;
  }
  const Problem& problem(std::size_t phase) const { return problem_.phases()[phase]; }
  const std::string& phase_name(std::size_t phase) const { return problem_.phases()[phase].name(); }
  void next(std::vector<PhasedTranscription::Grid> grids, const PhasedSolution& previous) {
    settings_.grids = std::move(grids);
    settings_.previous = &previous;
  }
  PhasedSolution solve_anew() const {
    PhasedSettings settings = settings_;
    settings.guesses.clear();
    for (std::size_t p = 0; p < settings.grids.size(); ++p)
      settings.guesses.push_back(
          resampled(problem(p), settings.previous->phases[p], settings.grids[p]));
    settings.previous = nullptr;
    return ocp::solve(problem_, settings);
  }

 private:
  const PhasedProblem& problem_;
  PhasedSettings settings_;
};

template <class Solves>
MeshRecord record_of(const typename Solves::Answer& answer) {
  MeshRecord record;
  for (const Solution* phase : Solves::phases(answer)) {
    record.intervals += phase->mesh.intervals();
    record.points += phase->trajectory.tau.size();
  }
  record.status = answer.status;
  record.iterations = answer.iterations;
  record.wall_s = answer.wall_s;
  record.objective = answer.objective;
  record.largest_error = record.objective_error = kInfinity;
  return record;
}

template <class Solves>
std::vector<ErrorEstimate> judge(const Solves& solves, const typename Solves::Answer& answer,
                                 MeshRecord& record) {
  std::vector<ErrorEstimate> errors;
  const auto phases = Solves::phases(answer);
  record.largest_error = -1;
  for (std::size_t p = 0; p < phases.size(); ++p) {
    errors.push_back(estimate_errors(solves.problem(p), *phases[p]));
    if (errors[p].largest <= record.largest_error) continue;
    record.largest_error = errors[p].largest;
    record.worst_phase = solves.phase_name(p);
    record.worst_interval = errors[p].worst;
  }
  return errors;
}

/// By phase; zeros where it is not asked for.
template <class Solves>
std::vector<std::vector<double>> unresolved_by_phase(const Solves& solves,
                                                     const typename Solves::Answer& answer,
                                                     const RefineRules& rules, MeshRecord& record) {
  std::vector<std::vector<double>> list;
  const auto phases = Solves::phases(answer);
  for (std::size_t p = 0; p < phases.size(); ++p) {
    list.emplace_back(phases[p]->mesh.intervals(), 0.0);
    if (rules.resolve_controls) list[p] = unresolved_controls(solves.problem(p), *phases[p]);
    record.unresolved += static_cast<std::size_t>(std::count_if(
        list[p].begin(), list[p].end(), [&](double each) { return each > rules.tolerance; }));
  }
  return list;
}

/// Change of the objective since the mesh before, relative to its size; infinite on the first.
double last_change(const std::vector<MeshRecord>& meshes, double size) {
  if (meshes.size() < 2) return kInfinity;
  return std::fabs(meshes.back().objective - meshes[meshes.size() - 2].objective) / size;
}

/// Fills `answer`, `errors` and `meshes`.
template <class Solves>
RefineStatus run(Solves solves, const RefineRules& rules, typename Solves::Answer& answer,
                 std::vector<ErrorEstimate>& errors, std::vector<MeshRecord>& meshes) {
  check(solves.name(), rules, solves.grids());
  std::vector<History> histories(solves.grids().size());
  for (int mesh = 1;; ++mesh) {
    auto now = solves.solve();
    if (mesh > 1 && !now.solved()) now = solves.solve_anew();
    MeshRecord& record = meshes.emplace_back(record_of<Solves>(now));
    const bool solved = now.solved();
    if (solved || mesh == 1) answer = std::move(now);
    if (!solved) return RefineStatus::not_solved;
    errors = judge(solves, answer, record);
    const auto unresolved = unresolved_by_phase(solves, answer, rules, record);
    const Shares shares(errors, rules.tolerance);
    record.objective_error = shares.sum();
    const double change = last_change(meshes, shares.size());
    if (record.unresolved > 0) record.objective_error = std::max(record.objective_error, change);
    if (record.largest_error <= rules.tolerance && !shares.too_large() &&
        (record.unresolved == 0 || change <= rules.tolerance))
      return RefineStatus::converged;
    if (mesh == rules.max_meshes) return RefineStatus::mesh_limit;
    std::vector<PhasedTranscription::Grid> grids;
    std::size_t size = 0;
    const auto phases = Solves::phases(answer);
    for (std::size_t p = 0; p < phases.size(); ++p) {
      grids.push_back(next_grid(*phases[p], errors[p], shares, unresolved[p], histories[p], rules));
      histories[p].note(*phases[p], errors[p]);
      size += points(grids.back());
    }
    if (size > static_cast<std::size_t>(rules.max_size)) return RefineStatus::size_limit;
    solves.next(std::move(grids), answer);
  }
}

}  // namespace

const char* to_string(RefineStatus status) {
  switch (status) {
    case RefineStatus::converged:
      return "converged";
    case RefineStatus::mesh_limit:
      return "mesh_limit";
    case RefineStatus::size_limit:
      return "size_limit";
    case RefineStatus::not_solved:
      return "not_solved";
  }
  return "unknown";
}

std::string table(const std::vector<MeshRecord>& meshes, RefineStatus status) {
  std::string text =
      "mesh  intervals  points  status  iterations  solve [s]  objective  its error  unresolved  "
      "error\n";
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const MeshRecord& mesh = meshes[m];
    text += fmt::format(
        "{}  {}  {}  {}  {}  {:.3g}  {:.10g}  {:.1e}  {}  {:.2e} in interval {}{}\n", m + 1,
        mesh.intervals, mesh.points, nlp::to_string(mesh.status), mesh.iterations, mesh.wall_s,
        mesh.objective, mesh.objective_error, mesh.unresolved, mesh.largest_error,
        mesh.worst_interval, mesh.worst_phase.empty() ? "" : " of " + mesh.worst_phase);
  }
  return text + to_string(status) + "\n";
}

Refined refine(const Problem& problem, const SolveSettings& start, const RefineRules& rules) {
  Refined result;
  std::vector<ErrorEstimate> errors;
  result.status = run(Single(problem, start), rules, result.solution, errors, result.meshes);
  if (!errors.empty()) result.errors = std::move(errors.front());
  if (result.status != RefineStatus::converged) result.solution.high_index = high_index(problem);
  return result;
}

PhasedRefined refine(const PhasedProblem& problem, const PhasedSettings& start,
                     const RefineRules& rules) {
  PhasedRefined result;
  result.status =
      run(Several(problem, start), rules, result.solution, result.errors, result.meshes);
  if (result.status == RefineStatus::converged) return result;
  for (std::size_t p = 0; p < result.solution.phases.size(); ++p)
    result.solution.phases[p].high_index = high_index(problem.phases()[p]);
  return result;
}

}  // namespace slalom::ocp
