#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "binding.hpp"
#include "slalom/nlp/check.hpp"
#include "slalom/nlp/solver.hpp"

namespace slalom::python {

/// The words of `status` and what they mean.
inline std::string statuses() {
  return std::string(doc::nlp_Status) + "\n\n- solved: " + doc::nlp_Status_solved +
         "\n- iteration_limit: " + doc::nlp_Status_iteration_limit +
         "\n- time_limit: " + doc::nlp_Status_time_limit +
         "\n- infeasible: " + doc::nlp_Status_infeasible +
         "\n- unbounded: " + doc::nlp_Status_unbounded +
         "\n- invalid_number: a function gave NaN or infinity; see fault" +
         "\n- too_few_freedoms: " + doc::nlp_Status_too_few_freedoms +
         "\n- interrupted: " + doc::nlp_Status_interrupted +
         "\n- numerical_failure: " + doc::nlp_Status_numerical_failure;
}

/// How a solve ended: what answers of one phase and of several have alike.
template <class Type>
void bind_verdict(nb::class_<Type>& type) {
  type.def_prop_ro(
          "status", [](const Type& s) { return nlp::to_string(s.answer.status); },
          statuses().c_str())
      .def_prop_ro(
          "solved", [](const Type& s) { return s.answer.solved(); },
          "Whether the solver says so, and the residuals recomputed from the point too.")
      .def_prop_ro(
          "objective", [](const Type& s) { return s.answer.objective; },
          "The sum of the cost terms.")
      .def_prop_ro(
          "iterations", [](const Type& s) { return s.answer.iterations; },
          "The solver's iterations.")
      .def_prop_ro(
          "backend", [](const Type& s) { return s.answer.backend; }, doc::ocp_Solution_backend)
      .def_prop_ro(
          "wall_s", [](const Type& s) { return s.answer.wall_s; },
          "Seconds by the clock in the solver.")
      .def_ro("starts", &Type::starts,
              "All answers in their order, where solve was asked for several starts; else none.")
      .def_ro("elapsed_s", &Type::elapsed_s,
              "Seconds by the clock from transcription to check, all of it outside Python.")
      .def_prop_ro(
          "violation", [](const Type& s) { return s.answer.residuals.violation; },
          doc::nlp_Residuals_violation)
      .def_prop_ro(
          "worst_constraint", [](const Type& s) { return s.answer.residuals.worst_constraint; },
          "The row or bound with that violation, by name and point.")
      .def_prop_ro(
          "conflicts",
          [](const Type& s) {
            std::vector<std::pair<std::string, double>> list;
            for (const auto& each : s.answer.conflicts) list.emplace_back(each.name, each.change);
            return list;
          },
          "Of an infeasible problem, pairs (name, change) of what stands against each other: by "
          "how "
          "much that\nconstraint's or bound's limit alone would have to move, to first order; what "
          "would have to give\nleast first.")
      .def_prop_ro(
          "stationarity", [](const Type& s) { return s.answer.residuals.stationarity; },
          doc::nlp_Residuals_stationarity)
      .def_prop_ro(
          "complementarity", [](const Type& s) { return s.answer.residuals.complementarity; },
          doc::nlp_Residuals_complementarity)
      .def_prop_ro(
          "fault",
          [](const Type& s) {
            const auto& fault = s.answer.fault;
            return fault ? fault.function + " at " + fault.where : std::string();
          },
          "The function that gave NaN or infinity, and where; empty if none did.");
}

/// Numbers at some of `count` points as numbers at all, 0 at the others; of what has one value,
/// that.
inline nb::object over_points(std::size_t count, const std::vector<std::size_t>& points,
                              const std::vector<double>& values) {
  if (points.empty()) {
    if (values.size() == 1) return nb::float_(values.front());
    return nb::cast(to_numpy(values));
  }
  // Of a family, a number for each member stands at a point, in the members' order.
  std::vector<std::vector<double>> rows(count);
  for (std::size_t k = 0; k < points.size(); ++k) rows[points[k]].push_back(values[k]);
  std::size_t members = 0;
  for (const auto& row : rows) members = std::max(members, row.size());
  for (auto& row : rows) row.resize(members);
  if (members != 1) return nb::cast(to_numpy(rows, members));
  std::vector<double> column;
  for (const auto& row : rows) column.push_back(row.front());
  return nb::cast(to_numpy(column));
}

/// Calls `function` of a Python module of the package, which needs an extra.
inline nb::any extra(const char* module, const char* function, nb::handle self,
                     const nb::kwargs& options) {
  return nb::borrow<nb::any>(nb::module_::import_(module).attr(function)(self, **options));
}

template <class Type>
void bind_extras(nb::class_<Type>& type, const char* plot, const char* frame) {
  type.def(
          "plot",
          [](nb::handle self, const nb::kwargs& options) {
            return extra("slalom._plot", "plot", self, options);
          },
          "options"_a, plot)
      .def(
          "to_frame",
          [](nb::handle self, const nb::kwargs& options) {
            return extra("slalom._frame", "to_frame", self, options);
          },
          "options"_a, frame);
}

}  // namespace slalom::python
