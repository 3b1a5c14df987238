#include "slalom/vehicle/agility.hpp"

#include <algorithm>
#include <cmath>

#include "slalom/vehicle/derived.hpp"

namespace slalom::vehicle {

double most_lateral(const Parameters& p) {
  const auto lifts = [&](double load, double transfer) {
    return transfer > 0 ? (load / 2 - p.Fz_min) / transfer : HUGE_VAL;
  };
  return std::max(0., std::min({p.PDY1 * kGravity, lifts(p.FzF0, p.KZYF), lifts(p.FzR0, p.KZYR)}));
}

namespace {

Agility absolute(const Parameters& p) {
  return {-p.ax_min_at(0), most_lateral(p), std::tan(p.sa_max()) / (p.la + p.lb),
          p.sr_max() / (p.la + p.lb)};
}

/// Steps over speed and over load in which a greatest value is looked for.
constexpr int kSteps = 100;

/// Largest |ax| at any speed [m/s^2].
double most_along(const Parameters& p) {
  double most = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const double ux = p.ux_min + (p.ux_max - p.ux_min) * i / kSteps;
    most = std::max({most, std::fabs(p.ax_min_at(ux)), std::fabs(p.ax_max_at(ux))});
  }
  return most;
}

/// Greatest lateral force [N] of an axle at loads up to `most` [N]: of the tyre formula (section 2
/// of docs/formulation.md) the peak D, with what shifts it.
double most_force(const Parameters& p, double most, double offset) {
  double force = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const double Fz = most * i / kSteps, beyond = Fz / p.FZ0 - 1;
    const double shift = p.tyre_asymmetry ? (p.PVY1 + p.PVY2 * beyond) * Fz + offset : 0;
    force = std::max(force, std::fabs((p.PDY1 + p.PDY2 * beyond) * Fz) + std::fabs(shift));
  }
  return force;
}

}  // namespace

Quickness quickness(const Parameters& p) {
  const double along = most_along(p);
  // Load moves with ax - v r (section 2), of which yawing gives no more than driving.
  const double moved = p.KZX * 2 * along;
  const double front = most_force(p, p.FzF0 + moved, p.F_offset_front);
  const double rear = most_force(p, p.FzR0 + moved, p.F_offset_rear);
  return {along,
          front * (1 / p.m + p.la * p.la / p.Izz) + rear * std::fabs(1 / p.m - p.la * p.lb / p.Izz),
          (p.la * front + p.lb * rear) / p.Izz};
}

Agility agility(const Parameters& parameters) {
  const Agility its = absolute(parameters), hmmwv = absolute(Parameters{});
  return {its.braking / hmmwv.braking, its.lateral / hmmwv.lateral, its.curvature / hmmwv.curvature,
          its.curvature_rate / hmmwv.curvature_rate};
}

}  // namespace slalom::vehicle
