#pragma once

#include <map>
#include <string>
#include <vector>

#include "nlp/expression_problem.hpp"

namespace slalom::nlp {

/// A problem of W. Hock and K. Schittkowski, Test Examples for Nonlinear Programming Codes, Lecture
/// Notes in Economics and Mathematical Systems 187, Springer 1981: variables, start, bounds and
/// rows g >= 0, g = 0 as they stand there.
struct HockSchittkowski : Statement {
  HockSchittkowski(int its_number, double value) : number(its_number), published(value) {}

  int number;
  double published;            ///< optimal value f(x*) as published
  std::vector<double> others;  ///< further values a method may end at, for the reason in `note`
  std::string note;
  Vector published_at;  ///< x*, where the published start leads to another local optimum
};

/// The problems of the library, by number; those with bounds alone are included.
std::vector<HockSchittkowski> hock_schittkowski();

/// Numbers from 1 to 119 that are not in the library, with the reason.
const std::map<int, std::string>& hock_schittkowski_excluded();

// Parts of the library, by number.
std::vector<HockSchittkowski> problems_1_to_23();
std::vector<HockSchittkowski> problems_24_to_49();
std::vector<HockSchittkowski> problems_50_to_70();
std::vector<HockSchittkowski> problems_71_to_92();
std::vector<HockSchittkowski> problems_93_to_108();
std::vector<HockSchittkowski> problems_109_to_119();

}  // namespace slalom::nlp
