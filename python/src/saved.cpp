#include <nanobind/stl/filesystem.h>

#include <filesystem>
#include <memory>

#include "binding.hpp"
#include "slalom/io/solution_file.hpp"
#include "solved.hpp"

namespace slalom::python {
namespace {

Solved load(const ocp::Problem& problem, const std::filesystem::path& file) {
  Solved s;
  s.answer = io::read_solution(file.string(), problem);
  s.problem = std::make_shared<const ocp::Problem>(problem);
  return s;
}

}  // namespace

void bind_saved(nb::module_& module) {
  nb::borrow<nb::class_<Solved>>(module.attr("Solution"))
      .def(
          "save",
          [](const Solved& s, const std::filesystem::path& file) {
            io::save_solution(file.string(), s.answer);
          },
          "file"_a, doc::io_save_solution)
      .def(
          "to_csv", [](const Solved& s) { return io::to_csv(s.answer); }, doc::io_to_csv);
  nb::borrow<nb::class_<ocp::Problem>>(module.attr("Problem"))
      .def("load_solution", &load, "file"_a,
           "An answer of this problem that Solution.save wrote, the same to the bit; as a guess or "
           "a warm start it goes on where that ended.");
}

}  // namespace slalom::python
