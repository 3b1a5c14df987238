#pragma once

#include <map>
#include <string>
#include <vector>

/// What the stub of KNITRO's library was told, and what it shall do.
struct KnitroStub {
  bool licence = true;
  int result = 0;    ///< returned by KN_solve instead of its own, where not 0
  int contexts = 0;  ///< made and not freed
  std::map<std::string, double> parameters;
  std::vector<double> xl, xu, gl, gu, x, y, z;  ///< bounds and start as given

  static KnitroStub& get();
};
