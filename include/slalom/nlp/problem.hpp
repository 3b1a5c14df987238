#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace slalom::nlp {

/// Which variables a row touches besides the globals.
enum class Coupling {
  local,      ///< its own stage
  neighbour,  ///< its own stage and the next
  border,     ///< none, or stages that are no neighbours
};

/// Shape of a stage-structured nonlinear program
///
///   min f(x)   subject to   gl <= g(x) <= gu,   xl <= x <= xu
///
/// Variables come stage by stage; what all stages share (final time, static parameters, lifted
/// copies) comes last and is called global. Rows come stage by stage too, border rows last.
/// Derivatives are sparse with a fixed pattern; the order of entries keeps to the stages.
struct Structure {
  std::size_t variables = 0;
  std::size_t rows = 0;
  std::vector<std::size_t> stage_begin;  ///< first variable of each stage, then of the globals
  std::vector<std::size_t> row_stage;    ///< stage of each row (of the first, when coupling)
  std::vector<Coupling> coupling;        ///< one a row
  std::vector<std::size_t> jacobian_row_begin;        ///< compressed rows: rows + 1 offsets
  std::vector<std::size_t> jacobian_col;              ///< ascending within a row
  std::vector<std::size_t> hessian_row, hessian_col;  ///< lower triangle, sorted by row, then col
  std::vector<double> variable_scale;                 ///< user's value = scale * x
  std::vector<double> row_scale;                      ///< row here = scale * the user's row

  std::size_t stages() const { return stage_begin.empty() ? 0 : stage_begin.size() - 1; }
  std::size_t first_global() const { return stage_begin.back(); }
};

/// Bounds of variables and rows; infinite where absent, equal for fixed variables and equations.
struct Limits {
  std::vector<double> xl, xu, gl, gu;
};

/// What an evaluation fills; sizes follow Structure.
struct Evaluation {
  double objective = 0;
  std::vector<double> gradient;  ///< variables
  std::vector<double> rows;      ///< rows
  std::vector<double> jacobian;  ///< entries
  std::vector<double> hessian;   ///< entries, of sigma f + y' g
};

/// The parts of an Evaluation to fill.
struct Parts {
  bool values = false;       ///< objective and rows
  bool derivatives = false;  ///< gradient and Jacobian
  bool hessian = false;
};

/// Where a user's function gave NaN or infinity; empty function name: nowhere.
struct Fault {
  std::string function;  ///< e.g. "dynamics of v"
  std::string where;     ///< e.g. "node 3"
  std::string variable;  ///< of a derivative: by what; empty for a value
  explicit operator bool() const { return !function.empty(); }
};

/// The one seam between problems and solvers.
class Problem {
 public:
  virtual ~Problem() = default;
  virtual const Structure& structure() const = 0;
  virtual const Limits& limits() const = 0;
  /// Fills `parts` at x (and, for the Hessian, sigma and y). Returns the first fault met.
  virtual Fault evaluate(std::span<const double> x, double sigma, std::span<const double> y,
                         Parts parts, Evaluation& out) = 0;
  virtual std::string variable_name(std::size_t index) const = 0;
  virtual std::string row_name(std::size_t index) const = 0;
};

}  // namespace slalom::nlp
