#pragma once

#include <memory>
#include <vector>

#include "model.hpp"
#include "slalom/kkt/system.hpp"

namespace slalom::nlp::ipm {

/// Change of each part of an Iterate.
using Step = Iterate;

/// The Newton step of the primal-dual equations (Waechter & Biegler 2006, eq. 9 to 13), bound
/// multipliers and slacks eliminated row by row, the rest by the stage-structured factorisation.
class Newton {
 public:
  explicit Newton(Model& model);

  /// Factorises at an iterate, with the least regularisation that gives the right inertia
  /// (Algorithm IC). False when none up to the limit does.
  [[nodiscard]] bool factorize(const Evaluation& e, const Iterate& at, double mu);
  /// The full step at the factorised iterate.
  void step(const Evaluation& e, const Iterate& at, double mu, Step& out);
  /// The same with other row residuals: for second-order corrections.
  void step_for(const Evaluation& e, const Iterate& at, double mu,
                const std::vector<double>& row_residuals, Step& out);

  double regularisation() const { return delta_w_; }
  double row_regularisation() const { return delta_c_; }
  const kkt::Backend& backend() const { return *backend_; }

 private:
  [[nodiscard]] kkt::Inertia try_factorize(const Evaluation& e);
  void reduce_and_solve(const Evaluation& e, Step& out);
  void refine(const Evaluation& e, Step& out);
  double flexibility(std::size_t r) const;
  void dual_steps(const Iterate& at, double mu, Step& out) const;

  Model& model_;
  const Limits& limits_;
  std::unique_ptr<kkt::Backend> backend_;
  kkt::Inertia wanted_;
  double delta_w_ = 0, delta_c_ = 0, last_delta_w_ = 0;
  std::vector<double> sigma_x_, sigma_s_;  ///< z / slack of variables, of row slacks
  std::vector<double> diagonal_, row_diagonal_;
  std::vector<double> r_x_, r_row_, r_s_;              ///< right-hand sides of the three equations
  std::vector<double> sigma_p_, sigma_n_, r_p_, r_n_;  ///< of the elastic parts
  std::vector<double> a_, b_;
  Step correction_;
};

}  // namespace slalom::nlp::ipm
