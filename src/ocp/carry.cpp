#include "carry.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

#include "between_points.hpp"
#include "duals.hpp"
#include "set_up_watch.hpp"

namespace slalom::ocp {
namespace {

using Matrix = std::vector<std::vector<double>>;

/// Solves a x = b for a symmetric positive definite a, by elimination.
std::vector<double> solve_definite(Matrix a, std::vector<double> b) {
  const std::size_t n = b.size();
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = a[i][k] / a[k][k];
      for (std::size_t j = k; j < n; ++j) a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
  return b;
}

/// The defects' multipliers y with rate' y = -weight * costates, by least squares.
std::vector<double> defect_multipliers(const Scheme& scheme, const std::vector<double>& costates) {
  const std::size_t defects = scheme.defects(), points = scheme.points.size();
  Matrix normal(defects, std::vector<double>(defects, 0.0));
  std::vector<double> right(defects, 0.0);
  for (std::size_t d = 0; d < defects; ++d)
    for (std::size_t j = 0; j < points; ++j) {
      right[d] -= scheme.rate[d][j] * scheme.weight[j] * costates[j];
      for (std::size_t e = 0; e < defects; ++e)
        normal[d][e] += scheme.rate[d][j] * scheme.rate[e][j];
    }
  return solve_definite(std::move(normal), std::move(right));
}

/// One name's multipliers as a density over time; 0 of a name that an answer has not. `ends_apart`:
/// what stands at the horizon's ends is no part of a density but what fixes the ends.
class Density {
 public:
  Density(const Duals& duals, const Layout& layout, const Multipliers* of, bool ends_apart)
      : duals_(duals), layout_(layout), of_(of) {
    if (of == nullptr || of->points.empty()) return;
    first_apart_ = ends_apart && of->points.front() == 0;
    last_apart_ = ends_apart && of->points.back() + 1 == duals.tau.size();
    from_ = first_apart_ ? 1 : 0;
    const std::size_t to = of->points.size() - (last_apart_ ? 1 : 0);
    for (std::size_t k = from_; k < to; ++k) tau_.push_back(duals.tau[of->points[k]]);
  }

  /// At a point of the new mesh.
  double at(std::size_t point) const {
    if (first_apart_ && point == 0) return of_->values.front();
    if (last_apart_ && point + 1 == layout_.points()) return of_->values.back();
    if (tau_.empty()) return 0;
    const auto density = [&](std::size_t k) {
      return of_->values[from_ + k] / share_of(duals_.tau, of_->points[from_ + k]);
    };
    return between_points(tau_, density, layout_.tau[point]) * share_of(layout_.tau, point);
  }

 private:
  const Duals& duals_;
  const Layout& layout_;
  const Multipliers* of_;
  bool first_apart_ = false, last_apart_ = false;
  std::size_t from_ = 0;
  std::vector<double> tau_;
};

/// A solution's multipliers by name.
class Densities {
 public:
  Densities(const Duals& duals, const Layout& layout) : duals_(duals), layout_(layout) {
    for (const auto& each : duals.multipliers) by_name_.emplace(each.name, &each);
  }

  double single(const std::string& name) const {
    const Multipliers* found = find(name);
    return found == nullptr || found->values.empty() ? 0 : found->values.front();
  }
  Density over_time(const std::string& name, bool ends_apart) const {
    return {duals_, layout_, find(name), ends_apart};
  }

 private:
  const Multipliers* find(const std::string& name) const {
    const auto it = by_name_.find(name);
    return it == by_name_.end() ? nullptr : it->second;
  }

  const Duals& duals_;
  const Layout& layout_;
  std::unordered_map<std::string, const Multipliers*> by_name_;
};

void carry_defects(const Transcribed& data, const Schemes& schemes,
                   const CollocatedCostates& costates, nlp::Start& start) {
  const Layout& layout = data.layout;
  for (std::size_t k = 0; k < layout.intervals(); ++k) {
    const Scheme& scheme = schemes.of(k);
    for (std::size_t i = 0; i < layout.nx; ++i) {
      SetUpWatch::poll();
      std::vector<double> at_points;
      for (std::size_t j = 0; j < scheme.points.size(); ++j)
        at_points.push_back(between_points(
            costates.tau, [&](std::size_t p) { return costates.values[p][i]; },
            layout.tau[layout.node_point[k] + j], j + 1 == scheme.points.size()));
      const auto y = defect_multipliers(scheme, at_points);
      for (std::size_t d = 0; d < y.size(); ++d) {
        const std::size_t row = defect_row(data, d, i, k);
        start.y[row] = y[d] / data.structure.row_scale[row];
      }
    }
  }
}

void carry_rows(const Problem& problem, const Transcribed& data, const Densities& densities,
                nlp::Start& start) {
  std::map<std::pair<std::size_t, std::size_t>, Density> known;  // by constraint and member
  for (std::size_t r = 0; r < data.origins.size(); ++r) {
    SetUpWatch::poll();
    const RowOrigin& origin = data.origins[r];
    if (origin.constraint == kNone) continue;
    double value = 0;
    if (problem.constraints()[origin.constraint].over_time()) {
      auto found = known.find({origin.constraint, origin.member});
      if (found == known.end())
        found = known
                    .emplace(std::pair(origin.constraint, origin.member),
                             densities.over_time(name_of(problem, origin), false))
                    .first;
      value = found->second.at(origin.point);
    } else {
      value = densities.single(name_of(problem, origin));
    }
    start.y[r] = value / data.structure.row_scale[r];
  }
}

void carry_bounds(const Problem& problem, const Transcribed& data, const Densities& densities,
                  nlp::Start& start) {
  const Layout& layout = data.layout;
  const auto set = [&](std::size_t variable, double value) {
    const double z = value * data.structure.variable_scale[variable];
    start.zu[variable] = std::max(z, 0.0);
    start.zl[variable] = std::max(-z, 0.0);
  };
  for (std::size_t i = 0; i < layout.nx; ++i) {
    SetUpWatch::ask_now();
    const Density density = densities.over_time(problem.states()[i].name, true);
    for (const std::size_t p : layout.state_points) set(layout.state(p, i), density.at(p));
  }
  for (std::size_t i = 0; i < layout.nu; ++i) {
    SetUpWatch::ask_now();
    const Density density = densities.over_time(problem.controls()[i].name, false);
    for (std::size_t p = 0; p < layout.points(); ++p) set(layout.control(p, i), density.at(p));
  }
  for (std::size_t i = 0; i < layout.slack.size(); ++i)
    set(layout.slack[i], densities.single(problem.slacks()[i].name));
  set(layout.t0, densities.single("t0"));
  set(layout.tf, densities.single("tf"));
  for (std::size_t i = 0; i < problem.static_parameters().size(); ++i)
    set(layout.static_parameters + i, densities.single(problem.static_parameters()[i].name));
  for (std::size_t i = 0; i < problem.integrals().size(); ++i)
    set(layout.integrals + i, densities.single(problem.integrals()[i].name));
}

}  // namespace

CollocatedCostates collocated_costates(const Transcribed& data, const Schemes& schemes,
                                       std::span<const double> y) {
  const Layout& layout = data.layout;
  CollocatedCostates costates;
  for (std::size_t k = 0; k < layout.intervals(); ++k) {
    const Scheme& scheme = schemes.of(k);
    for (std::size_t j = 0; j < scheme.points.size(); ++j) {
      if (scheme.weight[j] == 0) continue;
      costates.tau.push_back(layout.tau[layout.node_point[k] + j]);
      auto& values = costates.values.emplace_back(layout.nx, 0.0);
      for (std::size_t i = 0; i < layout.nx; ++i)
        for (std::size_t d = 0; d < scheme.defects(); ++d) {
          const std::size_t row = defect_row(data, d, i, k);
          values[i] -=
              scheme.rate[d][j] * y[row] * data.structure.row_scale[row] / scheme.weight[j];
        }
    }
  }
  return costates;
}

void carry_multipliers(const Problem& problem, const Transcribed& data, const Schemes& schemes,
                       const Duals& duals, nlp::Start& start) {
  start.y.assign(data.structure.rows, 0.0);
  start.zl.assign(data.structure.variables, 0.0);
  start.zu.assign(data.structure.variables, 0.0);
  const Densities densities(duals, data.layout);
  carry_defects(data, schemes, duals.costates, start);
  carry_rows(problem, data, densities, start);
  carry_bounds(problem, data, densities, start);
}

void settle_dependents(const Transcribed& data, const nlp::Evaluation& at, nlp::Start& start) {
  const auto& shape = data.structure;
  std::vector<double> slope = at.gradient;
  for (std::size_t i = 0; i < slope.size(); ++i) slope[i] += start.zu[i] - start.zl[i];
  for (std::size_t e = 0; e < at.jacobian.size(); ++e)
    slope[shape.jacobian_col[e]] += start.y[shape.jacobian_row[e]] * at.jacobian[e];
  std::vector<std::size_t> defined(shape.rows, kNone);
  for (std::size_t i = 0; i < data.integral_rows.size(); ++i)
    defined[data.integral_rows[i]] = data.layout.integrals + i;
  for (const auto& [row, variable] : data.copies) defined[row] = variable;
  for (std::size_t e = 0; e < at.jacobian.size(); ++e) {
    const std::size_t row = shape.jacobian_row[e];
    if (defined[row] == shape.jacobian_col[e]) start.y[row] = -slope[defined[row]] / at.jacobian[e];
  }
  for (const Excess& excess : data.excesses)
    for (const std::size_t variable : {excess.above, excess.below})
      if (variable != kNone && data.limits.xl[variable] == 0)
        start.zl[variable] = std::max(slope[variable], 0.0);
}

}  // namespace slalom::ocp
