#include "slalom/ocp/refine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "slalom/base/error.hpp"
#include "slalom/ocp/interpolant.hpp"

namespace slalom::ocp {
namespace {

/// Most pieces that one refinement cuts an interval into: errors far from the asymptotic regime
/// tell little.
constexpr int kMostPieces = 5;

bool has_degrees(const Scheme& scheme) {
  return scheme.name == "lgr" || scheme.name == "lgr_differential" || scheme.name == "lgl";
}

/// The n of lgr(n) and the like.
int points_of(const Scheme& scheme) {
  return static_cast<int>(scheme.points.size()) - (scheme.name == "lgl" ? 0 : 1);
}

void check(const Problem& problem, const RefineSettings& settings) {
  const std::string where = problem.name() + ": refinement: ";
  const auto at_least = [&](const char* name, int value, int least) {
    if (value < least)
      throw InvalidValue(where + name, std::to_string(value), fmt::format("at least {}", least));
  };
  if (!(settings.tolerance > 0 && settings.tolerance < 1))
    throw InvalidValue(where + "tolerance", fmt::format("{}", settings.tolerance),
                       "a number > 0 and < 1");
  at_least("max_meshes", settings.max_meshes, 1);
  at_least("max_size", settings.max_size, 2);
  at_least("min_points", settings.min_points, 2);
  at_least("max_points", settings.max_points, settings.min_points);
  settings.start.scheme.check(settings.start.mesh);
  if (settings.refinement == Refinement::h) return;
  for (std::size_t k = 0; k < settings.start.mesh.intervals(); ++k)
    if (!has_degrees(settings.start.scheme.of(k)))
      throw InvalidValue(where + "hp", "the scheme " + settings.start.scheme.of(k).name,
                         "lgr, lgr_differential or lgl, which have degrees");
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
Fate raise(const Scheme& scheme, double excess, const RefineSettings& settings) {
  const int now = points_of(scheme);
  const double more = std::max(1.0, std::ceil(std::log(excess) / std::log(std::max(now, 2))));
  if (now + more <= settings.max_points)
    return {1, ocp::scheme(scheme.name, now + static_cast<int>(more))};
  const double pieces = std::ceil(std::min(now + more, 1e3) / settings.min_points);
  return {std::clamp(static_cast<int>(pieces), 2, kMostPieces),
          ocp::scheme(scheme.name, settings.min_points)};
}

struct Grid {
  Mesh mesh;
  Schemes schemes;
  std::size_t points;
};

Grid next_grid(const Solution& solution, const ErrorEstimate& errors,
               const RefineSettings& settings) {
  const auto& breaks = solution.mesh.breakpoints();
  std::vector<double> next{0};
  std::vector<Scheme> schemes;
  std::size_t points = 1;
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
    const Scheme& scheme = solution.scheme.of(k);
    const double excess = errors.interval[k] / settings.tolerance;
    const Fate fate = excess <= 1                            ? Fate{1, scheme}
                      : settings.refinement == Refinement::h ? cut(scheme, excess)
                                                             : raise(scheme, excess, settings);
    for (int piece = 1; piece <= fate.pieces; ++piece) {
      const double share = static_cast<double>(piece) / fate.pieces;
      next.push_back(piece == fate.pieces ? breaks[k + 1]
                                          : breaks[k] + share * (breaks[k + 1] - breaks[k]));
      schemes.push_back(fate.scheme);
      points += fate.scheme.points.size() - 1;
    }
  }
  return {Mesh(std::move(next)), Schemes(std::move(schemes)), points};
}

MeshRecord record_of(const Solution& solution) {
  MeshRecord record;
  record.intervals = solution.mesh.intervals();
  record.points = solution.trajectory.tau.size();
  record.status = solution.status;
  record.iterations = solution.iterations;
  record.wall_s = solution.wall_s;
  record.objective = solution.objective;
  record.largest_error = kInfinity;
  return record;
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

std::string Refined::table() const {
  std::string text = "mesh  intervals  points  status  iterations  solve [s]  objective  error\n";
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const MeshRecord& mesh = meshes[m];
    text += fmt::format("{}  {}  {}  {}  {}  {:.3g}  {:.10g}  {:.2e} in interval {}\n", m + 1,
                        mesh.intervals, mesh.points, nlp::to_string(mesh.status), mesh.iterations,
                        mesh.wall_s, mesh.objective, mesh.largest_error, mesh.worst_interval);
  }
  return text + to_string(status) + "\n";
}

Refined refine(const Problem& problem, const RefineSettings& settings) {
  check(problem, settings);
  Refined result;
  SolveSettings now = settings.start;
  for (int mesh = 1;; ++mesh) {
    Solution solution = solve(problem, now);
    MeshRecord& record = result.meshes.emplace_back(record_of(solution));
    if (!solution.solved()) {
      if (mesh == 1) result.solution = std::move(solution);
      result.status = RefineStatus::not_solved;
      return result;
    }
    result.solution = std::move(solution);
    result.errors = estimate_errors(problem, result.solution);
    record.largest_error = result.errors.largest;
    record.worst_interval = result.errors.worst;
    if (record.largest_error <= settings.tolerance) {
      result.status = RefineStatus::converged;
      return result;
    }
    if (mesh == settings.max_meshes) {
      result.status = RefineStatus::mesh_limit;
      return result;
    }
    const Grid next = next_grid(result.solution, result.errors, settings);
    if (next.points > static_cast<std::size_t>(settings.max_size)) {
      result.status = RefineStatus::size_limit;
      return result;
    }
    const Interpolant polynomials(problem, result.solution.trajectory, result.solution.mesh,
                                  result.solution.scheme);
    now.guess = polynomials.resampled(next.mesh, next.schemes);
    now.mesh = next.mesh;
    now.scheme = next.schemes;
    now.warm_start = {};
  }
}

}  // namespace slalom::ocp
