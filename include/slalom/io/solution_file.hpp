#pragma once

#include <string>

#include "slalom/ocp/solve.hpp"

namespace slalom::io {

/// A whole answer as JSON (docs/output-files.md): trajectory, mesh and schemes as tables, costates,
/// multipliers, residuals, options, and the point for warm starts. Callbacks in the options are not
/// part of it. read_solution takes the same bits from it.
std::string to_json(const ocp::Solution& solution);
std::string to_json(const ocp::PhasedSolution& solution);

/// One row a point: t, tau, states, controls, and at mesh nodes costates (elsewhere empty cells,
/// and everywhere of a solve that did not begin). Numbers have the fewest digits that read back to
/// the same bits.
std::string to_csv(const ocp::Solution& solution);

/// Writes an answer as JSON into `file`, whole or not at all. Throws Error.
void save_solution(const std::string& file, const ocp::Solution& solution);
void save_solution(const std::string& file, const ocp::PhasedSolution& solution);

/// Throws InvalidValue with the file, the key, what was found and what was expected.
ocp::Solution read_solution(const std::string& file);
ocp::PhasedSolution read_phased_solution(const std::string& file);
/// An answer of this problem: what has other states, controls, static parameters, slacks or
/// integrals is refused too.
ocp::Solution read_solution(const std::string& file, const ocp::Problem& problem);

/// States and controls from a CSV file such as to_csv writes, by the problem's names, as a guess: t
/// in its first column, any other columns left aside; static parameters, slacks and integrals are
/// not in it. Throws InvalidValue with file and line.
ocp::Trajectory read_trajectory(const std::string& file, const ocp::Problem& problem);

}  // namespace slalom::io
