// Where a search that looks for a place to stand ends.

#include <algorithm>
#include <cmath>

#include "place_search.hpp"

namespace slalom::world {
namespace {

constexpr double kSpeedRounding = 1e-3;  ///< of a place's speed [m/s]
/// Whether a place leads on is seen by the way left from so far ahead of it [m].
constexpr double kFurther = 10;
/// Standing, the vehicle keeps so much more from all, for it comes to stand a little aside [m].
constexpr double kAside = 0.25;

}  // namespace

/// Whether the vehicle is as slow as it gets, and creeping straight on from here stays where it may
/// be, clear of all obstacles.
bool PlaceSearch::stands(const Place& place) const {
  if (static_cast<double>(place.v) > p_.v_min + kSpeedRounding) return false;
  const auto heading = static_cast<double>(place.heading);
  const Motion at = {static_cast<double>(place.x),
                     static_cast<double>(place.y),
                     std::cos(heading),
                     std::sin(heading),
                     heading,
                     standing_->creep,
                     0};
  const double crept = standing_->stopping + standing_->creep * standing_->horizon;
  for (const double ahead : ahead_)
    if (const double x = at.x + (ahead + crept) * at.c, y = at.y + (ahead + crept) * at.s;
        !region_.contains(x - kAside, y - kAside) || !region_.contains(x + kAside, y + kAside) ||
        !on_road(x, y))
      return false;
  Place further = place;
  further.x = static_cast<float>(at.x + kFurther * at.c);
  further.y = static_cast<float>(at.y + kFurther * at.s);
  if (way_left(place) - way_left(further) < standing_->onwards * kFurther) return false;
  return std::all_of(obstacles_.begin(), obstacles_.end(),
                     [&](const Ellipse& o) { return stands_clear(place, at, o); });
}

/// Whether an obstacle never comes to where the vehicle creeps on.
bool PlaceSearch::stands_clear(const Place& place, const Motion& at, const Ellipse& o) const {
  // At its nearest while it goes straight from a place, for so long.
  const auto clear = [&](double x, double y, double vx, double vy, double larger, double crept,
                         double during) {
    const double a = o.a + larger + kAside, b = o.b + larger + kAside;
    const double ux = (vx - at.v * at.c) / a, uy = (vy - at.v * at.s) / b;
    return std::all_of(ahead_.begin(), ahead_.end(), [&](double ahead) {
      const double dx = (x - at.x - (ahead + crept) * at.c) / a;
      const double dy = (y - at.y - (ahead + crept) * at.s) / b;
      const double square = ux * ux + uy * uy;
      const double when = square > 0 ? std::clamp(-(dx * ux + dy * uy) / square, 0., during) : 0;
      return std::hypot(dx + when * ux, dy + when * uy) >= 1;
    });
  };
  const double t = place.moves * p_.dt;
  if (o.moments < 0)
    return clear(o.x + o.vx * t, o.y + o.vy * t, o.vx, o.vy, 0, 0, standing_->horizon);
  const auto last = static_cast<int>(moments(p_)) - 1;
  for (int k = place.moves; k < last && (k - place.moves) * p_.dt < standing_->horizon; ++k) {
    const Moment& now = moments_[static_cast<std::size_t>(o.moments + k)];
    const Moment& then = moments_[static_cast<std::size_t>(o.moments + k + 1)];
    if (now.there && !clear(now.x, now.y, (then.x - now.x) / p_.dt, (then.y - now.y) / p_.dt,
                            then.larger, at.v * (k - place.moves) * p_.dt, p_.dt))
      return false;
  }
  return true;
}

}  // namespace slalom::world
