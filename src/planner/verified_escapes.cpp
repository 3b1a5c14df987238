// What a cycle tries where everything that it considered does harm soon: the hardest steering,
// braking and pushing that the vehicle can.

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "references.hpp"
#include "road_reference.hpp"
#include "slalom/vehicle/agility.hpp"
#include "verified_planner.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;

/// An escape is so many manoeuvres, each held for so long [s], in steps.
constexpr std::array kHeld = {0.2, 0.2, 0.3, 0.4};
constexpr double kStep = 0.05;
/// What does harm no sooner than this is no reason for one [s].
constexpr double kSoon = 2.5;
/// Of escapes that come so far, so many are driven on to a stop.
constexpr int kMost = 6;
/// Below this speed the vehicle brakes no harder than to it [m/s].
constexpr double kSlow = 0.5;
constexpr double kBraking = 3.4;  ///< of the stop that follows [m/s^2], of the HMMWV

}  // namespace

/// One look of an escape: the state and what may be held next.
struct VerifiedPlanner::Escape {
  Cycle& cycle;
  double turn = 1;     ///< the side that is tried first
  double edge = 0;     ///< kept from the road's edges [m]
  double outside = 0;  ///< the farthest that the footprint may be outside the region [m]
  int left = kMost;    ///< that may be driven on
  Motion motion{};
};

/// The state a step on, at full steering to a side and full braking or pushing, as far as limits
/// let it; appended to the motion. Whether it does no harm there.
bool VerifiedPlanner::step_on(Escape& escape, double steer, double push) const {
  const Parameters& p = task_.vehicle;
  const State& x = escape.motion.states.back();
  const auto [creep, spare, settling] = standing_of(p, task_.road != nullptr);
  const double sa = std::clamp(x[SA] + steer * p.sr_max() * kStep, -p.sa_max(), p.sa_max());
  double least = p.ax_min_at(x[UX]);
  if (x[UX] < kSlow) least = std::max(least, (p.ux_min + spare - x[UX]) * settling);
  const double ax = std::clamp(x[AX] + push * p.jx_max * kStep, least, p.ax_max_at(x[UX]));
  const Control u{(sa - x[SA]) / kStep, std::clamp((ax - x[AX]) / kStep, -p.jx_max, p.jx_max)};
  const double t = escape.motion.end() + kStep;
  escape.motion.controls.back() = u;
  escape.motion.add(t, plant_.advance(x, u, u, t - kStep, t), u);
  const State& next = escape.motion.states.back();
  const world::Footprint footprint(p);
  if (footprint.outside(task_.region, next) > escape.outside) return false;
  if (task_.road && footprint.edge_distance(*task_.road, next) < escape.edge) return false;
  return std::none_of(
      escape.cycle.obstacles.begin(), escape.cycle.obstacles.end(), [&](const auto& o) {
        return o.present(t, t) && footprint.distance(o, next, t) <= harmful_clearance();
      });
}

/// Holds each manoeuvre after those before, and where all is well drives on to a stop. Whether that
/// is good.
bool VerifiedPlanner::try_escapes(Escape& escape, std::size_t held) {
  if (escape.left <= 0 || escape.cycle.over()) return false;
  if (held == kHeld.size()) {
    --escape.left;
    const State& x = escape.motion.states.back();
    const double t = escape.motion.end(), can = agility(task_.vehicle).braking;
    Motion path = task_.road ? road_reference(*task_.road, x, t, x[UX] / can + 1, 0, task_.vehicle)
                             : straight_reference(x, t, 1);
    return stop_along(escape.cycle, {"escape", escape.motion, std::move(path)}, kBraking * can, {});
  }
  for (const double push : {-1., 0., 1.})
    for (const double side : {1., 0., -1.}) {
      const std::size_t size = escape.motion.size();
      bool goes_well = true;
      try {
        for (double after = 0; goes_well && after < kHeld[held] - kStep / 2; after += kStep)
          goes_well = step_on(escape, side * escape.turn, push);
      } catch (const PlantError&) {
        goes_well = false;
      }
      if (goes_well && try_escapes(escape, held + 1)) return true;
      while (escape.motion.size() > size) escape.motion.drop_last();
    }
  return false;
}

/// Escapes, where all that was refused does harm soon.
void VerifiedPlanner::escape(Cycle& cycle) {
  const State& X0p = cycle.request.X0p;
  const double t0 = cycle.t_start();
  for (Option& option : cycle.refused) {
    option.harm = harm_of(cycle, option.motion());
    if (*option.harm > t0 + kSoon) return;
  }
  const world::Footprint footprint(task_.vehicle);
  Escape escape{cycle};
  escape.outside = std::max(0., footprint.outside(task_.region, X0p));
  if (task_.road) {
    const world::OnRoad on = task_.road->project({X0p[X], X0p[Y]});
    const double ahead = task_.road->at(on.s + std::max(X0p[UX], 1.)).psi;
    escape.turn = std::sin(ahead - X0p[PSI]) < 0 ? -1 : 1;
    escape.edge = std::min(0., footprint.edge_distance(*task_.road, X0p));
  }
  escape.motion.add(t0, X0p, {});
  try_escapes(escape, 0);
}

}  // namespace slalom::planner
