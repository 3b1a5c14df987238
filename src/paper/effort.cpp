// Control effort along a drive. The samples' values are linear between samples (controls are, and
// the steering angle is the integral of one: its deviation from linear over .02 s is below 1e-5),
// and for linear f from f0 to f1 over h: int f^2 = h/3 (f0^2 + f0 f1 + f1^2), which is exact.
#include "reproduction.hpp"

namespace slalom::paper {
namespace {

double squared(double h, double f0, double f1) {
  return h / 3 * (f0 * f0 + f0 * f1 + f1 * f1);
}

/// Integrals of sa^2, sr^2 and jx^2, each times its weight.
ControlEffort effort(const sim::Drive& drive, double w_sa, double w_sr, double w_jx) {
  ControlEffort sum;
  for (std::size_t i = 1; i < drive.plant.size(); ++i) {
    const auto& a = drive.plant[i - 1];
    const auto& b = drive.plant[i];
    const double h = b.t - a.t;
    sum.steering_angle += w_sa * squared(h, a.state[vehicle::SA], b.state[vehicle::SA]);
    sum.steering_rate += w_sr * squared(h, a.control[vehicle::SR], b.control[vehicle::SR]);
    sum.jerk += w_jx * squared(h, a.control[vehicle::JX], b.control[vehicle::JX]);
  }
  return sum;
}

}  // namespace

ControlEffort effort_paper(const sim::Drive& drive) {
  return effort(drive, 0.1, 0.1, 0.1);
}

ControlEffort effort_weighted(const sim::Drive& drive, const planner::Settings& settings) {
  return effort(drive, settings.w_sa, settings.w_sr, settings.w_jx);
}

}  // namespace slalom::paper
