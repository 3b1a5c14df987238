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

}  // namespace

Agility agility(const Parameters& parameters) {
  const Agility its = absolute(parameters), hmmwv = absolute(Parameters{});
  return {its.braking / hmmwv.braking, its.lateral / hmmwv.lateral, its.curvature / hmmwv.curvature,
          its.curvature_rate / hmmwv.curvature_rate};
}

}  // namespace slalom::vehicle
