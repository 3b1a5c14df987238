#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "between_points.hpp"
#include "draft.hpp"
#include "slalom/base/error.hpp"
#include "slalom/ocp/moments.hpp"

namespace slalom::ocp {
namespace {

void add_excess(Draft& draft, std::size_t row, std::size_t stage,
                const Problem::Constraint& constraint) {
  const Bounds bounds = constraint.bounds;
  const Norm norm = constraint.soft->norm;
  Excess excess{row};
  const auto append = [&](double coefficient) {
    const std::size_t variable = draft.out.layout.append(stage);
    draft.out.structure.variable_scale.push_back(constraint.unit());
    draft.linear.push_back({row, variable, coefficient});
    return variable;
  };
  if (norm == Norm::l2 || bounds.upper < kInfinity) excess.above = append(-1);
  if (norm == Norm::l1 && bounds.lower > -kInfinity) excess.below = append(1);
  draft.out.excesses.push_back(excess);
}

/// The row of a constraint: its function's value and, where it is soft, its excesses.
void add_constraint(Draft& draft, std::size_t batch, std::size_t output, std::size_t lane,
                    RowName name, RowOrigin origin) {
  const auto& constraint = draft.problem.constraints()[origin.constraint];
  const std::size_t stage = draft.out.layout.point_stage[origin.point];
  Bounds bounds = constraint.bounds;
  if (constraint.soft) {
    bounds.lower -= constraint.soft->tolerance;
    bounds.upper += constraint.soft->tolerance;
  }
  const auto row = draft.add_row(std::move(name), stage, bounds, 1 / constraint.unit());
  draft.rows[row].origin = origin;
  draft.use(batch, output, lane, row, kNone, 1);
  if (constraint.soft) add_excess(draft, row, stage, constraint);
}

void use_as_row(Draft& draft, std::size_t batch, std::size_t output, std::size_t lane,
                std::size_t constraint) {
  const auto& row = draft.problem.constraints()[constraint];
  const std::size_t point = draft.out.batches[batch].lane_point[lane];
  const std::size_t member = draft.out.batches[batch].lane_member[lane];
  RowName name;
  name.text = " at " + draft.out.layout.point_name(point);
  if (row.kind == Problem::Kind::family) {
    name.family = constraint;
    name.member = member;
  } else {
    name.text = row.name + name.text;
  }
  add_constraint(draft, batch, output, lane, std::move(name), {constraint, member, point});
}

/// An equation that determines controls has none to determine where they are held, at a point that
/// no interval collocates.
bool overdetermines(const Draft& draft, const Problem::Constraint& row, std::size_t point) {
  if (draft.collocated[point] || row.bounds.lower != row.bounds.upper || row.soft) return false;
  const auto symbols = expr::symbols_of({row.value});
  return std::any_of(symbols.begin(), symbols.end(), [&](const Expr& symbol) {
    const Meaning* meaning = draft.symbols.find(symbol);
    return meaning != nullptr && meaning->kind == Meaning::Kind::control;
  });
}

void add_families(Draft& draft) {
  for (std::size_t f = 0; f < draft.problem.constraints().size(); ++f) {
    const auto& family = draft.problem.constraints()[f];
    if (!absent(family, Problem::Kind::family))
      use_paths(draft, draft.add_batches({{family.name, family.value}}, family.points, f), 0, {f});
  }
}

void add_ends(Draft& draft) {
  for (const End end : {End::initial, End::final}) {
    std::vector<Output> outputs;
    std::vector<std::size_t> rows;
    for (std::size_t c = 0; c < draft.problem.constraints().size(); ++c) {
      const auto& row = draft.problem.constraints()[c];
      if (absent(row, Problem::Kind::boundary) || draft.symbols.end_of(row.value, row.name) != end)
        continue;
      rows.push_back(c);
      outputs.push_back({row.name, row.value});
    }
    std::vector<std::size_t> terms;
    for (const auto& cost : draft.problem.costs())
      if (cost.enabled && cost.at_end() && draft.symbols.end_of(cost.value, cost.name) == end) {
        terms.push_back(draft.term_index(cost.name));
        outputs.push_back({cost.name, cost.value});
      }
    if (outputs.empty()) continue;
    const std::size_t point = end == End::initial ? 0 : draft.out.layout.points() - 1;
    const auto batch = draft.add_batch(outputs, {{point}, kNone, &end, {}, {}, kNone, {}});
    for (std::size_t i = 0; i < rows.size(); ++i)
      add_constraint(draft, batch, i, 0, {draft.problem.constraints()[rows[i]].name},
                     {rows[i], 0, point});
    for (std::size_t i = 0; i < terms.size(); ++i)
      draft.use(batch, rows.size() + i, 0, kNone, terms[i], 1);
  }
}

std::size_t point_at(const Draft& draft, const std::string& name, Moment moment) {
  const double share = draft.problem.share_of(name, moment);
  const auto& breaks = draft.mesh.breakpoints();
  for (std::size_t k = 0; k < breaks.size(); ++k)
    if (std::fabs(breaks[k] - share) <= kAtMoment) return draft.out.layout.node_point[k];
  throw InvalidValue(draft.problem.name() + ": " + name,
                     fmt::format("no node of the mesh at the share {} of the horizon", share),
                     "a mesh that with_moments() made");
}

/// Rows and cost terms at a moment.
void add_moments(Draft& draft) {
  const auto batch_at = [&](const std::string& name, const Expr& value, std::size_t point) {
    Lanes lanes;
    lanes.points = {point};
    return draft.add_batch({{name, value}}, lanes);
  };
  for (std::size_t c = 0; c < draft.problem.constraints().size(); ++c) {
    const auto& row = draft.problem.constraints()[c];
    if (absent(row, Problem::Kind::moment)) continue;
    const std::size_t point = point_at(draft, row.name, row.moment);
    add_constraint(draft, batch_at(row.name, row.value, point), 0, 0, {row.name}, {c, 0, point});
  }
  for (const auto& cost : draft.problem.costs())
    if (cost.enabled && cost.moment)
      draft.use(batch_at(cost.name, cost.value, point_at(draft, cost.name, *cost.moment)), 0, 0,
                kNone, draft.term_index(cost.name), 1);
}

/// What the excesses of a soft constraint cost.
void add_soft_cost(Draft& draft, std::size_t constraint) {
  const auto& row = draft.problem.constraints()[constraint];
  const std::string name = "soft " + row.name;
  const Expr excess = Expr::symbol("excess of " + row.name);
  Lanes lanes;
  lanes.soft = constraint;
  lanes.weight = Expr::symbol("weight of " + row.name);
  std::vector<std::size_t> variables;
  for (const Excess& each : draft.out.excesses) {
    const RowOrigin& origin = draft.rows[each.row].origin;
    if (origin.constraint != constraint) continue;
    for (const std::size_t variable : {each.above, each.below}) {
      if (variable == kNone) continue;
      variables.push_back(variable);
      lanes.points.push_back(origin.point);
    }
  }
  lanes.placed.push_back(
      {excess, [&variables](const Batch&, std::size_t lane) { return variables[lane]; }});
  const bool over_time = row.over_time();
  Expr cost = lanes.weight * (row.soft->norm == Norm::l1 ? excess : square(excess));
  if (over_time) cost = cost * (draft.problem.final_time() - draft.problem.initial_time());
  const std::size_t batch = draft.add_batch({{name, cost}}, lanes), term = draft.term_index(name);
  for (std::size_t lane = 0; lane < lanes.points.size(); ++lane)
    draft.use(batch, 0, lane, kNone, term,
              over_time ? share_of(draft.out.layout.tau, lanes.points[lane]) : 1);
}

}  // namespace

std::vector<std::size_t> path_rows(const Draft& draft, Points which, std::vector<Output>& outputs) {
  std::vector<std::size_t> rows;
  for (std::size_t c = 0; c < draft.problem.constraints().size(); ++c) {
    const auto& row = draft.problem.constraints()[c];
    if (absent(row, Problem::Kind::path) || row.points != which) continue;
    rows.push_back(c);
    outputs.push_back({row.name, row.value});
  }
  return rows;
}

void use_paths(Draft& draft, const std::vector<std::size_t>& batches, std::size_t first_output,
               const std::vector<std::size_t>& constraints) {
  for (std::size_t i = 0; i < constraints.size(); ++i)
    for (const std::size_t batch : batches)
      for (std::size_t lane = 0; lane < draft.out.batches[batch].lanes; ++lane)
        if (!overdetermines(draft, draft.problem.constraints()[constraints[i]],
                            draft.out.batches[batch].lane_point[lane]))
          use_as_row(draft, batch, first_output + i, lane, constraints[i]);
}

void add_constraints(Draft& draft) {
  std::vector<Output> outputs;
  const auto paths = path_rows(draft, Points::after_first, outputs);
  if (!outputs.empty()) use_paths(draft, draft.add_batches(outputs, Points::after_first), 0, paths);
  add_families(draft);
  add_ends(draft);
  add_moments(draft);
  for (std::size_t c = 0; c < draft.problem.constraints().size(); ++c)
    if (draft.problem.constraints()[c].soft &&
        !absent(draft.problem.constraints()[c], draft.problem.constraints()[c].kind))
      add_soft_cost(draft, c);
}

}  // namespace slalom::ocp
