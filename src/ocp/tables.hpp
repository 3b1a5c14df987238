#pragma once

#include <string>
#include <utility>
#include <vector>

#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {

/// The tables (expr::cubic_spline) that a problem's terms use, found once for all its solves.
/// Families of rows, and what holds at a moment, are not looked at.
class Tables {
 public:
  Tables() = default;
  explicit Tables(const Problem& problem);

  /// What Solution::beyond_tables says, at the points of the trajectory.
  std::vector<std::pair<std::string, double>> beyond(const Problem& problem,
                                                     const Solution& solution) const;

 private:
  struct Use {
    std::string term;
    std::vector<Expr> rooms;  ///< expr::room_in_tables
  };
  std::vector<Use> uses_;
};

}  // namespace slalom::ocp
