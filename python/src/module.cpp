#include <new>
#include <string>

#include "binding.hpp"
#include "slalom/base/error.hpp"
#include "slalom/io/version.hpp"
#include "solved.hpp"

namespace slalom::python {
namespace {

/// A new exception type of the module, never destroyed.
PyObject* exception(nb::module_& module, const char* name, const char* documentation,
                    const nb::tuple& bases, const nb::dict& members) {
  const auto full = nb::cast<std::string>(module.attr("__name__")) + "." + name;
  PyObject* type =
      PyErr_NewExceptionWithDoc(full.c_str(), documentation, bases.ptr(), members.ptr());
  if (type == nullptr) throw nb::python_error();
  module.attr(name) = nb::borrow(type);
  return type;
}

void raise(PyObject* type, const InvalidValue& bad) {
  const nb::object value = nb::borrow(type)(bad.what());
  value.attr("where") = bad.where();
  value.attr("found") = bad.found();
  value.attr("expected") = bad.expected();
  PyErr_SetObject(type, value.ptr());
}

/// slalom.Error is a RuntimeError; InvalidValue an Error and a ValueError; UnknownName an
/// InvalidValue and a KeyError.
void bind_errors(nb::module_& module) {
  nb::exception<Error>(module, "Error", PyExc_RuntimeError);
  const nb::object error = module.attr("Error");
  error.attr("__doc__") = doc::Error;
  static PyObject* invalid =
      exception(module, "InvalidValue", doc::InvalidValue,
                nb::make_tuple(error, nb::borrow(PyExc_ValueError)), nb::dict());
  // KeyError puts its message in quotes; this one is a sentence.
  nb::dict members;
  members["__str__"] = error.attr("__str__");
  static PyObject* unknown =
      exception(module, "UnknownName", "A name that an answer or a scenario does not have.",
                nb::make_tuple(nb::borrow(invalid), nb::borrow(PyExc_KeyError)), members);
  nb::register_exception_translator(
      [](const std::exception_ptr& thrown, void*) {
        try {
          std::rethrow_exception(thrown);
        } catch (const UnknownName& bad) {
          raise(unknown, bad);
        } catch (const InvalidValue& bad) {
          raise(invalid, bad);
        }
      },
      nullptr);
}

}  // namespace
}  // namespace slalom::python

NB_MODULE(_core, module) {
  using namespace slalom::python;
  module.attr("__version__") = slalom::io::kVersion;
  // For measurements to name it; a stripped extension says it nowhere else.
#ifdef __clang__
  module.attr("__compiler__") = "clang version " __clang_version__;
#else
  module.attr("__compiler__") = "g++ " __VERSION__;
#endif
  bind_errors(module);
  bind_expressions(module);
  bind_solution(module);
  bind_problem(module);
  bind_saved(module);
  bind_solve(module);
  bind_many(module);
  bind_simulation(module);
  bind_judge(module);
  bind_phases(module);
  bind_sensitivity(module);
  bind_refine(module);
  bind_mpc(module);
  bind_scenario(module);
  bind_planner(module);
  bind_drive(module);
  bind_sweep(module);
  bind_pickles(module);
}
