#pragma once

#include <span>
#include <string>
#include <vector>

#include "slalom/expr/function.hpp"
#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/trajectory.hpp"

namespace slalom::ocp {

/// A problem's functions of one point in time, all that a trajectory fixes (t0, tf, parameters, end
/// values) put in as numbers.
class PointFunctions {
 public:
  /// A path row, bounds of states and controls among them.
  struct Row {
    std::string name;
    Bounds bounds;
    Points points;
  };

  PointFunctions(const Problem& problem, const Trajectory& at);

  /// States' rates at time t; sizes are the problem's.
  void rates(double t, std::span<const double> x, std::span<const double> u,
             std::span<double> out) const;
  /// Sum of the integrands of the cost.
  double integrand(double t, std::span<const double> x, std::span<const double> u) const;
  /// That sum, then the problem's integrals' integrands.
  std::size_t integrands() const { return integrand_.outputs(); }
  void integrands(double t, std::span<const double> x, std::span<const double> u,
                  std::span<double> out) const;
  /// Throws InvalidValue where a family has numbers at the points of a mesh, and none between.
  const std::vector<Row>& rows() const;
  /// Those that hold between points; such a family is left out.
  const std::vector<Row>& known_rows() const { return rows_; }
  void row_values(double t, std::span<const double> x, std::span<const double> u,
                  std::span<double> out) const;

 private:
  void call(const expr::Function& f, double t, std::span<const double> x, std::span<const double> u,
            std::span<double> out) const;

  double t0_, tf_;
  expr::Function rates_, integrand_, row_functions_;
  std::vector<Row> rows_;
  std::string without_rows_;  ///< the family that has no rows between points
  mutable std::vector<double> inputs_;
};

/// A function of one point's states, controls, time and tau (in this order) with these outputs,
/// all that a trajectory fixes put in as numbers.
expr::Function function_along(const Problem& problem, const Trajectory& at,
                              const std::vector<Expr>& outputs);

/// The states' scales; 1 where none is given.
std::vector<double> scales_of(const Problem& problem);

/// The controls at the end of an interval as it sees them: those held over it are its begin's.
std::vector<double> end_controls(const Problem& problem, const Trajectory& trajectory,
                                 std::size_t begin, std::size_t end);

}  // namespace slalom::ocp
