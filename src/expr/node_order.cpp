#include "node_order.hpp"

#include <utility>

#include "op.hpp"

namespace slalom::expr {

NodeOrder::NodeOrder(const std::vector<Expr>& outputs) {
  std::vector<std::pair<const Node*, std::size_t>> stack;
  for (const auto& output : outputs) {
    stack.emplace_back(output.node(), 0);
    while (!stack.empty()) {
      auto& [node, next] = stack.back();
      if (next == 0 && place(node) != kNone) {
        stack.pop_back();
      } else if (next < node->args().size()) {
        const Node* child = node->args()[next++].node();
        if (place(child) == kNone) stack.emplace_back(child, 0);
      } else {
        if (place(node) == kNone) {
          nodes_.push_back(node);
          index_.add([&](std::size_t k) { return key(nodes_[k]); });
        }
        stack.pop_back();
      }
    }
  }
}

std::vector<const Node*> topological_order(const std::vector<Expr>& outputs) {
  return NodeOrder(outputs).nodes();
}

}  // namespace slalom::expr
