#include "draft.hpp"

#include <algorithm>
#include <utility>

#include "set_up_watch.hpp"
#include "slalom/base/error.hpp"

namespace slalom::ocp {
namespace {

void check_dynamics(const Problem& problem) {
  if (problem.states().empty())
    throw InvalidValue(problem.name(), "no states", "at least one state");
  for (const auto& state : problem.states())
    if (!state.has_rate)
      throw InvalidValue(problem.name() + ": state " + state.name, "no dynamics",
                         "a call of dynamics for each state");
}

}  // namespace

Draft::Draft(const Problem& p, const Mesh& m, const Schemes& s)
    : problem(p), mesh(m), schemes(s), symbols(p), compiler_(problem, symbols, out) {
  schemes.check(mesh);
  check_dynamics(problem);
  for (const auto& cost : problem.costs())
    if (cost.enabled) out.terms.push_back(cost.name);
  for (const auto& row : problem.constraints())
    if (row.soft && !absent(row, row.kind)) out.terms.push_back("soft " + row.name);
  out.layout = make_layout(problem, mesh, schemes, symbols.find_lifts());
  out.structure.variable_scale = variable_scales(problem, out.layout);
  collocated.assign(out.layout.points(), 0);
  for (std::size_t k = 0; k < out.layout.intervals(); ++k)
    for (std::size_t j = 0; j < schemes.of(k).points.size(); ++j)
      if (schemes.of(k).collocates(j)) collocated[out.layout.node_point[k] + j] = 1;
  if (out.layout.state_points.size() < out.layout.points()) midpoints_.emplace(problem, out.layout);
}

std::size_t Draft::add_row(RowName name, std::size_t stage, Bounds bounds, double scale) {
  SetUpWatch::poll();
  rows.push_back({std::move(name), stage, bounds, scale, {}});
  return rows.size() - 1;
}

void Draft::use(std::size_t batch, std::size_t output, std::size_t lane, std::size_t row,
                std::size_t term, double coefficient) {
  SetUpWatch::poll();
  uses[batch].push_back({output, lane, row, term, coefficient});
}

std::size_t Draft::term_index(const std::string& name) const {
  const auto it = std::find(out.terms.begin(), out.terms.end(), name);
  return static_cast<std::size_t>(it - out.terms.begin());
}

std::size_t Draft::add_batch(const std::vector<Output>& outputs, const Lanes& lanes) {
  SetUpWatch::ask_now();  // a large expression's derivatives take their time
  uses.emplace_back();
  return compiler_.add(outputs, lanes);
}

std::vector<std::size_t> Draft::add_batches(const std::vector<Output>& outputs, Points which,
                                            std::size_t family) {
  std::vector<std::size_t> with_state, without, batches;
  for (std::size_t point = which == Points::all ? 0 : 1; point < out.layout.points(); ++point)
    (out.layout.has_state(point) ? with_state : without).push_back(point);
  Lanes lanes;
  lanes.points = std::move(with_state);
  lanes.family = family;
  batches.push_back(add_batch(outputs, lanes));
  if (!without.empty())
    batches.push_back(
        add_batch(midpoints_->outputs(outputs), midpoints_->lanes(std::move(without), family)));
  return batches;
}

}  // namespace slalom::ocp
