#pragma once

#include <cstdlib>
#include <string>

namespace slalom {

/// The program that the tests of back end nl run: $SLALOM_NL_SOLVER, else the one built beside
/// them; empty where the machine lacks AMPL's library.
inline std::string nl_solver() {
  if (const char* given = std::getenv("SLALOM_NL_SOLVER")) return given;
#ifdef SLALOM_NL_SOLVER
  return SLALOM_NL_SOLVER;
#else
  return "";
#endif
}

}  // namespace slalom

/// A test that needs such a program.
#define SLALOM_NEEDS_NL_SOLVER() \
  if (slalom::nl_solver().empty()) GTEST_SKIP() << "no AMPL library to build a solver with"
