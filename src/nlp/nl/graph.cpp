#include "graph.hpp"

#include <fmt/format.h>

#include <iterator>

#include "slalom/base/error.hpp"

namespace slalom::nlp {
namespace {

using expr::Node;
using expr::Op;

bool leaf(const Node* node) {
  return node->args().empty();
}

/// How often the text of `node` writes each of its arguments.
std::size_t repeats(const Node* node) {
  return node->op() == Op::sign ? 2 : 1;
}

/// Opcodes of Gay 2005, table 5; none for what takes more than one.
const char* opcode(Op op) {
  switch (op) {
    case Op::add:
      return "o0\n";
    case Op::sub:
      return "o1\n";
    case Op::mul:
      return "o2\n";
    case Op::div:
      return "o3\n";
    case Op::square:
    case Op::pow:
      return "o5\n";
    case Op::min:
      return "o11\n2\n";
    case Op::max:
      return "o12\n2\n";
    case Op::abs:
      return "o15\n";
    case Op::neg:
      return "o16\n";
    case Op::tanh:
      return "o37\n";
    case Op::tan:
      return "o38\n";
    case Op::sqrt:
      return "o39\n";
    case Op::sinh:
      return "o40\n";
    case Op::sin:
      return "o41\n";
    case Op::log:
      return "o43\n";
    case Op::exp:
      return "o44\n";
    case Op::cosh:
      return "o45\n";
    case Op::cos:
      return "o46\n";
    case Op::atan2:
      return "o48\n";
    case Op::atan:
      return "o49\n";
    case Op::asin:
      return "o51\n";
    case Op::acos:
      return "o53\n";
    default:
      return "";
  }
}

/// A node to be written, or words.
struct Item {
  const Node* node;
  const char* words;
};

/// What stands for an operation, in order.
std::vector<Item> spelling(const Node* node) {
  const auto arg = [&](std::size_t i) { return Item{node->args()[i].node(), nullptr}; };
  const auto words = [](const char* text) { return Item{nullptr, text}; };
  switch (node->op()) {
    case Op::square:
      return {words(opcode(Op::pow)), arg(0), words("n2\n")};
    case Op::sign:  // if a > 0 then 1 else if a < 0 then -1 else 0
      return {words("o35\no29\n"), arg(0), words("n0\nn1\no35\no22\n"), arg(0),
              words("n0\nn-1\nn0\n")};
    case Op::select:
      return {words("o35\no29\n"), arg(0), words("n0\n"), arg(1), arg(2)};
    default: {
      std::vector<Item> items{words(opcode(node->op()))};
      for (std::size_t i = 0; i < node->args().size(); ++i) items.push_back(arg(i));
      return items;
    }
  }
}

void write_number(double value, std::string& out) {
  fmt::format_to(std::back_inserter(out), "n{}\n", value);
}

}  // namespace

std::vector<const Node*> Graph::add(const AffineParts& parts, std::size_t user) {
  std::vector<const Node*> symbols, stack;
  for (const auto& [root, factor] : parts.nonlinear) {
    ++uses_[root].references;
    roots_.push_back(root);
    stack.push_back(root);
    while (!stack.empty()) {
      const Node* node = stack.back();
      stack.pop_back();
      Use& use = uses_[node];
      if (use.last_user == user) continue;
      const bool known = use.shared.node != nullptr;
      use.last_user = user;
      use.shared.node = node;
      use.shared.in_objective = use.shared.in_objective || user == kObjective;
      if (user != kObjective) {
        ++use.shared.rows;
        use.shared.last_row = user;
      }
      if (node->op() == Op::symbol) symbols.push_back(node);
      for (const auto& arg : node->args()) {
        if (!known) uses_[arg.node()].references += repeats(node);
        stack.push_back(arg.node());
      }
    }
  }
  return symbols;
}

std::vector<Shared> Graph::shared() const {
  std::vector<Shared> result;
  std::unordered_map<const Node*, bool> done;  // false: its arguments are on the stack
  for (const Node* root : roots_) {
    std::vector<const Node*> stack{root};
    while (!stack.empty()) {
      const Node* node = stack.back();
      const auto [state, fresh] = done.emplace(node, false);
      if (fresh) {
        for (const auto& arg : node->args())
          if (!done.contains(arg.node())) stack.push_back(arg.node());
        continue;
      }
      stack.pop_back();
      if (state->second) continue;
      state->second = true;
      const Use& use = uses_.at(node);
      if (!leaf(node) && use.references > 1) result.push_back(use.shared);
    }
  }
  return result;
}

void write_tree(const Node* root, bool root_by_name, const NlNames& names, std::string& out) {
  std::vector<Item> stack{{root, nullptr}};
  while (!stack.empty()) {
    const auto [node, words] = stack.back();
    stack.pop_back();
    if (words != nullptr) {
      out += words;
      continue;
    }
    const auto name = names.find(node);
    if (name != names.end() && (root_by_name || node != root)) {
      fmt::format_to(std::back_inserter(out), "v{}\n", name->second);
    } else if (node->op() == Op::constant) {
      write_number(node->value(), out);
    } else {
      const auto items = spelling(node);
      stack.insert(stack.end(), items.rbegin(), items.rend());
    }
  }
}

void write_sum(const AffineParts& parts, const NlNames& names, std::string& out) {
  const bool constant = parts.constant != 0 || parts.nonlinear.empty();
  const std::size_t terms = parts.nonlinear.size() + (constant ? 1 : 0);
  if (terms == 2) out += opcode(Op::add);
  if (terms > 2) fmt::format_to(std::back_inserter(out), "o54\n{}\n", terms);
  for (const auto& [node, factor] : parts.nonlinear) {
    if (factor == -1) out += opcode(Op::neg);
    if (factor != 1 && factor != -1) {
      out += opcode(Op::mul);
      write_number(factor, out);
    }
    write_tree(node, true, names, out);
  }
  if (constant) write_number(parts.constant, out);
}

}  // namespace slalom::nlp
