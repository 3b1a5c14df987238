#include "slalom/expr/function.hpp"

#include <array>
#include <atomic>
#include <mutex>
#include <unordered_map>
#include <utility>

#include "dag.hpp"
#include "slalom/base/error.hpp"
#include "tape.hpp"

namespace slalom::expr {
namespace {

unsigned mask_of(Wanted wanted) {
  return (wanted.values ? 1u : 0u) | (wanted.jacobian ? 2u : 0u) | (wanted.hessian ? 4u : 0u);
}

void require(bool condition, const char* what) {
  if (!condition) throw Error(std::string("function: size of ") + what + " does not match");
}

}  // namespace

/// Derivatives and code are made when first wanted, once, whichever thread comes first.
struct Function::Impl {
  std::size_t variables = 0, data = 0;
  std::vector<Dag::Id> outputs, weights;
  mutable std::mutex mutex;
  mutable Dag dag;
  mutable SparseDerivative jacobian, hessian;
  mutable std::atomic<bool> has_jacobian = false, has_hessian = false;
  mutable std::array<Tape, 8> tapes;
  mutable std::array<std::atomic<bool>, 8> compiled{};

  void differentiate_once() const {
    if (has_jacobian.load(std::memory_order_acquire)) return;
    const std::lock_guard lock(mutex);
    if (has_jacobian.load(std::memory_order_relaxed)) return;
    jacobian = expr::jacobian(dag, outputs, variables);
    has_jacobian.store(true, std::memory_order_release);
  }
  void differentiate_twice() const {
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
  std::pair<std::size_t, std::size_t> cost(const SparseDerivative& candidate) const {
    auto results = outputs;
    results.insert(results.end(), jacobian.values.begin(), jacobian.values.end());
    results.insert(results.end(), candidate.values.begin(), candidate.values.end());
    return {candidate.pattern.size(), compile(dag, results).code.size()};
  }
  const Tape& tape(Wanted wanted) const {
    const unsigned mask = mask_of(wanted);
    if (compiled[mask].load(std::memory_order_acquire)) return tapes[mask];
    if (wanted.jacobian) differentiate_once();
    if (wanted.hessian) differentiate_twice();
    const std::lock_guard lock(mutex);
    if (compiled[mask].load(std::memory_order_relaxed)) return tapes[mask];
    std::vector<Dag::Id> results;
    if (wanted.values) results = outputs;
    if (wanted.jacobian)
      results.insert(results.end(), jacobian.values.begin(), jacobian.values.end());
    if (wanted.hessian) results.insert(results.end(), hessian.values.begin(), hessian.values.end());
    tapes[mask] = compile(dag, results);
    compiled[mask].store(true, std::memory_order_release);
    return tapes[mask];
  }
};

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
  impl_ = std::move(impl);
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
  const Tape& tape = impl_->tape(wanted);
  require(x.size() == variables() * lanes, "variables");
  require(p.size() == data() * lanes, "data");
  thread_local std::vector<const double*> inputs;
  thread_local std::vector<double*> results;
  inputs.clear();
  results.clear();
  for (std::size_t i = 0; i < variables(); ++i) inputs.push_back(x.data() + i * lanes);
  for (std::size_t i = 0; i < data(); ++i) inputs.push_back(p.data() + i * lanes);
  if (wanted.values) {
    require(values.size() == outputs() * lanes, "values");
    for (std::size_t i = 0; i < outputs(); ++i) results.push_back(values.data() + i * lanes);
  }
  if (wanted.jacobian) {
    const std::size_t n = impl_->jacobian.pattern.size();
    require(jacobian.size() == n * lanes, "the Jacobian");
    for (std::size_t i = 0; i < n; ++i) results.push_back(jacobian.data() + i * lanes);
  }
  if (wanted.hessian) {
    require(weights.size() == outputs() * lanes, "weights");
    for (std::size_t i = 0; i < outputs(); ++i) inputs.push_back(weights.data() + i * lanes);
    const std::size_t n = impl_->hessian.pattern.size();
    require(hessian.size() == n * lanes, "the Hessian");
    for (std::size_t i = 0; i < n; ++i) results.push_back(hessian.data() + i * lanes);
  }
  run(tape, {lanes, inputs, results});
}

void Function::operator()(std::span<const double> x, std::span<const double> p,
                          std::span<double> values) const {
  evaluate(1, x, p, {}, {}, values, {}, {});
}

std::size_t Function::instructions(Wanted wanted) const {
  return impl_->tape(wanted).code.size();
}

}  // namespace slalom::expr
