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
/// where W is the Hessian with all inequalities condensed onto it (CondensedHessian), and E holds
/// the equations' rows of the Jacobian. A variable or equation belongs to a stage or, with stage
/// number `stages`, to the border. If it couples stages that are not neighbours, it is carried
/// along from the first of them to the stage it belongs to. A phase's final time, for example, best
/// belongs to that phase's last stage, so that it is not carried through other phases. Entries may
/// come in any order, each place once.
struct Pattern {
  std::size_t variables = 0, equations = 0, stages = 0;
  std::vector<std::uint32_t> variable_stage, equation_stage;
  std::vector<char> fixed;  ///< variables that do not move: they are left out, dx = 0

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
  std::span<const double> hessian;      ///< W, one for each place of Pattern::hessian
  std::span<const double> diagonal;     ///< d, one for each variable
  std::span<const double> jacobian;     ///< E, read by JacobianEntry::source
  std::span<const double> flexibility;  ///< c >= 0, one for each equation
  /// The caller wants the factors only if the inertia is that of a minimum. Then factorize may
  /// stop, with part of the inertia, once negative pivots outnumber the equations met so far:
  /// the rest has at least one negative pivot for each of those that meet nothing eliminated.
  bool minimum_only = false;
  /// Asked between fronts, about every ten thousand multiplications; true ends the factorisation,
  /// with part of the inertia, and solve may not be called.
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
  /// With zero pivots (a singular system) solve may not be called.
  [[nodiscard]] virtual Inertia factorize(const Values& values) = 0;
  /// Overwrites `rhs` (a, then b) with the solution (dx, then dy).
  virtual void solve(std::span<double> rhs) = 0;
  /// The next factorisation chooses its pivots afresh, from its numbers alone. For a new solve, or
  /// when the last solution was inaccurate.
  virtual void distrust() {}
};

/// Eliminates the stages one after the other, with pivoting inside each. What cannot be pivoted in
/// its stage passes on to the next, and at last to the border. The cost is linear in stages and
/// entries. The order of pivots is kept from one factorisation to the next while every pivot stays
/// stable.
std::unique_ptr<Backend> make_stage_ldlt(const Pattern& pattern);
/// The same pivoting over a forest of fronts in an order of least fill, which ignores the stages.
/// It is the generic counterpart, for any sparse pattern. Values::minimum_only does not end it
/// early.
std::unique_ptr<Backend> make_sparse_ldlt(const Pattern& pattern);

}  // namespace slalom::kkt
