#include "builder.hpp"

#include <fmt/format.h>

#include <utility>

#include "draft.hpp"
#include "slalom/base/error.hpp"

namespace slalom::ocp {
namespace {

void add_lifts(Draft& draft) {
  const Layout& layout = draft.out.layout;
  const std::size_t last = layout.points() - 1;
  for (std::size_t i = 0; i < layout.nx; ++i) {
    const double scale = 1 / draft.problem.states()[i].unit();
    for (const auto& [lifted, point, symbol] :
         {std::tuple{layout.lifted_initial[i], std::size_t{0},
                     draft.problem.states()[i].initial_symbol},
          std::tuple{layout.lifted_final[i], last, draft.problem.states()[i].final_symbol}}) {
      if (lifted == kNone) continue;
      const auto row = draft.add_row({"copy of " + symbol.name()}, layout.point_stage[point],
                                     Bounds::equal(0), scale);
      draft.linear.push_back({row, layout.state(point, i), 1});
      draft.linear.push_back({row, lifted, -1});
      draft.out.copies.emplace_back(row, lifted);
    }
  }
}

/// Where the bounds of t0 and tf leave it open.
void run_time_forward(Draft& draft) {
  if (draft.problem.runs_forward()) return;
  const auto row = draft.add_row({"tf after t0"}, draft.out.layout.intervals() + 1,
                                 Bounds::at_least(0), 1 / draft.problem.tf().unit());
  draft.linear.push_back({row, draft.out.layout.tf, 1});
  draft.linear.push_back({row, draft.out.layout.t0, -1});
}

}  // namespace

Transcribed transcribe(const Problem& problem, const Mesh& mesh, const Schemes& schemes) {
  Draft draft(problem, mesh, schemes);
  add_lifts(draft);
  add_dynamics(draft);
  add_constraints(draft);
  run_time_forward(draft);
  fill_rows(draft.rows, draft.out);
  fill_limits(problem, draft.out);
  fill_sparsity(draft.rows, draft.linear, draft.uses, draft.out);
  for (auto& batch : draft.out.batches) batch.finish();
  fill_data(problem, draft.out);
  return std::move(draft.out);
}

void fill_limits(const Problem& problem, Transcribed& out) {
  fill_variable_limits(problem, out.layout, out.structure.variable_scale, out.limits);
  for (const Excess& excess : out.excesses)
    if (problem.constraints()[out.origins[excess.row].constraint].soft->norm == Norm::l1)
      for (const std::size_t variable : {excess.above, excess.below})
        if (variable != kNone) out.limits.xl[variable] = 0;
}

std::string RowName::in(const Problem& problem) const {
  if (family == kNone) return text;
  const auto& constraint = problem.constraints()[family];
  return fmt::format("{}[{}]{}", constraint.name, constraint.members[member], text);
}

}  // namespace slalom::ocp
