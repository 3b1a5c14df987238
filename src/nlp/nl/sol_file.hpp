#pragma once

#include <map>
#include <string>
#include <vector>

namespace slalom::nlp {

/// What a solver wrote into AMPL's .sol file (Gay, Hooking Your Solver to AMPL, 1997, section
/// "Writing the stub.sol file"; as text). Indices are the .nl file's.
struct SolFile {
  std::string message;
  std::vector<double> y, x;  ///< empty where the solver gave none
  int result = -1;           ///< solve_result_num; -1 where there is none
  /// Real suffixes of variables, by name; 0 where the file has no number.
  std::map<std::string, std::vector<double>> variable_suffixes;
};

/// Throws InvalidValue, naming `where` and the line, for a text that is not such a file, or is of
/// another number of variables or rows.
SolFile read_sol(const std::string& text, std::size_t variables, std::size_t rows,
                 const std::string& where);

}  // namespace slalom::nlp
