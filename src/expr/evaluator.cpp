#include "slalom/expr/evaluator.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "function_impl.hpp"

namespace slalom::expr {

struct Evaluator::Impl {
  std::shared_ptr<const Function::Impl> function;
  std::size_t lanes;
  std::vector<double> data, ahead, weights, values, jacobian, hessian;
  std::vector<InputRow> inputs;  ///< variables, data, weights, what is computed ahead
  std::vector<double*> ahead_rows;
  TapeSpace ahead_space;
  struct Prepared {
    const Tape* tape = nullptr;
    TapeSpace space;
    std::vector<double*> outputs;
  };
  std::array<Prepared, 8> prepared;

  Prepared& prepare(Wanted wanted) {
    Prepared& p = prepared[mask_of(wanted)];
    if (p.tape == nullptr) {
      p.tape = &function->tape_behind(wanted);
      p.space = TapeSpace(*p.tape, lanes);
      if (wanted.values) add_rows(values, lanes, p.outputs);
      if (wanted.jacobian) add_rows(jacobian, lanes, p.outputs);
      if (wanted.hessian) add_rows(hessian, lanes, p.outputs);
    }
    return p;
  }
  static void add_rows(std::vector<double>& numbers, std::size_t lanes,
                       std::vector<double*>& rows) {
    for (std::size_t i = 0; i < numbers.size(); i += lanes) rows.push_back(numbers.data() + i);
  }
};

Evaluator::Evaluator(const Function& function, std::size_t lanes)
    : impl_(std::make_unique<Impl>()) {
  Impl& e = *impl_;
  e.function = function.impl_;
  e.lanes = lanes;
  e.data.resize(function.data() * lanes);
  e.ahead.resize(e.function->ahead_count() * lanes);
  e.weights.resize(function.outputs() * lanes);
  e.values.resize(function.outputs() * lanes);
  e.jacobian.resize(function.jacobian_pattern().size() * lanes);
  e.hessian.resize(function.hessian_pattern().size() * lanes);
  e.inputs.assign(function.variables(), InputRow{nullptr, false});
  if (lanes == 0) return;
  for (auto* list : {&e.data, &e.weights, &e.ahead})
    for (std::size_t i = 0; i < list->size(); i += lanes)
      e.inputs.push_back({list->data() + i, false});
  Impl::add_rows(e.ahead, lanes, e.ahead_rows);
  e.ahead_space = TapeSpace(e.function->ahead(), lanes);
}

Evaluator::~Evaluator() = default;
Evaluator::Evaluator(Evaluator&&) noexcept = default;
Evaluator& Evaluator::operator=(Evaluator&&) noexcept = default;

std::size_t Evaluator::lanes() const {
  return impl_->lanes;
}
void Evaluator::prepare(Wanted wanted) {
  if (impl_->lanes > 0) impl_->prepare(wanted);
}
void Evaluator::set_variable(std::size_t i, const double* numbers, bool same) {
  impl_->inputs[i] = {numbers, same};
}
std::span<const double> Evaluator::data() const {
  return impl_->data;
}
std::span<double> Evaluator::data() {
  return impl_->data;
}
std::span<double> Evaluator::weights() {
  return impl_->weights;
}
std::span<const double> Evaluator::values() const {
  return impl_->values;
}
std::span<const double> Evaluator::jacobian() const {
  return impl_->jacobian;
}
std::span<const double> Evaluator::hessian() const {
  return impl_->hessian;
}

void Evaluator::data_changed() {
  Impl& e = *impl_;
  if (!e.ahead.empty()) e.ahead_space.run(e.function->ahead(), {e.lanes, e.inputs, e.ahead_rows});
}

void Evaluator::evaluate(Wanted wanted) {
  Impl& e = *impl_;
  if (e.lanes == 0 || mask_of(wanted) == 0) return;
  auto& [tape, space, outputs] = e.prepare(wanted);
  space.run(*tape, {e.lanes, e.inputs, outputs});
}

}  // namespace slalom::expr
