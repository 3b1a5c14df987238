#include "slalom/ocp/solve.hpp"

#include <nanobind/stl/variant.h>

#include <algorithm>
#include <string>
#include <variant>

#include "binding.hpp"
#include "slalom/base/error.hpp"
#include "slalom/base/options.hpp"
#include "slalom/base/timer.hpp"
#include "slalom/ocp/transcription.hpp"
#include "solved.hpp"

namespace slalom::python {
namespace {

using MeshChoice = std::variant<int, std::vector<double>>;

ocp::Mesh mesh_of(const MeshChoice& choice) {
  if (const auto* intervals = std::get_if<int>(&choice)) return ocp::Mesh::uniform(*intervals);
  return ocp::Mesh(std::get<std::vector<double>>(choice));
}

OptionValue option_value(nb::handle value, const std::string& name) {
  if (nb::isinstance<nb::bool_>(value)) return nb::cast<bool>(value);
  if (nb::isinstance<nb::int_>(value)) return nb::cast<std::int64_t>(value);
  if (nb::isinstance<nb::str>(value)) return nb::cast<std::string>(value);
  double number = 0;
  if (nb::try_cast(value, number)) return number;
  throw nb::type_error(("option " + name + ": a number, a word or a truth value").c_str());
}

/// Keyword arguments by the table of the solver's options.
nlp::Options options_of(const nb::kwargs& given) {
  nlp::Options options;
  const auto& table = nlp::solver_options();
  for (const auto& [key, value] : given) {
    const auto name = nb::cast<std::string>(key);
    const auto* entry = table.find(name);
    if (entry == nullptr) {
      std::vector<std::string> names = {"mesh", "scheme", "points", "backend", "guess"};
      for (const auto& each : table.entries()) names.push_back(each.info.name);
      const auto nearest = nearest_name(name, names);
      throw InvalidValue("solve", "option '" + name + "'",
                         nearest.empty() ? std::string("an option of docs/solver-options.md")
                                         : "perhaps '" + nearest + "'");
    }
    table.set(options, *entry, option_value(value, name), "solve: " + name);
  }
  return options;
}

std::vector<double> numbers_at(nb::handle given, const std::vector<double>& times,
                               const std::string& name) {
  nb::object value = nb::borrow(given);
  if (PyCallable_Check(value.ptr()) != 0) value = value(to_numpy(times));
  double constant = 0;
  if (nb::try_cast(value, constant)) return std::vector<double>(times.size(), constant);
  std::vector<double> numbers;
  if (!nb::try_cast(value, numbers))
    throw nb::type_error(("guess of " + name + ": a number, numbers, or a function of t").c_str());
  if (numbers.size() != times.size())
    throw InvalidValue("guess of " + name, std::to_string(numbers.size()) + " numbers",
                       std::to_string(times.size()) + ", one a time");
  return numbers;
}

std::size_t points_of_straight(const nb::dict& guess) {
  return guess.contains("t") ? nb::len(nb::object(guess["t"])) : 101;
}

template <class List>
bool overwrite(const List& variables, const std::string& name, const std::vector<double>& numbers,
               std::vector<std::vector<double>>& rows) {
  for (std::size_t i = 0; i < variables.size(); ++i)
    if (variables[i].name == name) {
      for (std::size_t k = 0; k < rows.size(); ++k) rows[k][i] = numbers[k];
      return true;
    }
  return false;
}

/// What a transcription guesses by itself, at `points` equal steps: its first and last point, lines
/// between.
ocp::Trajectory straight(const ocp::Problem& problem, std::size_t points) {
  const auto ends =
      ocp::Transcription(problem, ocp::Mesh::uniform(1), ocp::trapezoidal()).straight_guess();
  ocp::Trajectory guess = ends;
  guess.tau.clear();
  guess.states.clear();
  guess.controls.clear();
  for (std::size_t k = 0; k < points; ++k) {
    const double tau = points > 1 ? static_cast<double>(k) / (points - 1) : 0;
    const auto between = [tau](std::vector<double> a, const std::vector<double>& b) {
      for (std::size_t i = 0; i < a.size(); ++i) a[i] += tau * (b[i] - a[i]);
      return a;
    };
    guess.tau.push_back(tau);
    guess.states.push_back(between(ends.states.front(), ends.states.back()));
    guess.controls.push_back(between(ends.controls.front(), ends.controls.back()));
  }
  return guess;
}

/// Straight lines, overwritten by what a dictionary has: "t", times from t0 to tf; "tf"; and each
/// variable's number, numbers (one a time of "t") or function of times.
ocp::Trajectory guess_of(const ocp::Problem& problem, const nb::dict& given) {
  auto guess = straight(problem, points_of_straight(given));
  if (given.contains("tf")) guess.tf = nb::cast<double>(given["tf"]);
  if (given.contains("t")) {
    const auto t = nb::cast<std::vector<double>>(given["t"]);
    if (t.size() < 2 || !(t.back() > t.front()))
      throw InvalidValue("guess", "times that span nothing", "rising times from t0 to tf");
    guess.t0 = t.front();
    guess.tf = t.back();
    for (std::size_t k = 0; k < t.size(); ++k)
      guess.tau[k] = (t[k] - guess.t0) / (guess.tf - guess.t0);
    guess.tau.back() = 1;
  }
  std::vector<double> times;
  for (std::size_t k = 0; k < guess.tau.size(); ++k) times.push_back(guess.time(k));
  for (const auto& [key, value] : given) {
    const auto name = nb::cast<std::string>(key);
    if (name == "t" || name == "tf") continue;
    const auto numbers = numbers_at(value, times, name);
    if (overwrite(problem.states(), name, numbers, guess.states) ||
        overwrite(problem.controls(), name, numbers, guess.controls))
      continue;
    std::vector<std::string> names;
    for (const auto& each : problem.states()) names.push_back(each.name);
    for (const auto& each : problem.controls()) names.push_back(each.name);
    const auto nearest = nearest_name(name, names);
    throw InvalidValue("guess", "'" + name + "'",
                       nearest.empty() ? std::string("a state, a control, 't' or 'tf'")
                                       : "perhaps '" + nearest + "'");
  }
  return guess;
}

Solved solve(const ocp::Problem& problem, const MeshChoice& mesh, const std::string& scheme,
             int points, const std::string& backend, nb::object guess, const nb::kwargs& options) {
  ocp::SolveSettings settings;
  settings.mesh = mesh_of(mesh);
  settings.scheme = ocp::scheme(scheme, points);
  settings.backend = backend;
  settings.options = options_of(options);
  if (nb::isinstance<Solved>(guess))
    settings.guess = nb::cast<const Solved&>(guess).answer.trajectory;
  else if (!guess.is_none())
    settings.guess = guess_of(problem, nb::cast<nb::dict>(guess));
  Solved solved;
  Released released;
  settings.options.stop = [](void* data) { return static_cast<Released*>(data)->interrupted(); };
  settings.options.stop_data = &released;
  {
    const nb::gil_scoped_release unlock;
    const Timer timer;
    solved.answer = ocp::solve(problem, settings);
    solved.elapsed_s = timer.wall();
  }
  released.raise_if_interrupted();
  return solved;
}

}  // namespace

void bind_solve(nb::module_& module) {
  nb::borrow<nb::class_<ocp::Problem>>(module.attr("Problem"))
      .def(
          "solve", &solve, nb::kw_only(), "mesh"_a = 40, "scheme"_a = "hermite_simpson",
          "points"_a = 4, "backend"_a = "", "guess"_a = nb::none(), "options"_a,
          "Transcribes, solves and checks. `mesh` is a number of intervals, or breakpoints from 0 "
          "to 1;\n`scheme` one of scheme_names(), with `points` an interval where it has a choice; "
          "`guess` an earlier\nSolution, or a dict of \"t\", \"tf\" and by name a number, numbers "
          "at \"t\" or a function of times.\nOther keywords are the solver's options, such as tol "
          "and max_iterations. Raises InvalidValue\nfor set-up errors; how the solve ended is in "
          "the Solution.");
  module.def(
      "scheme_names", [] { return ocp::scheme_names(); }, doc::ocp_scheme_names);
  module.def("backends", &nlp::backends, doc::nlp_backends);
}

}  // namespace slalom::python
