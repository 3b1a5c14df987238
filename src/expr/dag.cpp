#include "dag.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "../base/same_bits.hpp"
#include "node_order.hpp"
#include "op.hpp"
#include "slalom/base/error.hpp"

namespace slalom::expr {

namespace {

std::uint64_t hash_of(const Dag::Vertex& v) {
  std::uint64_t hash = static_cast<std::uint64_t>(v.op) * 0x9E3779B97F4A7C15ull;
  for (std::uint64_t part : {std::uint64_t{v.arg[0]}, std::uint64_t{v.arg[1]},
                             std::uint64_t{v.arg[2]}, std::bit_cast<std::uint64_t>(v.value)}) {
    hash ^= part + 0x9E3779B97F4A7C15ull + (hash << 6) + (hash >> 2);
    hash *= 0xFF51AFD7ED558CCDull;
  }
  return hash ^ (hash >> 32);
}

}  // namespace

Dag::Id Dag::insert(Op op, Id a, Id b, Id c, double value) {
  const Vertex wanted{op, {a, b, c}, value};
  const auto found = index_.find(hash_of(wanted), [&](std::size_t id) {
    const Vertex& v = vertices_[id];
    return v.op == op && v.arg == wanted.arg && same_bits(v.value, value);
  });
  if (found != OpenIndex::kNone) return static_cast<Id>(found);
  vertices_.push_back(wanted);
  index_.add([&](std::size_t id) { return hash_of(vertices_[id]); });
  return static_cast<Id>(vertices_.size() - 1);
}

Dag::Id Dag::constant(double value) {
  return insert(Op::constant, 0, 0, 0, value == 0 ? 0.0 : value);  // one zero, not two
}

Dag::Id Dag::input(std::size_t index) {
  return insert(Op::symbol, 0, 0, 0, static_cast<double>(index));
}

Dag::Id Dag::apply(Op op, Id a, Id b, Id c) {
  const std::size_t n = arity(op);
  const bool constant_args =
      is_constant(a) && (n < 2 || is_constant(b)) && (n < 3 || is_constant(c));
  if (constant_args)
    return constant(evaluate(op, vertices_[a].value, n > 1 ? vertices_[b].value : 0,
                             n > 2 ? vertices_[c].value : 0));
  if (n == 2) {
    if (const auto masked = inside_mask(op, a, b)) return *masked;
    return simplify_binary(op, a, b);
  }
  if (op == Op::neg || op == Op::square)
    if (const auto masked = inside_mask(op, a, a)) return *masked;
  if (op == Op::neg) {
    if (vertices_[a].op == Op::neg) return vertices_[a].arg[0];
    if (vertices_[a].op == Op::sub) return sub(vertices_[a].arg[1], vertices_[a].arg[0]);
    if (vertices_[a].op == Op::mul && is_constant(vertices_[a].arg[0]))
      return scale(-vertices_[vertices_[a].arg[0]].value, vertices_[a].arg[1]);
  }
  if (op == Op::select) return simplify_select(a, b, c);
  if (op == Op::square && vertices_[a].op == Op::neg) a = vertices_[a].arg[0];
  return insert(op, a, n > 1 ? b : 0, n > 2 ? c : 0, 0);
}

Dag::Id Dag::lookup(const std::shared_ptr<const Steps>& steps, Id a) {
  if (is_constant(a)) return constant(steps->at(vertices_[a].value));
  const auto known = std::find(steps_.begin(), steps_.end(), steps);
  const auto index = static_cast<double>(known - steps_.begin());
  if (known == steps_.end()) steps_.push_back(steps);
  return insert(Op::lookup, a, 0, 0, index);
}

Dag::Id Dag::simplify_select(Id condition, Id yes, Id no) {
  const auto same_condition = [&](Id id) {
    return vertices_[id].op == Op::select && vertices_[id].arg[0] == condition;
  };
  if (is_constant(condition)) return vertices_[condition].value > 0 ? yes : no;
  if (same_condition(yes)) yes = vertices_[yes].arg[1];
  if (same_condition(no)) no = vertices_[no].arg[2];
  return yes == no ? yes : insert(Op::select, condition, yes, no, 0);
}

bool Dag::may_vanish(Id id, int depth) const {
  const Vertex& vertex = vertices_[id];
  const Op op = vertex.op;
  if (op == Op::constant) return vertex.value == 0;
  if (depth == 0) return false;
  const auto below = [&](std::size_t i) { return may_vanish(vertex.arg[i], depth - 1); };
  if (op == Op::select) return below(1) || below(2);
  if (op == Op::add || op == Op::sub) return below(0) && below(1);
  return op == Op::neg && below(0);
}

/// Derivatives are products and sums of partial derivatives, and select's are masks, select(c, 1,
/// 0). Multiplying inside masks, select(c, x, 0) * u = select(c, x * u, 0), keeps the derivative of
/// a branch that is not taken at 0 even if some factor of it, evaluated outside its domain, is
/// infinite or NaN.
std::optional<Dag::Id> Dag::inside_mask(Op op, Id a, Id b) {
  constexpr int kDeepest = 8;  // masks within masks, and added up; bounds the recursion
  const bool unary = arity(op) == 1, sum = op == Op::add || op == Op::sub;
  if (mask_depth_ >= kDeepest) return std::nullopt;
  if (!unary && !sum && op != Op::mul && op != Op::div) return std::nullopt;
  if (op == Op::mul && !may_vanish(a, kDeepest)) std::swap(a, b);
  if (is_constant(a) || !may_vanish(a, kDeepest)) return std::nullopt;
  const auto [outer, arg, value] = vertices_[a];
  const auto deeper = [&](Id left, Id right) {
    ++mask_depth_;
    const Id result = apply(op, left, right);
    --mask_depth_;
    return result;
  };
  if (outer != Op::select) {
    if (unary || sum) return std::nullopt;
    const Id left = deeper(arg[0], b);
    return apply(outer, left, outer == Op::neg ? 0 : deeper(arg[1], b));
  }
  const bool same = vertices_[b].op == Op::select && vertices_[b].arg[0] == arg[0];
  if (sum && !(same && may_vanish(b, kDeepest))) return std::nullopt;
  const Id yes = deeper(arg[1], same ? vertices_[b].arg[1] : b);
  const Id no = deeper(arg[2], same ? vertices_[b].arg[2] : b);
  return simplify_select(arg[0], yes, no);
}

Dag::Id Dag::simplify_binary(Op op, Id a, Id b) {
  switch (op) {
    case Op::add:
      if (is(a, 0)) return b;
      if (is(b, 0)) return a;
      if (a == b) return scale(2, a);
      if (vertices_[b].op == Op::neg) return sub(a, vertices_[b].arg[0]);
      if (vertices_[a].op == Op::neg) return sub(b, vertices_[a].arg[0]);
      if (a > b) std::swap(a, b);
      break;
    case Op::sub:
      if (is(b, 0)) return a;
      if (is(a, 0)) return apply(Op::neg, b);
      if (a == b) return constant(0);
      if (vertices_[b].op == Op::neg) return add(a, vertices_[b].arg[0]);
      break;
    case Op::mul:
      return simplify_mul(a, b);
    case Op::div:
      if (is(a, 0)) return constant(0);
      if (is(b, 1)) return a;
      if (a == b) return constant(1);
      if (is_constant(b) && std::isnormal(1 / vertices_[b].value))
        return scale(1 / vertices_[b].value, a);
      break;
    case Op::pow:
      return simplify_pow(a, b);
    case Op::min:
    case Op::max:
      if (a == b) return a;
      break;
    default:
      break;
  }
  return insert(op, a, b, 0, 0);
}

Dag::Id Dag::simplify_mul(Id a, Id b) {
  if (is_constant(b)) std::swap(a, b);  // constants first
  if (is(a, 0)) return a;
  if (is(a, 1)) return b;
  if (is(a, -1)) return apply(Op::neg, b);
  if (a == b) return apply(Op::square, a);
  if (is_constant(a) && vertices_[b].op == Op::mul && is_constant(vertices_[b].arg[0]))
    return scale(vertices_[a].value * vertices_[vertices_[b].arg[0]].value, vertices_[b].arg[1]);
  if (is_constant(a) && vertices_[b].op == Op::neg)
    return scale(-vertices_[a].value, vertices_[b].arg[0]);
  if (vertices_[a].op == Op::neg && vertices_[b].op == Op::neg)
    return mul(vertices_[a].arg[0], vertices_[b].arg[0]);
  if (!is_constant(a) && a > b) std::swap(a, b);
  return insert(Op::mul, a, b, 0, 0);
}

Dag::Id Dag::simplify_pow(Id a, Id b) {
  if (is_constant(b)) {
    const double n = vertices_[b].value;
    if (n == 0.5) return apply(Op::sqrt, a);
    if (n == std::floor(n) && std::fabs(n) <= 64) return integer_power(a, static_cast<int>(n));
  }
  return insert(Op::pow, a, b, 0, 0);
}

Dag::Id Dag::integer_power(Id a, int n) {
  if (n < 0) return div(constant(1), integer_power(a, -n));
  if (n == 0) return constant(1);
  if (n == 1) return a;
  const Id half = integer_power(a, n / 2);
  const Id even = apply(Op::square, half);
  return n % 2 == 0 ? even : mul(a, even);
}

std::vector<Dag::Id> Dag::import(const std::vector<Expr>& outputs,
                                 const std::unordered_map<const Node*, std::size_t>& input_of) {
  const NodeOrder order(outputs);
  std::vector<Id> image;
  image.reserve(order.nodes().size());
  for (const Node* node : order.nodes()) {
    Id id = 0;
    if (node->op() == Op::constant) {
      id = constant(node->value());
    } else if (node->op() == Op::symbol) {
      const auto it = input_of.find(node);
      if (it == input_of.end())
        throw Error("function: an output depends on '" + node->name() +
                    "', which is neither a variable nor data");
      id = input(it->second);
    } else {
      std::array<Id, 3> arg{};
      for (std::size_t i = 0; i < node->args().size(); ++i)
        arg[i] = image[order.place(node->args()[i].node())];
      id =
          node->steps() ? lookup(node->steps(), arg[0]) : apply(node->op(), arg[0], arg[1], arg[2]);
    }
    image.push_back(id);
  }
  std::vector<Id> ids;
  ids.reserve(outputs.size());
  for (const auto& output : outputs) ids.push_back(image[order.place(output.node())]);
  return ids;
}

}  // namespace slalom::expr
