#include "slalom/ocp/solve.hpp"

#include <memory>
#include <string>

#include "binding.hpp"
#include "running.hpp"
#include "settings.hpp"
#include "slalom/base/error.hpp"
#include "slalom/base/options.hpp"
#include "slalom/ocp/refine.hpp"
#include "solved.hpp"

namespace slalom::python {
namespace {

using ocp::Problem;
using ocp::Refined;

const std::vector<std::string> kKeywords = {"mesh",    "scheme", "points",
                                            "backend", "guess",  "warm_start"};

ocp::SolveSettings settings_of(const Problem& problem, const GridChoice& choice,
                               const std::string& backend, nb::handle guess,
                               const Solved* warm_start, const nb::kwargs& options,
                               const std::vector<std::string>& keywords) {
  const auto grid = grid_of(choice, problem.name());
  ocp::SolveSettings settings;
  settings.mesh = grid.mesh;
  settings.scheme = grid.schemes;
  settings.backend = backend;
  settings.options = options_of(options, keywords);
  settings.guess = guess_of(problem, grid, guess);
  if (warm_start != nullptr) settings.warm_start = warm_start->answer.point;
  return settings;
}

Solved solve(const Problem& problem, const MeshChoice& mesh, const SchemeChoice& scheme,
             const PointsChoice& points, const std::string& backend, const nb::object& guess,
             const Solved* warm_start, const nb::kwargs& options) {
  auto settings =
      settings_of(problem, {mesh, scheme, points}, backend, guess, warm_start, options, kKeywords);
  Solved solved;
  solved.problem = std::make_shared<const Problem>(problem);
  std::tie(solved.answer, solved.elapsed_s) =
      run_released(settings.options, [&] { return ocp::solve(*solved.problem, settings); });
  forget_stop(solved.answer.options);
  return solved;
}

ocp::Refinement refinement_of(const std::string& word) {
  if (word == "h") return ocp::Refinement::h;
  if (word == "hp") return ocp::Refinement::hp;
  throw InvalidValue("refinement", "'" + word + "'", "'h' or 'hp'");
}

/// What Python knows as Refined.
struct RefinedAnswer {
  Refined answer;
  Solved solution;
};

RefinedAnswer refine(const Problem& problem, double tolerance, const std::string& refinement,
                     int max_meshes, int max_size, int min_points, int max_points,
                     const MeshChoice& mesh, const SchemeChoice& scheme, const PointsChoice& points,
                     const std::string& backend, const nb::object& guess, const Solved* warm_start,
                     const nb::kwargs& options) {
  auto keywords = kKeywords;
  for (const char* each : {"tolerance", "refinement", "max_meshes", "max_size", "min_points"})
    keywords.emplace_back(each);
  auto start =
      settings_of(problem, {mesh, scheme, points}, backend, guess, warm_start, options, keywords);
  const ocp::RefineRules rules{.tolerance = tolerance,
                               .refinement = refinement_of(refinement),
                               .max_meshes = max_meshes,
                               .max_size = max_size,
                               .min_points = min_points,
                               .max_points = max_points};
  RefinedAnswer refined;
  refined.solution.problem = std::make_shared<const Problem>(problem);
  std::tie(refined.answer, refined.solution.elapsed_s) = run_released(
      start.options, [&] { return ocp::refine(*refined.solution.problem, start, rules); });
  refined.solution.answer = std::move(refined.answer.solution);
  forget_stop(refined.solution.answer.options);
  return refined;
}

void bind_refined(nb::module_& module) {
  using ocp::MeshRecord;
  nb::class_<MeshRecord>(module, "MeshRecord", doc::ocp_MeshRecord)
      .def_ro("intervals", &MeshRecord::intervals)
      .def_ro("points", &MeshRecord::points)
      .def_prop_ro("status", [](const MeshRecord& m) { return nlp::to_string(m.status); })
      .def_ro("iterations", &MeshRecord::iterations)
      .def_ro("wall_s", &MeshRecord::wall_s, doc::ocp_MeshRecord_wall_s)
      .def_ro("objective", &MeshRecord::objective)
      .def_ro("largest_error", &MeshRecord::largest_error, doc::ocp_MeshRecord_largest_error)
      .def_ro("worst_interval", &MeshRecord::worst_interval);
  nb::class_<RefinedAnswer>(module, "Refined",
                            "The answers of Problem.refine: that of the last mesh, and what each "
                            "mesh did.")
      .def_prop_ro(
          "status", [](const RefinedAnswer& r) { return ocp::to_string(r.answer.status); },
          doc::ocp_RefineStatus)
      .def_prop_ro(
          "converged",
          [](const RefinedAnswer& r) { return r.answer.status == ocp::RefineStatus::converged; },
          doc::ocp_RefineStatus_converged)
      .def_ro("solution", &RefinedAnswer::solution, doc::ocp_Refined_solution)
      .def_prop_ro(
          "errors",
          [](const RefinedAnswer& r) {
            const bool none = r.answer.errors.interval.empty();
            return none ? std::optional<ocp::ErrorEstimate>() : r.answer.errors;
          },
          "The re-integrated errors of that solution; None where no mesh was solved.")
      .def_prop_ro(
          "meshes", [](const RefinedAnswer& r) { return r.answer.meshes; },
          "One record a mesh that was solved.")
      .def(
          "table", [](const RefinedAnswer& r) { return r.answer.table(); }, doc::ocp_Refined_table)
      .def("__repr__", [](const RefinedAnswer& r) {
        return "<Refined: " + std::string(ocp::to_string(r.answer.status)) + " after " +
               std::to_string(r.answer.meshes.size()) + " meshes>";
      });
}

void bind_refine(nb::class_<Problem>& type) {
  const ocp::RefineRules defaults;
  type.def("refine", &refine, nb::kw_only(), "tolerance"_a = defaults.tolerance,
           "refinement"_a = "h", "max_meshes"_a = defaults.max_meshes,
           "max_size"_a = defaults.max_size, "min_points"_a = defaults.min_points,
           "max_points"_a = defaults.max_points, "mesh"_a = 40, "scheme"_a = "hermite_simpson",
           "points"_a = 4, "backend"_a = "", "guess"_a = nb::none(), "warm_start"_a = nb::none(),
           "options"_a,
           "Solves on one mesh after another, each from the last one's polynomials, until every\n"
           "interval's error, found by re-integration, is within `tolerance`. `refinement` \"h\" "
           "cuts\nintervals, \"hp\" raises the degree of lgr, lgr_differential or lgl up to "
           "`max_points`, then\ncuts into intervals of `min_points`; no more than `max_meshes` "
           "meshes, none of more than\n`max_size` points. The other keywords are those of solve, "
           "for the first mesh.");
}

/// The solver's options as rows of a table.
nb::typed<nb::list, ByName<nb::any>> option_rows() {
  nb::list rows;
  const nlp::Options defaults;
  for (const auto& entry : nlp::solver_options().entries()) {
    if (entry.info.name == "warm_start") continue;  // a Solution here
    nb::dict row;
    row["name"] = entry.info.name;
    std::visit([&](const auto& value) { row["default"] = nb::cast(value); }, entry.get(defaults));
    row["unit"] = entry.info.unit;
    row["rule"] = entry.info.kind == OptionKind::choice ? nb::object(nb::cast(entry.info.choices))
                                                        : nb::cast(entry.info.range.to_string());
    row["meaning"] = entry.info.doc;
    rows.append(row);
  }
  return rows;
}

}  // namespace

void bind_solve(nb::module_& module) {
  bind_refined(module);
  auto type = nb::borrow<nb::class_<Problem>>(module.attr("Problem"));
  type.def("solve", &solve, nb::kw_only(), "mesh"_a = 40, "scheme"_a = "hermite_simpson",
           "points"_a = 4, "backend"_a = "", "guess"_a = nb::none(), "warm_start"_a = nb::none(),
           "options"_a,
           "Transcribes, solves and checks.\n\n"
           "`mesh` is a number of intervals, or breakpoints from 0 to 1; `scheme` one of "
           "scheme_names(), with\n`points` an interval where it has a choice, each one for all or "
           "a list of one an interval.\n\n"
           "`guess` is an earlier Solution, on whatever mesh, or a dict over straight lines: by "
           "name a number,\nnumbers from t0 to tf (two make a line; at the times \"t\" if these "
           "are given) or a function of an\narray of times, and \"t0\", \"tf\". `warm_start` is an "
           "earlier Solution on the same mesh, whose\nmultipliers are used too.\n\n"
           "Other keywords are the solver's options, such as tol and max_iterations: "
           "solver_options().\nRaises InvalidValue for set-up errors; how the solve ended is in "
           "the Solution.");
  bind_refine(type);
  module.def(
      "scheme_names", [] { return ocp::scheme_names(); }, doc::ocp_scheme_names);
  module.def("backends", &nlp::backends, doc::nlp_backends);
  module.def("solver_options", &option_rows,
             "The keywords that solve takes besides its own: a dict each, with name, default, "
             "unit, rule and\nmeaning.");
}

}  // namespace slalom::python
