#include <fmt/format.h>

#include "builder.hpp"

namespace slalom::ocp {
namespace {

/// All lanes' outputs, [output * lanes + lane].
std::vector<Expr> lanes_of(const Batch& batch, const std::vector<Expr>& variables) {
  const auto& function = batch.function;
  const auto given = batch.data();
  std::vector<Expr> result(function.outputs() * batch.lanes);
  for (std::size_t lane = 0; lane < batch.lanes; ++lane) {
    std::vector<Expr> inputs, data;
    for (std::size_t i = 0; i < function.variables(); ++i) {
      const Expr& variable = variables[batch.gather[i * batch.lanes + lane]];
      inputs.push_back(batch.gather_scale[i] == 1 ? variable : batch.gather_scale[i] * variable);
    }
    for (std::size_t i = 0; i < function.data(); ++i)
      data.emplace_back(given[i * batch.lanes + lane]);
    const auto outputs = function(inputs, data);
    for (std::size_t o = 0; o < outputs.size(); ++o) result[o * batch.lanes + lane] = outputs[o];
  }
  return result;
}

}  // namespace

nlp::Formulas formulas(const Transcribed& transcribed) {
  nlp::Formulas result;
  for (std::size_t i = 0; i < transcribed.layout.variables; ++i)
    result.variables.push_back(Expr::symbol(fmt::format("x{}", i)));
  result.rows.resize(transcribed.structure.rows);
  for (const auto& batch : transcribed.batches) {
    const auto lanes = lanes_of(batch, result.variables);
    batch.to_rows.for_each([&](std::size_t from, std::size_t row, double coefficient) {
      result.rows[row] += coefficient * lanes[from];
    });
    batch.to_terms.for_each([&](std::size_t from, std::size_t, double coefficient) {
      result.objective += coefficient * lanes[from];
    });
  }
  transcribed.linear.for_each([&](std::size_t variable, std::size_t row, double coefficient) {
    result.rows[row] += coefficient * result.variables[variable];
  });
  return result;
}

}  // namespace slalom::ocp
