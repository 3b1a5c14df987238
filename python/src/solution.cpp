#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "answers.hpp"
#include "binding.hpp"
#include "slalom/base/options.hpp"
#include "slalom/ocp/solve.hpp"
#include "slalom/ocp/values.hpp"
#include "solved.hpp"

namespace slalom::python {
namespace {

/// One array a name.
ByName<Vector> columns(const std::vector<std::string>& names, const Solved& s,
                       std::vector<double> (ocp::Solution::*get)(const std::string&) const) {
  nb::dict result;
  for (const auto& name : names) result[name.c_str()] = to_numpy((s.answer.*get)(name));
  return result;
}

std::string number(double value) {
  return nb::cast<std::string>(nb::repr(nb::float_(value)));
}

std::string text(const Solved& s) {
  return "<Solution: " + std::string(nlp::to_string(s.answer.status)) + ", objective " +
         nb::cast<std::string>(nb::repr(nb::float_(s.answer.objective))) + ", " +
         std::to_string(s.answer.iterations) + " iterations>";
}

std::vector<double> nodes(const Solved& s) {
  std::vector<double> times;
  for (const double tau : s.answer.mesh.breakpoints())
    times.push_back(s.answer.trajectory.time_at(tau));
  return times;
}

std::vector<std::pair<std::string, std::size_t>> schemes(const Solved& s) {
  std::vector<std::pair<std::string, std::size_t>> list;
  for (std::size_t k = 0; k < s.answer.mesh.intervals(); ++k)
    list.emplace_back(s.answer.scheme.of(k).name, s.answer.scheme.of(k).points.size());
  return list;
}

double integral(const Solved& s, const std::string& name) {
  std::vector<std::string> names;
  const auto& integrals = s.problem->integrals();
  for (std::size_t i = 0; i < integrals.size(); ++i) {
    if (integrals[i].name == name) return s.answer.trajectory.integrals[i];
    names.push_back(integrals[i].name);
  }
  const auto nearest = nearest_name(name, names);
  throw UnknownName({"solution", "no integral '" + name + "'",
                     nearest.empty() ? "a name of an integral" : "perhaps '" + nearest + "'"});
}

/// One look-up of what C++ has by name at some points.
template <class Item>
nb::any item(const Solved& s, const Item& found) {
  return nb::borrow<nb::any>(
      over_points(s.answer.trajectory.tau.size(), found.points, found.values));
}

ByName<nb::any> multipliers(const Solved& s) {
  nb::dict result;
  for (const auto& each : s.answer.multipliers) result[each.name.c_str()] = item(s, each);
  return result;
}

/// Puts the numbers of each name at `times` beside it, in the shape of `times`.
void put(const std::vector<std::string>& names, const std::vector<std::vector<double>>& rows,
         const nb::object& shape, nb::dict& result) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::vector<double> numbers;
    numbers.reserve(rows.size());
    for (const auto& row : rows) numbers.push_back(row[i]);
    result[names[i].c_str()] = nb::len(shape) == 0
                                   ? nb::object(nb::float_(numbers.front()))
                                   : nb::cast(to_numpy(numbers)).attr("reshape")(shape);
  }
}

/// Times as an array of any shape, and in a row.
struct Times {
  nb::object shape;
  std::vector<double> values;
};

/// Of what the user gave. Warns of those beyond t0 ... tf by more than rounding, unless `hold`.
Times times_of(const Solved& s, const nb::object& t, bool hold) {
  const nb::module_ numpy = nb::module_::import_("numpy");
  const nb::object array = numpy.attr("asarray")(t, "dtype"_a = "float64");
  Times times{array.attr("shape"), nb::cast<std::vector<double>>(array.attr("ravel")())};
  const auto& at = s.answer.trajectory;
  const double room =
      1e-9 * std::max({std::fabs(at.t0), std::fabs(at.tf), std::fabs(at.tf - at.t0)});
  bool beyond = false;
  for (const double time : times.values) {
    if (std::isnan(time)) throw InvalidValue("solution", "the time NaN", "numbers");
    beyond = beyond || time < at.t0 - room || time > at.tf + room;
  }
  if (beyond && !hold)
    warn("times beyond " + number(at.t0) + " to " + number(at.tf) +
         " have the nearer end's values; hold=True says that this is meant");
  return times;
}

/// What an expression comes to.
nb::any value(const Solved& s, const ocp::Expr& expression, const std::optional<nb::object>& t,
              bool hold) {
  if (!t || t->is_none()) {
    const auto list = ocp::values(*s.problem, s.answer, expression);
    if (ocp::changes_over_time(*s.problem, expression))
      return nb::borrow<nb::any>(nb::cast(to_numpy(list)));
    return nb::borrow<nb::any>(nb::float_(list.front()));
  }
  const auto times = times_of(s, *t, hold);
  const auto list = ocp::values(*s.problem, s.answer, expression, times.values);
  if (nb::len(times.shape) == 0) return nb::borrow<nb::any>(nb::float_(list.front()));
  return nb::borrow<nb::any>(nb::cast(to_numpy(list)).attr("reshape")(times.shape));
}

/// States and controls at the times `t`, a number or an array of any shape.
ByName<nb::any> at(const Solved& s, const nb::object& t, bool hold) {
  const auto [shape, times] = times_of(s, t, hold);
  std::vector<std::vector<double>> states, controls;
  for (const double time : times) {
    states.push_back(s.between().states(time));
    controls.push_back(s.between().controls(time));
  }
  nb::dict result;
  put(s.answer.state_names, states, shape, result);
  put(s.answer.control_names, controls, shape, result);
  return result;
}

void bind_outcome(nb::class_<Solved>& type) {
  bind_verdict(type);
  type.def("__repr__", &text)
      .def_prop_ro(
          "name", [](const Solved& s) { return s.problem->name(); }, "The problem's name.")
      .def_prop_ro(
          "cost_terms", [](const Solved& s) { return by_name<double>(s.answer.cost_terms); },
          doc::ocp_Solution_cost_terms);
}

void bind_trajectory(nb::class_<Solved>& type) {
  const auto multiplier_doc = std::string(doc::ocp_Multipliers) +
                              " One number a point of `t`, or of what has one value a " +
                              "number.\n\n" + doc::ocp_Multipliers_values +
                              "\n\nIts name: " + doc::ocp_Multipliers_name;
  using ocp::Solution;
  type.def_prop_ro("t0", [](const Solved& s) { return s.answer.trajectory.t0; })
      .def_prop_ro("tf", [](const Solved& s) { return s.answer.trajectory.tf; })
      .def_prop_ro(
          "mesh", [](const Solved& s) { return to_numpy(s.answer.mesh.breakpoints()); },
          nb::rv_policy::move, doc::ocp_Mesh)
      .def_prop_ro("schemes", &schemes, "The scheme of each interval of the mesh: name and points.")
      .def_prop_ro(
          "nodes", [](const Solved& s) { return to_numpy(nodes(s)); }, nb::rv_policy::move,
          "Times of the mesh nodes, where costates and the Hamiltonian stand.")
      .def("__call__", &at, "t"_a, nb::kw_only(), "hold"_a = false,
           "States and controls at any time or array of times by name, on the scheme's own "
           "polynomials;\nbeyond t0 ... tf the nearer end's values, with a warning unless `hold`.")
      .def("value", &value, "expression"_a, "t"_a = nb::none(), nb::kw_only(), "hold"_a = false,
           "What an expression of the problem's symbols comes to: one number a point of `t`, or at "
           "the times\ngiven; of ends, times and parameters alone, a number.")
      .def_prop_ro(
          "scales", [](const Solved& s) { return by_name<double>(s.answer.scales); },
          doc::ocp_Solution_scales)
      .def_prop_ro(
          "high_index", [](const Solved& s) { return by_name<int>(s.answer.high_index); },
          doc::ocp_Solution_high_index)
      .def_prop_ro(
          "kinks", [](const Solved& s) { return s.answer.kinks; }, doc::ocp_Solution_kinks)
      .def_prop_ro(
          "beyond_tables", [](const Solved& s) { return by_name<double>(s.answer.beyond_tables); },
          doc::ocp_Solution_beyond_tables)
      .def_prop_ro(
          "t", [](const Solved& s) { return to_numpy(s.answer.time()); }, nb::rv_policy::move,
          doc::ocp_Solution_time)
      .def(
          "state",
          [](const Solved& s, const std::string& n) {
            return to_numpy(named([&] { return s.answer.state(n); }));
          },
          "name"_a, "Values of a state, one for each point of `t`.")
      .def(
          "control",
          [](const Solved& s, const std::string& n) {
            return to_numpy(named([&] { return s.answer.control(n); }));
          },
          "name"_a, "Values of a control, one for each point of `t`.")
      .def(
          "costate",
          [](const Solved& s, const std::string& n) {
            return to_numpy(named([&] { return s.answer.costate(n); }));
          },
          "state"_a, doc::ocp_Solution_costates)
      .def(
          "static_parameter",
          [](const Solved& s, const std::string& n) {
            return named([&] { return s.answer.static_parameter(n); });
          },
          "name"_a, "The value of a static parameter.")
      .def(
          "slack",
          [](const Solved& s, const std::string& n) {
            return named([&] { return s.answer.slack(n); });
          },
          "name"_a, "The value of a slack.")
      .def(
          "multiplier",
          [](const Solved& s, const std::string& n) {
            return item(s, named([&] { return s.answer.multiplier(n); }));
          },
          "name"_a, multiplier_doc.c_str())
      .def_prop_ro("multipliers", &multipliers, "Those of all constraints and bounds by name.")
      .def(
          "excess",
          [](const Solved& s, const std::string& n) {
            return item(s, named([&] { return s.answer.excess(n); }));
          },
          "constraint"_a, doc::ocp_Excesses)
      .def("integral", &integral, "name"_a, "The value of an integral.")
      .def_prop_ro(
          "states",
          [](const Solved& s) { return columns(s.answer.state_names, s, &Solution::state); },
          "Values of all states by name.")
      .def_prop_ro(
          "controls",
          [](const Solved& s) { return columns(s.answer.control_names, s, &Solution::control); },
          "Values of all controls by name.")
      .def_prop_ro(
          "costates",
          [](const Solved& s) { return columns(s.answer.state_names, s, &Solution::costate); },
          "Costates of all states by name, one number a mesh node.");
  bind_extras(type, "States and controls over time; a Matplotlib figure (extra 'plot').",
              "States and controls as a pandas DataFrame over time (extra 'frame').");
}

}  // namespace

void warn_of(const ocp::Problem& problem, const ocp::Solution& answer) {
  for (const auto& [row, index] : answer.high_index)
    warn(problem.name() + ": the equation '" + row + "' is of index " + std::to_string(index) +
         ": controls meet it in derivative " + std::to_string(index - 1) +
         " alone; hold that derivative instead, and the equation and its lower derivatives at t0");
  for (const auto& cost : answer.kinks)
    warn(problem.name() + ": the cost '" + cost +
         "' has a kink (abs, max or min), at which a solve can go to and fro; smooth_kinks() of "
         "the problem states the same cost without it");
  for (const auto& [term, by] : answer.beyond_tables)
    warn(problem.name() + ": " + term + " uses a table up to " + number(by) +
         " beyond its ends, where it goes on as a line; beyond=\"hold\" holds its value there");
}

void bind_solution(nb::module_& module) {
  auto type = nb::class_<Solved>(module, "Solution", doc::ocp_Solution);
  bind_outcome(type);
  bind_trajectory(type);
}

}  // namespace slalom::python
