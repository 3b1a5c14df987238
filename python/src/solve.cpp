#include "slalom/ocp/solve.hpp"
#include "slalom/ocp/starts.hpp"

#include <cstdint>
#include <memory>
#include <string>

#include "binding.hpp"
#include "running.hpp"
#include "settings.hpp"
#include "slalom/base/error.hpp"
#include "slalom/base/options.hpp"
#include "solved.hpp"

namespace slalom::python {
namespace {

using ocp::Problem;

Solved solve(const Problem& problem, const MeshChoice& mesh, const SchemeChoice& scheme,
             const PointsChoice& points, const std::string& backend, const nb::object& guess,
             const Solved* warm_start, int starts, std::uint64_t seed, const nb::kwargs& options) {
  auto settings = settings_of(problem, {mesh, scheme, points}, backend, guess, warm_start, options,
                              {"starts", "seed"});
  const auto as_then = std::make_shared<const Problem>(problem);
  auto [answers, elapsed] = run_released(
      settings.options, [&] { return ocp::solve_from_several(*as_then, settings, starts, seed); });
  const std::size_t best = ocp::best_of(answers);
  std::vector<Solved> all;
  for (auto& answer : answers) {
    Solved& one = all.emplace_back();
    one.problem = as_then;
    one.answer = std::move(answer);
    one.elapsed_s = elapsed;
    forget_stop(one.answer.options);
  }
  Solved solved = all[best];
  warn_of(problem, solved.answer);
  if (starts > 1) solved.starts = std::move(all);
  return solved;
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
  auto type = nb::borrow<nb::class_<Problem>>(module.attr("Problem"));
  type.def(
      "solve", &solve, nb::kw_only(), "mesh"_a = 40, "scheme"_a = "hermite_simpson",
      "points"_a = nb::none(), "backend"_a = "", "guess"_a = nb::none(),
      "warm_start"_a = nb::none(), "starts"_a = 1, "seed"_a = 1, "options"_a,
      "Transcribes, solves and checks.\n\n"
      "`mesh` is a number of intervals, or breakpoints from 0 to 1; `scheme` one of "
      "scheme_names(), with\n`points` for each interval where it has a choice (4 if not given); "
      "each is one "
      "value for all or a list with\none for each interval.\n\n"
      "`guess` is an earlier Solution on whatever mesh, or a Simulation, by name; or a dict "
      "over straight\nlines: by name a number, numbers from t0 to tf (two make a line; at the "
      "times \"t\" if these are\ngiven) or a function of an array of times, and \"t0\", "
      "\"tf\". `warm_start` is an earlier Solution on\nwhatever mesh, whose multipliers are "
      "used too; it beats the guess.\n\n"
      "With several `starts`, the guess is moved at random for all but the first; the best answer "
      "is returned\n(solved, with the least objective), and its `starts` has all. The same `seed` "
      "gives the "
      "same starts.\n\n"
      "Other keywords are the solver's options, such as tol and max_iterations: "
      "solver_options().\nRaises InvalidValue for set-up errors; how the solve ended is in "
      "the Solution.");
  module.def(
      "scheme_names", [] { return ocp::scheme_names(); }, doc::ocp_scheme_names);
  module.def("backends", &nlp::backends, doc::nlp_backends);
  module.def("solver_options", &option_rows,
             "The keywords that solve takes besides its own: a dict each, with name, default, "
             "unit, rule and\nmeaning.");
}

}  // namespace slalom::python
