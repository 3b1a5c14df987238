#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "slalom/nlp/problem.hpp"
#include "slalom/nlp/solver.hpp"

namespace slalom::nlp {

/// A problem as text in AMPL's .nl format (Gay, Writing .nl Files, SAND2005-7907P, 2005), which
/// wants nonlinear variables and rows first.
struct NlFile {
  std::string text;
  std::vector<std::uint32_t> variables, rows;  ///< by place in the file: the problem's index
};

/// Formulas as expression graphs whose shared parts are defined variables; linear parts stand in
/// the J and G segments alone. The start's multipliers are written when `with_duals`: AMPL's sign
/// of a row's is the opposite of Start's; those of bounds are suffixes that Ipopt knows.
NlFile nl_file(const Formulas& formulas, const Limits& limits, const Start& start, bool with_duals);

}  // namespace slalom::nlp
