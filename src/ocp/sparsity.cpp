#include "sparsity.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace slalom::ocp {
namespace {

using Position = std::pair<std::size_t, std::size_t>;

std::uint32_t narrow(std::size_t n) {
  return static_cast<std::uint32_t>(n);
}

std::uint32_t find(const std::vector<Position>& sorted, Position position) {
  return narrow(static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), position) -
                                         sorted.begin()));
}

void sort_unique(std::vector<Position>& positions) {
  std::sort(positions.begin(), positions.end());
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
}

/// Calls f(use, entry index in the Jacobian pattern, NLP variable, scale) for each use and entry.
template <class F>
void for_first_derivatives(const Batch& batch, const std::vector<Use>& uses, F f) {
  const auto& pattern = batch.function.jacobian_pattern();
  for (const Use& use : uses) {
    const auto first =
        std::lower_bound(pattern.begin(), pattern.end(), use.output,
                         [](const expr::Entry& entry, std::size_t row) { return entry.row < row; });
    for (auto entry = first; entry != pattern.end() && entry->row == use.output; ++entry)
      f(use, static_cast<std::size_t>(entry - pattern.begin()),
        std::size_t{batch.gather[entry->col * batch.lanes + use.lane]},
        batch.gather_scale[entry->col]);
  }
}

/// Calls f(entry, lane, position, coefficient) for each second derivative.
template <class F>
void for_second_derivatives(const Batch& batch, F f) {
  const auto& pattern = batch.function.hessian_pattern();
  for (std::size_t e = 0; e < pattern.size(); ++e)
    for (std::size_t lane = 0; lane < batch.lanes; ++lane) {
      const std::size_t a = batch.gather[pattern[e].row * batch.lanes + lane];
      const std::size_t b = batch.gather[pattern[e].col * batch.lanes + lane];
      const double twice = a == b && pattern[e].row != pattern[e].col ? 2 : 1;
      f(e, lane, Position{std::max(a, b), std::min(a, b)},
        twice * batch.gather_scale[pattern[e].row] * batch.gather_scale[pattern[e].col]);
    }
}

void fill_lists(const std::vector<RowInfo>& rows, const std::vector<Use>& uses,
                const std::vector<Position>& jacobian, const std::vector<Position>& hessian,
                Batch& batch) {
  for (const Use& use : uses) {
    const auto source = narrow(use.output * batch.lanes + use.lane);
    if (use.row != kNone)
      batch.to_rows.push_back({source, narrow(use.row), use.coefficient * rows[use.row].scale});
    else
      batch.to_terms.push_back({source, narrow(use.term), use.coefficient});
  }
  for_first_derivatives(
      batch, uses, [&](const Use& use, std::size_t entry, std::size_t variable, double scale) {
        const auto source = narrow(entry * batch.lanes + use.lane);
        if (use.row != kNone)
          batch.to_jacobian.push_back({source, find(jacobian, {use.row, variable}),
                                       use.coefficient * rows[use.row].scale * scale});
        else
          batch.to_gradient.push_back({source, narrow(variable), use.coefficient * scale});
      });
  for_second_derivatives(
      batch, [&](std::size_t entry, std::size_t lane, Position position, double scale) {
        batch.to_hessian.push_back(
            {narrow(entry * batch.lanes + lane), find(hessian, position), scale});
      });
}

}  // namespace

void sort_rows(std::vector<RowInfo>& rows, std::vector<RowTerm>& linear,
               std::vector<std::vector<Use>>& uses, std::vector<std::size_t>& references) {
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t r) {
    const bool border = rows[r].coupling == nlp::Coupling::border;
    return std::tuple(border, rows[r].stage, rows[r].coupling);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  std::vector<std::size_t> place(rows.size());
  std::vector<RowInfo> sorted;
  sorted.reserve(rows.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[order[i]] = i;
    sorted.push_back(std::move(rows[order[i]]));
  }
  rows = std::move(sorted);
  for (auto& term : linear) term.row = place[term.row];
  for (auto& list : uses)
    for (auto& use : list)
      if (use.row != kNone) use.row = place[use.row];
  for (auto& reference : references) reference = place[reference];
}

void fill_rows(const std::vector<RowInfo>& rows, Transcribed& out) {
  auto& structure = out.structure;
  structure.variables = out.layout.variables;
  structure.rows = rows.size();
  structure.stage_begin = out.layout.stage_begin;
  for (const auto& row : rows) {
    structure.row_stage.push_back(row.stage);
    structure.coupling.push_back(row.coupling);
    structure.row_scale.push_back(row.scale);
    out.limits.gl.push_back(row.bounds.lower * row.scale);
    out.limits.gu.push_back(row.bounds.upper * row.scale);
    out.row_names.push_back(row.name);
  }
}

void fill_sparsity(const std::vector<RowInfo>& rows, const std::vector<RowTerm>& linear,
                   const std::vector<std::vector<Use>>& uses, Transcribed& out) {
  std::vector<Position> jacobian, hessian;
  for (const auto& term : linear) jacobian.emplace_back(term.row, term.col);
  for (std::size_t b = 0; b < out.batches.size(); ++b) {
    for_first_derivatives(out.batches[b], uses[b],
                          [&](const Use& use, std::size_t, std::size_t variable, double) {
                            if (use.row != kNone) jacobian.emplace_back(use.row, variable);
                          });
    for_second_derivatives(out.batches[b], [&](std::size_t, std::size_t, Position position,
                                               double) { hessian.push_back(position); });
  }
  sort_unique(jacobian);
  sort_unique(hessian);

  auto& structure = out.structure;
  structure.jacobian_row_begin.assign(rows.size() + 1, 0);
  for (const auto& [row, col] : jacobian) {
    ++structure.jacobian_row_begin[row + 1];
    structure.jacobian_col.push_back(col);
  }
  std::partial_sum(structure.jacobian_row_begin.begin(), structure.jacobian_row_begin.end(),
                   structure.jacobian_row_begin.begin());
  for (const auto& [row, col] : hessian) {
    structure.hessian_row.push_back(row);
    structure.hessian_col.push_back(col);
  }
  out.constant_jacobian.assign(jacobian.size(), 0.0);
  for (const auto& term : linear) {
    const double coefficient =
        term.coefficient * rows[term.row].scale * structure.variable_scale[term.col];
    out.linear.push_back({narrow(term.row), narrow(term.col), coefficient});
    out.constant_jacobian[find(jacobian, {term.row, term.col})] += coefficient;
  }
  for (std::size_t b = 0; b < out.batches.size(); ++b)
    fill_lists(rows, uses[b], jacobian, hessian, out.batches[b]);
}

}  // namespace slalom::ocp
