#pragma once

#include <vector>

#include "slalom/expr/expr.hpp"

namespace slalom::expr {

/// The natural cubic spline through (knots[i], values[i]) as a function of x: twice continuously
/// differentiable, with a second derivative of 0 at both ends, and a line beyond them (de Boor, A
/// Practical Guide to Splines, 2001, chapter IV). Two knots make a line. Throws InvalidValue for
/// fewer, for numbers that are not finite, for knots that do not rise, and unless there are as many
/// values as knots.
Expr cubic_spline(const Expr& x, const std::vector<double>& knots,
                  const std::vector<double>& values);
/// The same through values that are expressions, such as parameters of an optimal-control problem:
/// a function of time that changes between solves.
Expr cubic_spline(const Expr& x, const std::vector<double>& knots, const std::vector<Expr>& values);

}  // namespace slalom::expr
