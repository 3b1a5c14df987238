#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "binding.hpp"
#include "settings.hpp"
#include "slalom/base/error.hpp"
#include "slalom/base/options.hpp"
#include "slalom/ocp/simulate.hpp"
#include "solved.hpp"

namespace slalom::python {
namespace {

using ocp::Controls;
using ocp::Problem;

template <class List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  for (const auto& each : list) names.push_back(each.name);
  return names;
}

/// The entries of a dictionary in the order of `names`, all of them and no other.
std::vector<nb::object> in_order(const nb::dict& given, const std::vector<std::string>& names,
                                 const std::string& where) {
  std::vector<nb::object> values;
  for (const auto& name : names) {
    if (!given.contains(name.c_str()))
      throw UnknownName({where, "no '" + name + "'", "a value for each"});
    values.emplace_back(given[name.c_str()]);
  }
  for (const auto& [key, value] : given) {
    const auto name = as<std::string>(key, where, "names");
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    const auto nearest = nearest_name(name, names);
    throw UnknownName({where, "'" + name + "'",
                       nearest.empty() ? "a name of the problem" : "perhaps '" + nearest + "'"});
  }
  return values;
}

std::vector<double> begin_of(const Problem& problem, const nb::object& given) {
  const std::string where = problem.name() + ": x0";
  if (!nb::isinstance<nb::dict>(given))
    return as<std::vector<double>>(given, where, "a dict by name, or numbers");
  std::vector<double> values;
  for (const auto& value : in_order(nb::cast<nb::dict>(given), names_of(problem.states()), where))
    values.push_back(as<double>(value, where, "numbers"));
  return values;
}

/// Of each control a number or a function of time.
Controls by_name(const Problem& problem, const nb::dict& given) {
  const std::string where = problem.name() + ": controls";
  const auto values = in_order(given, names_of(problem.controls()), where);
  return ocp::controls_of_time([values, where](double t) {
    const nb::gil_scoped_acquire lock;
    std::vector<double> u;
    for (const auto& value : values)
      u.push_back(as<double>(PyCallable_Check(value.ptr()) != 0 ? value(t) : value, where,
                             "numbers, or functions of time that give them"));
    return u;
  });
}

Controls controls_of(const Problem& problem, const nb::object& given) {
  if (nb::isinstance<Solved>(given)) {
    const auto& solved = nb::cast<const Solved&>(given);
    return ocp::controls_of(*solved.problem, solved.answer);
  }
  if (nb::isinstance<nb::dict>(given)) return by_name(problem, nb::cast<nb::dict>(given));
  const std::string where = problem.name() + ": controls";
  if (PyCallable_Check(given.ptr()) == 0)
    return ocp::constant_controls(as<std::vector<double>>(
        given, where, "a Solution, a dict by name, numbers, or a function of t and states"));
  return {[given, where](double t, std::span<const double> x) {
            const nb::gil_scoped_acquire lock;
            const auto u = given(t, to_numpy(std::vector<double>(x.begin(), x.end())));
            return as<std::vector<double>>(u, where, "a number for each control");
          },
          {}};
}

Simulated simulate(const Problem& problem, const nb::object& x0, const nb::object& controls,
                   std::optional<double> t0, std::optional<double> tf, int steps,
                   double tolerance) {
  check_at_most(steps, 1'000'000, problem.name() + ": simulate: steps");
  Simulated result;
  result.problem = std::make_shared<const Problem>(problem);
  const auto begin = begin_of(problem, x0);
  const Controls driven = controls_of(problem, controls);
  Released released;
  {
    const nb::gil_scoped_release unlock;
    result.answer = ocp::simulate(
        *result.problem, begin, driven,
        {.t0 = t0, .tf = tf, .steps = steps, .tolerance = tolerance, .stop = [&released] {
           return released.interrupted();
         }});
  }
  released.raise_if_interrupted();
  return result;
}

template <class List>
ByName<Vector> columns(const List& list, const std::vector<std::vector<double>>& rows) {
  nb::dict result;
  for (std::size_t i = 0; i < list.size(); ++i) {
    std::vector<double> column;
    for (const auto& row : rows) column.push_back(row[i]);
    result[list[i].name.c_str()] = to_numpy(column);
  }
  return result;
}

}  // namespace

void bind_simulation(nb::module_& module) {
  nb::class_<Simulated>(module, "Simulation", doc::ocp_Simulation)
      .def_prop_ro(
          "t",
          [](const Simulated& s) {
            std::vector<double> times;
            for (std::size_t k = 0; k < s.answer.trajectory.tau.size(); ++k)
              times.push_back(s.answer.trajectory.time(k));
            return to_numpy(times);
          },
          nb::rv_policy::move, "The times of the points.")
      .def_prop_ro(
          "states",
          [](const Simulated& s) {
            return columns(s.problem->states(), s.answer.trajectory.states);
          },
          "Values of all states by name.")
      .def_prop_ro(
          "controls",
          [](const Simulated& s) {
            return columns(s.problem->controls(), s.answer.trajectory.controls);
          },
          "Values of all controls by name.")
      .def_prop_ro(
          "complete", [](const Simulated& s) { return s.answer.complete; },
          doc::ocp_Simulation_complete)
      .def_prop_ro(
          "message", [](const Simulated& s) { return s.answer.message; },
          doc::ocp_Simulation_message);
  nb::borrow<nb::class_<Problem>>(module.attr("Problem"))
      .def(
          "simulate", &simulate, "x0"_a, "controls"_a, nb::kw_only(), "t0"_a = nb::none(),
          "tf"_a = nb::none(), "steps"_a = 100, "tolerance"_a = 1e-9,
          "Integrates the dynamics from x0, a dict by name or numbers in the order of the states. "
          "`controls`\nare a Solution's, a dict by name of numbers and functions of time, numbers, "
          "or a function of t and\nthe array of states. `t0` and `tf` are the problem's guesses if "
          "left out; `steps` equal steps lie\nbetween the points; `tolerance` is of the "
          "integrator, relative and in units of the states' scales.\nA Simulation may be a guess.");
}

}  // namespace slalom::python
