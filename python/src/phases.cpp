#include "slalom/ocp/phases.hpp"
#include "slalom/ocp/moments.hpp"
#include "slalom/ocp/starts.hpp"

#include <map>
#include <memory>
#include <string>
#include <variant>

#include <nanobind/stl/map.h>
#include <nanobind/stl/shared_ptr.h>

#include "answers.hpp"
#include "binding.hpp"
#include "bounds.hpp"
#include "phased.hpp"
#include "running.hpp"
#include "settings.hpp"
#include "slalom/base/error.hpp"
#include "slalom/base/options.hpp"
#include "solved.hpp"

namespace slalom::python {
namespace {

using ocp::PhasedProblem;
using ocp::PhasedSolution;
using ocp::Problem;

std::size_t phase_number(const PhasedProblem& problem, const std::string& name) {
  std::vector<std::string> names;
  for (std::size_t p = 0; p < problem.phases().size(); ++p) {
    names.push_back(problem.phases()[p].name());
    if (names.back() == name) return p;
  }
  const auto nearest = nearest_name(name, names);
  throw UnknownName({problem.name(), "no phase '" + name + "'",
                     nearest.empty() ? "the name of a phase" : "perhaps '" + nearest + "'"});
}

/// `phases[name][key]` as a T, or `otherwise`.
template <class T>
T choice(const nb::dict& of_phase, const char* key, const T& otherwise) {
  return of_phase.contains(key) ? as<T>(of_phase[key], key, "what solve takes") : otherwise;
}

/// Those for all are for the phases whose scheme has a choice.
PointsChoice points_of(const nb::dict& of_phase, const GridChoice& all) {
  if (of_phase.contains("points") || !of_phase.contains("scheme"))
    return choice(of_phase, "points", all.points);
  return std::nullopt;
}

void check_keys(const nb::dict& of_phase, const std::string& phase) {
  static const std::vector<std::string> known = {"mesh", "scheme", "points", "guess"};
  for (const auto& [key, value] : of_phase) {
    const auto name = as<std::string>(key, "phase " + phase, "words");
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const auto nearest = nearest_name(name, known);
    throw UnknownName(
        {"phase " + phase, "'" + name + "'",
         nearest.empty() ? "mesh, scheme, points or guess" : "perhaps '" + nearest + "'"});
  }
}

std::vector<nb::dict> own_settings(const PhasedProblem& problem, const nb::dict& phases) {
  std::vector<nb::dict> own(problem.phases().size());
  for (const auto& [key, value] : phases) {
    const auto name = as<std::string>(key, "phases", "names of phases");
    auto& settings = own[phase_number(problem, name)];
    settings = as<nb::dict>(value, "phase " + name, "a dict of settings");
    check_keys(settings, name);
  }
  return own;
}

void check_count(const PhasedProblem& problem, const char* what, const PhasedSolved* answer) {
  if (answer != nullptr && answer->phases.size() != problem.phases().size())
    throw InvalidValue(problem.name() + ": " + what,
                       std::to_string(answer->phases.size()) + " phases",
                       std::to_string(problem.phases().size()));
}

void start_warm(const PhasedProblem& problem, const PhasedSolved& answer, PhasedStart& start) {
  bool same = true;
  for (std::size_t p = 0; p < answer.phases.size(); ++p) {
    check_alike(problem.phases()[p], *answer.phases[p].problem);
    same = same && same_grid(answer.phases[p].answer, start.settings.grids[p]);
  }
  if (same) start.settings.warm_start = answer.answer.point;
  start.previous = std::make_unique<const PhasedSolution>(answer.whole());
  start.settings.previous = start.previous.get();
}

}  // namespace

PhasedStart start_of(const PhasedProblem& problem, const GridChoice& all, const nb::dict& phases,
                     const std::string& backend, const PhasedSolved* guess,
                     const PhasedSolved* warm_start, const nb::kwargs& options,
                     const std::vector<std::string>& keywords) {
  check_count(problem, "guess", guess);
  check_count(problem, "warm_start", warm_start);
  const auto own = own_settings(problem, phases);
  PhasedStart start;
  start.settings.backend = backend;
  start.settings.options = options_of(options, keywords);
  for (std::size_t p = 0; p < own.size(); ++p) {
    const Problem& phase = problem.phases()[p];
    const auto grid = grid_of({choice(own[p], "mesh", all.mesh),
                               choice(own[p], "scheme", all.scheme), points_of(own[p], all)},
                              problem.name() + ": phase " + phase.name());
    start.settings.grids.push_back(with_moments(phase, grid));
    const nb::object given = own[p].contains("guess") ? nb::object(own[p]["guess"])
                             : guess != nullptr       ? nb::cast(guess->phases[p])
                                                      : nb::none();
    start.settings.guesses.push_back(guess_of(phase, given));
  }
  if (warm_start != nullptr) start_warm(problem, *warm_start, start);
  return start;
}

PhasedSolved::PhasedSolved(const PhasedProblem& of, PhasedSolution solution, double elapsed)
    : problem(std::make_shared<const PhasedProblem>(of)),
      answer(std::move(solution)),
      elapsed_s(elapsed) {
  forget_stop(answer.options);
  for (std::size_t p = 0; p < of.phases().size(); ++p) {
    Solved& phase = phases.emplace_back();
    phase.problem = std::make_shared<const Problem>(of.phases()[p]);
    phase.answer = std::move(answer.phases[p]);
    phase.elapsed_s = elapsed;
    forget_stop(phase.answer.options);
  }
  answer.phases.clear();
}

PhasedSolution PhasedSolved::whole() const {
  PhasedSolution result = answer;
  for (const auto& phase : phases) result.phases.push_back(phase.answer);
  return result;
}

namespace {

PhasedSolved solve(const Phases& phases_now, const MeshChoice& mesh, const SchemeChoice& scheme,
                   const PointsChoice& points, const ByName<nb::any>& phases,
                   const std::string& backend, const PhasedSolved* guess,
                   const PhasedSolved* warm_start, int starts, std::uint64_t seed,
                   const nb::kwargs& options) {
  const PhasedProblem copy = phases_now.now();
  auto start = start_of(copy, {mesh, scheme, points}, phases, backend, guess, warm_start, options,
                        {"starts", "seed"});
  auto [answers, elapsed] = run_released(start.settings.options, [&] {
    return ocp::solve_from_several(copy, start.settings, starts, seed);
  });
  const std::size_t best = ocp::best_of(answers);
  std::vector<PhasedSolved> all;
  for (auto& answer : answers) all.emplace_back(copy, std::move(answer), elapsed);
  PhasedSolved solved = all[best];
  for (const auto& phase : solved.phases) warn_of(*phase.problem, phase.answer);
  if (starts > 1) solved.starts = std::move(all);
  return solved;
}

/// By how much a state is higher in the later phase.
using Jumps = std::map<std::string, std::variant<double, ocp::Expr>>;

void bind_problem_of_phases(nb::module_& module) {
  static const std::string connect_doc =
      std::string(doc::ocp_PhasedProblem_connect) +
      "\n\n`without` has names of states (or \"time\") that are left alone; `jumps` by state how "
      "much higher it\nis at the start of the later phase, such as {\"m\": -1000} of a mass that "
      "is dropped.";
  nb::class_<Phases>(module, "PhasedProblem", doc::ocp_PhasedProblem)
      .def(nb::init<std::string>(), "name"_a)
      .def_prop_ro("name", [](const Phases& p) { return p.name(); })
      .def(
          "add", &Phases::add_live, "phase"_a,
          "Appends a phase; their names must differ. What is added to it later counts too. Returns "
          "its number,\nfrom 0.")
      .def(
          "replace",
          [](Phases& p, const std::variant<std::size_t, std::string>& which,
             std::shared_ptr<Problem> phase) {
            const auto* number = std::get_if<std::size_t>(&which);
            p.replace_live(number ? *number : phase_number(p, std::get<std::string>(which)),
                           std::move(phase));
          },
          "phase"_a, "problem"_a, doc::ocp_PhasedProblem_replace)
      .def(
          "link",
          [](Phases& p, const std::string& name, const ocp::Expr& value, Limit lower, Limit upper,
             Limit equal) {
            const bool none = !lower && !upper && !equal;
            p.link(name, value, none ? ocp::Bounds::equal(0) : bounds(lower, upper, equal));
          },
          "name"_a, "value"_a, nb::kw_only(), "lower"_a = nb::none(), "upper"_a = nb::none(),
          "equal"_a = nb::none(), doc::ocp_PhasedProblem_link)
      .def(
          "connect",
          [](Phases& p, std::size_t from, std::size_t to, const std::vector<std::string>& without,
             const Jumps& jumps) {
            p.take_over();
            ocp::PhasedProblem::Gaps gaps{without, {}};
            for (const auto& [state, jump] : jumps)
              gaps.jumps.emplace_back(
                  state, std::visit([](const auto& value) { return ocp::Expr(value); }, jump));
            p.connect(from, to, gaps);
          },
          "from_phase"_a, "to_phase"_a, nb::kw_only(), "without"_a = std::vector<std::string>(),
          "jumps"_a = Jumps(), connect_doc.c_str())
      .def(
          "share",
          [](Phases& p, const std::string& name) {
            p.take_over();
            p.share(name);
          },
          "static_parameter"_a, doc::ocp_PhasedProblem_share)
      .def(
          "mayer",
          [](Phases& p, const std::string& name, const ocp::Expr& term, bool maximise) {
            p.mayer(name, maximise ? -term : term);
          },
          "name"_a, "term"_a, nb::kw_only(), "maximise"_a = false,
          (std::string(doc::ocp_PhasedProblem_mayer) + kMaximised).c_str())
      .def("solve", &solve, nb::kw_only(), "mesh"_a = 40, "scheme"_a = "hermite_simpson",
           "points"_a = nb::none(), "phases"_a = nb::dict(), "backend"_a = "",
           "guess"_a = nb::none(), "warm_start"_a = nb::none(), "starts"_a = 1, "seed"_a = 1,
           "options"_a,
           "Transcribes, solves and checks all phases as one problem. The keywords are those of "
           "Problem.solve;\n`phases` has by phase a dict of those that differ there: mesh, scheme, "
           "points, guess. `guess` and\n`warm_start` are earlier PhasedSolutions.");
}

std::string text(const PhasedSolved& s) {
  return "<PhasedSolution: " + std::string(nlp::to_string(s.answer.status)) + ", " +
         std::to_string(s.phases.size()) + " phases, objective " +
         nb::cast<std::string>(nb::repr(nb::float_(s.answer.objective))) + ">";
}

/// A phase by number, from the end if negative, or by name.
const Solved& phase_of(const PhasedSolved& s,
                       const std::variant<std::int64_t, std::string>& which) {
  if (const auto* number = std::get_if<std::int64_t>(&which)) {
    const auto count = static_cast<std::int64_t>(s.phases.size());
    const auto at = *number < 0 ? *number + count : *number;
    if (at < 0 || at >= count) throw nb::index_error("no such phase");
    return s.phases[static_cast<std::size_t>(at)];
  }
  const auto& name = std::get<std::string>(which);
  std::vector<std::string> names;
  for (const auto& phase : s.phases) {
    if (phase.problem->name() == name) return phase;
    names.push_back(phase.problem->name());
  }
  const auto nearest = nearest_name(name, names);
  throw UnknownName({"solution", "no phase '" + name + "'",
                     nearest.empty() ? "the name of a phase" : "perhaps '" + nearest + "'"});
}

void bind_solution_of_phases(nb::module_& module) {
  auto type = nb::class_<PhasedSolved>(module, "PhasedSolution", doc::ocp_PhasedSolution);
  bind_verdict(type);
  type.def("__repr__", &text)
      .def("__len__", [](const PhasedSolved& s) { return s.phases.size(); })
      .def("__getitem__", &phase_of, "phase"_a, nb::rv_policy::reference_internal,
           "The Solution of a phase, by number or by name.")
      .def_ro("phases", &PhasedSolved::phases, doc::ocp_PhasedSolution_phases)
      .def_prop_ro(
          "cost_terms", [](const PhasedSolved& s) { return by_name<double>(s.answer.cost_terms); },
          doc::ocp_PhasedSolution_cost_terms)
      .def_prop_ro(
          "link_multipliers",
          [](const PhasedSolved& s) { return by_name<double>(s.answer.link_multipliers); },
          doc::ocp_PhasedSolution_link_multipliers);
  bind_extras(type,
              "States and controls of all phases over time; a Matplotlib figure (extra 'plot').",
              "States and controls as a pandas DataFrame over phase and time (extra 'frame').");
}

}  // namespace

void bind_phases(nb::module_& module) {
  bind_problem_of_phases(module);
  bind_solution_of_phases(module);
}

}  // namespace slalom::python
