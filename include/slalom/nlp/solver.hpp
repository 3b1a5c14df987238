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

/// How the barrier parameter falls where there is no floor.
enum class BarrierRule { monotone, adaptive };

/// One iteration, for logs and callbacks.
struct IterationInfo {
  int iteration = 0;
  bool restoration = false;  ///< of the feasibility restoration phase
  double objective = 0;
  double violation = 0;  ///< largest residual of a row
  double dual = 0;       ///< largest |gradient of the Lagrangian|
  double mu = 0;
  double step = 0;                  ///< largest |change of a variable or slack|
  double delta_w = 0, delta_c = 0;  ///< regularisation of the Hessian and of the rows
  double alpha_primal = 0, alpha_dual = 0;
  int trials = 0;  ///< of the line search
};

struct Options {
  /// Barrier floor mu [objective's units]: the solve ends at the central point of mu. 0: none.
  double floor = 0;
  double tol = 1e-8;             ///< scaled optimality tolerance without a floor
  double dual_tol = 1e-3;        ///< at a floor: gradient of the Lagrangian [objective's units]
  double constraint_tol = 1e-6;  ///< at a floor: rows and defects [their units]
  double floor_tol = 0.01;       ///< at a floor: |s z / mu - 1|
  int max_iterations = 500;
  /// Deadline: this thread's processor time [s], without callbacks. interior_point starts a step
  /// only if one as long as its longest so far would still end in time.
  double time_limit = std::numeric_limits<double>::infinity();
  bool warm_start = false;                           ///< the start's multipliers are used
  BarrierRule barrier_rule = BarrierRule::adaptive;  ///< of interior_point, without a floor
  int print_level = 0;              ///< of the back end's own log, on standard output
  std::string nl_solver = "ipopt";  ///< of nl: the executable that reads the .nl file
  std::string nl_options = "";      ///< of nl: words for its command line
  bool (*stop)(void*) = nullptr;    ///< polled each iteration; true ends the solve
  void* stop_data = nullptr;
  void (*on_iteration)(const IterationInfo&, void*) = nullptr;  ///< called after each iteration
  void* on_iteration_data = nullptr;
};

/// The registered options of Options with unit, range, meaning and reason.
const OptionTable<Options>& solver_options();

/// Throws InvalidValue, naming `where`, when a value is outside its registered range or not finite
/// (time_limit may be infinite). Every solve checks its options so.
void check(const Options& options, const std::string& where);

/// A primal and, for a warm start, dual point. Sign convention: the Lagrangian is
/// f + y' g - zl' (x - xl) + zu' (x - xu), so zl, zu >= 0 and y >= 0 at an upper bound of a row.
struct Start {
  std::vector<double> x, y, zl, zu;
};

/// A point and how it was reached. It is the solution where solved. Otherwise, interior_point gives
/// the best point it met: the one with the least barrier function among those that meet the rows to
/// constraint_tol, or if none does, the one with the least violation. Other back ends give the
/// last.
struct Answer {
  Status status = Status::numerical_failure;
  std::string backend;
  std::string message;  ///< the reason in words
  Fault fault;          ///< for invalid_number
  /// Primal and dual. Of interior_point's `infeasible` without a floor, the multipliers are those
  /// of the sum of the rows' violations (scaled), relative to that sum: 1 / multiplier is how far a
  /// bound must move for it to vanish, to first order.
  Start point;
  double objective = 0;
  double violation = 0;       ///< largest, of a row at the point, in the user's unit
  std::size_t worst_row = 0;  ///< its row, see Problem::row_name; meaningless for violation 0
  int iterations = 0;
  double cpu_s = 0, wall_s = 0;  ///< of this thread, and by the clock
  double callback_s = 0;         ///< thread time in callbacks, not counted against the deadline
  double longest_step_s = 0;     ///< thread time of the longest iteration (interior_point)
};

/// A method that solves stage-structured programs. Not thread-safe; use one for each thread.
class Solver {
 public:
  virtual ~Solver() = default;
  /// `start` needs x, and for a warm start y, zl and zu too; throws InvalidValue for wrong sizes.
  /// Reuses the memory of `answer`: interior_point allocates nothing when the last solve had a
  /// problem of the same structure (Structure::id).
  virtual void solve(Problem& problem, const Start& start, const Options& options,
                     Answer& answer) = 0;
  [[nodiscard]] Answer solve(Problem& problem, const Start& start, const Options& options) {
    Answer answer;
    solve(problem, start, options, answer);
    return answer;
  }
};

/// Throws InvalidValue unless `start` has the sizes of `structure`; duals only where `with_duals`.
void check_sizes(const Start& start, const Structure& structure, bool with_duals);

/// Names of the back ends there are: those of this build, and ipopt where Ipopt's library can be
/// loaded (libipopt.so.1 or .3, or what $SLALOM_IPOPT names). A further one, nl, is not among them:
/// it runs any solver that reads AMPL's .nl files, if the machine has one (Options::nl_solver).
std::vector<std::string> backends();
/// A solver by its back end's name; without one, interior_point. Throws InvalidValue for a back end
/// that is not there, saying what is.
std::unique_ptr<Solver> make_solver(const std::string& backend = "");

}  // namespace slalom::nlp
