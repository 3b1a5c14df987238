#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "slalom/expr/expr.hpp"

namespace slalom::nlp {

/// Shape of a stage-structured nonlinear program
///
///   min f(x)   subject to   gl <= g(x) <= gu,   xl <= x <= xu
///
/// Every variable belongs to a stage or, with stage number `stages`, to all of them (final time,
/// static parameters, lifted copies); the latter is called global. Variables, rows and entries may
/// come in any order. Where one formula stands at many stages, its entries best follow each other
/// stage by stage, since solvers then run over them as over one vector.
struct Structure {
  /// Tells structures apart, so that a solver may keep its workspace from one solve to the next.
  /// Set it to next_id() once the structure no longer changes; with 0 no workspace is kept.
  std::uint64_t id = 0;
  std::size_t variables = 0;
  std::size_t rows = 0;
  std::size_t stages = 0;
  std::vector<std::uint32_t> variable_stage;
  /// Of each row: the first stage it touches; `stages` for one that spans many.
  std::vector<std::uint32_t> row_stage;
  std::vector<std::uint32_t> jacobian_row, jacobian_col;  ///< one for each entry, each place once
  std::vector<std::uint32_t> hessian_row, hessian_col;    ///< lower triangle, each place once
  std::vector<double> variable_scale;                     ///< user's value = scale * x
  std::vector<double> row_scale;                          ///< row here = scale * the user's row

  bool global(std::size_t variable) const { return variable_stage[variable] == stages; }
  static std::uint64_t next_id();
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

/// A problem's functions as expressions, for solvers that want formulas rather than numbers.
struct Formulas {
  std::vector<expr::Expr> variables;  ///< symbols, in the problem's order
  expr::Expr objective;
  std::vector<expr::Expr> rows;
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
  /// None from a problem that knows numbers alone.
  virtual std::optional<Formulas> formulas() const { return std::nullopt; }
};

}  // namespace slalom::nlp
