#pragma once

#include <cstddef>
#include <vector>

#include "slalom/expr/expr.hpp"

namespace slalom::expr {

/// The operation on plain numbers: the one definition of what each Op means.
double evaluate(Op op, double a, double b, double c);

/// Number of arguments.
std::size_t arity(Op op);

/// All nodes below `outputs`, arguments before users, each once.
std::vector<const Node*> topological_order(const std::vector<Expr>& outputs);

}  // namespace slalom::expr
