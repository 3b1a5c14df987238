#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "dag.hpp"
#include "op.hpp"

namespace slalom::expr {
namespace {

using Id = Dag::Id;

/// First and second partial derivatives of one vertex by its arguments, arguments merged when the
/// same vertex stands twice (atan2(x, x)).
struct Partials {
  std::vector<std::pair<Id, Id>> first;                          ///< argument, derivative
  std::vector<std::tuple<std::size_t, std::size_t, Id>> second;  ///< positions i >= j in `first`
};

Id unary_first(Dag& d, Op op, Id a, Id v) {
  switch (op) {
    case Op::neg:
      return d.constant(-1);
    case Op::square:
      return d.scale(2, a);
    case Op::sqrt:
      return d.div(d.constant(0.5), v);
    case Op::exp:
      return v;
    case Op::log:
      return d.div(d.constant(1), a);
    case Op::sin:
      return d.apply(Op::cos, a);
    case Op::cos:
      return d.apply(Op::neg, d.apply(Op::sin, a));
    case Op::tan:
      return d.add(d.constant(1), d.apply(Op::square, v));
    case Op::asin:
    case Op::acos:
      return d.div(d.constant(op == Op::asin ? 1 : -1),
                   d.apply(Op::sqrt, d.sub(d.constant(1), d.apply(Op::square, a))));
    case Op::atan:
      return d.div(d.constant(1), d.add(d.constant(1), d.apply(Op::square, a)));
    case Op::sinh:
      return d.apply(Op::cosh, a);
    case Op::cosh:
      return d.apply(Op::sinh, a);
    case Op::tanh:
      return d.sub(d.constant(1), d.apply(Op::square, v));
    case Op::abs:
      return d.apply(Op::sign, a);
    default:
      return d.constant(0);
  }
}

/// Second derivative from argument a, value v and first derivative p.
Id unary_second(Dag& d, Op op, Id a, Id v, Id p) {
  switch (op) {
    case Op::square:
      return d.constant(2);
    case Op::sqrt:
      return d.div(d.scale(-0.5, p), a);
    case Op::exp:
    case Op::sinh:
    case Op::cosh:
      return v;
    case Op::log:
      return d.apply(Op::neg, d.apply(Op::square, p));
    case Op::sin:
    case Op::cos:
      return d.apply(Op::neg, v);
    case Op::tan:
      return d.scale(2, d.mul(v, p));
    case Op::asin:
    case Op::acos:
      return d.mul(a, d.mul(p, d.apply(Op::square, p)));
    case Op::atan:
      return d.scale(-2, d.mul(a, d.apply(Op::square, p)));
    case Op::tanh:
      return d.scale(-2, d.mul(v, p));
    default:
      return d.constant(0);
  }
}

struct BinaryPartials {
  Id a, b, aa, ab, bb;
};

BinaryPartials pow_partials(Dag& d, Id a, Id b, Id v) {
  const Id zero = d.constant(0), one = d.constant(1);
  const Id b_less = d.sub(b, one);
  const Id power = d.apply(Op::pow, a, b_less);
  const Id fa = d.mul(b, power);
  const Id faa = d.mul(d.mul(b, b_less), d.apply(Op::pow, a, d.sub(b, d.constant(2))));
  if (d.is_constant(b)) return {fa, zero, faa, zero, zero};
  const Id log_a = d.apply(Op::log, a);
  return {fa, d.mul(v, log_a), faa, d.mul(power, d.add(one, d.mul(b, log_a))),
          d.mul(v, d.apply(Op::square, log_a))};
}

BinaryPartials atan2_partials(Dag& d, Id y, Id x) {
  // With r = x² + y²: by y x/r = p, by x -y/r = -q; second -2pq, (q - p)(q + p), 2pq.
  const Id r = d.add(d.apply(Op::square, x), d.apply(Op::square, y));
  const Id p = d.div(x, r), q = d.div(y, r);
  const Id cross = d.scale(2, d.mul(p, q));
  return {p, d.apply(Op::neg, q), d.apply(Op::neg, cross), d.mul(d.sub(q, p), d.add(q, p)), cross};
}

BinaryPartials binary_partials(Dag& d, Op op, Id a, Id b, Id v) {
  const Id zero = d.constant(0), one = d.constant(1);
  switch (op) {
    case Op::add:
      return {one, one, zero, zero, zero};
    case Op::sub:
      return {one, d.constant(-1), zero, zero, zero};
    case Op::mul:
      return {b, a, zero, one, zero};
    case Op::div: {
      const Id fa = d.div(one, b);
      const Id fb = d.apply(Op::neg, d.mul(v, fa));
      return {fa, fb, zero, d.apply(Op::neg, d.apply(Op::square, fa)), d.scale(-2, d.mul(fa, fb))};
    }
    case Op::pow:
      return pow_partials(d, a, b, v);
    case Op::atan2:
      return atan2_partials(d, a, b);
    case Op::min:
    case Op::max: {
      const Id gap = op == Op::min ? d.sub(b, a) : d.sub(a, b);
      return {d.apply(Op::select, gap, one, zero), d.apply(Op::select, gap, zero, one), zero, zero,
              zero};
    }
    default:
      return {zero, zero, zero, zero, zero};
  }
}

Partials partials(Dag& d, Id v, bool second) {
  const Dag::Vertex vertex = d[v];  // by value: the Dag grows below
  const auto [a, b, c] = vertex.arg;
  Partials result;
  if (arity(vertex.op) == 1) {
    const Id first = unary_first(d, vertex.op, a, v);
    result.first = {{a, first}};
    if (second) result.second = {{0, 0, unary_second(d, vertex.op, a, v, first)}};
  } else if (arity(vertex.op) == 2) {
    const auto p = binary_partials(d, vertex.op, a, b, v);
    if (a == b) {
      result.first = {{a, d.add(p.a, p.b)}};
      if (second) result.second = {{0, 0, d.add(d.add(p.aa, p.bb), d.scale(2, p.ab))}};
    } else {
      result.first = {{a, p.a}, {b, p.b}};
      if (second) result.second = {{0, 0, p.aa}, {1, 0, p.ab}, {1, 1, p.bb}};
    }
  } else if (vertex.op == Op::select) {
    const Id one = d.constant(1), zero = d.constant(0);
    result.first = {{b, d.apply(Op::select, a, one, zero)}, {c, d.apply(Op::select, a, zero, one)}};
  }
  return result;
}

/// Vertices below `outputs` that depend on a variable, ascending (arguments first).
std::vector<Id> active_vertices(const Dag& dag, const std::vector<Id>& outputs,
                                std::size_t variables) {
  std::vector<char> below(dag.size(), 0), active(dag.size(), 0);
  for (Id id : outputs) below[id] = 1;
  for (Id id = static_cast<Id>(dag.size()); id-- > 0;)
    if (below[id])
      for (std::size_t i = 0; i < arity(dag[id].op); ++i) below[dag[id].arg[i]] = 1;
  std::vector<Id> result;
  for (Id id = 0; id < dag.size(); ++id) {
    if (!below[id]) continue;
    if (dag[id].op == Op::symbol) {
      active[id] = dag[id].value < static_cast<double>(variables);
    } else {
      for (std::size_t i = 0; i < arity(dag[id].op); ++i) active[id] |= active[dag[id].arg[i]];
    }
    if (active[id]) result.push_back(id);
  }
  return result;
}

/// The linearised computational graph, eliminated down to input -> output edges.
class Elimination {
 public:
  Elimination(Dag& dag, const std::vector<Id>& outputs, std::size_t variables) : dag_(dag) {
    const auto active = active_vertices(dag, outputs, variables);
    const std::set<Id> is_active(active.begin(), active.end());
    for (Id v : active) {
      if (dag[v].op == Op::symbol) continue;
      intermediates_.push_back(v);
      for (const auto& [arg, weight] : partials(dag, v, false).first)
        if (is_active.contains(arg) && !dag.is(weight, 0)) connect(arg, v, weight);
    }
    for (std::size_t k = 0; k < outputs.size(); ++k)
      if (is_active.contains(outputs[k])) connect(outputs[k], output_key(k), dag.constant(1));
  }

  SparseDerivative run(std::size_t outputs) {
    std::set<std::pair<std::size_t, Key>> queue;
    for (Id v : intermediates_) queue.insert(rank(v));
    while (!queue.empty()) {
      const Key v = ~queue.begin()->second;
      queue.erase(queue.begin());
      const auto below = std::move(preds_[v]);
      const auto above = std::move(succs_[v]);
      std::vector<Key> touched;
      for (const auto& entry : below) touched.push_back(entry.first);
      for (Key key : above) touched.push_back(key);
      for (Key key : touched) queue.erase(rank(key));
      for (Key up : above) {
        const Id weight_up = preds_[up].at(v);
        preds_[up].erase(v);
        for (const auto& [down, weight] : below) connect(down, up, dag_.mul(weight_up, weight));
      }
      for (const auto& entry : below) succs_[entry.first].erase(v);
      for (Key key : touched)
        if (is_intermediate(key)) queue.insert(rank(key));
    }
    SparseDerivative result;
    for (std::size_t k = 0; k < outputs; ++k) {
      std::map<std::size_t, Id> row;
      for (const auto& [key, weight] : preds_[output_key(k)])
        row[static_cast<std::size_t>(dag_[static_cast<Id>(key)].value)] = weight;
      for (const auto& [col, weight] : row) {
        if (dag_.is(weight, 0)) continue;
        result.pattern.push_back({k, col});
        result.values.push_back(weight);
      }
    }
    return result;
  }

 private:
  using Key = std::uint64_t;  ///< a vertex id, or beyond all ids an output
  static Key output_key(std::size_t k) { return (Key{1} << 32) + k; }
  bool is_intermediate(Key key) const {
    return key < output_key(0) && dag_[static_cast<Id>(key)].op != Op::symbol;
  }
  std::size_t cost(Key v) const {
    const auto below = preds_.find(v);
    const auto above = succs_.find(v);
    return (below == preds_.end() ? 0 : below->second.size()) *
           (above == succs_.end() ? 0 : above->second.size());
  }
  /// Markowitz: the cheapest first, of equals the one nearest to the outputs.
  std::pair<std::size_t, Key> rank(Key v) const { return {cost(v), ~v}; }
  void connect(Key from, Key to, Id weight) {
    const auto [it, fresh] = preds_[to].try_emplace(from, weight);
    if (!fresh) it->second = dag_.add(it->second, weight);
    succs_[from].insert(to);
  }

  Dag& dag_;
  std::vector<Id> intermediates_;
  std::map<Key, std::map<Key, Id>> preds_;
  std::map<Key, std::set<Key>> succs_;
};

/// Adjoints and the nonlinear interactions not yet pushed down to the inputs.
class EdgePushing {
 public:
  explicit EdgePushing(Dag& dag) : dag_(dag) {}

  void seed(Id v, Id weight) { accumulate(adjoint_, v, weight); }

  void push(Id v, const std::set<Id>& active) {
    auto local = partials(dag_, v, true);
    const auto edges = std::move(edges_[v]);
    edges_.erase(v);
    for (const auto& [other, weight] : edges) {
      if (other != v) edges_[other].erase(v);
      push_edge(v, other, weight, local, active);
    }
    const auto adjoint = adjoint_.find(v);
    if (adjoint == adjoint_.end()) return;
    const Id bar = adjoint->second;
    for (const auto& [i, j, weight] : local.second) {
      const Id from = local.first[i].first, to = local.first[j].first;
      if (active.contains(from) && active.contains(to)) connect(from, to, dag_.mul(bar, weight));
    }
    for (const auto& [arg, weight] : local.first)
      if (active.contains(arg)) accumulate(adjoint_, arg, dag_.mul(bar, weight));
  }

  const std::map<Id, std::map<Id, Id>>& edges() const { return edges_; }

 private:
  void push_edge(Id v, Id other, Id weight, const Partials& local, const std::set<Id>& active) {
    for (std::size_t i = 0; i < local.first.size(); ++i) {
      const auto& [arg_i, d_i] = local.first[i];
      if (!active.contains(arg_i)) continue;
      const Id pushed = dag_.mul(weight, d_i);
      if (other != v) {
        connect(arg_i, other, arg_i == other ? dag_.scale(2, pushed) : pushed);
        continue;
      }
      for (std::size_t j = 0; j <= i; ++j) {
        const auto& [arg_j, d_j] = local.first[j];
        if (active.contains(arg_j)) connect(arg_i, arg_j, dag_.mul(pushed, d_j));
      }
    }
  }
  void connect(Id a, Id b, Id weight) {
    if (dag_.is(weight, 0)) return;
    accumulate(edges_[a], b, weight);
    if (a != b) accumulate(edges_[b], a, weight);
  }
  void accumulate(std::map<Id, Id>& sums, Id key, Id value) {
    if (dag_.is(value, 0)) return;
    const auto [it, fresh] = sums.try_emplace(key, value);
    if (!fresh) it->second = dag_.add(it->second, value);
  }

  Dag& dag_;
  std::map<Id, Id> adjoint_;
  std::map<Id, std::map<Id, Id>> edges_;  ///< symmetric: H(a, b) stands at [a][b] and [b][a]
};

}  // namespace

SparseDerivative jacobian(Dag& dag, const std::vector<Id>& outputs, std::size_t variables) {
  return Elimination(dag, outputs, variables).run(outputs.size());
}

SparseDerivative hessian(Dag& dag, const std::vector<Id>& outputs, const std::vector<Id>& weights,
                         std::size_t variables) {
  const auto active = active_vertices(dag, outputs, variables);
  const std::set<Id> is_active(active.begin(), active.end());
  EdgePushing pushing(dag);
  for (std::size_t k = 0; k < outputs.size(); ++k)
    if (is_active.contains(outputs[k])) pushing.seed(outputs[k], weights[k]);
  for (auto v = active.rbegin(); v != active.rend(); ++v)
    if (dag[*v].op != Op::symbol) pushing.push(*v, is_active);

  std::map<std::pair<std::size_t, std::size_t>, Id> entries;
  for (const auto& [a, row] : pushing.edges())
    for (const auto& [b, weight] : row) {
      const auto i = static_cast<std::size_t>(dag[a].value);
      const auto j = static_cast<std::size_t>(dag[b].value);
      if (i >= j && !dag.is(weight, 0)) entries[{i, j}] = weight;
    }
  SparseDerivative result;
  for (const auto& [position, weight] : entries) {
    result.pattern.push_back({position.first, position.second});
    result.values.push_back(weight);
  }
  return result;
}

SparseDerivative hessian_by_elimination(Dag& dag, const SparseDerivative& jacobian,
                                        const std::vector<Id>& weights, std::size_t variables) {
  std::vector<Id> gradient(variables, dag.constant(0));
  for (std::size_t k = 0; k < jacobian.values.size(); ++k) {
    const auto& [row, col] = jacobian.pattern[k];
    gradient[col] = dag.add(gradient[col], dag.mul(weights[row], jacobian.values[k]));
  }
  const auto full = expr::jacobian(dag, gradient, variables);
  SparseDerivative lower;
  for (std::size_t k = 0; k < full.values.size(); ++k)
    if (full.pattern[k].row >= full.pattern[k].col) {
      lower.pattern.push_back(full.pattern[k]);
      lower.values.push_back(full.values[k]);
    }
  return lower;
}

}  // namespace slalom::expr
