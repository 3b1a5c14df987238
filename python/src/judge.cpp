#include <cstdint>
#include <string>

#include "binding.hpp"
#include "settings.hpp"
#include "slalom/ocp/errors.hpp"
#include "solved.hpp"

namespace slalom::python {
namespace {

using ocp::ErrorEstimate;
using ocp::Violation;

/// Of an interval.
constexpr std::int64_t kMostSamples = 100'000;

/// Runs `work` while other threads may run.
template <class Work>
auto unlocked(const Work& work) {
  const nb::gil_scoped_release unlock;
  return work();
}

void bind_estimates(nb::module_& module) {
  nb::class_<ErrorEstimate>(module, "ErrorEstimate", doc::ocp_ErrorEstimate)
      .def_prop_ro(
          "interval", [](const ErrorEstimate& e) { return to_numpy(e.interval); },
          nb::rv_policy::move, doc::ocp_ErrorEstimate_interval)
      .def_ro("state", &ErrorEstimate::state, doc::ocp_ErrorEstimate_state)
      .def_ro("largest", &ErrorEstimate::largest, doc::ocp_ErrorEstimate_largest)
      .def_ro("worst", &ErrorEstimate::worst, doc::ocp_ErrorEstimate_worst)
      .def_ro("horizon", &ErrorEstimate::horizon, doc::ocp_ErrorEstimate_horizon)
      .def_ro("amplification", &ErrorEstimate::amplification, doc::ocp_ErrorEstimate_amplification)
      .def_ro("objective", &ErrorEstimate::objective, doc::ocp_ErrorEstimate_objective)
      .def_prop_ro(
          "objective_share", [](const ErrorEstimate& e) { return to_numpy(e.objective_share); },
          nb::rv_policy::move, doc::ocp_ErrorEstimate_objective_share)
      .def_ro("objective_size", &ErrorEstimate::objective_size,
              doc::ocp_ErrorEstimate_objective_size)
      .def("__repr__", [](const ErrorEstimate& e) {
        return "<ErrorEstimate: " + nb::cast<std::string>(nb::repr(nb::float_(e.largest))) +
               " in interval " + std::to_string(e.worst) + ">";
      });
  nb::class_<Violation>(module, "Violation", doc::ocp_Violation)
      .def_ro("value", &Violation::value, doc::ocp_Violation_value)
      .def_ro("constraint", &Violation::constraint)
      .def_ro("time", &Violation::time)
      .def("__repr__", [](const Violation& v) {
        return "<Violation: " + nb::cast<std::string>(nb::repr(nb::float_(v.value))) +
               (v.constraint.empty() ? "" : " of " + v.constraint) + ">";
      });
}

}  // namespace

void bind_judge(nb::module_& module) {
  bind_estimates(module);
  nb::borrow<nb::class_<Solved>>(module.attr("Solution"))
      .def(
          "estimate_errors",
          [](const Solved& s, double tolerance) {
            return unlocked([&] { return ocp::estimate_errors(*s.problem, s.answer, tolerance); });
          },
          "tolerance"_a = 1e-12, doc::ocp_estimate_errors)
      .def(
          "largest_violation",
          [](const Solved& s, int samples) {
            check_at_most(samples, kMostSamples, s.problem->name() + ": samples");
            return unlocked([&] { return ocp::largest_violation(*s.problem, s.answer, samples); });
          },
          "samples"_a = 20, doc::ocp_largest_violation)
      .def(
          "unresolved_controls",
          [](const Solved& s) { return to_numpy(ocp::unresolved_controls(*s.problem, s.answer)); },
          nb::rv_policy::move, doc::ocp_unresolved_controls)
      .def(
          "hamiltonian",
          [](const Solved& s) { return to_numpy(ocp::hamiltonian(*s.problem, s.answer)); },
          nb::rv_policy::move, doc::ocp_hamiltonian);
}

}  // namespace slalom::python
