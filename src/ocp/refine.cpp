#include "slalom/ocp/refine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>

#include "conflicts.hpp"
#include "damping.hpp"
#include "mesh_solves.hpp"
#include "minimum_principle.hpp"
#include "remesh.hpp"
#include "set_up_watch.hpp"
#include "slalom/base/error.hpp"
#include "slalom/base/timer.hpp"
#include "symbols.hpp"

namespace slalom::ocp {
namespace {

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

/// Whether a cost depends on anything that a solve may change.
bool has_cost(const Problem& problem) {
  const Symbols symbols(problem);
  const auto may_change = [&](const Expr& symbol) {
    const Meaning* meaning = symbols.find(symbol);
    return meaning == nullptr || meaning->kind != Meaning::Kind::parameter;
  };
  return std::any_of(problem.costs().begin(), problem.costs().end(), [&](const auto& cost) {
    const auto used = expr::symbols_of({cost.value});
    return cost.enabled && std::any_of(used.begin(), used.end(), may_change);
  });
}

/// Where nothing costs, the objective is the same whatever the states are, and multipliers are
/// rounding.
template <class Solves>
bool costs_nothing(const Solves& solves, const typename Solves::Answer& answer) {
  if constexpr (!std::is_same_v<typename Solves::Answer, Solution>)
    if (!answer.cost_terms.empty()) return false;  // of several phases together
  const std::size_t phases = Solves::phases(answer).size();
  for (std::size_t p = 0; p < phases; ++p)
    if (has_cost(solves.problem(p))) return false;
  return true;
}

template <class Solves>
std::vector<ErrorEstimate> judge(const Solves& solves, const typename Solves::Answer& answer,
                                 MeshRecord& record) {
  std::vector<ErrorEstimate> errors;
  const auto phases = Solves::phases(answer);
  const bool free = costs_nothing(solves, answer);
  record.largest_error = -1;
  for (std::size_t p = 0; p < phases.size(); ++p) {
    errors.push_back(estimate_errors(solves.problem(p), *phases[p]));
    if (free) {
      errors[p].objective = 0;
      errors[p].objective_share.assign(errors[p].objective_share.size(), 0.0);
      errors[p].bound_share.assign(errors[p].bound_share.size(), 0.0);
    }
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

template <class Solves>
std::vector<Chatter> chatter_in(const typename Solves::Answer& answer, bool damped) {
  std::vector<Chatter> list;
  for (const Solution* phase : Solves::phases(answer)) list.push_back(chatter_of(*phase, damped));
  return list;
}

/// What is found of one mesh's answer.
struct Findings {
  std::vector<ErrorEstimate> errors;
  std::vector<Chatter> chatter;
  std::vector<std::vector<double>> unresolved;
};

/// By phase.
template <class Solves>
std::vector<HamiltonianGap> gaps_in(const Solves& solves, const typename Solves::Answer& answer) {
  std::vector<HamiltonianGap> list;
  const auto phases = Solves::phases(answer);
  for (std::size_t p = 0; p < phases.size(); ++p)
    list.push_back(hamiltonian_gap(solves.problem(p), *phases[p]));
  return list;
}

/// One refinement, mesh after mesh.
template <class Solves>
class Refining {
 public:
  using Answer = typename Solves::Answer;
  Refining(Solves solves, const RefineRules& rules)
      : solves_(std::move(solves)),
        rules_(rules),
        histories_(solves_.grids().size()),
        damping_(rules.resolve_controls && rules.damp_chatter),
        limit_(solves_.options().time_limit) {}

  /// Fills `answer`, `errors` and `meshes`.
  RefineStatus run(Answer& answer, std::vector<ErrorEstimate>& errors,
                   std::vector<MeshRecord>& meshes) {
    std::optional<Answer> lower;
    for (int mesh = 1, damped = 0;;) {
      Answer now = lower ? std::move(*lower) : meshes.empty() ? solve(true) : solve_after(answer);
      lower.reset();
      const bool first = meshes.empty();
      MeshRecord& record = meshes.emplace_back(record_of<Solves>(now));
      record.damping = damping_.weight();
      if (!now.solved()) {
        const bool ended = stopped(now) && !first;
        if (first) answer = std::move(now);
        return ended ? RefineStatus::stopped : RefineStatus::not_solved;
      }
      std::optional<Findings> found = find(now, record);
      if (!found) {
        if (first) answer = std::move(now);
        return RefineStatus::stopped;
      }
      const Shares shares(found->errors, Solves::costs_beside(now), rules_);
      record.objective_error = shares.sum();
      // Without damping, whatever it does between points.
      const bool plain = record.damping == 0 && converged(record, shares);
      const bool low = damping_.lowered(), raised = !plain && damping_.raised(found->chatter);
      const bool kept = !(low && raised);  // else the answer with more weight is the better one
      if (kept) {
        answer = std::move(now);
        errors = std::move(found->errors);
      }
      if (plain || (kept && record.damping > 0 && converged(record, shares) && !raised)) {
        lower = lower_than(answer, shares.size());
        if (!lower) return RefineStatus::converged;
        continue;
      }
      Grids grids = !raised ? next_grids(answer, errors, shares, found->unresolved)
                    : low   ? halved_grids(answer, found->chatter)
                            : grids_of(answer);
      const bool same = count(grids) == count(grids_of(answer));
      if (same && !raised) damping_.lower();
      const bool last = damping_.weight() > 0 ? ++damped > kDampedSolves * rules_.max_meshes
                                              : ++mesh > rules_.max_meshes;
      if (last) return RefineStatus::mesh_limit;
      if (count(grids) > static_cast<std::size_t>(rules_.max_size)) return RefineStatus::size_limit;
      solves_.next(std::move(grids), answer);
      solves_.damp(answer, damping_.chosen(), damping_.weight() * shares.size());
    }
  }
  /// Of the last converged answer, away from bounds of states; 0 without one.
  double hamiltonian_gap() const {
    double sum = 0;
    for (const auto& gap : gaps_) sum += gap.away_from_bounds;
    return sum;
  }

 private:
  using Grids = std::vector<PhasedTranscription::Grid>;
  /// For each mesh that there may be: most by which damping ends or its weight is found.
  static constexpr int kDampedSolves = 2;
  /// Times the tolerance: what damping may be estimated to leave.
  static constexpr double kDampedTolerance = 5;
  /// Of the parts of the Hamiltonian: a gap that counts however small the costates are. They vanish
  /// where an answer has lost all that it could gain.
  static constexpr double kLargeGap = 1e-2;
  /// Most answers that are left for a lower one.
  static constexpr int kEscapes = 2;

  Answer solve(bool first) {
    Answer now = in_time([&] { return solves_.solve(); });
    if (!first && !now.solved() && !stopped(now))
      now = in_time([&] { return solves_.solve_anew(); });
    return now;
  }
  /// On the mesh that follows that of `before`. Equations that follow from others, such as periodic
  /// ones of a system that conserves something, may all hold on a mesh only by its symmetry. Where
  /// they do not, that mesh is halved as a whole.
  Answer solve_after(const Answer& before) {
    Answer now = solve(false);
    if (now.status != nlp::Status::too_few_freedoms) return now;
    Grids grids = grids_of(before);
    for (auto& grid : grids) grid = halved(grid, std::vector<char>(grid.mesh.intervals(), 1));
    if (count(grids) > static_cast<std::size_t>(rules_.max_size)) return now;
    solves_.next(std::move(grids), before);
    return solve(false);
  }
  /// A solve in what is left of the whole refinement's time.
  template <class Solve>
  Answer in_time(const Solve& solve) {
    solves_.options().time_limit = left_s();
    Answer answer = solve();
    for (nlp::Options* options : Solves::options_of(answer)) options->time_limit = limit_;
    return answer;
  }
  double left_s() const { return std::max(0.0, limit_ - timer_.wall()); }
  static bool stopped(const Answer& answer) {
    return answer.status == nlp::Status::time_limit || answer.status == nlp::Status::interrupted;
  }
  /// Nothing, and no errors in the record, where time is up or the options' callback says so.
  std::optional<Findings> find(const Answer& now, MeshRecord& record) {
    nlp::Options options = solves_.options();
    options.time_limit = left_s();
    const SetUpWatch watch(options);
    const MeshRecord before = record;
    try {
      SetUpWatch::ask_now();
      Findings found;
      found.chatter = chatter_in<Solves>(now, record.damping > 0);
      found.errors = judge(solves_, now, record);
      found.unresolved = unresolved_by_phase(solves_, now, rules_, record);
      return found;
    } catch (const SetUpWatch::Stopped&) {
      record = before;
      return std::nullopt;
    }
  }
  /// An answer on the same mesh with a lower objective, where the minimum principle says that there
  /// may be one: from a guess whose controls are those that it asks for.
  std::optional<Answer> lower_than(const Answer& answer, double size) {
    nlp::Options limits = solves_.options();
    limits.time_limit = left_s();
    try {
      const SetUpWatch watch(limits);
      gaps_ = gaps_in(solves_, answer);
    } catch (const SetUpWatch::Stopped&) {
      gaps_.clear();  // converged it is, and not judged
      return std::nullopt;
    }
    double gap = 0, parts = 0;
    for (const auto& each : gaps_) {
      gap += each.value;
      parts += each.size;
    }
    if (gap <= std::min(kObjectiveTolerance * rules_.tolerance * size, kLargeGap * parts))
      return std::nullopt;
    if (++escapes_ > kEscapes) return std::nullopt;
    for (const auto states : {GuessedStates::kept, GuessedStates::simulated}) {
      std::vector<Trajectory> guesses;
      const auto phases = Solves::phases(answer);
      for (std::size_t p = 0; p < phases.size(); ++p)
        if (auto guess = guess_by(solves_.problem(p), *phases[p], gaps_[p], states, limits))
          guesses.push_back(std::move(*guess));
      if (guesses.size() < phases.size()) continue;
      Answer other = in_time([&] { return solves_.solve_from(std::move(guesses)); });
      if (other.solved() && other.objective < answer.objective - rules_.tolerance * size)
        return other;
      if (stopped(other)) break;
    }
    return std::nullopt;
  }
  /// Fills the record's error of the objective too.
  bool converged(MeshRecord& record, const Shares& shares) {
    const double change = std::fabs(record.objective - last_objective_) / shares.size();
    last_objective_ = record.objective;
    double left = 0;
    if (record.damping > 0)
      left = std::max(damping_.calm(change), std::fabs(solves_.damping_cost()) / shares.size());
    if (record.unresolved > 0) record.objective_error = std::max(record.objective_error, change);
    record.objective_error = std::max(record.objective_error, left);
    return fine(record, shares) && (record.unresolved == 0 || change <= rules_.tolerance) &&
           left <= kDampedTolerance * rules_.tolerance;
  }
  bool fine(const MeshRecord& record, const Shares& shares) const {
    return record.largest_error <= rules_.tolerance && !shares.too_large();
  }
  static std::size_t count(const Grids& grids) {
    std::size_t size = 0;
    for (const auto& grid : grids) size += points(grid);
    return size;
  }
  static Grids grids_of(const Answer& answer) {
    Grids grids;
    for (const Solution* phase : Solves::phases(answer))
      grids.push_back({phase->mesh, phase->scheme});
    return grids;
  }
  /// Cut where a control chattered by less weight.
  static Grids halved_grids(const Answer& answer, const std::vector<Chatter>& chatter) {
    Grids grids = grids_of(answer);
    for (std::size_t p = 0; p < grids.size(); ++p)
      grids[p] = halved(grids[p], chatter[p].intervals);
    return grids;
  }
  Grids next_grids(const Answer& answer, const std::vector<ErrorEstimate>& errors,
                   const Shares& shares, const std::vector<std::vector<double>>& unresolved) {
    Grids grids;
    const auto phases = Solves::phases(answer);
    for (std::size_t p = 0; p < phases.size(); ++p) {
      grids.push_back(
          next_grid(*phases[p], errors[p], shares, unresolved[p], histories_[p], rules_));
      histories_[p].note(*phases[p], errors[p]);
    }
    return grids;
  }

  Solves solves_;
  const RefineRules& rules_;
  std::vector<History> histories_;
  Damping damping_;
  const double limit_;  ///< [s], of all together
  const Timer timer_;
  double last_objective_ = kInfinity;
  std::vector<HamiltonianGap> gaps_;  ///< of the last converged answer, by phase
  int escapes_ = 0;
};

template <class Solves>
RefineStatus run(Solves solves, const RefineRules& rules, typename Solves::Answer& answer,
                 std::vector<ErrorEstimate>& errors, std::vector<MeshRecord>& meshes,
                 double& hamiltonian_gap) {
  check(solves.name(), rules, solves.grids());
  Refining<Solves> refining(std::move(solves), rules);
  const RefineStatus status = refining.run(answer, errors, meshes);
  hamiltonian_gap = refining.hamiltonian_gap();
  return status;
}

}  // namespace

Refined refine(const Problem& problem, const SolveSettings& start, const RefineRules& rules) {
  Refined result;
  std::vector<ErrorEstimate> errors;
  result.status = run(Single(problem, start), rules, result.solution, errors, result.meshes,
                      result.hamiltonian_gap);
  if (!errors.empty()) result.errors = std::move(errors.front());
  if (result.status != RefineStatus::converged) result.solution.high_index = high_index(problem);
  return result;
}

PhasedRefined refine(const PhasedProblem& problem, const PhasedSettings& start,
                     const RefineRules& rules) {
  PhasedRefined result;
  result.status = run(Several(problem, start), rules, result.solution, result.errors, result.meshes,
                      result.hamiltonian_gap);
  if (result.status == RefineStatus::converged) return result;
  for (std::size_t p = 0; p < result.solution.phases.size(); ++p)
    result.solution.phases[p].high_index = high_index(problem.phases()[p]);
  return result;
}

}  // namespace slalom::ocp
