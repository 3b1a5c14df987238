#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace slalom::expr {

/// Elementary operations. Each function below documents its derivative at kinks.
enum class Op : std::uint8_t {
  constant,
  symbol,
  neg,
  square,
  sqrt,
  exp,
  log,
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  sinh,
  cosh,
  tanh,
  abs,
  sign,
  lookup,  ///< the value of a step function, which the node has, at a
  add,
  sub,
  mul,
  div,
  pow,
  atan2,
  min,
  max,
  select,  ///< a > 0 ? b : c
};

class Node;

/// A step function: values[k] where x lies in (begins[k], begins[k + 1]], values[0] before, and the
/// last value after. As many begins, which rise, as values.
struct Steps {
  std::vector<double> begins, values;

  double at(double x) const;
};

/// A scalar expression: an immutable, shared graph of elementary operations, built by operators.
/// Copying shares the graph; building is thread-safe as long as each thread has its own Expr.
class Expr {
 public:
  Expr();              ///< the constant 0
  Expr(double value);  ///< a constant; implicit, so that 2 * x reads as in the paper

  /// A new symbol; two calls with one name give two different symbols.
  static Expr symbol(std::string name);

  bool is_constant() const;
  bool is_constant(double value) const;
  bool is_symbol() const;
  double value() const;             ///< of a constant; throws Error otherwise
  const std::string& name() const;  ///< of a symbol; throws Error otherwise
  bool same(const Expr& other) const { return node_ == other.node_; }
  const Node* node() const { return node_.get(); }

  Expr& operator+=(const Expr& other);
  Expr& operator-=(const Expr& other);
  Expr& operator*=(const Expr& other);
  Expr& operator/=(const Expr& other);

  /// For builders of graphs: applies `op`; constants fold. Algebraic rules are left to Function.
  static Expr apply(Op op, const Expr& a);
  static Expr apply(Op op, const Expr& a, const Expr& b);
  static Expr apply(Op op, const Expr& a, const Expr& b, const Expr& c);
  /// The step function at `a`; its derivative is 0. Takes as long whatever the number of steps.
  static Expr apply(std::shared_ptr<const Steps> steps, const Expr& a);

 private:
  friend class Node;
  explicit Expr(std::shared_ptr<const Node> node) : node_(std::move(node)) {}
  std::shared_ptr<const Node> node_;
};

Expr operator+(const Expr& a, const Expr& b);
Expr operator-(const Expr& a, const Expr& b);
Expr operator*(const Expr& a, const Expr& b);
Expr operator/(const Expr& a, const Expr& b);
Expr operator-(const Expr& a);
Expr operator+(const Expr& a);

Expr square(const Expr& a);
Expr sqrt(const Expr& a);  ///< derivative at 0 is +inf, and a solve that meets it says so
Expr exp(const Expr& a);
Expr log(const Expr& a);
Expr sin(const Expr& a);
Expr cos(const Expr& a);
Expr tan(const Expr& a);
Expr asin(const Expr& a);
Expr acos(const Expr& a);
Expr atan(const Expr& a);
Expr sinh(const Expr& a);
Expr cosh(const Expr& a);
Expr tanh(const Expr& a);
Expr abs(const Expr& a);   ///< derivative sign(a): 0 at a = 0
Expr sign(const Expr& a);  ///< -1, 0 or 1; derivative 0 everywhere
/// a^b. For a constant integer b the power is exact for negative a too; otherwise a > 0 is needed
/// wherever a derivative with respect to b is taken.
Expr pow(const Expr& a, const Expr& b);
Expr atan2(const Expr& y, const Expr& x);
Expr min(const Expr& a, const Expr& b);  ///< derivative at a = b: b's
Expr max(const Expr& a, const Expr& b);  ///< derivative at a = b: b's
/// condition > 0 ? if_positive : otherwise; the condition itself has derivative 0. So has the
/// branch not taken, even where it is undefined: select(x, sqrt(x), 0) is safe to differentiate at
/// x <= 0. (Guaranteed for up to eight nested selects, and up to eight that share a subexpression.)
Expr select(const Expr& condition, const Expr& if_positive, const Expr& otherwise);

/// A node of the graph, over which differentiation and compilation walk.
class Node {
 public:
  Node(Op op, double value, std::string name, std::vector<Expr> args,
       std::shared_ptr<const Steps> steps = {});
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;
  ~Node();  ///< iterative: a sum of a million terms must not overflow the stack

  Op op() const { return op_; }
  double value() const { return value_; }
  const std::string& name() const { return name_; }
  const std::vector<Expr>& args() const { return args_; }
  const std::shared_ptr<const Steps>& steps() const { return steps_; }  ///< of a lookup

 private:
  Op op_;
  double value_;
  std::string name_;
  std::vector<Expr> args_;
  std::shared_ptr<const Steps> steps_;
};

/// Replaces symbols by expressions throughout `outputs`.
std::vector<Expr> substitute(const std::vector<Expr>& outputs, const std::vector<Expr>& symbols,
                             const std::vector<Expr>& replacements);

/// The same functions, with equal subexpressions shared as one node and algebraic rules applied, as
/// Function does.
std::vector<Expr> simplified(const std::vector<Expr>& outputs);

/// The symbols on which `outputs` depend, in order of first appearance.
std::vector<Expr> symbols_of(const std::vector<Expr>& outputs);

}  // namespace slalom::expr
