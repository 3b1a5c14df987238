#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "../base/open_index.hpp"
#include "slalom/expr/expr.hpp"

namespace slalom::expr {

/// The nodes below some outputs, each once, arguments before users, and the place of each.
class NodeOrder {
 public:
  static constexpr std::size_t kNone = OpenIndex::kNone;

  explicit NodeOrder(const std::vector<Expr>& outputs);

  const std::vector<const Node*>& nodes() const { return nodes_; }
  /// kNone for a node that is not among them.
  std::size_t place(const Node* node) const {
    return index_.find(key(node), [&](std::size_t k) { return nodes_[k] == node; });
  }

 private:
  static std::uint64_t key(const Node* node) { return reinterpret_cast<std::uintptr_t>(node) >> 4; }

  std::vector<const Node*> nodes_;
  OpenIndex index_;
};

}  // namespace slalom::expr
