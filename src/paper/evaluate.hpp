#pragma once

#include <functional>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "expression.hpp"
#include "reproduction.hpp"
#include "slalom/report/sweep_report.hpp"

namespace slalom::paper {

using Numbers = std::vector<double>;
/// What a formula comes to. Truth is 1 or 0; an interval is three numbers: the estimate, its least
/// and its greatest value.
using Value = std::variant<double, std::string, Numbers>;

/// A trial of the paper's sweep, as formulas see it.
struct SweepTrial {
  std::string planner, outcome, hit;
  double tex = 0, speed = 0;                         ///< [s], of O2 [m/s]
  double longest = 0, longest_wall = 0, median = 0;  ///< solve times [s]
};
/// Throws InvalidValue unless the sweep is over loop.tex and obstacles.O2.vy.
std::vector<SweepTrial> sweep_trials(const report::SweepTable& table);

/// What formulas look at. A pointer is null where there is none of it.
struct Evidence {
  std::map<std::string, const ReproducedDrive*> drives;  ///< by folder: "E_A/P_B", "cases/A"
  const PaperData* paper = nullptr;
  const report::PublishedSweep* published = nullptr;
  const std::vector<SweepTrial>* trials = nullptr;
  bool whole = false;  ///< all is driven that formulas may ask for
};

/// Thrown where a formula asks for what was not driven.
struct NotDriven {
  std::string what;
};

/// Where a formula is evaluated.
struct Context {
  const Evidence* evidence = nullptr;
  const std::map<std::string, Expression>* names = nullptr;  ///< a claim's own
  const std::vector<SweepTrial>* trials = nullptr;           ///< all, or those of one tex
  const SweepTrial* trial = nullptr;                         ///< within trials(), number(), ...
};

/// A measure or function: what it makes of its arguments.
struct Function {
  std::size_t least = 0, most = 0;  ///< arguments
  std::function<Value(const std::vector<Expression>&, const Context&)> call;
};
using Functions = std::map<std::string, Function>;
const Functions& list_functions();   ///< of lists of numbers
const Functions& drive_functions();  ///< of drives
const Functions& sweep_functions();  ///< of the sweep's trials

/// Throws InvalidValue for an unknown measure or number of arguments, at `where`.
void check_names(const Expression& expression, const std::string& where);

/// Throws NotDriven, and InvalidValue where kinds do not fit.
Value evaluate(const Expression& expression, const Context& context);
double number_of(const Expression& expression, const Context& context);
Numbers numbers_of(const Expression& expression, const Context& context);
std::string text_of(const Expression& expression, const Context& context);

/// A function of evaluated arguments.
Function eager(std::size_t arguments, std::function<double(const std::vector<Numbers>&)> function);

}  // namespace slalom::paper
