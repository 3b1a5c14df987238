#include "smooth_box.hpp"

#include <algorithm>
#include <numbers>

namespace slalom::bench {

using ocp::Expr;

namespace {

/// Smoothing for each metre that shapes may stick out by: at .2 m, .5 m, which is about .1 m at a
/// corner.
constexpr double kSmoothing = 2.5;

}  // namespace

SmoothBox::SmoothBox(const world::Footprint& footprint, double cover_excess)
    : middle_((footprint.corners()[0].x + footprint.corners()[1].x) / 2),
      half_length_((footprint.corners()[0].x - footprint.corners()[1].x) / 2),
      half_width_(footprint.corners()[0].y),
      smoothing_(kSmoothing * cover_excess) {}

Expr SmoothBox::square_of_distance(const Expr& dx, const Expr& dy, const Expr& psi) const {
  const Expr c = cos(psi), s = sin(psi);
  const auto beyond = [e = smoothing_](const Expr& z, double half) {
    const Expr q = sqrt(square(z) + e * e) - half;
    return (q + sqrt(square(q) + e * e)) / 2;
  };
  return square(beyond(c * dx + s * dy - middle_, half_length_)) +
         square(beyond(c * dy - s * dx, half_width_));
}

/// The most that the smooth distance is where the true one is `radius`: about a corner.
double SmoothBox::smooth_radius(double radius) const {
  constexpr int kParts = 32;
  const auto beyond = [e = smoothing_](double z, double half) {
    const double q = std::hypot(z, e) - half;
    return (q + std::hypot(q, e)) / 2;
  };
  double most = 0;
  for (int k = 0; k <= kParts; ++k) {
    const double angle = std::numbers::pi / 2 * k / kParts;
    most = std::max(most, std::hypot(beyond(half_length_ + radius * std::cos(angle), half_length_),
                                     beyond(half_width_ + radius * std::sin(angle), half_width_)));
  }
  return most;
}

}  // namespace slalom::bench
