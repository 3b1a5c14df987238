#pragma once

#include <string>
#include <vector>

namespace slalom::paper {

/// A formula of config/paper: numbers, words, calls of measures, and operations.
///
///     time(E_A/P_B) < time(E_A/P_A) - 1.5 and arrives(E_A/P_B)
///
/// Operators bind in this order: * and /, + and -, comparisons, not, and, or. A word may hold '/',
/// '-' and '.', so that it can name a drive; the operators of these signs stand between spaces.
struct Expression {
  enum class Kind { number, word, call, operation };
  Kind kind = Kind::number;
  double number = 0;
  std::string name;  ///< word, measure, or operator ("negate" for a sign)
  std::vector<Expression> parts;
};

/// Throws InvalidValue at `where` for text that is no formula.
Expression parse_expression(const std::string& text, const std::string& where);

}  // namespace slalom::paper
