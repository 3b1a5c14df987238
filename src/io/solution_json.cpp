#include "solution_json.hpp"

#include <fmt/format.h>

namespace slalom::io {

Json scheme_json(const ocp::Scheme& scheme) {
  return {{"name", scheme.name},
          {"order", scheme.order},
          {"points", json_numbers(scheme.points)},
          {"state", json_table(scheme.state)},
          {"rate", json_table(scheme.rate)},
          {"weight", json_numbers(scheme.weight)},
          {"compressed", scheme.compressed}};
}

ocp::Scheme read_scheme(const JsonReader& reader) {
  ocp::Scheme scheme;
  scheme.name = reader.at("name").text();
  scheme.order = reader.at("order").whole();
  scheme.points = reader.at("points").list();
  const std::size_t points = scheme.points.size();
  if (points < 2) reader.at("points").refuse(fmt::format("{} points", points), "at least 2");
  scheme.state = reader.at("state").table(points);
  scheme.rate = reader.at("rate").table(points);
  if (scheme.rate.size() != scheme.state.size())
    reader.at("rate").refuse(fmt::format("{} rows", scheme.rate.size()),
                             fmt::format("{}, as 'state' has", scheme.state.size()));
  scheme.weight = reader.at("weight").list();
  if (scheme.weight.size() != points)
    reader.at("weight").refuse(fmt::format("{} numbers", scheme.weight.size()),
                               fmt::format("{}", points));
  scheme.compressed = reader.at("compressed").flag();
  return scheme;
}

Json trajectory_json(const ocp::Trajectory& trajectory) {
  return {{"t0", json_number(trajectory.t0)},
          {"tf", json_number(trajectory.tf)},
          {"tau", json_numbers(trajectory.tau)},
          {"states", json_table(trajectory.states)},
          {"controls", json_table(trajectory.controls)},
          {"static_parameters", json_numbers(trajectory.static_parameters)},
          {"slacks", json_numbers(trajectory.slacks)},
          {"integrals", json_numbers(trajectory.integrals)}};
}

ocp::Trajectory read_trajectory(const JsonReader& reader, std::size_t states,
                                std::size_t controls) {
  ocp::Trajectory result;
  result.t0 = reader.at("t0").real();
  result.tf = reader.at("tf").real();
  result.tau = reader.at("tau").list();
  result.states = reader.at("states").table(states);
  result.controls = reader.at("controls").table(controls);
  for (const auto& [key, rows] :
       {std::pair("states", result.states.size()), std::pair("controls", result.controls.size())})
    if (rows != result.tau.size())
      reader.at(key).refuse(fmt::format("{} points", rows),
                            fmt::format("{}, one for each tau", result.tau.size()));
  result.static_parameters = reader.at("static_parameters").list();
  result.slacks = reader.at("slacks").list();
  result.integrals = reader.at("integrals").list();
  return result;
}

Json fault_json(const nlp::Fault& fault) {
  return {{"function", fault.function}, {"where", fault.where}, {"variable", fault.variable}};
}
nlp::Fault read_fault(const JsonReader& reader) {
  return {reader.at("function").text(), reader.at("where").text(), reader.at("variable").text()};
}

namespace {

/// The numbers of Residuals by name, once for both ways.
constexpr std::pair<const char*, double nlp::Residuals::*> kNumbers[] = {
    {"violation", &nlp::Residuals::violation},
    {"stationarity", &nlp::Residuals::stationarity},
    {"complementarity", &nlp::Residuals::complementarity},
    {"relative_violation", &nlp::Residuals::relative_violation},
    {"relative_stationarity", &nlp::Residuals::relative_stationarity},
    {"relative_complementarity", &nlp::Residuals::relative_complementarity},
    {"objective", &nlp::Residuals::objective},
    {"phi", &nlp::Residuals::phi}};
constexpr std::pair<const char*, std::string nlp::Residuals::*> kNames[] = {
    {"worst_constraint", &nlp::Residuals::worst_constraint},
    {"worst_variable", &nlp::Residuals::worst_variable},
    {"worst_pair", &nlp::Residuals::worst_pair}};
/// Which files of earlier versions do not have.
constexpr const char* kBeyondRounding = "violation_beyond_rounding";

}  // namespace

Json residuals_json(const nlp::Residuals& residuals) {
  Json json;
  for (const auto& [key, member] : kNumbers) json[key] = json_number(residuals.*member);
  for (const auto& [key, member] : kNames) json[key] = residuals.*member;
  json[kBeyondRounding] = json_number(residuals.violation_beyond_rounding);
  json["fault"] = fault_json(residuals.fault);
  return json;
}
nlp::Residuals read_residuals(const JsonReader& reader) {
  nlp::Residuals residuals;
  for (const auto& [key, member] : kNumbers) residuals.*member = reader.at(key).real();
  for (const auto& [key, member] : kNames) residuals.*member = reader.at(key).text();
  residuals.violation_beyond_rounding =
      reader.has(kBeyondRounding) ? reader.at(kBeyondRounding).real() : residuals.violation;
  residuals.fault = read_fault(reader.at("fault"));
  return residuals;
}

Json pairs_json(const std::vector<std::pair<std::string, double>>& pairs) {
  Json json = Json::array();
  for (const auto& [name, value] : pairs)
    json.push_back(Json{{"name", name}, {"value", json_number(value)}});
  return json;
}
std::vector<std::pair<std::string, double>> read_pairs(const JsonReader& reader) {
  return reader.each([](const JsonReader& item) {
    return std::pair(item.at("name").text(), item.at("value").real());
  });
}

}  // namespace slalom::io
