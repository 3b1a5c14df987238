#include "point_functions.hpp"

#include <algorithm>

#include "slalom/base/error.hpp"

namespace slalom::ocp {
namespace {

/// Symbols and the numbers that a trajectory gives them.
struct Given {
  std::vector<Expr> symbols, numbers;

  void add(const Expr& symbol, double number) {
    symbols.push_back(symbol);
    numbers.emplace_back(number);
  }
};

Given given(const Problem& problem, const Trajectory& at) {
  Given list;
  list.add(problem.initial_time(), at.t0);
  list.add(problem.final_time(), at.tf);
  for (const auto& parameter : problem.parameters()) list.add(parameter.symbol, parameter.value);
  for (std::size_t i = 0; i < problem.states().size(); ++i) {
    list.add(problem.states()[i].initial_symbol, at.states.front()[i]);
    list.add(problem.states()[i].final_symbol, at.states.back()[i]);
  }
  const auto add_all = [&](const auto& variables, const std::vector<double>& values) {
    for (std::size_t i = 0; i < variables.size(); ++i)
      list.add(variables[i].symbol, i < values.size() ? values[i] : variables[i].guess);
  };
  add_all(problem.static_parameters(), at.static_parameters);
  add_all(problem.slacks(), at.slacks);
  add_all(problem.integrals(), at.integrals);
  return list;
}

}  // namespace

expr::Function function_along(const Problem& problem, const Trajectory& at,
                              const std::vector<Expr>& outputs) {
  std::vector<Expr> inputs;
  for (const auto& state : problem.states()) inputs.push_back(state.symbol);
  for (const auto& control : problem.controls()) inputs.push_back(control.symbol);
  inputs.push_back(problem.time());
  inputs.push_back(problem.tau());
  const Given fixed = given(problem, at);
  return {inputs, {}, expr::substitute(outputs, fixed.symbols, fixed.numbers)};
}

PointFunctions::PointFunctions(const Problem& problem, const Trajectory& at)
    : t0_(at.t0), tf_(at.tf) {
  inputs_.resize(problem.states().size() + problem.controls().size() + 2);

  std::vector<Expr> rates, values;
  for (const auto& state : problem.states()) rates.push_back(state.rate);
  Expr integrand = 0;
  for (const auto& cost : problem.costs())
    if (cost.enabled && cost.lagrange) integrand += cost.value;
  const auto add_row = [&](const std::string& name, const Expr& value, Bounds bounds,
                           Points points) {
    if (!bounds.bounded()) return;
    rows_.push_back({name, bounds, points});
    values.push_back(value);
  };
  for (const auto& state : problem.states())
    add_row(state.name, state.symbol, state.bounds, Points::all);
  for (const auto& control : problem.controls())
    add_row(control.name, control.symbol, control.bounds, Points::all);
  for (const auto& row : problem.constraints()) {
    if (!row.enabled || !row.over_time()) continue;
    if (row.kind == Problem::Kind::path) add_row(row.name, row.value, row.bounds, row.points);
    if (row.by_point()) {
      without_rows_ = problem.name() + ": family " + row.name;
      continue;
    }
    for (std::size_t m = 0; m < row.member_values.size(); ++m) {
      const auto own = row.numbers_at(m);
      const std::vector<Expr> numbers(own.begin(), own.end());
      add_row(row.name + "[" + row.members[m] + "]",
              expr::substitute({row.value}, row.symbols, numbers).front(), row.bounds, row.points);
    }
  }
  rates_ = function_along(problem, at, rates);
  std::vector<Expr> integrands{integrand};
  for (const auto& integral : problem.integrals()) integrands.push_back(integral.integrand);
  integrand_ = function_along(problem, at, integrands);
  row_functions_ = function_along(problem, at, values);
}

void PointFunctions::call(const expr::Function& f, double t, std::span<const double> x,
                          std::span<const double> u, std::span<double> out) const {
  auto next = std::copy(x.begin(), x.end(), inputs_.begin());
  next = std::copy(u.begin(), u.end(), next);
  *next++ = t;
  *next = tf_ > t0_ ? (t - t0_) / (tf_ - t0_) : 0;
  f(inputs_, {}, out);
}

void PointFunctions::rates(double t, std::span<const double> x, std::span<const double> u,
                           std::span<double> out) const {
  call(rates_, t, x, u, out);
}

double PointFunctions::integrand(double t, std::span<const double> x,
                                 std::span<const double> u) const {
  std::vector<double> values(integrands());
  call(integrand_, t, x, u, values);
  return values.front();
}

void PointFunctions::integrands(double t, std::span<const double> x, std::span<const double> u,
                                std::span<double> out) const {
  call(integrand_, t, x, u, out);
}

const std::vector<PointFunctions::Row>& PointFunctions::rows() const {
  if (!without_rows_.empty())
    throw InvalidValue(without_rows_, "numbers at the points of a mesh",
                       "numbers that hold between points too");
  return rows_;
}

void PointFunctions::row_values(double t, std::span<const double> x, std::span<const double> u,
                                std::span<double> out) const {
  if (!rows_.empty()) call(row_functions_, t, x, u, out);
}

std::vector<double> scales_of(const Problem& problem) {
  std::vector<double> scales;
  for (const auto& state : problem.states()) scales.push_back(state.unit());
  return scales;
}

std::vector<double> end_controls(const Problem& problem, const Trajectory& trajectory,
                                 std::size_t begin, std::size_t end) {
  std::vector<double> controls = trajectory.controls[end];
  for (std::size_t i = 0; i < controls.size(); ++i)
    if (problem.controls()[i].form == ControlForm::constant)
      controls[i] = trajectory.controls[begin][i];
  return controls;
}

}  // namespace slalom::ocp
