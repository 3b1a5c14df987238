#pragma once

#include "json_file.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::io {

/// Most bytes of a solution's file, JSON or CSV.
inline constexpr std::size_t kMaxSolutionBytes = std::size_t{1} << 30U;

/// Parts of a solution's file, one function each way.
Json scheme_json(const ocp::Scheme& scheme);
ocp::Scheme read_scheme(const JsonReader& reader);
Json trajectory_json(const ocp::Trajectory& trajectory);
ocp::Trajectory read_trajectory(const JsonReader& reader, std::size_t states, std::size_t controls);
Json residuals_json(const nlp::Residuals& residuals);
nlp::Residuals read_residuals(const JsonReader& reader);
Json fault_json(const nlp::Fault& fault);
nlp::Fault read_fault(const JsonReader& reader);
/// Of a list of (name, number).
Json pairs_json(const std::vector<std::pair<std::string, double>>& pairs);
std::vector<std::pair<std::string, double>> read_pairs(const JsonReader& reader);

}  // namespace slalom::io
