#pragma once

#include <vector>

#include "point.hpp"

namespace slalom::nlp::ipm {

/// Residuals of the primal-dual equations at a point (Waechter & Biegler 2006, eq. 4).
struct Survey {
  double dual = 0;       ///< largest |gradient of the Lagrangian|
  double primal = 0;     ///< largest |row residual|
  bool bounded = false;  ///< there are bounds, and so products of slack and multiplier:
  double bounds = 0;     ///< how many
  double least_product = 0, most_product = 0, mean_product = 0;
  double dual_scale = 1, product_scale = 1;  ///< s_d, s_c of eq. 5

  /// Largest |slack * multiplier - mu|.
  double complementarity(double mu) const;
  /// Largest |slack * multiplier / mu - 1|.
  double off_centre(double mu) const { return complementarity(mu) / mu; }
  /// Optimality error at mu with the multipliers' size divided out (eq. 5).
  double error(double mu) const;
};

/// Takes the survey of points of one form.
class Surveyor {
 public:
  explicit Surveyor(const SlackForm& form);
  /// Of a point that is complete.
  Survey operator()(const Point& point);
  /// Largest |gradient of the Lagrangian| by a variable at the point of the last survey, in the
  /// user's unit of that variable.
  double dual_in_users_units() const;

 private:
  const SlackForm& form_;
  std::vector<double> gradient_;  ///< of the Lagrangian, by entry of w
};

}  // namespace slalom::nlp::ipm
