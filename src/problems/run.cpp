#include "slalom/problems/run.hpp"

#include <cmath>

namespace slalom::problems {
namespace {

/// Of several points an interval, fewer intervals do.
int first_intervals(const Entry& entry, const RunSettings& settings) {
  if (settings.intervals != 0) return settings.intervals;
  return ocp::has_choice_of_points(settings.scheme) ? (entry.intervals + 1) / 2 : entry.intervals;
}

ocp::RefineRules rules_of(const Entry& entry, const RunSettings& settings) {
  ocp::RefineRules rules;
  rules.tolerance = settings.tolerance != 0 ? settings.tolerance : entry.refinement;
  rules.resolve_controls = entry.resolve_controls;
  if (!settings.refined) {
    rules.max_meshes = 1;
    rules.damp_chatter = false;
  }
  if (ocp::has_choice_of_points(settings.scheme)) rules.refinement = ocp::Refinement::hp;
  return rules;
}

template <class Refined>
Run taken_from(const Refined& refined) {
  Run result;
  result.status = refined.status;
  result.backend = refined.solution.backend;
  result.value = refined.solution.objective;
  result.meshes = refined.meshes;
  result.error = refined.meshes.back().largest_error;
  for (const auto& mesh : refined.meshes) result.wall_s += mesh.wall_s;
  return result;
}

Run solved(const Statement& statement, const Entry& entry, const RunSettings& settings) {
  const auto mesh = ocp::Mesh::uniform(first_intervals(entry, settings));
  const auto scheme = ocp::scheme(settings.scheme, settings.points);
  if (const auto* one = std::get_if<ocp::Problem>(&statement.problem)) {
    ocp::SolveSettings start;
    start.mesh = mesh;
    start.scheme = scheme;
    start.backend = settings.backend;
    start.options.tol = entry.tol;
    if (!statement.guesses.empty()) start.guess = statement.guesses.front();
    return taken_from(ocp::refine(*one, start, rules_of(entry, settings)));
  }
  const auto& several = std::get<ocp::PhasedProblem>(statement.problem);
  ocp::PhasedSettings start;
  start.grids.assign(several.phases().size(), {mesh, scheme});
  start.backend = settings.backend;
  start.options.tol = entry.tol;
  start.guesses = statement.guesses;
  return taken_from(ocp::refine(several, start, rules_of(entry, settings)));
}

}  // namespace

Run run(const Entry& entry, const RunSettings& settings) {
  Run result = solved(entry.state(), entry, settings);
  if (entry.maximised) result.value = -result.value;
  const double reference = entry.reference();
  const double gap = result.value - reference;
  result.difference = reference == 0 ? gap : gap / std::fabs(reference);
  const bool done = result.status == ocp::RefineStatus::converged ||
                    (!settings.refined && result.status == ocp::RefineStatus::mesh_limit);
  result.agrees = done && std::fabs(gap) <= entry.tolerance();
  return result;
}

}  // namespace slalom::problems
