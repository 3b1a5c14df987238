#include "slalom/expr/expr.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>

#include "node_order.hpp"
#include "op.hpp"
#include "slalom/base/error.hpp"

namespace slalom::expr {

Node::Node(Op op, double value, std::string name, std::vector<Expr> args,
           std::shared_ptr<const Steps> steps)
    : op_(op),
      value_(value),
      name_(std::move(name)),
      args_(std::move(args)),
      steps_(std::move(steps)) {}

Node::~Node() {
  // Children that die with this node are collected and released one by one: no recursion.
  std::vector<Expr> dying = std::move(args_);
  while (!dying.empty()) {
    Expr last = std::move(dying.back());
    dying.pop_back();
    if (last.node_ && last.node_.use_count() == 1) {
      std::atomic_thread_fence(std::memory_order_acquire);  // after the other owners' last reads
      auto& args = const_cast<Node*>(last.node_.get())->args_;
      for (auto& arg : args) dying.push_back(std::move(arg));
      args.clear();
    }
  }
}

Expr::Expr() : Expr(0.0) {}
Expr::Expr(double value)
    : node_(std::make_shared<Node>(Op::constant, value, "", std::vector<Expr>{})) {}

Expr Expr::symbol(std::string name) {
  return Expr(std::make_shared<Node>(Op::symbol, 0.0, std::move(name), std::vector<Expr>{}));
}

bool Expr::is_constant() const {
  return node_->op() == Op::constant;
}
bool Expr::is_constant(double value) const {
  return is_constant() && node_->value() == value;
}
bool Expr::is_symbol() const {
  return node_->op() == Op::symbol;
}

double Expr::value() const {
  if (!is_constant()) throw Error("value of an expression that is not a constant");
  return node_->value();
}

const std::string& Expr::name() const {
  if (!is_symbol()) throw Error("name of an expression that is not a symbol");
  return node_->name();
}

Expr Expr::apply(Op op, const Expr& a) {
  if (a.is_constant()) return Expr(evaluate(op, a.value(), 0, 0));
  return Expr(std::make_shared<Node>(op, 0.0, "", std::vector<Expr>{a}));
}

Expr Expr::apply(Op op, const Expr& a, const Expr& b) {
  if (a.is_constant() && b.is_constant()) return Expr(evaluate(op, a.value(), b.value(), 0));
  return Expr(std::make_shared<Node>(op, 0.0, "", std::vector<Expr>{a, b}));
}

Expr Expr::apply(Op op, const Expr& a, const Expr& b, const Expr& c) {
  if (a.is_constant() && b.is_constant() && c.is_constant())
    return Expr(evaluate(op, a.value(), b.value(), c.value()));
  return Expr(std::make_shared<Node>(op, 0.0, "", std::vector<Expr>{a, b, c}));
}

double Steps::at(double x) const {
  // Where the steps are about evenly wide, as a table's mostly are, their number follows from x.
  if (const std::size_t count = begins.size(); count > 3) {
    const double share = (x - begins[1]) / (begins.back() - begins[1]);
    if (share > 0 && share < 1) {
      const auto k =
          std::min(1 + static_cast<std::size_t>(share * static_cast<double>(count - 2)), count - 2);
      if (begins[k] < x && x <= begins[k + 1]) return values[k];
    }
  }
  const auto next = std::lower_bound(begins.begin() + 1, begins.end(), x);
  return values[static_cast<std::size_t>(next - begins.begin()) - 1];
}

Expr Expr::apply(std::shared_ptr<const Steps> steps, const Expr& a) {
  if (a.is_constant()) return Expr(steps->at(a.value()));
  return Expr(std::make_shared<Node>(Op::lookup, 0.0, "", std::vector<Expr>{a}, std::move(steps)));
}

Expr& Expr::operator+=(const Expr& other) {
  return *this = *this + other;
}
Expr& Expr::operator-=(const Expr& other) {
  return *this = *this - other;
}
Expr& Expr::operator*=(const Expr& other) {
  return *this = *this * other;
}
Expr& Expr::operator/=(const Expr& other) {
  return *this = *this / other;
}

Expr operator+(const Expr& a, const Expr& b) {
  return Expr::apply(Op::add, a, b);
}
Expr operator-(const Expr& a, const Expr& b) {
  return Expr::apply(Op::sub, a, b);
}
Expr operator*(const Expr& a, const Expr& b) {
  return Expr::apply(Op::mul, a, b);
}
Expr operator/(const Expr& a, const Expr& b) {
  return Expr::apply(Op::div, a, b);
}
Expr operator-(const Expr& a) {
  return Expr::apply(Op::neg, a);
}
Expr operator+(const Expr& a) {
  return a;
}

Expr square(const Expr& a) {
  return Expr::apply(Op::square, a);
}
Expr sqrt(const Expr& a) {
  return Expr::apply(Op::sqrt, a);
}
Expr exp(const Expr& a) {
  return Expr::apply(Op::exp, a);
}
Expr log(const Expr& a) {
  return Expr::apply(Op::log, a);
}
Expr sin(const Expr& a) {
  return Expr::apply(Op::sin, a);
}
Expr cos(const Expr& a) {
  return Expr::apply(Op::cos, a);
}
Expr tan(const Expr& a) {
  return Expr::apply(Op::tan, a);
}
Expr asin(const Expr& a) {
  return Expr::apply(Op::asin, a);
}
Expr acos(const Expr& a) {
  return Expr::apply(Op::acos, a);
}
Expr atan(const Expr& a) {
  return Expr::apply(Op::atan, a);
}
Expr sinh(const Expr& a) {
  return Expr::apply(Op::sinh, a);
}
Expr cosh(const Expr& a) {
  return Expr::apply(Op::cosh, a);
}
Expr tanh(const Expr& a) {
  return Expr::apply(Op::tanh, a);
}
Expr abs(const Expr& a) {
  return Expr::apply(Op::abs, a);
}
Expr sign(const Expr& a) {
  return Expr::apply(Op::sign, a);
}
Expr pow(const Expr& a, const Expr& b) {
  return Expr::apply(Op::pow, a, b);
}
Expr atan2(const Expr& y, const Expr& x) {
  return Expr::apply(Op::atan2, y, x);
}
Expr min(const Expr& a, const Expr& b) {
  return Expr::apply(Op::min, a, b);
}
Expr max(const Expr& a, const Expr& b) {
  return Expr::apply(Op::max, a, b);
}
Expr select(const Expr& condition, const Expr& if_positive, const Expr& otherwise) {
  return Expr::apply(Op::select, condition, if_positive, otherwise);
}

double evaluate(Op op, double a, double b, double c) {
  switch (op) {
    case Op::constant:
    case Op::symbol:
      return a;
    case Op::neg:
      return -a;
    case Op::square:
      return a * a;
    case Op::sqrt:
      return std::sqrt(a);
    case Op::exp:
      return std::exp(a);
    case Op::log:
      return std::log(a);
    case Op::sin:
      return std::sin(a);
    case Op::cos:
      return std::cos(a);
    case Op::tan:
      return std::tan(a);
    case Op::asin:
      return std::asin(a);
    case Op::acos:
      return std::acos(a);
    case Op::atan:
      return std::atan(a);
    case Op::sinh:
      return std::sinh(a);
    case Op::cosh:
      return std::cosh(a);
    case Op::tanh:
      return std::tanh(a);
    case Op::abs:
      return std::fabs(a);
    case Op::sign:
      return std::isnan(a) ? a : static_cast<double>((a > 0) - (a < 0));
    case Op::lookup:  // of a step function: Steps::at
      break;
    case Op::add:
      return a + b;
    case Op::sub:
      return a - b;
    case Op::mul:
      return a * b;
    case Op::div:
      return a / b;
    case Op::pow:
      return std::pow(a, b);
    case Op::atan2:
      return std::atan2(a, b);
    case Op::min:
      return a < b ? a : b;
    case Op::max:
      return a > b ? a : b;
    case Op::select:
      return a > 0 ? b : c;
  }
  return std::nan("");
}

std::size_t arity(Op op) {
  if (op <= Op::symbol) return 0;
  if (op <= Op::lookup) return 1;
  return op == Op::select ? 3 : 2;
}

namespace {

/// Of each node of an order, an expression that is it: a part of another, or an output.
std::vector<const Expr*> handles(const NodeOrder& order, const std::vector<Expr>& outputs) {
  std::vector<const Expr*> handle(order.nodes().size(), nullptr);
  for (const auto& output : outputs) handle[order.place(output.node())] = &output;
  for (const Node* node : order.nodes())
    for (const auto& arg : node->args()) handle[order.place(arg.node())] = &arg;
  return handle;
}

/// The node with other arguments.
Expr applied(const Node& node, const std::vector<Expr>& args) {
  switch (args.size()) {
    case 1:
      return node.steps() ? Expr::apply(node.steps(), args[0]) : Expr::apply(node.op(), args[0]);
    case 2:
      return Expr::apply(node.op(), args[0], args[1]);
    default:
      return Expr::apply(node.op(), args[0], args[1], args[2]);
  }
}

}  // namespace

std::vector<Expr> substitute(const std::vector<Expr>& outputs, const std::vector<Expr>& symbols,
                             const std::vector<Expr>& replacements) {
  if (symbols.size() != replacements.size())
    throw Error("substitute: as many replacements as symbols are needed");
  std::unordered_map<const Node*, const Expr*> replacement;
  for (std::size_t i = 0; i < symbols.size(); ++i) {
    if (!symbols[i].is_symbol()) throw Error("substitute: only a symbol can be replaced");
    if (!replacement.emplace(symbols[i].node(), &replacements[i]).second)
      throw Error("substitute: '" + symbols[i].name() + "' is listed twice");
  }
  const NodeOrder order(outputs);
  // Of nodes above a symbol that is replaced; the others stay.
  std::vector<std::optional<Expr>> changed(order.nodes().size());
  std::vector<Expr> args;
  for (std::size_t k = 0; k < changed.size(); ++k) {
    const Node* node = order.nodes()[k];
    if (node->op() == Op::symbol) {
      if (const auto found = replacement.find(node); found != replacement.end())
        changed[k] = *found->second;
      continue;
    }
    bool any = false;
    for (const auto& arg : node->args()) any = any || changed[order.place(arg.node())];
    if (!any) continue;
    args.clear();
    for (const auto& arg : node->args())
      args.push_back(changed[order.place(arg.node())].value_or(arg));
    changed[k] = applied(*node, args);
  }
  std::vector<Expr> result;
  result.reserve(outputs.size());
  for (const auto& output : outputs)
    result.push_back(changed[order.place(output.node())].value_or(output));
  return result;
}

std::vector<Expr> symbols_of(const std::vector<Expr>& outputs) {
  const NodeOrder order(outputs);
  const auto handle = handles(order, outputs);
  std::vector<Expr> symbols;
  for (std::size_t k = 0; k < handle.size(); ++k)
    if (order.nodes()[k]->op() == Op::symbol) symbols.push_back(*handle[k]);
  return symbols;
}

}  // namespace slalom::expr
