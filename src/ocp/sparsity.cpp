#include "sparsity.hpp"

#include <algorithm>
#include <utility>

#include "../base/open_index.hpp"
#include "set_up_watch.hpp"

namespace slalom::ocp {
namespace {

std::uint32_t narrow(std::size_t n) {
  return static_cast<std::uint32_t>(n);
}

/// Numbers the places of a sparse matrix in the order in which they are first met.
class Places {
 public:
  Places(std::vector<std::uint32_t>& rows, std::vector<std::uint32_t>& cols)
      : rows_(rows), cols_(cols) {}

  std::uint32_t number(std::size_t row, std::size_t col) {
    SetUpWatch::poll();
    const std::uint64_t wanted = (std::uint64_t{row} << 32) | col;
    const std::size_t found =
        index_.find(wanted, [&](std::size_t number) { return key(number) == wanted; });
    if (found != OpenIndex::kNone) return narrow(found);
    rows_.push_back(narrow(row));
    cols_.push_back(narrow(col));
    index_.add([&](std::size_t number) { return key(number); });
    return narrow(rows_.size() - 1);
  }

 private:
  std::uint64_t key(std::size_t number) const {
    return (std::uint64_t{rows_[number]} << 32) | cols_[number];
  }

  std::vector<std::uint32_t>&rows_, &cols_;
  OpenIndex index_;
};

/// Calls f(uses of one output on consecutive lanes): first and last of each such stretch.
template <class F>
void for_stretches(const std::vector<Use>& uses, F f) {
  for (auto first = uses.begin(); first != uses.end();) {
    auto last = first + 1;
    while (last != uses.end() && last->output == first->output &&
           (last->row == kNone) == (first->row == kNone))
      ++last;
    f(first, last);
    first = last;
  }
}

class Filler {
 public:
  Filler(const std::vector<RowInfo>& rows, Transcribed& out)
      : rows_(rows),
        out_(out),
        jacobian_(out.structure.jacobian_row, out.structure.jacobian_col),
        hessian_(out.structure.hessian_row, out.structure.hessian_col) {}

  void values(const std::vector<Use>& uses, Batch& batch) {
    std::vector<Scatter> to_rows, to_terms;
    for (const Use& use : uses) {
      SetUpWatch::poll();
      const auto source = narrow(use.output * batch.lanes + use.lane);
      if (use.row != kNone)
        to_rows.push_back({source, narrow(use.row), use.coefficient * rows_[use.row].scale});
      else
        to_terms.push_back({source, narrow(use.term), use.coefficient});
    }
    batch.to_rows = LaneRuns(to_rows, &written(rows_written_, rows_.size()));
    batch.to_terms = LaneRuns(to_terms);
  }

  void first_derivatives(const std::vector<Use>& uses, Batch& batch) {
    std::vector<Scatter> to_jacobian, to_gradient;
    const auto& pattern = batch.function.jacobian_pattern();
    for_stretches(uses, [&](auto first, auto last) {
      for (std::size_t e = 0; e < pattern.size(); ++e) {
        if (pattern[e].row != first->output) continue;
        for (auto use = first; use != last; ++use) {
          const auto source = narrow(e * batch.lanes + use->lane);
          const std::size_t variable = batch.gather[pattern[e].col * batch.lanes + use->lane];
          const double scale = use->coefficient * batch.gather_scale[pattern[e].col];
          if (use->row != kNone)
            to_jacobian.push_back(
                {source, jacobian_.number(use->row, variable), scale * rows_[use->row].scale});
          else
            to_gradient.push_back({source, narrow(variable), scale});
        }
      }
    });
    batch.to_jacobian =
        LaneRuns(to_jacobian, &written(jacobian_written_, out_.structure.jacobian_row.size()));
    batch.to_gradient = LaneRuns(to_gradient);
  }

  void second_derivatives(Batch& batch) {
    std::vector<Scatter> list;
    const auto& pattern = batch.function.hessian_pattern();
    for (std::size_t e = 0; e < pattern.size(); ++e)
      for (std::size_t lane = 0; lane < batch.lanes; ++lane) {
        const std::size_t a = batch.gather[pattern[e].row * batch.lanes + lane];
        const std::size_t b = batch.gather[pattern[e].col * batch.lanes + lane];
        const double twice = a == b && pattern[e].row != pattern[e].col ? 2 : 1;
        list.push_back(
            {narrow(e * batch.lanes + lane), hessian_.number(std::max(a, b), std::min(a, b)),
             twice * batch.gather_scale[pattern[e].row] * batch.gather_scale[pattern[e].col]});
      }
    batch.to_hessian =
        LaneRuns(list, &written(hessian_written_, out_.structure.hessian_row.size()));
  }

  void linear_terms(const std::vector<RowTerm>& linear) {
    std::vector<Scatter> values, constant;
    for (const auto& term : linear) {
      const double coefficient =
          term.coefficient * rows_[term.row].scale * out_.structure.variable_scale[term.col];
      values.push_back({narrow(term.col), narrow(term.row), coefficient});
      constant.push_back({0, jacobian_.number(term.row, term.col), coefficient});
    }
    out_.linear = LaneRuns(values, &written(rows_written_, rows_.size()));
    out_.linear_jacobian =
        LaneRuns(constant, &written(jacobian_written_, out_.structure.jacobian_row.size()));
  }

 private:
  const std::vector<RowInfo>& rows_;
  Transcribed& out_;
  Places jacobian_, hessian_;
  std::vector<char> rows_written_, jacobian_written_, hessian_written_;

  static std::vector<char>& written(std::vector<char>& list, std::size_t size) {
    list.resize(size, 0);
    return list;
  }
};

}  // namespace

void fill_rows(const std::vector<RowInfo>& rows, Transcribed& out) {
  auto& structure = out.structure;
  structure.variables = out.layout.variables;
  structure.rows = rows.size();
  structure.stages = out.layout.intervals() + 1;
  structure.variable_stage = out.layout.variable_stage;
  for (const auto& row : rows) {
    SetUpWatch::poll();
    structure.row_stage.push_back(narrow(row.stage));
    structure.row_scale.push_back(row.scale);
    out.limits.gl.push_back(row.bounds.lower * row.scale);
    out.limits.gu.push_back(row.bounds.upper * row.scale);
    out.row_names.push_back(row.name);
    out.origins.push_back(row.origin);
  }
}

void fill_sparsity(const std::vector<RowInfo>& rows, const std::vector<RowTerm>& linear,
                   const std::vector<std::vector<Use>>& uses, Transcribed& out) {
  Filler filler(rows, out);
  for (std::size_t b = 0; b < out.batches.size(); ++b) {
    filler.values(uses[b], out.batches[b]);
    filler.first_derivatives(uses[b], out.batches[b]);
    filler.second_derivatives(out.batches[b]);
  }
  filler.linear_terms(linear);
  out.structure.id = nlp::Structure::next_id();
}

}  // namespace slalom::ocp
