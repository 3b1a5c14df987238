#pragma once

#include <vector>

#include "slalom/expr/expr.hpp"

namespace slalom::expr {

/// How a table goes on beyond its first and last knot.
enum class Beyond {
  line,  ///< with the slope it has there
  hold,  ///< with the value it has there
};

/// The natural cubic spline through (knots[i], values[i]) as a function of x: twice continuously
/// differentiable, with a second derivative of 0 at both ends (de Boor, A Practical Guide to
/// Splines, 2001, chapter IV). Two knots make a line. Throws InvalidValue for fewer, for numbers
/// that are not finite, for knots that do not rise, and unless there are as many values as knots.
Expr cubic_spline(const Expr& x, const std::vector<double>& knots,
                  const std::vector<double>& values, Beyond beyond = Beyond::line);
/// The same through values that are expressions, such as parameters of an optimal-control problem:
/// a function of time that changes between solves.
Expr cubic_spline(const Expr& x, const std::vector<double>& knots, const std::vector<Expr>& values,
                  Beyond beyond = Beyond::line);

/// For each table that `outputs` use and that goes on as a line, how far inside its knots its x is
/// [unit of x]: negative beyond them.
std::vector<Expr> room_in_tables(const std::vector<Expr>& outputs);

/// The same functions without Op::lookup, by choices between values: for what knows no tables.
std::vector<Expr> without_lookups(const std::vector<Expr>& outputs);

}  // namespace slalom::expr
