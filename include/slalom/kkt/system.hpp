#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace slalom::kkt {

/// Shape of the symmetric system of an interior-point step on a stage-structured problem,
///
///   [ W + diag(d)    E'       ] [ dx ]   [ a ]
///   [ E             -diag(c)  ] [ dy ] = [ b ],
///
/// W the Hessian with all inequalities condensed onto it (CondensedHessian), E the equations' rows
/// of the Jacobian. A variable or equation belongs to a stage or, with stage number `stages`, to
/// the border. What couples stages that are no neighbours is carried along from the first of them
/// to the stage it belongs to: a final time of one phase best belongs to that phase's last stage,
/// and is carried through no other. Entries may come in any order, each place once.
struct Pattern {
  std::size_t variables = 0, equations = 0, stages = 0;
  std::vector<std::uint32_t> variable_stage, equation_stage;
  std::vector<char> fixed;  ///< variables that do not move: left out, dx = 0

  struct Place {
    std::uint32_t row, col;
    friend bool operator==(const Place&, const Place&) = default;
  };
  struct JacobianEntry {
    std::uint32_t source;  ///< where in Values::jacobian
    std::uint32_t equation, variable;
  };
  std::vector<Place> hessian;  ///< one triangle: each pair once
  std::vector<JacobianEntry> jacobian;
};

/// The numbers of one system.
struct Values {
  std::span<const double> hessian;      ///< W, one a place of Pattern::hessian
  std::span<const double> diagonal;     ///< d, one a variable
  std::span<const double> jacobian;     ///< E, read by JacobianEntry::source
  std::span<const double> flexibility;  ///< c >= 0, one an equation
  /// Only the inertia of a minimum is wanted: factorize may stop, with part of the inertia, once
  /// there are more negative pivots than equations, for what is left has as many at least as it has
  /// equations.
  bool minimum_only = false;
  /// Asked between fronts, some ten thousand multiplications apart; true ends the factorisation,
  /// with part of the inertia and nothing ready to be solved.
  bool (*stop)(void*) = nullptr;
  void* stop_data = nullptr;
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
  /// With zero pivots (a singular system) nothing is ready to be solved.
  [[nodiscard]] virtual Inertia factorize(const Values& values) = 0;
  /// Overwrites `rhs` (a, then b) by the solution (dx, then dy).
  virtual void solve(std::span<double> rhs) = 0;
  /// Asks for pivots chosen afresh at the next factorisation, from its numbers alone: for a new
  /// solve, or when the last solution was inaccurate.
  virtual void distrust() {}
};

/// Sequential elimination of the stages with pivoting inside each; what cannot be pivoted in its
/// stage passes on to the next, at last to the border. Cost linear in stages and entries. The order
/// of pivots is kept from one factorisation to the next for as long as every pivot stays stable.
std::unique_ptr<Backend> make_stage_ldlt(const Pattern& pattern);
/// The same pivoting over a forest of fronts in an order of least fill, blind to the stages: the
/// generic method beside it, for any sparse pattern. Values::minimum_only does not end it early.
std::unique_ptr<Backend> make_sparse_ldlt(const Pattern& pattern);

}  // namespace slalom::kkt
