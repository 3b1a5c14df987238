#include "smooth_box.hpp"

#include <algorithm>
#include <numbers>

namespace slalom::planner {

using ocp::Expr;

SmoothBox::SmoothBox(const world::Footprint& footprint)
    : middle_((footprint.corners()[0].x + footprint.corners()[1].x) / 2),
      half_length_((footprint.corners()[0].x - footprint.corners()[1].x) / 2),
      half_width_(footprint.corners()[0].y) {}

Expr SmoothBox::square_of_distance(const Expr& dx, const Expr& dy, const Expr& psi) const {
  const Expr c = cos(psi), s = sin(psi);
  const auto beyond = [](const Expr& z, double half) {
    const Expr q = sqrt(square(z) + kSmoothing * kSmoothing) - half;
    return (q + sqrt(square(q) + kSmoothing * kSmoothing)) / 2;
  };
  return square(beyond(c * dx + s * dy - middle_, half_length_)) +
         square(beyond(c * dy - s * dx, half_width_));
}

/// The most that the smooth distance is where the true one is `radius`: about a corner.
double SmoothBox::smooth_radius(double radius) const {
  constexpr int kParts = 32;
  const auto beyond = [](double z, double half) {
    const double q = std::hypot(z, kSmoothing) - half;
    return (q + std::hypot(q, kSmoothing)) / 2;
  };
  double most = 0;
  for (int k = 0; k <= kParts; ++k) {
    const double angle = std::numbers::pi / 2 * k / kParts;
    most = std::max(most, std::hypot(beyond(half_length_ + radius * std::cos(angle), half_length_),
                                     beyond(half_width_ + radius * std::sin(angle), half_width_)));
  }
  return most;
}

}  // namespace slalom::planner
