#include "slalom/ocp/sensitivity.hpp"

#include <nanobind/stl/map.h>
#include <nanobind/stl/variant.h>

#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "answers.hpp"
#include "binding.hpp"
#include "phased.hpp"
#include "solved.hpp"

namespace slalom::python {
namespace {

using ocp::PhasedSensitivity;
using ocp::Problem;
using ocp::Sensitivity;

/// A problem with other numbers, or some of its numbers by name.
using Numbers = std::map<std::string, double>;
using Changed = std::variant<Problem, Numbers>;
using ChangedPhases = std::variant<Phases, Numbers>;

/// The problem that was solved, with those numbers.
template <class Solved>
auto with_numbers(const Solved& s, const Numbers& numbers) {
  return named([&] { return ocp::with_numbers(*s.problem, {numbers.begin(), numbers.end()}); });
}

Solved predict(const Solved& s, const Changed& changed) {
  Solved predicted;
  const auto* given = std::get_if<Problem>(&changed);
  predicted.problem = std::make_shared<const Problem>(
      given != nullptr ? *given : with_numbers(s, std::get<Numbers>(changed)));
  predicted.answer = s.sensitivities().predict(*predicted.problem);
  return predicted;
}

PhasedSolved predict_phases(const PhasedSolved& s, const ChangedPhases& changed) {
  const auto* given = std::get_if<Phases>(&changed);
  const ocp::PhasedProblem problem =
      given != nullptr ? given->now() : with_numbers(s, std::get<Numbers>(changed));
  return {problem, s.sensitivities().predict(problem), 0};
}

template <class Get>
ByName<Vector> columns(const std::vector<std::string>& names, const Get& get) {
  nb::dict result;
  for (const auto& name : names) result[name.c_str()] = to_numpy(get(name));
  return result;
}

nb::any multiplier(const Sensitivity& s, const ocp::Multipliers& found) {
  return nb::borrow<nb::any>(over_points(s.trajectory.tau.size(), found.points, found.values));
}

ByName<nb::any> multipliers(const Sensitivity& s) {
  nb::dict result;
  for (const auto& each : s.multipliers) result[each.name.c_str()] = multiplier(s, each);
  return result;
}

void bind_rates(nb::class_<Sensitivity>& type) {
  type.def_prop_ro(
          "t0", [](const Sensitivity& s) { return s.trajectory.t0; },
          "The derivative of the initial time.")
      .def_prop_ro("tf", &Sensitivity::tf, "The derivative of the final time.")
      .def(
          "state",
          [](const Sensitivity& s, const std::string& n) {
            return to_numpy(named([&] { return s.state(n); }));
          },
          "name"_a, "The derivative of a state, one number for each point of the solution's `t`.")
      .def(
          "control",
          [](const Sensitivity& s, const std::string& n) {
            return to_numpy(named([&] { return s.control(n); }));
          },
          "name"_a, "The derivative of a control, one number for each point of the solution's `t`.")
      .def(
          "static_parameter",
          [](const Sensitivity& s, const std::string& n) {
            return named([&] { return s.static_parameter(n); });
          },
          "name"_a, "The derivative of a static parameter.")
      .def(
          "slack",
          [](const Sensitivity& s, const std::string& n) {
            return named([&] { return s.slack(n); });
          },
          "name"_a, "The derivative of a slack.")
      .def(
          "integral",
          [](const Sensitivity& s, const std::string& n) {
            return named([&] { return s.integral(n); });
          },
          "name"_a, "The derivative of an integral.")
      .def(
          "multiplier",
          [](const Sensitivity& s, const std::string& n) {
            return multiplier(s, named([&] { return s.multiplier(n); }));
          },
          "name"_a, "The derivative of what Solution.multiplier gives by that name.")
      .def_prop_ro(
          "states",
          [](const Sensitivity& s) {
            return columns(s.state_names, [&](const auto& n) { return s.state(n); });
          },
          "The derivatives of all states, by name.")
      .def_prop_ro(
          "controls",
          [](const Sensitivity& s) {
            return columns(s.control_names, [&](const auto& n) { return s.control(n); });
          },
          "The derivatives of all controls, by name.")
      .def_prop_ro("multipliers", &multipliers,
                   "The derivatives of the multipliers of all constraints and bounds, by name.");
}

void bind_one_phase(nb::module_& module) {
  auto type = nb::class_<Sensitivity>(module, "Sensitivity", doc::ocp_Sensitivity);
  type.def_ro("number", &Sensitivity::number, doc::ocp_Sensitivity_number)
      .def_ro("objective", &Sensitivity::objective, doc::ocp_Sensitivity_objective)
      .def("__repr__", [](const Sensitivity& s) { return "<Sensitivity to " + s.number + ">"; });
  bind_rates(type);
  static const std::string names =
      std::string("Its derivative by one of sensitivity_numbers. ") + doc::ocp_Sensitivities;
  static const std::string predicted =
      std::string(doc::ocp_Sensitivities_predict) +
      "\n\n`changed` is that problem, or a dict of the numbers that differ, by name.";
  nb::borrow<nb::class_<Solved>>(module.attr("Solution"))
      .def(
          "sensitivity",
          [](const Solved& s, const std::string& number) {
            const auto& known = s.sensitivities();
            return named([&] { return known(number); });
          },
          "number"_a, names.c_str())
      .def("predict", &predict, "changed"_a, predicted.c_str())
      .def_prop_ro(
          "sensitivity_numbers",
          [](const Solved& s) { return by_name<double>(ocp::sensitivity_numbers(*s.problem)); },
          doc::ocp_sensitivity_numbers);
}

void bind_several_phases(nb::module_& module) {
  nb::class_<PhasedSensitivity>(module, "PhasedSensitivity", doc::ocp_PhasedSensitivity)
      .def_ro("number", &PhasedSensitivity::number, doc::ocp_Sensitivity_number)
      .def_ro("objective", &PhasedSensitivity::objective, doc::ocp_Sensitivity_objective)
      .def_ro("phases", &PhasedSensitivity::phases, doc::ocp_PhasedSensitivity_phases)
      .def_prop_ro(
          "link_multipliers",
          [](const PhasedSensitivity& s) { return by_name<double>(s.link_multipliers); },
          "The derivatives of the solution's link_multipliers.")
      .def("__repr__",
           [](const PhasedSensitivity& s) { return "<PhasedSensitivity to " + s.number + ">"; });
  nb::borrow<nb::class_<PhasedSolved>>(module.attr("PhasedSolution"))
      .def(
          "sensitivity",
          [](const PhasedSolved& s, const std::string& number) {
            const auto& known = s.sensitivities();
            return named([&] { return known(number); });
          },
          "number"_a,
          "Its derivative by one of sensitivity_numbers, as Solution.sensitivity has it.")
      .def(
          "predict", &predict_phases, "changed"_a,
          "As Solution.predict: the answer to that problem with other numbers, or to a dict of the "
          "numbers\nthat differ, to first order.")
      .def_prop_ro(
          "sensitivity_numbers",
          [](const PhasedSolved& s) {
            return by_name<double>(ocp::sensitivity_numbers(*s.problem));
          },
          "The numbers of its problem, as Solution.sensitivity_numbers has them: of a phase as "
          "\"phase: name\".\nA parameter's own name is that parameter in every phase that has one, "
          "and a link's its bound.");
}

}  // namespace

void bind_sensitivity(nb::module_& module) {
  bind_one_phase(module);
  bind_several_phases(module);
}

}  // namespace slalom::python
