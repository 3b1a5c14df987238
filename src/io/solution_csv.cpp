// A solution as a table, and a table as a guess.

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "csv.hpp"
#include "slalom/base/error.hpp"
#include "slalom/base/options.hpp"
#include "slalom/io/solution_file.hpp"
#include "solution_json.hpp"
#include "text_file.hpp"

namespace slalom::io {
namespace {

/// By point: its node of the mesh, or none.
std::vector<std::size_t> nodes_of(const ocp::Solution& solution, std::size_t none) {
  std::vector<std::size_t> nodes(solution.trajectory.tau.size(), none);
  std::size_t point = 0;
  for (std::size_t k = 0; k <= solution.mesh.intervals() && point < nodes.size(); ++k) {
    nodes[point] = k;
    if (k < solution.mesh.intervals()) point += solution.scheme.of(k).points.size() - 1;
  }
  return nodes;
}

/// One column a wanted name, each by its place in the header.
std::vector<std::size_t> columns_of(const std::vector<std::string>& names,
                                    const std::vector<std::string>& header,
                                    const std::string& where) {
  std::vector<std::size_t> columns;
  for (const auto& name : names) {
    const auto found = std::find(header.begin(), header.end(), name);
    if (found == header.end()) {
      const auto nearest = nearest_name(name, header);
      throw InvalidValue(where, "no column '" + name + "'",
                         nearest.empty() ? "a column for each state and control of the problem"
                                         : "one; perhaps '" + nearest + "' is meant");
    }
    columns.push_back(static_cast<std::size_t>(found - header.begin()));
  }
  return columns;
}

template <class List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  for (const auto& item : list) names.push_back(item.name);
  return names;
}

/// Times become taus between the first and the last.
void set_times(const std::vector<double>& times, const std::string& file,
               ocp::Trajectory& trajectory) {
  if (times.size() < 2)
    throw InvalidValue(file, fmt::format("{} rows of numbers", times.size()), "at least 2");
  trajectory.t0 = times.front();
  trajectory.tf = times.back();
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (k > 0 && !(times[k] > times[k - 1]))
      throw InvalidValue(fmt::format("{}:{}", file, k + 2),
                         fmt::format("t = {} after {}", times[k], times[k - 1]), "rising times");
    trajectory.tau.push_back((times[k] - trajectory.t0) / (trajectory.tf - trajectory.t0));
  }
  trajectory.tau.back() = 1;
}

}  // namespace

std::string to_csv(const ocp::Solution& solution) {
  constexpr auto kNone = static_cast<std::size_t>(-1);
  std::string text = "t,tau";
  for (const auto* names : {&solution.state_names, &solution.control_names})
    for (const auto& name : *names) text += "," + csv_cell(name);
  for (const auto& name : solution.state_names) text += "," + csv_cell("costate " + name);
  text += "\n";
  const auto& trajectory = solution.trajectory;
  const auto nodes = nodes_of(solution, kNone);
  const bool begun = !solution.costates.empty();  // else its solve found none
  for (std::size_t point = 0; point < trajectory.tau.size(); ++point) {
    fmt::format_to(std::back_inserter(text), "{},{}", trajectory.time(point),
                   trajectory.tau[point]);
    for (const auto* rows : {&trajectory.states, &trajectory.controls})
      for (const double value : (*rows)[point])
        fmt::format_to(std::back_inserter(text), ",{}", value);
    for (std::size_t i = 0; i < solution.state_names.size(); ++i) {
      text += ",";
      if (begun && nodes[point] != kNone)
        fmt::format_to(std::back_inserter(text), "{}", solution.costates[nodes[point]][i]);
    }
    text += "\n";
  }
  return text;
}

ocp::Trajectory read_trajectory(const std::string& file, const ocp::Problem& problem) {
  CsvRows rows(read_file(file, kMaxSolutionBytes, "a table of a trajectory (CSV)"));
  const auto header = rows.next().value_or(std::vector<std::string>());
  const auto where = fmt::format("{}:{}", file, std::max(1, rows.line()));
  const auto time = columns_of({"t"}, header, where);
  const auto states = columns_of(names_of(problem.states()), header, where);
  const auto controls = columns_of(names_of(problem.controls()), header, where);
  ocp::Trajectory trajectory;
  std::vector<double> times;
  while (const auto row = rows.next()) {
    const auto& cells = *row;
    const auto take = [&](const std::vector<std::size_t>& columns) {
      std::vector<double> values;
      for (const std::size_t column : columns) {
        const auto value = column < cells.size() ? csv_number(cells[column]) : std::nullopt;
        if (!value)
          throw InvalidValue(fmt::format("{}:{}: {}", file, rows.line(), header[column]),
                             column < cells.size() ? "'" + cells[column] + "'" : "too few cells",
                             "a finite number");
        values.push_back(*value);
      }
      return values;
    };
    times.push_back(take(time).front());
    trajectory.states.push_back(take(states));
    trajectory.controls.push_back(take(controls));
  }
  set_times(times, file, trajectory);
  return trajectory;
}

}  // namespace slalom::io
