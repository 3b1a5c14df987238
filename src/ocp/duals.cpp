#include "duals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace slalom::ocp {
namespace {

using Rows = std::vector<std::vector<double>>;

/// By node and state: slopes of the Lagrangian's part in the interval before and the one after.
struct Slopes {
  Rows before, after;

  explicit Slopes(const Layout& layout)
      : before(layout.intervals() + 1, std::vector<double>(layout.nx, 0.0)), after(before) {}
};

/// y' times the derivatives of the defects by the states at the nodes.
void add_defects(const Transcribed& data, std::span<const double> y, const nlp::Evaluation& at,
                 Slopes& slopes) {
  const auto& shape = data.structure;
  const Layout& layout = data.layout;
  const std::size_t slots = layout.state_points.size();
  for (std::size_t e = 0; e < at.jacobian.size(); ++e) {
    const std::size_t row = shape.jacobian_row[e], col = shape.jacobian_col[e];
    if (row < data.defect_begin || row >= data.defect_end || col >= layout.nx * slots) continue;
    const std::size_t k = shape.row_stage[row];
    const std::size_t i = col / slots, point = layout.state_points[col % slots];
    if (point == layout.node_point[k]) slopes.after[k][i] += y[row] * at.jacobian[e];
    if (point == layout.node_point[k + 1]) slopes.before[k + 1][i] += y[row] * at.jacobian[e];
  }
}

/// The quadratures' slopes: of the cost's integrands, and of the integrals' by their multipliers.
void add_integrands(const Transcribed& data, std::span<const double> y, std::size_t b,
                    Slopes& slopes) {
  const Layout& layout = data.layout;
  const Batch& batch = data.batches[b];
  const std::size_t slots = layout.state_points.size();
  for (std::size_t e = 0; e < batch.function.jacobian_pattern().size(); ++e) {
    const auto entry = batch.function.jacobian_pattern()[e];
    const std::size_t outputs = data.first_integral + data.integral_rows.size();
    if (entry.row < layout.nx || entry.row >= outputs) continue;
    double factor = batch.gather_scale[entry.col];
    if (entry.row >= data.first_integral) {
      const std::size_t row = data.integral_rows[entry.row - data.first_integral];
      factor *= y[row] * data.structure.row_scale[row];
    }
    for (std::size_t lane = 0; lane < batch.lanes; ++lane) {
      const std::size_t variable = batch.gather[entry.col * batch.lanes + lane];
      if (variable >= layout.nx * slots) continue;
      const double slope =
          factor * data.quadrature[b][lane] * batch.evaluator->jacobian()[e * batch.lanes + lane];
      const std::size_t i = variable / slots, point = layout.state_points[variable % slots];
      const std::size_t k = layout.point_stage[point];
      if (point != layout.node_point[k]) continue;
      const bool begins = b != data.ends && point < batch.lane_point[lane];
      const double share = b == 0 ? data.share_after[k] : begins ? 1 : 0;
      slopes.after[k][i] += share * slope;
      slopes.before[k][i] += (1 - share) * slope;
    }
  }
}

}  // namespace

Rows costates(const Transcribed& data, std::span<const double> y, const nlp::Evaluation& at) {
  const Layout& layout = data.layout;
  Slopes slopes(layout);
  for (const std::size_t batch : {std::size_t{0}, data.ends, data.midpoints})
    if (batch != kNone) add_integrands(data, y, batch, slopes);
  add_defects(data, y, at, slopes);
  Rows result = slopes.after;
  for (std::size_t k = 0; k <= layout.intervals(); ++k)
    for (std::size_t i = 0; i < layout.nx; ++i) {
      const double scale = data.structure.variable_scale[layout.state(0, i)];
      const double mean = k == 0 ? slopes.after[k][i]
                          : k == layout.intervals()
                              ? -slopes.before[k][i]
                              : (slopes.after[k][i] - slopes.before[k][i]) / 2;
      result[k][i] = mean / scale;
    }
  return result;
}

namespace {

/// Multipliers of the bounds of variables.
class BoundMultipliers {
 public:
  BoundMultipliers(const Transcribed& data, const nlp::Start& point, std::vector<Multipliers>& list)
      : data_(data), point_(point), list_(list) {}

  void add(const Problem::Variable& variable, std::size_t index) {
    if (variable.bounds.bounded()) list_.push_back({variable.name, {}, {value(index)}});
  }
  template <class Place>
  void add(const std::string& name, const std::vector<std::size_t>& points, Place place) {
    Multipliers each{name, points, {}};
    for (const std::size_t p : points) each.values.push_back(value(place(p)));
    list_.push_back(std::move(each));
  }

 private:
  double value(std::size_t variable) const {
    return (point_.zu[variable] - point_.zl[variable]) / data_.structure.variable_scale[variable];
  }

  const Transcribed& data_;
  const nlp::Start& point_;
  std::vector<Multipliers>& list_;
};

/// Puts values in the order of their points, for midpoints of compressed intervals come last.
template <class List>
void sort_by_point(List& list) {
  if (std::is_sorted(list.points.begin(), list.points.end())) return;
  std::vector<std::size_t> order(list.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return list.points[a] < list.points[b]; });
  const List unsorted = list;
  for (std::size_t i = 0; i < order.size(); ++i) {
    list.points[i] = unsorted.points[order[i]];
    list.values[i] = unsorted.values[order[i]];
  }
}

}  // namespace

std::string name_of(const Problem& problem, RowOrigin origin) {
  const auto& row = problem.constraints()[origin.constraint];
  return row.kind == Problem::Kind::family
             ? fmt::format("{}[{}]", row.name, row.members[origin.member])
             : row.name;
}

std::vector<Multipliers> multipliers(const Problem& problem, const Transcribed& data,
                                     const nlp::Start& point) {
  const Layout& layout = data.layout;
  std::map<std::pair<std::size_t, std::size_t>, Multipliers> rows;  // by constraint and member
  for (std::size_t r = 0; r < data.origins.size(); ++r) {
    const RowOrigin& origin = data.origins[r];
    if (origin.constraint == kNone) continue;
    Multipliers& each = rows[{origin.constraint, origin.member}];
    each.name = name_of(problem, origin);
    each.values.push_back(point.y[r] * data.structure.row_scale[r]);
    if (problem.constraints()[origin.constraint].over_time()) each.points.push_back(origin.point);
  }
  std::vector<Multipliers> list;
  for (auto& [key, each] : rows) {
    sort_by_point(each);
    list.push_back(std::move(each));
  }
  BoundMultipliers bounds(data, point, list);
  std::vector<std::size_t> points;
  for (std::size_t p = 0; p < layout.points(); ++p) points.push_back(p);
  for (std::size_t i = 0; i < layout.nx; ++i) {
    const auto& state = problem.states()[i];
    if (state.bounds.bounded() || state.initial.bounded() || state.final.bounded())
      bounds.add(state.name, layout.state_points,
                 [&](std::size_t p) { return layout.state(p, i); });
  }
  for (std::size_t i = 0; i < layout.nu; ++i)
    if (problem.controls()[i].bounds.bounded())
      bounds.add(problem.controls()[i].name, points,
                 [&](std::size_t p) { return layout.control(p, i); });
  for (std::size_t i = 0; i < layout.slack.size(); ++i)
    bounds.add(problem.slacks()[i], layout.slack[i]);
  bounds.add(problem.t0(), layout.t0);
  bounds.add(problem.tf(), layout.tf);
  for (std::size_t i = 0; i < problem.static_parameters().size(); ++i)
    bounds.add(problem.static_parameters()[i], layout.static_parameters + i);
  for (std::size_t i = 0; i < problem.integrals().size(); ++i)
    bounds.add(problem.integrals()[i], layout.integrals + i);
  return list;
}

std::vector<Excesses> excesses(const Problem& problem, const Transcribed& data,
                               std::span<const double> x) {
  std::map<std::size_t, Excesses> list;  // by constraint
  for (const Excess& excess : data.excesses) {
    const RowOrigin& origin = data.origins[excess.row];
    Excesses& each = list[origin.constraint];
    each.name = problem.constraints()[origin.constraint].name;
    each.points.push_back(origin.point);
    const auto value = [&](std::size_t variable) {
      return variable == kNone ? 0 : x[variable] * data.structure.variable_scale[variable];
    };
    each.values.push_back(value(excess.above) - value(excess.below));
  }
  std::vector<Excesses> result;
  for (auto& [constraint, each] : list) {
    sort_by_point(each);
    result.push_back(std::move(each));
  }
  return result;
}

}  // namespace slalom::ocp
