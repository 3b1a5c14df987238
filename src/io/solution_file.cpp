#include "slalom/io/solution_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "file_set.hpp"
#include "slalom/base/error.hpp"
#include "slalom/io/drive_files.hpp"
#include "slalom/io/version.hpp"
#include "solution_json.hpp"

namespace slalom::io {
namespace {

constexpr const char* kFormat = "slalom solution 1";
constexpr const char* kPhasedFormat = "slalom solution of phases 1";
constexpr const char* kContent = "a solution (JSON, from save_solution)";

// --- schemes: each table once, and its number for each interval ------------------------------

bool same(const ocp::Scheme& a, const ocp::Scheme& b) {
  return a.name == b.name && a.points == b.points && a.state == b.state && a.rate == b.rate;
}

void put_schemes(const ocp::Solution& solution, Json& json) {
  std::vector<const ocp::Scheme*> tables;
  Json of_interval = Json::array();
  for (std::size_t k = 0; k < solution.mesh.intervals(); ++k) {
    const ocp::Scheme& scheme = solution.scheme.of(k);
    const auto known = std::find_if(tables.begin(), tables.end(),
                                    [&](const auto* table) { return same(*table, scheme); });
    of_interval.push_back(known - tables.begin());
    if (known == tables.end()) tables.push_back(&scheme);
  }
  json["mesh"] = json_numbers(solution.mesh.breakpoints());
  json["schemes"] = Json::array();
  for (const auto* table : tables) json["schemes"].push_back(scheme_json(*table));
  json["scheme_of_interval"] = of_interval;
}

ocp::Schemes read_schemes(const JsonReader& reader, std::size_t intervals) {
  std::vector<ocp::Scheme> tables, list;
  const JsonReader schemes = reader.at("schemes"), numbers = reader.at("scheme_of_interval");
  for (std::size_t i = 0; i < schemes.size(); ++i) tables.push_back(read_scheme(schemes.at(i)));
  const auto of_interval = numbers.counts();
  if (of_interval.size() != intervals)
    numbers.refuse(fmt::format("{} numbers", of_interval.size()),
                   fmt::format("{}, one for each interval of the mesh", intervals));
  for (std::size_t k = 0; k < intervals; ++k) {
    if (of_interval[k] >= tables.size())
      numbers.at(k).refuse(fmt::format("{}", of_interval[k]),
                           fmt::format("the number of one of {} schemes", tables.size()));
    list.push_back(tables[of_interval[k]]);
  }
  if (tables.size() == 1) list.resize(1);
  return ocp::Schemes(std::move(list));
}

ocp::Mesh read_mesh(const JsonReader& reader) {
  try {
    return ocp::Mesh(reader.list());
  } catch (const InvalidValue& error) {
    if (error.where().rfind(reader.where(), 0) == 0) throw;
    reader.refuse(error.found(), error.expected());
  }
}

// --- names and numbers at points ---------------------------------------------------------------

template <class List>
Json at_points_json(const List& list) {
  Json json = Json::array();
  for (const auto& item : list)
    json.push_back(
        Json{{"name", item.name}, {"points", item.points}, {"values", json_numbers(item.values)}});
  return json;
}
/// Of a trajectory of `count` points: a number each, or numbers without a point.
template <class Item>
std::vector<Item> read_at_points(const JsonReader& reader, std::size_t count) {
  return reader.each([&](const JsonReader& item) {
    Item result{item.at("name").text(), item.at("points").counts(), item.at("values").list()};
    const auto& points = result.points;
    if (!points.empty() && points.size() != result.values.size())
      item.at("values").refuse(fmt::format("{} numbers", result.values.size()),
                               fmt::format("{}, one for each point", points.size()));
    for (std::size_t k = 0; k < points.size(); ++k)
      if (points[k] >= count)
        item.at("points").at(k).refuse(fmt::format("{}", points[k]),
                                       fmt::format("one of {} points, from 0", count));
    return result;
  });
}

Json conflicts_json(const std::vector<ocp::Conflict>& conflicts) {
  Json json = Json::array();
  for (const auto& each : conflicts)
    json.push_back(Json{{"name", each.name}, {"change", json_number(each.change)}});
  return json;
}
std::vector<ocp::Conflict> read_conflicts(const JsonReader& reader) {
  return reader.each([](const JsonReader& item) {
    return ocp::Conflict{item.at("name").text(), item.at("change").real()};
  });
}

Json high_index_json(const std::vector<ocp::HighIndex>& equations) {
  Json json = Json::array();
  for (const auto& each : equations)
    json.push_back(Json{{"name", each.name}, {"index", each.index}});
  return json;
}
std::vector<ocp::HighIndex> read_high_index(const JsonReader& reader) {
  return reader.each([](const JsonReader& item) {
    return ocp::HighIndex{item.at("name").text(), item.at("index").whole()};
  });
}

/// What solutions of one phase and of several both have.
template <class S>
void put_outcome(const S& solution, Json& json) {
  json["version"] = kVersion;
  json["status"] = nlp::to_string(solution.status);
  json["fault"] = fault_json(solution.fault);
  json["objective"] = json_number(solution.objective);
  json["backend"] = solution.backend;
  json["iterations"] = solution.iterations;
  json["wall_s"] = json_number(solution.wall_s);
  json["residuals"] = residuals_json(solution.residuals);
  json["options"] = json_options(solution.options);
  json["conflicts"] = conflicts_json(solution.conflicts);
  json["point"] = json_point(solution.point);
}
template <class S>
void read_outcome(const JsonReader& reader, S& solution) {
  solution.status = reader.at("status").one_of(nlp::Status::numerical_failure);
  solution.fault = read_fault(reader.at("fault"));
  solution.objective = reader.at("objective").real();
  solution.backend = reader.at("backend").text();
  solution.iterations = reader.at("iterations").whole();
  solution.wall_s = reader.at("wall_s").real();
  solution.residuals = read_residuals(reader.at("residuals"));
  solution.options = reader.at("options").options();
  solution.point = reader.at("point").point();
  // Lacking in files of versions before.
  if (reader.has("conflicts")) solution.conflicts = read_conflicts(reader.at("conflicts"));
}

Json solution_json(const ocp::Solution& solution) {
  Json json;
  json["format"] = kFormat;
  put_outcome(solution, json);
  json["state_names"] = solution.state_names;
  json["state_units"] = json_numbers(solution.state_units);
  json["control_names"] = solution.control_names;
  json["static_parameter_names"] = solution.static_parameter_names;
  json["slack_names"] = solution.slack_names;
  json["cost_terms"] = pairs_json(solution.cost_terms);
  put_schemes(solution, json);
  json["trajectory"] = trajectory_json(solution.trajectory);
  json["costates"] = json_table(solution.costates);
  json["collocated_costates"] = {{"tau", json_numbers(solution.collocated_costates.tau)},
                                 {"values", json_table(solution.collocated_costates.values)}};
  json["multipliers"] = at_points_json(solution.multipliers);
  json["excesses"] = at_points_json(solution.excesses);
  json["beyond_tables"] = pairs_json(solution.beyond_tables);
  json["scales"] = pairs_json(solution.scales);
  json["high_index"] = high_index_json(solution.high_index);
  return json;
}

void expect_size(const JsonReader& reader, std::size_t found, std::size_t expected,
                 const char* what) {
  if (found != expected)
    reader.refuse(fmt::format("{} of {}", found, what), fmt::format("{}", expected));
}

/// Points of the trajectory that mesh and schemes make.
std::size_t points_of(const ocp::Solution& solution) {
  std::size_t points = 1;
  for (std::size_t k = 0; k < solution.mesh.intervals(); ++k)
    points += solution.scheme.of(k).points.size() - 1;
  return points;
}

/// A solve that did not begin has none.
void read_costates(const JsonReader& reader, std::size_t states, ocp::Solution& solution) {
  solution.costates = reader.at("costates").table(states);
  const JsonReader collocated = reader.at("collocated_costates");
  solution.collocated_costates = {collocated.at("tau").list(),
                                  collocated.at("values").table(states)};
  expect_size(collocated.at("values"), solution.collocated_costates.values.size(),
              solution.collocated_costates.tau.size(), "the points in 'tau'");
  const bool begun = !solution.collocated_costates.tau.empty();
  if (begun || !solution.costates.empty())
    expect_size(reader.at("costates"), solution.costates.size(), solution.mesh.intervals() + 1,
                "the mesh's nodes");
}

/// The integrals' names stand in `scales` alone, between those of the slacks and the times.
std::vector<std::string> integral_names(const ocp::Solution& solution) {
  std::vector<std::string> names;
  const std::size_t first = solution.state_names.size() + solution.control_names.size() +
                            solution.static_parameter_names.size() + solution.slack_names.size();
  const std::size_t count = solution.trajectory.integrals.size();
  for (std::size_t i = 0; i < count && first + i < solution.scales.size(); ++i)
    names.push_back(solution.scales[first + i].first);
  return names;
}

template <class List>
std::string listed(const List& list) {
  std::string names;
  for (const auto& each : list) {
    if (!names.empty()) names += ", ";
    if constexpr (requires { each.name; })
      names += each.name;
    else
      names += each;
  }
  return names.empty() ? "none" : names;
}

void check_answer_of(const ocp::Problem& problem, const ocp::Solution& solution,
                     const std::string& file) {
  const auto check = [&](const char* what, const auto& found, const auto& expected) {
    if (listed(found) != listed(expected))
      throw InvalidValue(
          file, std::string("an answer of another problem, with the ") + what + " " + listed(found),
          std::string("those of ") + problem.name() + ": " + listed(expected));
  };
  check("states", solution.state_names, problem.states());
  check("controls", solution.control_names, problem.controls());
  check("static parameters", solution.static_parameter_names, problem.static_parameters());
  check("slacks", solution.slack_names, problem.slacks());
  const std::size_t integrals = solution.trajectory.integrals.size();
  if (integrals != problem.integrals().size())
    throw InvalidValue(file, fmt::format("an answer with {} integrals", integrals),
                       fmt::format("{}, as {} has", problem.integrals().size(), problem.name()));
  // Files of versions before have no scales, and so none of these names.
  if (!solution.scales.empty()) check("integrals", integral_names(solution), problem.integrals());
}

ocp::Solution read_one(const JsonReader& reader) {
  ocp::Solution solution;
  read_outcome(reader, solution);
  solution.state_names = reader.at("state_names").texts();
  solution.control_names = reader.at("control_names").texts();
  solution.static_parameter_names = reader.at("static_parameter_names").texts();
  solution.slack_names = reader.at("slack_names").texts();
  const std::size_t states = solution.state_names.size();
  solution.state_units = reader.at("state_units").list();
  expect_size(reader.at("state_units"), solution.state_units.size(), states, "state_units");
  solution.cost_terms = read_pairs(reader.at("cost_terms"));
  solution.mesh = read_mesh(reader.at("mesh"));
  solution.scheme = read_schemes(reader, solution.mesh.intervals());
  const JsonReader trajectory = reader.at("trajectory");
  solution.trajectory = read_trajectory(trajectory, states, solution.control_names.size());
  expect_size(trajectory.at("tau"), solution.trajectory.tau.size(), points_of(solution),
              "the mesh's points");
  expect_size(trajectory.at("static_parameters"), solution.trajectory.static_parameters.size(),
              solution.static_parameter_names.size(), "static_parameters");
  expect_size(trajectory.at("slacks"), solution.trajectory.slacks.size(),
              solution.slack_names.size(), "slacks");
  read_costates(reader, states, solution);
  const std::size_t points = solution.trajectory.tau.size();
  solution.multipliers = read_at_points<ocp::Multipliers>(reader.at("multipliers"), points);
  solution.excesses = read_at_points<ocp::Excesses>(reader.at("excesses"), points);
  // Lacking in files of versions before.
  if (reader.has("beyond_tables")) solution.beyond_tables = read_pairs(reader.at("beyond_tables"));
  if (reader.has("scales")) solution.scales = read_pairs(reader.at("scales"));
  if (reader.has("high_index")) solution.high_index = read_high_index(reader.at("high_index"));
  return solution;
}

std::string dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string to_json(const ocp::Solution& solution) {
  return dump(solution_json(solution));
}

std::string to_json(const ocp::PhasedSolution& solution) {
  Json json;
  json["format"] = kPhasedFormat;
  put_outcome(solution, json);
  json["link_multipliers"] = pairs_json(solution.link_multipliers);
  json["cost_terms"] = pairs_json(solution.cost_terms);
  json["phases"] = Json::array();
  for (const auto& phase : solution.phases) json["phases"].push_back(solution_json(phase));
  return dump(json);
}

void save_solution(const std::string& file, const ocp::Solution& solution) {
  write_file(file, to_json(solution));
}
void save_solution(const std::string& file, const ocp::PhasedSolution& solution) {
  write_file(file, to_json(solution));
}

ocp::Solution read_solution(const std::string& file) {
  const Json json = read_json(file, kMaxSolutionBytes, kContent, {kFormat});
  return read_one(JsonReader(file, kContent, json));
}

ocp::Solution read_solution(const std::string& file, const ocp::Problem& problem) {
  ocp::Solution solution = read_solution(file);
  check_answer_of(problem, solution, file);
  return solution;
}

ocp::PhasedSolution read_phased_solution(const std::string& file) {
  const Json json = read_json(file, kMaxSolutionBytes, kContent, {kPhasedFormat});
  const JsonReader reader(file, kContent, json);
  ocp::PhasedSolution solution;
  read_outcome(reader, solution);
  solution.link_multipliers = read_pairs(reader.at("link_multipliers"));
  // Files written before problems of several phases had cost terms of their own lack them.
  if (reader.has("cost_terms")) solution.cost_terms = read_pairs(reader.at("cost_terms"));
  const JsonReader phases = reader.at("phases");
  for (std::size_t p = 0; p < phases.size(); ++p) solution.phases.push_back(read_one(phases.at(p)));
  return solution;
}

}  // namespace slalom::io
