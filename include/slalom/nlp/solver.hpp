#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "slalom/base/options.hpp"
#include "slalom/nlp/problem.hpp"

namespace slalom::nlp {

/// How a solve ended.
enum class Status {
  solved,             ///< central point of the floor, or optimum, to tolerance
  iteration_limit,    ///< max_iterations reached
  time_limit,         ///< time_limit reached
  infeasible,         ///< converged to a point of locally least violation
  unbounded,          ///< iterates diverge while the objective falls
  invalid_number,     ///< a function gave NaN or infinity; see Answer::fault
  too_few_freedoms,   ///< more equations than free variables
  interrupted,        ///< the stop callback asked for it
  numerical_failure,  ///< the method could not go on: no step, restoration failed, ...
};
const char* to_string(Status status);

struct Options {
  /// Barrier floor mu [objective's units]: the solve ends at the central point of mu. 0: none.
  double floor = 0;
  double tol = 1e-8;             ///< scaled optimality tolerance without a floor
  double dual_tol = 1e-3;        ///< at a floor: gradient of the Lagrangian [objective's units]
  double constraint_tol = 1e-6;  ///< at a floor: rows and defects [their units]
  double floor_tol = 0.01;       ///< at a floor: |s z / mu - 1|
  int max_iterations = 500;
  double time_limit = std::numeric_limits<double>::infinity();  ///< wall clock [s]
  bool warm_start = false;        ///< the start's multipliers are used
  int print_level = 0;            ///< of the back end's own log
  bool (*stop)(void*) = nullptr;  ///< polled each iteration; true ends the solve
  void* stop_data = nullptr;
};

/// A primal and, for a warm start, dual point. Sign convention: the Lagrangian is
/// f + y' g - zl' (x - xl) + zu' (x - xu), so zl, zu >= 0 and y >= 0 at an upper bound of a row.
struct Start {
  std::vector<double> x, y, zl, zu;
};

/// The last iterate and how it was reached.
struct Answer {
  Status status = Status::numerical_failure;
  std::string backend;
  std::string message;  ///< the back end's own words
  Fault fault;          ///< for invalid_number
  Start point;          ///< primal and dual
  double objective = 0;
  int iterations = 0;
  double cpu_s = 0, wall_s = 0;
};

/// A method that solves stage-structured programs. Not thread-safe; one a thread.
class Solver {
 public:
  virtual ~Solver() = default;
  /// `start` needs x, and for a warm start y, zl and zu too; throws InvalidValue for other sizes.
  [[nodiscard]] virtual Answer solve(Problem& problem, const Start& start,
                                     const Options& options) = 0;
};

/// Throws InvalidValue unless `start` has the sizes of `structure`; duals only where `with_duals`.
void check_sizes(const Start& start, const Structure& structure, bool with_duals);

/// Names of the back ends this build has.
std::vector<std::string> backends();
/// Throws InvalidValue for a back end this build lacks, naming those it has.
std::unique_ptr<Solver> make_solver(const std::string& backend = "");

}  // namespace slalom::nlp
