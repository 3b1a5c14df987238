#include <string>

#include "binding.hpp"
#include "slalom/nlp/check.hpp"
#include "slalom/ocp/solve.hpp"
#include "solved.hpp"

namespace slalom::python {
namespace {

/// One array a name.
nb::dict columns(const std::vector<std::string>& names, const Solved& s,
                 std::vector<double> (ocp::Solution::*get)(const std::string&) const) {
  nb::dict result;
  for (const auto& name : names) result[name.c_str()] = to_numpy((s.answer.*get)(name));
  return result;
}

std::string text(const Solved& s) {
  return "<Solution: " + std::string(nlp::to_string(s.answer.status)) + ", objective " +
         nb::cast<std::string>(nb::repr(nb::float_(s.answer.objective))) + ", " +
         std::to_string(s.answer.iterations) + " iterations>";
}

nb::dict cost_terms(const Solved& s) {
  nb::dict result;
  for (const auto& [name, value] : s.answer.cost_terms) result[name.c_str()] = value;
  return result;
}

/// Calls `function` of a Python module of the package, which needs an extra.
nb::object extra(const char* module, const char* function, nb::handle self,
                 const nb::kwargs& options) {
  return nb::module_::import_(module).attr(function)(self, **options);
}

void bind_outcome(nb::class_<Solved>& type) {
  type.def("__repr__", &text)
      .def_prop_ro(
          "status", [](const Solved& s) { return nlp::to_string(s.answer.status); },
          doc::nlp_Status)
      .def_prop_ro(
          "solved", [](const Solved& s) { return s.answer.solved(); },
          "Whether the solver says so, and the residuals recomputed from the point too.")
      .def_prop_ro("objective", [](const Solved& s) { return s.answer.objective; })
      .def_prop_ro("cost_terms", &cost_terms, doc::ocp_Solution_cost_terms)
      .def_prop_ro("iterations", [](const Solved& s) { return s.answer.iterations; })
      .def_prop_ro(
          "wall_s", [](const Solved& s) { return s.answer.wall_s; },
          "Seconds by the clock in the solver.")
      .def_prop_ro(
          "elapsed_s", [](const Solved& s) { return s.elapsed_s; },
          "Seconds by the clock from transcription to check, all of it outside Python.")
      .def_prop_ro(
          "violation", [](const Solved& s) { return s.answer.residuals.violation; },
          doc::nlp_Residuals_violation)
      .def_prop_ro("worst_constraint",
                   [](const Solved& s) { return s.answer.residuals.worst_constraint; })
      .def_prop_ro(
          "stationarity", [](const Solved& s) { return s.answer.residuals.stationarity; },
          doc::nlp_Residuals_stationarity)
      .def_prop_ro(
          "complementarity", [](const Solved& s) { return s.answer.residuals.complementarity; },
          doc::nlp_Residuals_complementarity)
      .def_prop_ro(
          "fault",
          [](const Solved& s) {
            const auto& fault = s.answer.fault;
            return fault ? fault.function + " at " + fault.where : std::string();
          },
          "The function that gave NaN or infinity, and where; empty if none did.");
}

void bind_trajectory(nb::class_<Solved>& type) {
  using ocp::Solution;
  type.def_prop_ro("t0", [](const Solved& s) { return s.answer.trajectory.t0; })
      .def_prop_ro("tf", [](const Solved& s) { return s.answer.trajectory.tf; })
      .def_prop_ro(
          "t", [](const Solved& s) { return to_numpy(s.answer.time()); }, nb::rv_policy::move,
          doc::ocp_Solution_time)
      .def(
          "state",
          [](const Solved& s, const std::string& n) { return to_numpy(s.answer.state(n)); },
          "name"_a, "Values of a state, one a point of `t`.")
      .def(
          "control",
          [](const Solved& s, const std::string& n) { return to_numpy(s.answer.control(n)); },
          "name"_a, "Values of a control, one a point of `t`.")
      .def(
          "costate",
          [](const Solved& s, const std::string& n) { return to_numpy(s.answer.costate(n)); },
          "state"_a, doc::ocp_Solution_costates)
      .def(
          "static_parameter",
          [](const Solved& s, const std::string& n) { return s.answer.static_parameter(n); },
          "name"_a)
      .def(
          "slack", [](const Solved& s, const std::string& n) { return s.answer.slack(n); },
          "name"_a)
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
          "Costates of all states by name, one number a mesh node.")
      .def(
          "plot",
          [](nb::handle self, const nb::kwargs& options) {
            return extra("slalom._plot", "plot", self, options);
          },
          "options"_a, "Draws states and controls over time; a Matplotlib figure (extra 'plot').")
      .def(
          "to_frame",
          [](nb::handle self, const nb::kwargs& options) {
            return extra("slalom._frame", "to_frame", self, options);
          },
          "options"_a, "States and controls as a pandas DataFrame over time (extra 'frame').");
}

}  // namespace

void bind_solution(nb::module_& module) {
  auto type = nb::class_<Solved>(module, "Solution", doc::ocp_Solution);
  bind_outcome(type);
  bind_trajectory(type);
}

}  // namespace slalom::python
