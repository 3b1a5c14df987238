#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "../base/open_index.hpp"
#include "slalom/expr/expr.hpp"
#include "slalom/expr/function.hpp"

namespace slalom::expr {

/// A hash-consed working copy of expressions: equal subexpressions are one vertex, algebraic rules
/// are applied on the way in. Arguments always have smaller ids than their users.
class Dag {
 public:
  using Id = std::uint32_t;
  struct Vertex {
    Op op;
    std::array<Id, 3> arg;
    double value;  ///< of a constant; index of an input (Op::symbol), or of steps (Op::lookup)
  };

  Id constant(double value);
  Id input(std::size_t index);
  Id apply(Op op, Id a, Id b = 0, Id c = 0);
  Id lookup(const std::shared_ptr<const Steps>& steps, Id a);

  Id add(Id a, Id b) { return apply(Op::add, a, b); }
  Id sub(Id a, Id b) { return apply(Op::sub, a, b); }
  Id mul(Id a, Id b) { return apply(Op::mul, a, b); }
  Id div(Id a, Id b) { return apply(Op::div, a, b); }
  Id scale(double factor, Id a) { return mul(constant(factor), a); }

  const Vertex& operator[](Id id) const { return vertices_[id]; }
  std::size_t size() const { return vertices_.size(); }
  const std::vector<Vertex>& vertices() const { return vertices_; }
  /// The step function of a lookup.
  const std::shared_ptr<const Steps>& steps(Id id) const {
    return steps_[static_cast<std::size_t>(vertices_[id].value)];
  }
  const std::vector<std::shared_ptr<const Steps>>& all_steps() const { return steps_; }
  bool is_constant(Id id) const { return vertices_[id].op == Op::constant; }
  bool is(Id id, double value) const { return is_constant(id) && vertices_[id].value == value; }

  /// Copies `outputs` in; `input_of` gives the input index of each symbol. Throws Error naming a
  /// symbol that has none.
  std::vector<Id> import(const std::vector<Expr>& outputs,
                         const std::unordered_map<const Node*, std::size_t>& input_of);

 private:
  Id insert(Op op, Id a, Id b, Id c, double value);
  Id simplify_binary(Op op, Id a, Id b);
  Id simplify_mul(Id a, Id b);
  Id simplify_pow(Id a, Id b);
  Id simplify_select(Id condition, Id yes, Id no);
  bool may_vanish(Id id, int depth) const;  ///< a select with a 0, or a sum of such
  std::optional<Id> inside_mask(Op op, Id a, Id b);
  Id integer_power(Id a, int n);

  std::vector<Vertex> vertices_;
  std::vector<std::shared_ptr<const Steps>> steps_;
  OpenIndex index_;  ///< of the vertices
  int mask_depth_ = 0;
};

/// The vertices `ids` as expressions of `inputs`, one for each input of the graph; what several of
/// them use is one node.
std::vector<Expr> expressions(const Dag& dag, const std::vector<Dag::Id>& ids,
                              const std::vector<Expr>& inputs);

/// A symbolic sparse derivative: positions and the vertices that hold their values.
struct SparseDerivative {
  std::vector<Entry> pattern;
  std::vector<Dag::Id> values;
};

/// Jacobian of `outputs` by the first `variables` inputs, sorted by row, then column. Vertex
/// elimination in Markowitz order (Griewank & Walther, Evaluating Derivatives, 2nd ed., ch. 10).
SparseDerivative jacobian(Dag& dag, const std::vector<Dag::Id>& outputs, std::size_t variables);

/// Lower triangle of the Hessian of sum weights[k] * outputs[k] by the first `variables` inputs,
/// by edge pushing (Gower & Mello, Optim. Methods Softw. 27(2), 2012), which keeps to the
/// nonlinear interactions that exist and uses symmetry.
SparseDerivative hessian(Dag& dag, const std::vector<Dag::Id>& outputs,
                         const std::vector<Dag::Id>& weights, std::size_t variables);

/// The same from the Jacobian of the outputs, by elimination in the graph of the weighted gradient:
/// blind to symmetry, but sharing the Jacobian's work. Which one is shorter depends on the
/// function.
SparseDerivative hessian_by_elimination(Dag& dag, const SparseDerivative& jacobian,
                                        const std::vector<Dag::Id>& weights, std::size_t variables);

}  // namespace slalom::expr
