#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "ocp/closed_forms.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {

inline const std::vector<int> kIntervals = {6, 12, 24, 48};

/// N intervals, at most 1.9 times as long at one end as at the other, the same grading for all N.
inline Mesh graded(int n) {
  std::vector<double> breaks;
  for (int k = 0; k <= n; ++k) {
    const double s = static_cast<double>(k) / n;
    breaks.push_back(k == n ? 1 : s + 0.3 * s * (1 - s));
  }
  return Mesh(breaks);
}

/// Errors of the objective below this are the solver's; states and costates have fifty times as
/// much.
inline constexpr double kNoise = 2e-8;

/// Largest error of the objective and of states and costates at the mesh nodes; negative: not
/// known. A mesh too coarse for a scheme to meet the ends within the bounds is infeasible.
struct Errors {
  double objective = -1, states = -1, costates = -1;
};

inline Errors errors_of(const ClosedForm& form, const Scheme& scheme, const Mesh& mesh) {
  SolveSettings settings{.mesh = mesh, .scheme = scheme, .guess = form.guess};
  settings.options.tol = 1e-11;
  const Solution solution = solve(form.problem, settings);
  if (solution.status == nlp::Status::infeasible) return {};
  if (!solution.solved())
    throw std::runtime_error(form.name + ": " + to_string(solution.status) + " with " +
                             std::to_string(mesh.intervals()) + " intervals");
  Errors errors;
  errors.objective = std::fabs(solution.objective - form.objective);
  const auto& trajectory = solution.trajectory;
  const std::size_t step = scheme.interior() + 1;
  const auto compare = [&](double& worst, const auto& exact, const auto& at_node) {
    if (!exact) return;
    for (std::size_t k = 0; k <= mesh.intervals(); ++k) {
      const auto expected = exact(trajectory.time(k * step));
      for (std::size_t i = 0; i < expected.size(); ++i)
        worst = std::max(worst, std::fabs(at_node(k)[i] - expected[i]));
    }
  };
  compare(errors.states, form.states, [&](std::size_t k) { return trajectory.states[k * step]; });
  compare(errors.costates, form.costates, [&](std::size_t k) { return solution.costates[k]; });
  return errors;
}

/// Order of convergence: slope of a straight line through log(error) over log(N) by least squares.
/// Errors at the solver's own tolerance say nothing; infinite when all are there: exact.
struct Order {
  double value = 0;
  bool known = true, exact = false;

  static Order fit(const std::vector<double>& errors, double noise) {
    if (*std::min_element(errors.begin(), errors.end()) < 0) return {0, false, false};
    if (*std::max_element(errors.begin(), errors.end()) < noise) return {0, true, true};
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      if (errors[i] < noise / 100) continue;
      const double a = std::log(kIntervals[i]), b = std::log(errors[i]);
      n += 1, x += a, y += b, xx += a * a, xy += a * b;
    }
    return {-(n * xy - x * y) / (n * xx - x * x), true, false};
  }
  std::string text() const { return !known ? "" : exact ? "exact" : fmt::format("{:.1f}", value); }
};

/// One row of the table: a problem by a scheme on a family of meshes.
struct OrderRow {
  std::string problem, scheme, mesh, limit;
  int expected;
  std::vector<double> objective_errors;
  Order objective, states, costates;
};

/// Name, and of schemes of any number of points how many.
inline std::string label(const Scheme& scheme) {
  if (scheme.name == "lgl") return fmt::format("lgl {}", scheme.points.size());
  return scheme.name.starts_with("lgr")
             ? fmt::format("{} {}", scheme.name, scheme.points.size() - 1)
             : scheme.name;
}

inline std::vector<OrderRow> measure_orders() {
  std::vector<OrderRow> table;
  for (const auto& form : closed_forms())
    for (const Scheme& scheme :
         {backward_euler(), trapezoidal(), lgr(2), lgr_differential(2), lgr_flipped(2),
          hermite_simpson(), hermite_simpson_compressed(), lgr(3), lgl(4)})
      for (const bool uniform : {true, false}) {
        std::vector<double> objective, states, costates;
        for (int n : kIntervals) {
          const auto e = errors_of(form, scheme, uniform ? Mesh::uniform(n) : graded(n));
          objective.push_back(e.objective);
          states.push_back(e.states);
          costates.push_back(e.costates);
        }
        const Order order = Order::fit(objective, kNoise);
        const double noise = (order.exact ? 500 : 50) * kNoise;
        table.push_back({form.name, label(scheme), uniform ? "uniform" : "graded", form.limit,
                         scheme.order, objective, order, Order::fit(states, noise),
                         Order::fit(costates, noise)});
      }
  return table;
}

/// The text of docs/convergence.md.
inline std::string order_page(const std::vector<OrderRow>& table) {
  std::string text =
      "# Orders of convergence, measured\n\n"
      "<!-- Written by slalom_orders (tests/ocp/order_table.cpp); a test compares it. -->\n\n"
      "Problems with known solutions (`tests/ocp/closed_forms.hpp`), solved by `ocp::solve` to "
      "1e-11\n"
      "with N = 6, 12, 24 and 48 intervals. Order: slope of log error over log N by least "
      "squares,\n"
      "for the objective, and for states and costates at the mesh nodes (largest error). "
      "\"exact\":\n"
      "no error above the solver's own; a blank: no closed form compared. Backward Euler has order "
      "1,\n"
      "trapezoidal collocation 2, LGR of n points 2 n - 1, LGL 2 n - 2, Hermite-Simpson 4.\n"
      "The graded meshes are 1.9 times coarser at the start than at the end.\n\n"
      "| problem | scheme | mesh | error of J: N = 6 | 12 | 24 | 48 | order: J | x | costates |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n";
  std::string limits;
  std::set<std::string> told;
  for (const auto& row : table) {
    text += fmt::format("| {} | {} | {} |", row.problem, row.scheme, row.mesh);
    for (double error : row.objective_errors)
      text += error < 0        ? " infeasible |"
              : error < kNoise ? " <2e-8 |"
                               : fmt::format(" {:.1e} |", error);
    text += fmt::format(" {} | {} | {} |\n", row.objective.text(), row.states.text(),
                        row.costates.text());
    if (!row.limit.empty() && told.insert(row.problem).second)
      limits += fmt::format("- {}: {}.\n", row.problem, row.limit);
  }
  text +=
      "\nWhere the scheme's order is not reached, or changes from mesh to mesh, the control is not "
      "smooth.\nHermite-Simpson is exact for these where a mesh has a node at every kink or jump, "
      "as "
      "the uniform\nmeshes do at 1/2 (and 1/3):\n\n" +
      limits;
  return text;
}

}  // namespace slalom::ocp
