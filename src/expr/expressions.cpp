// From the working copy back to expressions.

#include <optional>

#include "dag.hpp"
#include "function_impl.hpp"
#include "op.hpp"
#include "slalom/base/error.hpp"

namespace slalom::expr {

std::vector<Expr> expressions(const Dag& dag, const std::vector<Dag::Id>& ids,
                              const std::vector<Expr>& inputs) {
  std::vector<char> needed(dag.size(), 0);
  for (const auto id : ids) needed[id] = 1;
  for (auto id = static_cast<Dag::Id>(dag.size()); id-- > 0;)
    for (std::size_t i = 0; needed[id] != 0 && i < arity(dag[id].op); ++i)
      needed[dag[id].arg[i]] = 1;
  std::vector<std::optional<Expr>> image(dag.size());
  for (Dag::Id id = 0; id < dag.size(); ++id) {
    if (needed[id] == 0) continue;
    const auto& [op, arg, value] = dag[id];
    if (op == Op::constant)
      image[id] = Expr(value);
    else if (op == Op::symbol)
      image[id] = inputs.at(static_cast<std::size_t>(value));
    else if (op == Op::lookup)
      image[id] = Expr::apply(dag.steps(id), *image[arg[0]]);
    else if (arity(op) == 1)
      image[id] = Expr::apply(op, *image[arg[0]]);
    else if (arity(op) == 2)
      image[id] = Expr::apply(op, *image[arg[0]], *image[arg[1]]);
    else
      image[id] = Expr::apply(op, *image[arg[0]], *image[arg[1]], *image[arg[2]]);
  }
  std::vector<Expr> result;
  result.reserve(ids.size());
  for (const auto id : ids) result.push_back(*image[id]);
  return result;
}

std::vector<Expr> simplified(const std::vector<Expr>& outputs) {
  const auto symbols = symbols_of(outputs);
  std::unordered_map<const Node*, std::size_t> input_of;
  for (const auto& symbol : symbols) input_of.emplace(symbol.node(), input_of.size());
  Dag dag;
  const auto ids = dag.import(outputs, input_of);
  return expressions(dag, ids, symbols);
}

std::vector<Expr> Function::operator()(const std::vector<Expr>& variables,
                                       const std::vector<Expr>& data) const {
  if (variables.size() != impl_->variables || data.size() != impl_->data)
    throw Error("function: " + std::to_string(variables.size()) + " variables and " +
                std::to_string(data.size()) + " data, expected " +
                std::to_string(impl_->variables) + " and " + std::to_string(impl_->data));
  std::vector<Expr> inputs = variables;
  inputs.insert(inputs.end(), data.begin(), data.end());
  const std::lock_guard lock(impl_->mutex);  // derivatives made elsewhere grow the graph
  return expressions(impl_->dag, impl_->outputs, inputs);
}

}  // namespace slalom::expr
