#include "affine.hpp"

#include <algorithm>

namespace slalom::nlp {
namespace {

using expr::Expr;
using expr::Node;
using expr::Op;

/// The arguments through which `node` is linear, with their factors; none where it is not, or is a
/// leaf.
std::vector<std::pair<const Node*, double>> linear_arguments(const Node& node) {
  const auto& args = node.args();
  switch (node.op()) {
    case Op::add:
      return {{args[0].node(), 1}, {args[1].node(), 1}};
    case Op::sub:
      return {{args[0].node(), 1}, {args[1].node(), -1}};
    case Op::neg:
      return {{args[0].node(), -1}};
    case Op::mul:
      if (args[0].is_constant()) return {{args[1].node(), args[0].value()}};
      if (args[1].is_constant()) return {{args[0].node(), args[1].value()}};
      return {};
    case Op::div:
      if (args[1].is_constant()) return {{args[0].node(), 1 / args[1].value()}};
      return {};
    default:
      return {};
  }
}

/// The nodes of the sum, users before arguments.
std::vector<const Node*> users_first(const Node* root) {
  std::vector<const Node*> order;
  std::unordered_map<const Node*, bool> done;  // false: its arguments are on the stack
  std::vector<const Node*> stack{root};
  while (!stack.empty()) {
    const Node* node = stack.back();
    const auto [state, fresh] = done.emplace(node, false);
    if (fresh) {
      for (const auto& [arg, factor] : linear_arguments(*node))
        if (!done.contains(arg)) stack.push_back(arg);
      continue;
    }
    stack.pop_back();
    if (state->second) continue;
    state->second = true;
    order.push_back(node);
  }
  std::reverse(order.begin(), order.end());
  return order;
}

}  // namespace

AffineParts affine_parts(const Expr& output, const VariableIndex& index) {
  AffineParts parts;
  std::unordered_map<const Node*, double> coefficient{{output.node(), 1}};
  for (const Node* node : users_first(output.node())) {
    const double factor = coefficient[node];
    const auto arguments = linear_arguments(*node);
    if (node->op() == Op::constant)
      parts.constant += factor * node->value();
    else if (node->op() == Op::symbol)
      parts.linear.emplace_back(index.at(node), factor);
    else if (arguments.empty())
      parts.nonlinear.emplace_back(node, factor);
    for (const auto& [arg, scale] : arguments) coefficient[arg] += factor * scale;
  }
  return parts;
}

}  // namespace slalom::nlp
