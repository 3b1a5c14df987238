#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "docstrings.hpp"

namespace slalom::python {

namespace nb = nanobind;
using namespace nb::literals;

using Vector = nb::ndarray<nb::numpy, double, nb::ndim<1>>;
using Matrix = nb::ndarray<nb::numpy, double, nb::ndim<2>>;

/// Dictionaries as the type stub has them.
template <class Value>
using ByName = nb::typed<nb::dict, nb::str, Value>;

/// A list of names, each with its value, as a dictionary.
template <class Value, class List>
ByName<Value> by_name(const List& list) {
  nb::dict result;
  for (const auto& [name, value] : list) result[name.c_str()] = value;
  return result;
}

/// What the documentation of cost terms says of that keyword.
inline constexpr const char* kMaximised =
    "\nWith `maximise` it is to be large: it counts with a minus, in the objective too.";

/// A NumPy array that owns a copy of the numbers.
Vector to_numpy(const std::vector<double>& numbers);
/// Rows of equal length as an array [row, column]; `columns` is for no rows at all.
Matrix to_numpy(const std::vector<std::vector<double>>& rows, std::size_t columns);

/// The matrix of `get(item)` over a list, one row an item.
template <class List, class Get>
Matrix table(const List& list, std::size_t columns, Get get) {
  std::vector<std::vector<double>> rows;
  rows.reserve(list.size());
  for (const auto& item : list) {
    const auto& row = get(item);
    rows.emplace_back(row.begin(), row.end());
  }
  return to_numpy(rows, columns);
}

/// What Python gave as a T; a TypeError that says where and what was expected, if it is none.
template <class T>
T as(nb::handle given, const std::string& where, const char* expected) {
  T value;
  if (!nb::try_cast(given, value)) throw nb::type_error((where + ": expected " + expected).c_str());
  return value;
}

/// A UserWarning, or the exception that the user makes of those.
void warn(const std::string& message);

/// Lets other Python threads run while it lives, and hears an interrupt (Ctrl-C) all the same.
class Released {
 public:
  Released();
  /// Whether an interrupt came. Asks the interpreter twenty times a second at most, for that takes
  /// the lock that other threads hold.
  bool interrupted();
  /// To be called once the interpreter's lock is held again: raises the interrupt's exception.
  void raise_if_interrupted() const;

 private:
  double asked_;
  bool interrupted_ = false;
};

void bind_expressions(nb::module_& module);
void bind_pickles(nb::module_& module);
void bind_problem(nb::module_& module);
void bind_saved(nb::module_& module);
void bind_sensitivity(nb::module_& module);
void bind_solution(nb::module_& module);
void bind_solve(nb::module_& module);
void bind_simulation(nb::module_& module);
void bind_many(nb::module_& module);
void bind_mpc(nb::module_& module);
void bind_refine(nb::module_& module);
void bind_judge(nb::module_& module);
void bind_phases(nb::module_& module);
void bind_drive(nb::module_& module);
void bind_scenario(nb::module_& module);
void bind_planner(nb::module_& module);
void bind_sweep(nb::module_& module);

}  // namespace slalom::python
