#include "slalom/ocp/many.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "binding.hpp"
#include "running.hpp"
#include "settings.hpp"
#include "slalom/base/error.hpp"
#include "slalom/ocp/sensitivity.hpp"
#include "solved.hpp"

namespace slalom::python {
namespace {

using ocp::Problem;
using ocp::Solution;

constexpr std::int64_t kMostSolves = 1'000'000;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// What was not begun has no trajectory, and NaN in the arrays.
bool begun(const Solution& answer) {
  return !answer.trajectory.tau.empty();
}

/// What Python knows as Solutions: of one problem with other numbers each, on one mesh.
struct ManySolved {
  std::shared_ptr<const Problem> problem;
  std::vector<ocp::Variation> variations;
  std::vector<Solution> answers;
  double elapsed_s = 0;

  Solved at(std::ptrdiff_t index) const {
    const auto size = static_cast<std::ptrdiff_t>(answers.size());
    if (index < -size || index >= size) throw nb::index_error("Solutions: index out of range");
    const auto i = static_cast<std::size_t>(index < 0 ? index + size : index);
    if (!begun(answers[i]))
      throw Error("Solutions: solve " + std::to_string(i) + " was not begun before the call ended");
    Solved one;
    std::vector<std::pair<std::string, double>> numbers;
    for (const auto& [name, values] : variations) numbers.emplace_back(name, values[i]);
    one.problem = std::make_shared<const Problem>(ocp::with_numbers(*problem, numbers));
    one.answer = answers[i];
    one.elapsed_s = elapsed_s;
    return one;
  }
};

std::vector<ocp::Variation> variations_of(const Problem& problem, const nb::dict& numbers) {
  const std::string where = problem.name() + ": solve_many";
  if (nb::len(numbers) == 0)
    throw InvalidValue(where, "no numbers", "a dictionary from names to a number for each solve");
  const nb::object as_array = nb::module_::import_("numpy").attr("asarray");
  std::vector<ocp::Variation> variations;
  for (const auto& [key, values] : numbers) {
    const auto name = as<std::string>(key, where, "names as keys");
    const nb::object array = as_array(values, "dtype"_a = "float64");
    if (const int dimensions = nb::cast<int>(array.attr("ndim")); dimensions != 1)
      throw InvalidValue(where + ": " + name,
                         "an array of " + std::to_string(dimensions) + " dimensions",
                         "one number for each solve");
    variations.push_back({name, nb::cast<std::vector<double>>(array)});
    check_at_most(static_cast<std::int64_t>(variations.back().values.size()), kMostSolves,
                  where + ": " + name);
  }
  return variations;
}

ManySolved solve_many(const Problem& problem, const nb::dict& numbers, const MeshChoice& mesh,
                      const SchemeChoice& scheme, const PointsChoice& points,
                      const std::string& backend, const nb::object& guess, const Solved* warm_start,
                      int threads, const nb::kwargs& options) {
  check_at_most(threads, kMostThreads, problem.name() + ": solve_many: threads");
  ManySolved many;
  many.variations = variations_of(problem, numbers);
  auto settings = settings_of(problem, {mesh, scheme, points}, backend, guess, warm_start, options,
                              {"numbers", "threads"});
  settings.warm_start = {};
  settings.previous = warm_start != nullptr ? &warm_start->answer : nullptr;
  many.problem = std::make_shared<const Problem>(problem);
  auto [answers, elapsed] = run_released(settings.options, [&] {
    return ocp::solve_many(*many.problem, settings, many.variations, threads);
  });
  many.answers = std::move(answers);
  many.elapsed_s = elapsed;
  for (auto& answer : many.answers) forget_stop(answer.options);
  return many;
}

/// One number a solve.
template <class Get>
Vector numbers(const ManySolved& many, const Get& get) {
  std::vector<double> result;
  result.reserve(many.answers.size());
  for (const auto& answer : many.answers) result.push_back(begun(answer) ? get(answer) : kNone);
  return to_numpy(result);
}

/// One that was begun, for the number of points; null if none was.
const Solution* some(const ManySolved& many) {
  const auto found = std::find_if(many.answers.begin(), many.answers.end(), begun);
  return found == many.answers.end() ? nullptr : &*found;
}

/// A row for each solve.
template <class Get>
Matrix rows(const ManySolved& many, const Get& get) {
  const Solution* one = some(many);
  const std::size_t columns = one == nullptr ? 0 : one->trajectory.tau.size();
  return table(many.answers, columns, [&](const Solution& answer) {
    return begun(answer) ? get(answer) : std::vector<double>(columns, kNone);
  });
}

/// By name of what the problem declares, so that all are there where no solve was begun; `get`
/// gives the value of a name.
template <class Value, class Declared, class Get>
ByName<Value> each_name(const std::vector<Declared>& all, const Get& get) {
  nb::dict result;
  for (const auto& declared : all) result[declared.name.c_str()] = get(declared.name);
  return result;
}

template <class Declared>
ByName<Matrix> variables(const ManySolved& many, const std::vector<Declared>& all,
                         std::vector<double> (Solution::*get)(const std::string&) const) {
  return each_name<Matrix>(all, [&](const std::string& name) {
    return rows(many, [&](const Solution& answer) { return (answer.*get)(name); });
  });
}

ByName<Vector> static_parameters(const ManySolved& many) {
  return each_name<Vector>(many.problem->static_parameters(), [&](const std::string& name) {
    return numbers(many, [&](const Solution& answer) { return answer.static_parameter(name); });
  });
}

void bind_solutions(nb::module_& module) {
  nb::class_<ManySolved>(
      module, "Solutions",
      "Answers to one problem with other numbers each, in their order. Arrays "
      "have a row for each solve, NaN\nwhere the call ended before it was begun; "
      "`solutions[i]` is the Solution of one.")
      .def("__len__", [](const ManySolved& many) { return many.answers.size(); })
      .def("__getitem__", &ManySolved::at, "index"_a)
      .def_prop_ro(
          "solved",
          [](const ManySolved& many) {
            nb::list flags;
            for (const auto& answer : many.answers) flags.append(answer.solved());
            return nb::module_::import_("numpy").attr("asarray")(flags, "dtype"_a = "bool");
          },
          "Whether each is an optimum, by the independent check too.")
      .def_prop_ro(
          "status",
          [](const ManySolved& many) {
            std::vector<std::string> list;
            for (const auto& answer : many.answers) list.emplace_back(to_string(answer.status));
            return list;
          },
          "How each solve ended.")
      .def_prop_ro(
          "objective",
          [](const ManySolved& many) {
            return numbers(many, [](const Solution& answer) { return answer.objective; });
          },
          nb::rv_policy::move)
      .def_prop_ro(
          "tf",
          [](const ManySolved& many) {
            return numbers(many, [](const Solution& answer) { return answer.tf(); });
          },
          nb::rv_policy::move)
      .def_prop_ro(
          "iterations",
          [](const ManySolved& many) {
            nb::list counts;
            for (const auto& answer : many.answers) counts.append(answer.iterations);
            return nb::module_::import_("numpy").attr("asarray")(counts, "dtype"_a = "int64");
          },
          "0 where a solve was not begun.")
      .def_prop_ro(
          "time",
          [](const ManySolved& many) {
            return rows(many, [](const Solution& answer) { return answer.time(); });
          },
          nb::rv_policy::move, "The time of each point, [solve, point].")
      .def_prop_ro(
          "states",
          [](const ManySolved& many) {
            return variables(many, many.problem->states(), &Solution::state);
          },
          "Values by name, [solve, point].")
      .def_prop_ro(
          "controls",
          [](const ManySolved& many) {
            return variables(many, many.problem->controls(), &Solution::control);
          },
          "Values by name, [solve, point].")
      .def_prop_ro("static_parameters", &static_parameters,
                   "Values by name, one number for each solve.")
      .def_ro("elapsed_s", &ManySolved::elapsed_s, "Seconds by the clock that all took together.")
      .def("__repr__", [](const ManySolved& many) {
        std::size_t solved = 0;
        for (const auto& answer : many.answers) solved += answer.solved();
        return "<Solutions: " + std::to_string(solved) + " of " +
               std::to_string(many.answers.size()) + " solved>";
      });
}

}  // namespace

void bind_many(nb::module_& module) {
  bind_solutions(module);
  auto type = nb::borrow<nb::class_<Problem>>(module.attr("Problem"));
  type.def(
      "solve_many", &solve_many, "numbers"_a, nb::kw_only(), "mesh"_a = 40,
      "scheme"_a = "hermite_simpson", "points"_a = nb::none(), "backend"_a = "",
      "guess"_a = nb::none(), "warm_start"_a = nb::none(), "threads"_a = 0, "options"_a,
      "Solves the problem for many sets of numbers. `numbers` has, by the name of one of the "
      "problem's numbers, such as\na parameter or \"initial x\" (Solution.sensitivity_numbers), an "
      "array with a number for each solve.\n\n"
      "The problem is transcribed once a thread, so that this takes much less time than as "
      "many calls\nof solve. Each solve starts from the guess, or from the solution "
      "`warm_start` with its multipliers,\nand depends on nothing else: an answer has the "
      "same bits on any number of `threads` (0: as many as\nprocessors). A time_limit is of "
      "the whole call. The other keywords are those of solve.");
}

}  // namespace slalom::python
