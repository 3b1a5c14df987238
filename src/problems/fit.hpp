#pragma once

#include <functional>
#include <string>
#include <vector>

#include "statement.hpp"

namespace slalom::problems {

/// A least-squares fit of constants to measurements of all states.
struct Fit {
  std::string name;
  std::vector<std::string> states, constants;
  std::vector<double> guess;              ///< of the constants, which are >= 0
  std::vector<double> begin;              ///< states at t = 0; empty: to be estimated too
  std::vector<double> times;              ///< of the measurements
  std::vector<std::vector<double>> data;  ///< [measurement][state]
  /// Rates of the states, from these, the constants and the time.
  std::function<std::vector<Expr>(const std::vector<Expr>& states,
                                  const std::vector<Expr>& constants, const Expr& time)>
      rates;
};

/// One phase between a measurement and the next, each constant a state of rate 0 that all phases
/// connect: the squared residuals are then costs at the phases' ends. The guess of the states is
/// lines through the measurements.
Statement fitted(const Fit& fit);

}  // namespace slalom::problems
