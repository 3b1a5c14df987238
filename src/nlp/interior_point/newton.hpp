#pragma once

#include <memory>
#include <span>
#include <vector>

#include "barrier_terms.hpp"
#include "point.hpp"
#include "row_elimination.hpp"
#include "slalom/kkt/system.hpp"

namespace slalom::nlp::ipm {

/// Tells a long factorisation when to give up.
class Deadline {
 public:
  virtual ~Deadline() = default;
  virtual bool passed() = 0;
};

/// The Newton step of the primal-dual equations (Waechter & Biegler 2006, eq. 9 to 13): multipliers
/// of bounds are eliminated entry by entry and what belongs to one row by RowElimination; the rest,
/// dx and the equations' dy, is the condensed system, solved by the stage-structured factorisation.
class Newton {
 public:
  explicit Newton(const SlackForm& form);
  /// For a new solve, which is to depend on nothing from before.
  void restart();

  /// Asked during factorisations from now on; outlives this.
  void give_up_at(Deadline* deadline) { deadline_ = deadline; }
  /// Whether the last factorisation gave up.
  bool gave_up() const { return gave_up_; }

  /// Factorises at a point (complete), with the least regularisation that gives the right inertia
  /// (Algorithm IC). False when none up to the limit does, or when it gave up.
  [[nodiscard]] bool factorize(const Point& point, const BarrierTerms& terms);
  /// The same with the rows regularised from the start: when the last step was not accurate, for
  /// then rows depend on each other though no pivot vanished (section 3.1).
  [[nodiscard]] bool factorize_as_singular(const Point& point, const BarrierTerms& terms);
  /// The full step at the factorised point. False when it is not finite.
  [[nodiscard]] bool step(const Point& point, const BarrierTerms& terms, Step& out);
  /// The same with other row residuals: for second-order corrections.
  [[nodiscard]] bool step_for(const Point& point, const BarrierTerms& terms,
                              std::span<const double> residuals, Step& out);
  /// Whether refinement brought the last step's residual down.
  bool accurate() const { return accurate_; }

  double regularisation() const { return delta_w_; }
  double row_regularisation() const { return delta_c_; }
  kkt::Backend& backend() { return *backend_; }
  const kkt::Backend& backend() const { return *backend_; }

 private:
  static double row_regularisation(double mu);
  static bool deadline_passed(void* self);
  [[nodiscard]] bool find_regularisation(const Point& point, const BarrierTerms& terms);
  kkt::Inertia attempt(const Point& point, const BarrierTerms& terms);
  double set_right_hand_side(const Point& point, const BarrierTerms& terms,
                             std::span<const double> residuals);
  void solve(const std::vector<double>& rhs, std::vector<double>& solution);
  void recover(const Point& point, const BarrierTerms& terms, std::span<const double> residuals,
               Step& out);
  double refine(const Point& point, const BarrierTerms& terms, std::span<const double> residuals,
                double size, Step& out);
  double find_remainder(const Point& point, const BarrierTerms& terms,
                        std::span<const double> residuals, const Step& out);
  void add_correction(const Point& point, const BarrierTerms& terms, Step& out);
  std::span<const double> primal_part(const std::vector<double>& condensed) const;
  std::span<const double> equations_part(const std::vector<double>& condensed) const;

  const SlackForm& form_;
  std::unique_ptr<RowElimination> elimination_;
  std::unique_ptr<kkt::Backend> backend_;
  const kkt::Inertia wanted_;
  double delta_w_ = 0, delta_c_ = 0, last_delta_w_ = 0;
  bool accurate_ = true, gave_up_ = false;
  Deadline* deadline_ = nullptr;
  std::vector<double> hessian_;      ///< with the inequalities condensed onto it
  std::vector<double> diagonal_;     ///< by variable: added to it
  std::vector<double> flexibility_;  ///< by equation
  /// Of the condensed system, dx first and then the equations' dy: what it is solved for, its
  /// solution, what that leaves of the unreduced equations, and what corrects it.
  std::vector<double> rhs_, solution_, remainder_, correction_;
  std::vector<double> jdx_, corrected_jdx_;  ///< by row: J dx of the step, of the correction
  std::vector<double> next_y_;               ///< by row: y + dy
  std::vector<double> force_;                ///< by variable: of multipliers, J' y
};

/// Inertia of a condensed system whose Newton step leads to a minimum.
kkt::Inertia inertia_of_minimum(const SlackForm& form);

}  // namespace slalom::nlp::ipm
