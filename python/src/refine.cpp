#include "slalom/ocp/refine.hpp"

#include <memory>
#include <optional>
#include <string>

#include "binding.hpp"
#include "phased.hpp"
#include "running.hpp"
#include "settings.hpp"
#include "slalom/base/error.hpp"
#include "solved.hpp"

namespace slalom::python {
namespace {

using ocp::PhasedProblem;
using ocp::Problem;
using ocp::RefineRules;

/// What Python knows as Refined and PhasedRefined.
template <class Answer, class Solution>
struct RefinedAnswer {
  Answer answer;
  Solution solution;
};
using OnePhase = RefinedAnswer<ocp::Refined, Solved>;
using PhasedAnswer = RefinedAnswer<ocp::PhasedRefined, PhasedSolved>;

const std::vector<std::string> kRules = {"tolerance",        "refinement",  "max_meshes",
                                         "max_size",         "min_points",  "max_points",
                                         "resolve_controls", "damp_chatter"};

RefineRules rules_of(double tolerance, const std::string& refinement, int max_meshes, int max_size,
                     int min_points, int max_points, bool resolve_controls, bool damp_chatter) {
  check_at_most(max_meshes, 1000, "refine: max_meshes");
  check_at_most(max_size, 1'000'000, "refine: max_size");
  check_at_most(max_points, 100, "refine: max_points");
  RefineRules rules;
  rules.tolerance = tolerance;
  rules.resolve_controls = resolve_controls;
  rules.damp_chatter = damp_chatter;
  rules.max_meshes = max_meshes;
  rules.max_size = max_size;
  rules.min_points = min_points;
  rules.max_points = max_points;
  if (refinement == "h")
    rules.refinement = ocp::Refinement::h;
  else if (refinement == "hp")
    rules.refinement = ocp::Refinement::hp;
  else
    throw InvalidValue("refinement", "'" + refinement + "'", "'h' or 'hp'");
  return rules;
}

OnePhase refine(const Problem& problem, double tolerance, const std::string& refinement,
                int max_meshes, int max_size, int min_points, int max_points, bool resolve_controls,
                bool damp_chatter, const MeshChoice& mesh, const SchemeChoice& scheme,
                const PointsChoice& points, const std::string& backend, const nb::object& guess,
                const Solved* warm_start, const nb::kwargs& options) {
  auto start =
      settings_of(problem, {mesh, scheme, points}, backend, guess, warm_start, options, kRules);
  const auto rules = rules_of(tolerance, refinement, max_meshes, max_size, min_points, max_points,
                              resolve_controls, damp_chatter);
  OnePhase refined;
  refined.solution.problem = std::make_shared<const Problem>(problem);
  std::tie(refined.answer, refined.solution.elapsed_s) = run_released(
      start.options, [&] { return ocp::refine(*refined.solution.problem, start, rules); });
  refined.solution.answer = std::move(refined.answer.solution);
  forget_stop(refined.solution.answer.options);
  warn_of(problem, refined.solution.answer);
  return refined;
}

PhasedAnswer refine_phases(const Phases& problem, double tolerance, const std::string& refinement,
                           int max_meshes, int max_size, int min_points, int max_points,
                           bool resolve_controls, bool damp_chatter, const MeshChoice& mesh,
                           const SchemeChoice& scheme, const PointsChoice& points,
                           const ByName<nb::any>& phases, const std::string& backend,
                           const PhasedSolved* guess, const PhasedSolved* warm_start,
                           const nb::kwargs& options) {
  const PhasedProblem copy = problem.now();
  auto start =
      start_of(copy, {mesh, scheme, points}, phases, backend, guess, warm_start, options, kRules);
  const auto rules = rules_of(tolerance, refinement, max_meshes, max_size, min_points, max_points,
                              resolve_controls, damp_chatter);
  auto [answer, elapsed] = run_released(start.settings.options,
                                        [&] { return ocp::refine(copy, start.settings, rules); });
  PhasedSolved solution(copy, std::move(answer.solution), elapsed);
  for (const auto& phase : solution.phases) warn_of(*phase.problem, phase.answer);
  return {std::move(answer), std::move(solution)};
}

void bind_record(nb::module_& module) {
  using ocp::MeshRecord;
  nb::class_<MeshRecord>(module, "MeshRecord", doc::ocp_MeshRecord)
      .def_ro("intervals", &MeshRecord::intervals)
      .def_ro("points", &MeshRecord::points)
      .def_prop_ro("status", [](const MeshRecord& m) { return nlp::to_string(m.status); })
      .def_ro("iterations", &MeshRecord::iterations)
      .def_ro("wall_s", &MeshRecord::wall_s, doc::ocp_MeshRecord_wall_s)
      .def_ro("objective", &MeshRecord::objective)
      .def_ro("largest_error", &MeshRecord::largest_error, doc::ocp_MeshRecord_largest_error)
      .def_ro("objective_error", &MeshRecord::objective_error, doc::ocp_MeshRecord_objective_error)
      .def_ro("unresolved", &MeshRecord::unresolved, doc::ocp_MeshRecord_unresolved)
      .def_ro("damping", &MeshRecord::damping, doc::ocp_MeshRecord_damping)
      .def_ro("worst_phase", &MeshRecord::worst_phase, doc::ocp_MeshRecord_worst_phase)
      .def_ro("worst_interval", &MeshRecord::worst_interval);
}

/// What both kinds of answers have.
template <class Type>
nb::class_<Type> bind_refined(nb::module_& module, const char* name, const char* documentation) {
  nb::class_<Type> type(module, name, documentation);
  type.def_prop_ro(
          "status", [](const Type& r) { return ocp::to_string(r.answer.status); },
          doc::ocp_RefineStatus)
      .def_prop_ro(
          "converged",
          [](const Type& r) { return r.answer.status == ocp::RefineStatus::converged; },
          doc::ocp_RefineStatus_converged)
      .def_ro("solution", &Type::solution, doc::ocp_Refined_solution)
      .def_prop_ro(
          "hamiltonian_gap", [](const Type& r) { return r.answer.hamiltonian_gap; },
          doc::ocp_Refined_hamiltonian_gap)
      .def_prop_ro(
          "meshes", [](const Type& r) { return r.answer.meshes; },
          "One record for each mesh that was solved.")
      .def(
          "table", [](const Type& r) { return r.answer.table(); },
          "The records as a table of plain text.")
      .def("__repr__", [name = std::string(name)](const Type& r) {
        return "<" + name + ": " + ocp::to_string(r.answer.status) + " after " +
               std::to_string(r.answer.meshes.size()) + " meshes>";
      });
  return type;
}

/// `class_<...>::def` of refine, whose keywords are those of solve after its own.
template <class Type, class Function, class... Keywords>
void def_refine(nb::class_<Type>& type, const Function& function, const Keywords&... keywords) {
  const RefineRules defaults;
  type.def("refine", function, nb::kw_only(), "tolerance"_a = defaults.tolerance,
           "refinement"_a = "h", "max_meshes"_a = defaults.max_meshes,
           "max_size"_a = defaults.max_size, "min_points"_a = defaults.min_points,
           "max_points"_a = defaults.max_points, "resolve_controls"_a = defaults.resolve_controls,
           "damp_chatter"_a = defaults.damp_chatter, "mesh"_a = 40, "scheme"_a = "hermite_simpson",
           "points"_a = nb::none(), keywords..., "backend"_a = "", "guess"_a = nb::none(),
           "warm_start"_a = nb::none(), "options"_a,
           "Solves on one mesh after another, each from the last one's polynomials and "
           "multipliers, until\nevery interval's error, found by re-integration, is within "
           "`tolerance`. `refinement` \"h\" cuts\nintervals, \"hp\" raises the degree of lgr, "
           "lgr_differential, lgr_flipped or lgl up to `max_points`, then cuts\ninto intervals of "
           "`min_points`; no more than `max_meshes` meshes, none of more than `max_size`\npoints. "
           "`resolve_controls` goes on until jumps of the controls are resolved, and the "
           "objective too\nmoves by less than `tolerance`. `damp_chatter` holds a control that "
           "goes to and fro "
           "from point to point, as on\nsingular arcs, near an average of its own. The other "
           "keywords are those of solve, "
           "for the first mesh.");
}

}  // namespace

void bind_refine(nb::module_& module) {
  bind_record(module);
  auto one = bind_refined<OnePhase>(
      module, "Refined",
      "What Problem.refine comes to: the last mesh's answer, and every mesh's "
      "record.");
  one.def_prop_ro(
      "errors",
      [](const OnePhase& r) {
        const bool none = r.answer.errors.interval.empty();
        return none ? std::optional<ocp::ErrorEstimate>() : r.answer.errors;
      },
      "The re-integrated errors of that solution; None where no mesh was judged.");
  auto several =
      bind_refined<PhasedAnswer>(module, "PhasedRefined",
                                 "What PhasedProblem.refine comes to: the last mesh's answer, and "
                                 "every mesh's record.");
  several.def_prop_ro(
      "errors", [](const PhasedAnswer& r) { return r.answer.errors; },
      "The re-integrated errors of each phase; empty where no mesh was judged.");
  auto problem = nb::borrow<nb::class_<Problem>>(module.attr("Problem"));
  def_refine(problem, &refine);
  auto phased = nb::borrow<nb::class_<Phases>>(module.attr("PhasedProblem"));
  def_refine(phased, &refine_phases, "phases"_a = nb::dict());
}

}  // namespace slalom::python
