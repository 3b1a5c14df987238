#include "dependence.hpp"

#include <algorithm>
#include <utility>

#include "stored_trajectory.hpp"

namespace slalom::ocp {
namespace {

std::vector<Expr> fresh(std::size_t count) {
  std::vector<Expr> symbols;
  for (std::size_t i = 0; i < count; ++i) symbols.push_back(Expr::symbol(""));
  return symbols;
}

}  // namespace

DataSlopes::DataSlopes(const Transcribed& t, std::span<const double> x, std::span<const double> y)
    : t_(t) {
  for (std::size_t b = 0; b < t.batches.size(); ++b) slopes_.push_back(slopes_of(b, x, y));
}

DataSlopes::Slopes DataSlopes::slopes_of(std::size_t b, std::span<const double> x,
                                         std::span<const double> y) const {
  const Batch& batch = t_.batches[b];
  const auto& sources = t_.batch_data[b].sources;
  const std::size_t lanes = batch.lanes;
  Slopes slopes;
  auto variables = fresh(batch.function.variables());
  const auto data = fresh(batch.function.data());
  const auto outputs = batch.function(variables, data);
  std::vector<Expr> resting;
  std::vector<double> at, given;
  for (std::size_t i = 0; i < variables.size(); ++i)
    for (std::size_t lane = 0; lane < lanes; ++lane)
      at.push_back(batch.gather_scale[i] * x[batch.gather[i * lanes + lane]]);
  for (std::size_t i = 0; i < data.size(); ++i) {
    const bool moves = sources[i].kind != DataSource::Kind::tau;
    const auto column = batch.data().subspan(i * lanes, lanes);
    (moves ? variables : resting).push_back(data[i]);
    (moves ? at : given).insert((moves ? at : given).end(), column.begin(), column.end());
    if (moves) slopes.columns.push_back(i);
  }
  if (slopes.columns.empty() && t_.midpoints == kNone) return slopes;
  slopes.function = expr::Function(std::move(variables), std::move(resting), outputs);
  std::vector<double> weights(outputs.size() * lanes, 0.0), values(weights.size());
  batch.to_rows.gather(y, weights);
  batch.to_terms.add_to_sources(1, weights);
  slopes.jacobian.resize(slopes.function.jacobian_pattern().size() * lanes);
  slopes.hessian.resize(slopes.function.hessian_pattern().size() * lanes);
  slopes.function.evaluate(lanes, at, given, weights,
                           {.values = true, .jacobian = true, .hessian = true}, values,
                           slopes.jacobian, slopes.hessian);
  return slopes;
}

nlp::Dependence DataSlopes::dependence(const Direction& direction) const {
  auto out = nlp::no_dependence(t_.structure);
  out.limits = direction.limits;
  for (std::size_t b = 0; b < slopes_.size(); ++b) add(b, direction, out);
  return out;
}

void DataSlopes::add(std::size_t b, const Direction& direction, nlp::Dependence& out) const {
  const Slopes& slopes = slopes_[b];
  if (slopes.columns.empty()) return;
  const Batch& batch = t_.batches[b];
  const std::size_t lanes = batch.lanes, variables = batch.function.variables();
  const auto rates_of = [&](std::size_t col) {
    return direction.data[b].data() + slopes.columns[col - variables] * lanes;
  };
  std::vector<double> moved(batch.function.outputs() * lanes, 0.0);
  const auto& pattern = slopes.function.jacobian_pattern();
  for (std::size_t e = 0; e < pattern.size(); ++e) {
    if (pattern[e].col < variables) continue;
    const double* rates = rates_of(pattern[e].col);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      if (rates[lane] != 0)
        moved[pattern[e].row * lanes + lane] += slopes.jacobian[e * lanes + lane] * rates[lane];
  }
  batch.to_rows.for_each([&](std::size_t from, std::size_t row, double coefficient) {
    out.rows[row] += coefficient * moved[from];
  });
  batch.to_terms.for_each([&](std::size_t from, std::size_t, double coefficient) {
    out.objective += coefficient * moved[from];
  });
  const auto& second = slopes.function.hessian_pattern();
  for (std::size_t e = 0; e < second.size(); ++e) {
    const auto [row, col] = second[e];
    if (row < variables || col >= variables) continue;
    const double* rates = rates_of(row);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      if (rates[lane] != 0)
        out.gradient[batch.gather[col * lanes + lane]] +=
            batch.gather_scale[col] * slopes.hessian[e * lanes + lane] * rates[lane];
  }
}

double DataSlopes::output_rate(std::size_t b, std::size_t output, std::size_t lane,
                               std::span<const double> dx, const Direction& direction) const {
  const Slopes& slopes = slopes_[b];
  const Batch& batch = t_.batches[b];
  const std::size_t lanes = batch.lanes, variables = batch.function.variables();
  const auto& pattern = slopes.function.jacobian_pattern();
  double rate = 0;
  for (std::size_t e = 0; e < pattern.size(); ++e) {
    const auto [row, col] = pattern[e];
    if (row != output) continue;
    const double moved = col < variables
                             ? batch.gather_scale[col] * dx[batch.gather[col * lanes + lane]]
                             : direction.data[b][slopes.columns[col - variables] * lanes + lane];
    if (moved != 0) rate += slopes.jacobian[e * lanes + lane] * moved;
  }
  return rate;
}

namespace {

/// Of the states at compressed midpoints, x_m = (x_0 + x_1)/2 + h/8 (f_0 - f_1): see Midpoints.
void fill_midpoints(const Problem& problem, const Transcribed& t, const DataSlopes& slopes,
                    std::span<const double> dx, const Direction& direction, Trajectory& rate) {
  const Layout& layout = t.layout;
  for (std::size_t k = 0; k < layout.intervals(); ++k) {
    const std::size_t begin = layout.node_point[k], point = begin + 1,
                      end = layout.node_point[k + 1];
    if (point == end || layout.has_state(point)) continue;
    const double length = layout.tau[end] - layout.tau[begin];
    // The batches' outputs are the rates times the duration.
    const auto at_end = [&]() -> std::pair<std::size_t, std::size_t> {
      if (t.ends == kNone) return {0, layout.state_slot[end]};
      const auto& points = t.batches[t.ends].lane_point;
      const auto found = std::find(points.begin(), points.end(), end);
      return {t.ends, static_cast<std::size_t>(found - points.begin())};
    }();
    for (std::size_t i = 0; i < problem.states().size(); ++i)
      rate.states[point][i] =
          (rate.states[begin][i] + rate.states[end][i]) / 2 +
          length / 8 *
              (slopes.output_rate(0, i, layout.state_slot[begin], dx, direction) -
               slopes.output_rate(at_end.first, i, at_end.second, dx, direction));
  }
}

}  // namespace

Trajectory trajectory_rate(const Problem& problem, const Transcribed& t, const DataSlopes& slopes,
                           std::span<const double> dx, const Direction& direction) {
  Trajectory rate = stored_trajectory(problem, t, dx);
  if (t.layout.state_points.size() < t.layout.points())
    fill_midpoints(problem, t, slopes, dx, direction, rate);
  return rate;
}

}  // namespace slalom::ocp
