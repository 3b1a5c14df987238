#include <string>

#include "binding.hpp"
#include "slalom/io/scenario_file.hpp"
#include "slalom/sim/scenario.hpp"

namespace slalom::python {
namespace {

/// Pickling an object of this class is a TypeError that says what to do instead.
void refuse(nb::module_& module, const char* name, const std::string& instead) {
  const auto message = "a " + std::string(name) + " cannot be pickled: " + instead;
  module.attr(name).attr("__reduce__") = nb::cpp_function(
      [message](const nb::object&) -> nb::tuple { throw nb::type_error(message.c_str()); },
      nb::is_method(), nb::sig("def __reduce__(self) -> tuple[object, ...]"));
}

}  // namespace

void bind_pickles(nb::module_& module) {
  nb::borrow<nb::class_<sim::Scenario>>(module.attr("Scenario"))
      .def("__getstate__", [](const sim::Scenario& s) { return io::to_yaml_as_stated(s); })
      .def("__setstate__", [](sim::Scenario& s, const std::string& yaml) {
        new (&s) sim::Scenario(io::parse_scenario(yaml, "a pickled scenario"));
      });
  const std::string formulas = "it holds formulas; state it in a function that each process calls";
  for (const char* name : {"Problem", "PhasedProblem", "Expr"}) refuse(module, name, formulas);
  refuse(
      module, "Solution",
      "it holds its problem's formulas; solution.save(FILE) and problem.load_solution(FILE) keep "
      "it to the bit");
  const std::string arrays = "it holds its problem's formulas; pickle the arrays that you need";
  for (const char* name : {"PhasedSolution", "Simulation", "Refined", "PhasedRefined", "MpcResult",
                           "Sensitivity", "PhasedSensitivity"})
    if (nb::hasattr(module, name)) refuse(module, name, arrays);
  refuse(module, "Drive",
         "drive.write(FOLDER) keeps its files; or pickle its scenario, which drives again to the "
         "same bits, or the arrays that you need");
  for (const char* name : {"Planner", "Plant", "Mpc"})
    refuse(module, name, "make one in each process, of what it was made of");
}

}  // namespace slalom::python
