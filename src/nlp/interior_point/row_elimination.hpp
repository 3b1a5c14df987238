#pragma once

#include <span>
#include <vector>

#include "barrier_terms.hpp"
#include "point.hpp"

namespace slalom::nlp::ipm {

/// Leaves the rows' slacks, and whatever else belongs to one row, out of the Newton system. What is
/// left of a row in the step (dx, dy) is
///
///   J dx - F dy = b,
///
/// F >= 0 what the row gives way by for a multiplier of 1. An equation stays in the condensed
/// system with that F; an inequality leaves it too, with weight 1 / F on J' J, as
/// y + dy = (y - b / F) + J dx / F.
class RowElimination {
 public:
  explicit RowElimination(const SlackForm& form);
  virtual ~RowElimination() = default;

  /// For a factorisation with these terms: weight(), give() and the curvature of what they belong
  /// to.
  virtual void weigh(const BarrierTerms& terms) = 0;
  std::span<const double> weight() const { return weight_; }  ///< by row; 0 of an equation
  std::span<const double> give() const { return give_; }      ///< by row; F of an equation
  /// Adds the diagonal second derivatives that the evaluation's Hessian lacks.
  virtual void add_curvature(std::span<double>) const {}

  /// For a step from a point with these row residuals: b of the equations, and the multipliers
  /// that the rows have at dx = 0, dy = 0 of the equations.
  virtual void shift(const BarrierTerms& terms, const Iterate& at,
                     std::span<const double> residuals) = 0;
  std::span<const double> right_hand_side() const { return b_; }
  std::span<const double> multipliers() const { return multipliers_; }

  /// Fills dy and what was left out of w from J dx and the equations' dy.
  virtual void recover(const BarrierTerms& terms, const Iterate& at,
                       std::span<const double> residuals, std::span<const double> jdx,
                       std::span<const double> equations_dy, Step& out) = 0;
  /// The same for a change of dx and the equations' dy, added to a step recovered before.
  void correct(const BarrierTerms& terms, std::span<const double> jdx,
               std::span<const double> equations_dy, Step& out);
  /// Adds to what is left of the equations what their own entries of the step bring to it.
  virtual void add_to_equations(const Step&, std::span<double>) const {}

 protected:
  void set_equations(std::span<const double> values, std::span<double> by_row) const;
  /// Adds to a step's slacks, and the like, what follows from changes of J dx and of y.
  virtual void move_slacks(const BarrierTerms& terms, std::span<const double> jdx,
                           std::span<const double> dy, Step& out) const = 0;

  std::vector<double> weight_, give_, b_, multipliers_;

 private:
  const SlackForm& form_;
  std::vector<double> dy_;
};

/// Rows with nothing but their slacks.
class SlackElimination final : public RowElimination {
 public:
  explicit SlackElimination(const SlackForm& form) : RowElimination(form), form_(form) {}
  void weigh(const BarrierTerms& terms) override;
  void shift(const BarrierTerms& terms, const Iterate& at,
             std::span<const double> residuals) override;
  void recover(const BarrierTerms& terms, const Iterate& at, std::span<const double> residuals,
               std::span<const double> jdx, std::span<const double> equations_dy,
               Step& out) override;

 private:
  void move_slacks(const BarrierTerms& terms, std::span<const double> jdx,
                   std::span<const double> dy, Step& out) const override;

  const SlackForm& form_;
};

}  // namespace slalom::nlp::ipm
