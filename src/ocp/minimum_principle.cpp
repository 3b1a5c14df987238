#include "minimum_principle.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "between_points.hpp"
#include "bound_shares.hpp"
#include "point_functions.hpp"
#include "set_up_watch.hpp"
#include "simulated_guess.hpp"
#include "slalom/ocp/simulate.hpp"
#include "solution_points.hpp"

namespace slalom::ocp {
namespace {

using Vector = std::vector<double>;

/// Of each control at each point: how many values are tried, evenly over its range.
constexpr int kValues = 13;
/// Times that each control is tried, the others being as they were found best.
constexpr int kSweeps = 2;
/// Of all that a row of states takes on: as near to its bound it is at it.
constexpr double kNear = 1e-3;
/// Of a row's bound, or of 1: by how much another control may break it more.
constexpr double kRowTolerance = 1e-9;

bool can_be_judged(const Problem& problem, const Solution& solution) {
  return problem.integrals().empty() && !solution.collocated_costates.tau.empty() &&
         std::none_of(problem.constraints().begin(), problem.constraints().end(),
                      [](const auto& row) { return row.enabled && row.by_point(); });
}

/// The values of each control that are tried; none for one that stays.
std::vector<Vector> values_tried(const Problem& problem, const Solution& solution) {
  std::vector<Vector> list;
  for (std::size_t i = 0; i < problem.controls().size(); ++i) {
    const auto& control = problem.controls()[i];
    Vector& values = list.emplace_back();
    if (control.form != ControlForm::scheme) continue;
    const ControlRange range = control_range(problem, solution, i);
    const double more = std::max(range.high - range.low, range.scale);
    const Bounds bounds = control.bounds;
    const double low = std::isfinite(bounds.lower) ? bounds.lower : range.low - more;
    const double high = std::isfinite(bounds.upper) ? bounds.upper : range.high + more;
    for (int v = 0; v < kValues; ++v) values.push_back(low + (high - low) * v / (kValues - 1));
  }
  return list;
}

/// What one collocation of a point has in its sum: a node may be collocated by both its intervals.
struct Collocation {
  std::size_t costates;  ///< of Solution::collocated_costates
  double weight;         ///< [time unit]
};

/// By point of the trajectory.
std::vector<std::vector<Collocation>> collocations_of(const Solution& solution) {
  const Trajectory& at = solution.trajectory;
  const auto& breaks = solution.mesh.breakpoints();
  std::vector<std::vector<Collocation>> list(at.tau.size());
  std::size_t entry = 0, first = 0;
  for (std::size_t k = 0; k < solution.mesh.intervals(); ++k) {
    const Scheme& scheme = solution.scheme.of(k);
    const double duration = (breaks[k + 1] - breaks[k]) * (at.tf - at.t0);
    for (std::size_t j = 0; j < scheme.points.size(); ++j)
      if (scheme.weight[j] != 0) list[first + j].push_back({entry++, scheme.weight[j] * duration});
    first += scheme.points.size() - 1;
  }
  return list;
}

/// By point, whether a row of states alone is at a bound there.
std::vector<char> at_bounds(const Problem& problem, const Solution& solution) {
  const PointFunctions functions(problem, solution.trajectory);
  const Trajectory& at = solution.trajectory;
  const auto names = rows_of_states(problem);
  const auto& rows = functions.known_rows();
  std::vector<Vector> values(at.tau.size(), Vector(rows.size()));
  for (std::size_t p = 0; p < values.size(); ++p)
    functions.row_values(at.time(p), at.states[p], at.controls[p], values[p]);
  std::vector<char> list(at.tau.size(), 0);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Bounds& bounds = rows[r].bounds;
    if (std::find(names.begin(), names.end(), rows[r].name) == names.end()) continue;
    double low = kInfinity, high = -kInfinity;
    for (const Vector& each : values) {
      low = std::min(low, each[r]);
      high = std::max(high, each[r]);
    }
    for (std::size_t p = 0; p < values.size(); ++p)
      if (std::min(values[p][r] - bounds.lower, bounds.upper - values[p][r]) <=
          kNear * (high - low))
        list[p] = 1;
  }
  return list;
}

/// By point, whether an interval with it, or one next to such an interval, has a point that is
/// marked.
std::vector<char> beside(const std::vector<char>& marked, const Solution& solution) {
  const std::size_t intervals = solution.mesh.intervals();
  const auto node = node_points(solution);
  std::vector<char> list(marked.size(), 0);
  for (std::size_t k = 0; k < intervals; ++k)
    for (std::size_t p = node[k]; p <= node[k + 1]; ++p)
      if (marked[p] != 0)
        std::fill(list.begin() + static_cast<std::ptrdiff_t>(node[k > 0 ? k - 1 : 0]),
                  list.begin() + static_cast<std::ptrdiff_t>(node[std::min(k + 2, intervals)]) + 1,
                  1);
  return list;
}

/// The part of the Hamiltonian's integral that is one point's, as a function of its controls.
class PointSum {
 public:
  PointSum(const Problem& problem, const Solution& solution)
      : solution_(solution),
        functions_(problem, solution.trajectory),
        rates_(problem.states().size()),
        rows_(functions_.known_rows().size()),
        own_rows_(rows_.size()) {}

  void move_to(std::size_t point, const std::vector<Collocation>& collocations) {
    point_ = point;
    collocations_ = &collocations;
    functions_.row_values(time(), states(), solution_.trajectory.controls[point], own_rows_);
  }
  /// Infinite where it is not a number or a row is broken by more than by the answer's controls.
  double operator()(const Vector& u) {
    functions_.row_values(time(), states(), u, rows_);
    for (std::size_t r = 0; r < rows_.size(); ++r)
      if (!(excess(r, rows_[r]) <= std::max(0.0, excess(r, own_rows_[r])))) return kInfinity;
    functions_.rates(time(), states(), u, rates_);
    const double integrand = functions_.integrand(time(), states(), u);
    double sum = 0;
    size_ = 0;
    for (const Collocation& each : *collocations_) {
      const Vector& costates = solution_.collocated_costates.values[each.costates];
      double h = integrand, size = std::fabs(integrand);
      for (std::size_t i = 0; i < rates_.size(); ++i) {
        h += costates[i] * rates_[i];
        size += std::fabs(costates[i] * rates_[i]);
      }
      sum += each.weight * h;
      size_ += each.weight * size;
    }
    return std::isfinite(sum) ? sum : kInfinity;
  }
  /// The magnitudes that added up to the last sum.
  double size() const { return size_; }

 private:
  double time() const { return solution_.trajectory.time(point_); }
  const Vector& states() const { return solution_.trajectory.states[point_]; }
  double excess(std::size_t row, double value) const {
    const Bounds& bounds = functions_.known_rows()[row].bounds;
    const auto room = [](double bound) { return kRowTolerance * std::max(1.0, std::fabs(bound)); };
    return std::max(bounds.lower - room(bounds.lower) - value,
                    value - room(bounds.upper) - bounds.upper);
  }

  const Solution& solution_;
  PointFunctions functions_;
  Vector rates_, rows_, own_rows_;
  std::size_t point_ = 0;
  double size_ = 0;
  const std::vector<Collocation>* collocations_ = nullptr;
};

}  // namespace

HamiltonianGap hamiltonian_gap(const Problem& problem, const Solution& solution) {
  HamiltonianGap gap;
  gap.controls = solution.trajectory.controls;
  if (!can_be_judged(problem, solution)) return gap;
  const auto tried = values_tried(problem, solution);
  const auto collocations = collocations_of(solution);
  const auto near_bounds = beside(at_bounds(problem, solution), solution);
  PointSum sum(problem, solution);
  for (std::size_t p = 0; p < collocations.size(); ++p) {
    SetUpWatch::ask_now();
    if (collocations[p].empty()) {  // its controls are held from the point before
      if (p > 0) gap.controls[p] = gap.controls[p - 1];
      continue;
    }
    sum.move_to(p, collocations[p]);
    Vector& best = gap.controls[p];
    const double own = sum(best);
    if (!std::isfinite(own)) continue;
    gap.size += sum.size();
    double least = own;
    for (int sweep = 0; sweep < kSweeps; ++sweep)
      for (std::size_t i = 0; i < tried.size(); ++i) {
        Vector u = best;
        for (const double value : tried[i]) {
          u[i] = value;
          if (const double now = sum(u); now < least) {
            least = now;
            best = u;
          }
        }
      }
    gap.value += own - least;
    if (near_bounds[p] == 0) gap.away_from_bounds += own - least;
  }
  return gap;
}

std::optional<Trajectory> guess_by(const Problem& problem, const Solution& solution,
                                   const HamiltonianGap& gap, GuessedStates states,
                                   const nlp::Options& limits) {
  Trajectory guess = solution.trajectory;
  guess.controls = gap.controls;
  if (states == GuessedStates::kept) return guess;
  // Lines from point to point: the scheme's polynomials may leave the bounds where controls jump.
  const auto law = [&](double t) {
    const double tau = guess.tf > guess.t0 ? (t - guess.t0) / (guess.tf - guess.t0) : 0;
    Vector u;
    for (std::size_t i = 0; i < problem.controls().size(); ++i)
      u.push_back(between_points(guess.tau, guess.controls, i, tau));
    return u;
  };
  Vector corners;
  for (const double tau : solution.mesh.breakpoints()) corners.push_back(guess.time_at(tau));
  return led_by(problem, guess, controls_of_time(law, corners), limits);
}

}  // namespace slalom::ocp
