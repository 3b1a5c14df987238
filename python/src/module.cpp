#include <new>
#include <string>

#include "binding.hpp"
#include "slalom/base/error.hpp"
#include "slalom/io/version.hpp"

namespace slalom::python {
namespace {

/// slalom.Error is a RuntimeError; slalom.InvalidValue an Error and a ValueError.
void bind_errors(nb::module_& module) {
  nb::exception<Error>(module, "Error", PyExc_RuntimeError);
  const nb::object error = module.attr("Error");
  const nb::tuple bases = nb::make_tuple(error, nb::borrow(PyExc_ValueError));
  static PyObject* invalid = PyErr_NewExceptionWithDoc("slalom._core.InvalidValue",
                                                       doc::InvalidValue, bases.ptr(), nullptr);
  if (invalid == nullptr) throw nb::python_error();
  module.attr("InvalidValue") = nb::borrow(invalid);
  error.attr("__doc__") = doc::Error;
  nb::register_exception_translator(
      [](const std::exception_ptr& thrown, void*) {
        try {
          std::rethrow_exception(thrown);
        } catch (const InvalidValue& bad) {
          const nb::object value = nb::borrow(invalid)(bad.what());
          value.attr("where") = bad.where();
          value.attr("found") = bad.found();
          value.attr("expected") = bad.expected();
          PyErr_SetObject(invalid, value.ptr());
        }
      },
      nullptr);
}

}  // namespace
}  // namespace slalom::python

NB_MODULE(_core, module) {
  using namespace slalom::python;
  module.attr("__version__") = slalom::io::kVersion;
  bind_errors(module);
  bind_expressions(module);
  bind_solution(module);
  bind_problem(module);
  bind_solve(module);
  bind_planner(module);
  bind_drive(module);
}
