#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace slalom::kkt {

/// Shape of the symmetric system of an interior-point step on a stage-structured problem,
///
///   [ W + diag(d) + Ji' diag(w) Ji    Je'        ] [ dx ]   [ a ]
///   [ Je                             -diag(c)    ] [ dy ] = [ b ]
///
/// with Je the equations' rows of the Jacobian and Ji the inequalities', condensed onto the
/// variables. Variables come stage by stage, globals last; a row touches its own stage, the next
/// one and the globals, unless it is a border row, which may touch anything.
struct Pattern {
  std::vector<std::size_t> stage_begin;  ///< first variable of each stage, then of the globals
  std::size_t variables = 0;
  std::vector<char> fixed;     ///< variables that do not move: left out, dx = 0
  std::vector<char> equation;  ///< one a row: keeps a multiplier in the system
  std::vector<std::size_t> row_stage;
  std::vector<char> border;            ///< one a row
  std::vector<std::size_t> row_begin;  ///< compressed rows of the Jacobian
  std::vector<std::size_t> col;
  std::vector<std::size_t> hessian_row, hessian_col;  ///< lower triangle of W

  std::size_t rows() const { return equation.size(); }
  std::size_t stages() const { return stage_begin.size() - 1; }
};

/// The numbers of one system; sizes follow Pattern.
struct Values {
  std::span<const double> hessian;
  std::span<const double> diagonal;  ///< d, by variable
  std::span<const double> jacobian;
  std::span<const double> row_diagonal;  ///< by row: c >= 0 of an equation, w >= 0 otherwise
};

/// Signs of the pivots. A regular step on a minimum has as many positive as free variables and as
/// many negative as equations.
struct Inertia {
  std::size_t positive = 0, negative = 0, zero = 0;
  friend bool operator==(const Inertia&, const Inertia&) = default;
};

/// A way to factorise such systems. Memory is taken at construction; factorize and solve take none.
class Backend {
 public:
  virtual ~Backend() = default;
  virtual std::string name() const = 0;
  [[nodiscard]] virtual Inertia factorize(const Values& values) = 0;
  /// Overwrites a and b by dx and dy. b has one entry a row; those of inequalities are not touched.
  virtual void solve(std::span<double> a, std::span<double> b) const = 0;
};

/// Sequential elimination of the stages with pivoting inside each; what cannot be pivoted in its
/// stage passes on to the next, at last to the border. Cost linear in stages and rows.
std::unique_ptr<Backend> make_stage_ldlt(const Pattern& pattern);
/// One dense matrix with the same pivoting, blind to the structure: the reference in tests.
std::unique_ptr<Backend> make_dense_ldlt(const Pattern& pattern);

}  // namespace slalom::kkt
