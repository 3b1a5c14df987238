#include <fmt/format.h>

#include "slalom/ocp/refine.hpp"

namespace slalom::ocp {

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
    case RefineStatus::stopped:
      return "stopped";
  }
  return "unknown";
}

std::string table(const std::vector<MeshRecord>& meshes, RefineStatus status) {
  std::string text =
      "mesh  intervals  points  status  iterations  solve [s]  objective  its error  unresolved  "
      "damping  error\n";
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const MeshRecord& mesh = meshes[m];
    text += fmt::format(
        "{}  {}  {}  {}  {}  {:.3g}  {:.10g}  {:.1e}  {}  {:.2g}  {:.2e} in interval {}{}\n", m + 1,
        mesh.intervals, mesh.points, nlp::to_string(mesh.status), mesh.iterations, mesh.wall_s,
        mesh.objective, mesh.objective_error, mesh.unresolved, mesh.damping, mesh.largest_error,
        mesh.worst_interval, mesh.worst_phase.empty() ? "" : " of " + mesh.worst_phase);
  }
  return text + to_string(status) + "\n";
}

}  // namespace slalom::ocp
