#pragma once

#include <memory>
#include <span>
#include <vector>

#include "model.hpp"
#include "slalom/kkt/system.hpp"

namespace slalom::nlp::ipm {

/// Change of each part of an Iterate, and how far it may go.
struct Step : Iterate {
  StepReach reach;
};

/// What one iterate's Newton system is made of besides the functions' derivatives.
struct Local {
  std::vector<double> over_lower, over_upper;  ///< 1 / slack of each bound of w
  std::vector<double> sigma;                   ///< sum of z / slack
  std::vector<double> slope;                   ///< gradient of the barrier term
  std::vector<double> residuals;               ///< of the rows
  double violation = 0;                        ///< their 1-norm

  void resize(const Model& model);
  BoundedVector bounded(const Model& model, const Iterate& at) const;
};

/// Tells a long factorisation when to give up.
class Deadline {
 public:
  virtual ~Deadline() = default;
  virtual bool passed() = 0;
};

/// The Newton step of the primal-dual equations (Waechter & Biegler 2006, eq. 9 to 13), bound
/// multipliers, inequalities and elastic parts eliminated row by row, the rest by the
/// stage-structured factorisation.
class Newton {
 public:
  explicit Newton(Model& model);
  /// For a new solve, which is to depend on nothing from before.
  void restart() {
    last_delta_w_ = 0;
    backend_->distrust();
  }

  /// Asked during factorisations from now on; outlives this.
  void give_up_at(Deadline* deadline) { deadline_ = deadline; }
  /// Whether the last factorisation gave up.
  bool gave_up() const { return gave_up_; }

  /// Factorises at an iterate, with the least regularisation that gives the right inertia
  /// (Algorithm IC). False when none up to the limit does, or when it gave up.
  [[nodiscard]] bool factorize(const Evaluation& e, const Local& local, double mu);
  /// The same with the rows regularised from the start: when the last step was not accurate, for
  /// then rows depend on each other though no pivot vanished (section 3.1).
  [[nodiscard]] bool factorize_as_singular(const Evaluation& e, const Local& local, double mu);
  /// Whether refinement brought the last step's residual down.
  bool accurate() const { return accurate_; }
  /// The full step at the factorised iterate. False when it is not finite.
  [[nodiscard]] bool step(const Evaluation& e, const Local& local, const Iterate& at, double mu,
                          Step& out);
  /// The same with other row residuals: for second-order corrections.
  [[nodiscard]] bool step_for(const Evaluation& e, const Local& local, const Iterate& at, double mu,
                              std::span<const double> residuals, Step& out);

  /// Multipliers y, into out.y, that leave the least |grad f + J' y - zl + zu| over variables and
  /// slacks (section 3.6). False when their equations are singular.
  [[nodiscard]] bool fit_multipliers(const Evaluation& e, const Iterate& at, Step& out);

  double regularisation() const { return delta_w_; }
  double row_regularisation() const { return delta_c_; }
  const kkt::Backend& backend() const { return *backend_; }

 private:
  static double row_regularisation(double mu);
  static bool deadline_passed(void* self);
  [[nodiscard]] bool find_regularisation(const Evaluation& e, const Local& local, double mu);
  void weigh(const Local& local);
  void shift(const Local& local, const Iterate& at, std::span<const double> residuals);
  void recover(const Evaluation& e, const Local& local, const Iterate& at,
               std::span<const double> residuals, Step& out);
  double unsolved(const Evaluation& e, const Local& local, const Iterate& at,
                  std::span<const double> residuals, const Step& out);
  void add_correction(const Evaluation& e, const Local& local, Step& out);

  Model& model_;
  std::unique_ptr<kkt::Backend> backend_;
  kkt::Inertia wanted_;
  double delta_w_ = 0, delta_c_ = 0, last_delta_w_ = 0;
  bool accurate_ = true, gave_up_ = false;
  Deadline* deadline_ = nullptr;
  std::vector<double> sigma_x_;      ///< diagonal added to W
  std::vector<double> weight_;       ///< by row: what condenses an inequality; 0 of an equation
  std::vector<double> give_;         ///< by row: what elastic parts give way for a multiplier of 1
  std::vector<double> flexibility_;  ///< by equation
  std::vector<double> hessian_;      ///< condensed
  std::vector<double> no_hessian_;   ///< zeros
  std::vector<double> row_rhs_, multipliers_, products_;  ///< by row
  std::vector<double> force_;                             ///< by variable
  std::vector<double> rhs_, solution_;                    ///< of the condensed system
};

}  // namespace slalom::nlp::ipm
