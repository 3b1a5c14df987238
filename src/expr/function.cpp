#include "slalom/expr/function.hpp"

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>

#include "function_impl.hpp"
#include "kept_functions.hpp"
#include "op.hpp"
#include "slalom/base/error.hpp"

namespace slalom::expr {
namespace {

void require(bool condition, const char* what) {
  if (!condition) throw Error(std::string("function: size of ") + what + " does not match");
}

/// Spaces of the last few tapes a thread ran, each keeping its function alive.
class RecentSpaces {
 public:
  TapeSpace& of(const std::shared_ptr<const void>& owner, const Tape& tape, std::size_t lanes) {
    for (auto& entry : entries_)
      if (entry.tape == &tape && entry.lanes == lanes) return entry.space;
    Entry& entry = entries_[next_++ % entries_.size()];
    entry = {owner, &tape, lanes, TapeSpace(tape, lanes)};
    return entry.space;
  }

 private:
  struct Entry {
    std::shared_ptr<const void> owner;
    const Tape* tape = nullptr;
    std::size_t lanes = 0;
    TapeSpace space;
  };
  std::array<Entry, 8> entries_;
  std::size_t next_ = 0;
};

/// Which vertices depend on data (and constants) alone, and on some data.
std::vector<char> data_only(const Dag& dag, std::size_t variables, std::size_t data) {
  std::vector<char> result(dag.size(), 0);
  for (Dag::Id id = 0; id < dag.size(); ++id) {
    const auto& v = dag[id];
    if (v.op == Op::symbol) {
      const auto input = static_cast<std::size_t>(v.value);
      result[id] = input >= variables && input < variables + data;
      continue;
    }
    bool some = false, all = true;
    for (std::size_t i = 0; i < arity(v.op); ++i) {
      some = some || result[v.arg[i]];
      all = all && (result[v.arg[i]] || dag.is_constant(v.arg[i]));
    }
    result[id] = some && all;
  }
  return result;
}

}  // namespace

void Function::Impl::differentiate_once() const {
  if (has_jacobian.load(std::memory_order_acquire)) return;
  const std::lock_guard lock(mutex);
  if (has_jacobian.load(std::memory_order_relaxed)) return;
  jacobian = expr::jacobian(dag, outputs, variables);
  has_jacobian.store(true, std::memory_order_release);
}

void Function::Impl::differentiate_twice() const {
  if (has_hessian.load(std::memory_order_acquire)) return;
  differentiate_once();
  const std::lock_guard lock(mutex);
  if (has_hessian.load(std::memory_order_relaxed)) return;
  auto pushed = expr::hessian(dag, outputs, weights, variables);
  auto eliminated = hessian_by_elimination(dag, jacobian, weights, variables);
  hessian = std::move(cost(eliminated) < cost(pushed) ? eliminated : pushed);
  has_hessian.store(true, std::memory_order_release);
}

/// Entries, then instructions beside values and Jacobian.
std::pair<std::size_t, std::size_t> Function::Impl::cost(const SparseDerivative& candidate) const {
  auto list = results({.values = true, .jacobian = true});
  list.insert(list.end(), candidate.values.begin(), candidate.values.end());
  return {candidate.pattern.size(), compile(dag, list).code.size()};
}

std::vector<Dag::Id> Function::Impl::results(Wanted wanted) const {
  std::vector<Dag::Id> list;
  const auto add = [&](const std::vector<Dag::Id>& more) {
    list.insert(list.end(), more.begin(), more.end());
  };
  if (wanted.values) add(outputs);
  if (wanted.jacobian) add(jacobian.values);
  if (wanted.hessian) add(hessian.values);
  return list;
}

const Tape& Function::Impl::get(Tapes& tapes, Wanted wanted, const Given& given,
                                const std::vector<Dag::Id>& family) const {
  const unsigned mask = mask_of(wanted);
  if (tapes.ready[mask].load(std::memory_order_acquire)) return tapes.tape[mask];
  if (wanted.jacobian) differentiate_once();
  if (wanted.hessian) differentiate_twice();
  const std::lock_guard lock(mutex);
  if (tapes.ready[mask].load(std::memory_order_relaxed)) return tapes.tape[mask];
  tapes.tape[mask] = compile(dag, results(wanted), given, family);
  tapes.ready[mask].store(true, std::memory_order_release);
  return tapes.tape[mask];
}

const Tape& Function::Impl::tape_behind(Wanted wanted) const {
  find_ahead();
  return get(behind_, wanted, given_, all_results_);
}
const Tape& Function::Impl::ahead() const {
  find_ahead();
  return ahead_;
}
std::size_t Function::Impl::ahead_count() const {
  find_ahead();
  return given_.vertices.size();
}

/// The vertices on the border of what depends on data alone, and reciprocals of such divisors.
void Function::Impl::find_ahead() const {
  if (has_ahead_.load(std::memory_order_acquire)) return;
  differentiate_twice();
  const std::lock_guard lock(mutex);
  if (has_ahead_.load(std::memory_order_relaxed)) return;
  const auto list = all_results_ = results({.values = true, .jacobian = true, .hessian = true});
  const auto from_data = data_only(dag, variables, data);
  const std::size_t size = dag.size();
  std::vector<char> needed(size, 0), wanted(size, 0);
  for (auto id : list) needed[id] = 1;
  for (auto id : list) wanted[id] = from_data[id];
  std::vector<std::pair<Dag::Id, Dag::Id>> divisors;
  for (auto id = static_cast<Dag::Id>(size); id-- > 0;) {
    if (!needed[id] || from_data[id]) continue;
    const auto v = dag[id];  // a copy: the graph grows below
    for (std::size_t i = 0; i < arity(v.op); ++i) {
      const Dag::Id arg = v.arg[i];
      needed[arg] = 1;
      if (!from_data[arg]) continue;
      if (v.op == Op::div && i == 1)
        divisors.emplace_back(arg, dag.div(dag.constant(1), arg));
      else
        wanted[arg] = 1;
    }
  }
  std::vector<Dag::Id> ahead;
  for (Dag::Id id = 0; id < size; ++id)
    if (wanted[id] && arity(dag[id].op) > 0) ahead.push_back(id);
  for (const auto& [divisor, id] : divisors) {
    if (std::find(ahead.begin(), ahead.end(), id) == ahead.end()) ahead.push_back(id);
    given_.reciprocals.push_back({divisor, id});
  }
  for (std::size_t k = 0; k < ahead.size(); ++k)
    given_.vertices.push_back({ahead[k], variables + data + weights.size() + k});
  ahead_ = compile(dag, ahead);
  has_ahead_.store(true, std::memory_order_release);
}

Function::Function() : Function({}, {}, {}) {}

Function::Function(std::vector<Expr> variables, std::vector<Expr> data,
                   const std::vector<Expr>& outputs) {
  auto impl = std::make_shared<Impl>();
  impl->variables = variables.size();
  impl->data = data.size();
  std::unordered_map<const Node*, std::size_t> input_of;
  for (const auto* list : {&variables, &data})
    for (const auto& symbol : *list) {
      if (!symbol.is_symbol()) throw Error("function: an input is not a symbol");
      if (!input_of.emplace(symbol.node(), input_of.size()).second)
        throw Error("function: '" + symbol.name() + "' is listed twice among the inputs");
    }
  impl->outputs = impl->dag.import(outputs, input_of);
  for (std::size_t k = 0; k < outputs.size(); ++k)
    impl->weights.push_back(impl->dag.input(impl->variables + impl->data + k));
  impl_ = Impl::Kept::instance().instead_of(std::move(impl));
}

std::size_t Function::variables() const {
  return impl_->variables;
}
std::size_t Function::data() const {
  return impl_->data;
}
std::size_t Function::outputs() const {
  return impl_->outputs.size();
}

const std::vector<Entry>& Function::jacobian_pattern() const {
  impl_->differentiate_once();
  return impl_->jacobian.pattern;
}

const std::vector<Entry>& Function::hessian_pattern() const {
  impl_->differentiate_twice();
  return impl_->hessian.pattern;
}

void Function::evaluate(std::size_t lanes, std::span<const double> x, std::span<const double> p,
                        std::span<const double> weights, Wanted wanted, std::span<double> values,
                        std::span<double> jacobian, std::span<double> hessian) const {
  if (lanes == 0 || mask_of(wanted) == 0) return;
  const Impl& f = *impl_;
  const Tape& tape = f.tape(wanted);
  if (!wanted.values) values = {};
  if (!wanted.jacobian) jacobian = {};
  if (!wanted.hessian) weights = {}, hessian = {};
  require(x.size() == f.variables * lanes, "variables");
  require(p.size() == f.data * lanes, "data");
  require(!wanted.values || values.size() == f.outputs.size() * lanes, "values");
  require(!wanted.jacobian || jacobian.size() == f.jacobian.pattern.size() * lanes, "the Jacobian");
  require(!wanted.hessian || weights.size() == f.outputs.size() * lanes, "weights");
  require(!wanted.hessian || hessian.size() == f.hessian.pattern.size() * lanes, "the Hessian");
  const std::array<std::span<const double>, 3> given{x, p, weights};
  const std::array<std::span<double>, 3> filled{values, jacobian, hessian};
  thread_local RecentSpaces spaces;
  TapeSpace& space = spaces.of(impl_, tape, lanes);
  if (lanes == 1) return space.run(tape, PointRun{given, filled});
  thread_local std::vector<InputRow> inputs;
  thread_local std::vector<double*> results;
  inputs.clear();
  results.clear();
  for (const auto& piece : given)
    for (std::size_t i = 0; i < piece.size(); i += lanes)
      inputs.push_back({piece.data() + i, false});
  for (const auto& piece : filled)
    for (std::size_t i = 0; i < piece.size(); i += lanes) results.push_back(piece.data() + i);
  space.run(tape, TapeRun{lanes, inputs, results});
}

void Function::operator()(std::span<const double> x, std::span<const double> p,
                          std::span<double> values) const {
  evaluate(1, x, p, {}, {}, values, {}, {});
}

std::size_t Function::instructions(Wanted wanted) const {
  return impl_->tape(wanted).code.size();
}

}  // namespace slalom::expr
