#include "slalom/world/path_exists.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <queue>
#include <vector>

#include "cell_set.hpp"
#include "slalom/world/footprint.hpp"

namespace slalom::world {
namespace {

constexpr int kParts = 10;  ///< of a move, each checked: a metre at 25 m/s
/// Cells within which places count as one.
constexpr double kPlace = 1, kHeading = 0.1, kSpeed = 3, kCurvature = 0.013, kTime = 0.8;
/// How much more the way ahead counts than the way so far: a way is enough, it need not be the
/// shortest.
constexpr double kGreed = 2;

struct Place {
  double x = 0, y = 0, psi = 0, v = 0, kappa = 0, t = 0;
};

/// By how much discs may stick out of what they stand in for [m].
constexpr double kCoverExcess = 0.1;

/// Where a disc is at the parts of moves, and whether it is there.
struct Track {
  struct Moment {
    double x, y;
    bool there;
  };
  double radius;
  std::vector<Moment> moments;
};

/// A place to go on from; `rank` is the time it would bring us to the goal at, at best.
struct Open {
  double rank = 0;
  std::uint32_t order = 0;  ///< of two alike the older first: the same search everywhere
  Place at;
  bool operator<(const Open& other) const {
    return rank > other.rank || (rank == other.rank && order > other.order);
  }
};

class Search {
 public:
  Search(const Environment& environment, const vehicle::Parameters& vehicle,
         const PathSearch& search)
      : goal_(environment.goal),
        region_(environment.region),
        wheelbase_(vehicle.la + vehicle.lb),
        body_(Footprint(vehicle).covering_discs(kCoverExcess)),
        p_(search) {
    const double larger = p_.clearance + body_.front().radius;
    for (const auto& o : environment.obstacles) {
      if (o.is_plain()) {
        obstacles_.push_back(o.grown(larger));
        continue;
      }
      for (const auto& disc : covering_discs(o, kCoverExcess)) add_track(disc, disc.a + larger);
    }
  }

  bool run(const vehicle::State& X) {
    hold_discs(X);
    add({X[vehicle::X], X[vehicle::Y], X[vehicle::PSI],
         std::clamp(X[vehicle::UX], p_.v_min, p_.v_max), 0, 0});
    for (int looked_at = 0; !open_.empty() && looked_at < p_.max_places; ++looked_at) {
      const Place from = open_.top().at;
      open_.pop();
      if (arrived(from)) return true;
      for (const double turn : {0.0, -1.0, 1.0})
        for (const double push : {p_.acceleration, 0.0, -p_.braking})
          if (Place to; move(from, turn * p_.curvature_rate, push, to)) add(to);
    }
    return false;
  }

 private:
  bool arrived(const Place& p) const {
    vehicle::State state{};
    state[vehicle::X] = p.x;
    state[vehicle::Y] = p.y;
    state[vehicle::PSI] = p.psi;
    state[vehicle::UX] = p.v;
    return goal_.reached(state, p.t, nullptr);
  }
  /// The region for the centres of the body's discs. They stick out of the body: a start beside a
  /// side of the region may be as near to it as they are there.
  void hold_discs(const vehicle::State& X) {
    const double radius = body_.front().radius;
    region_ = {region_.x_min + radius, region_.x_max - radius, region_.y_min + radius,
               region_.y_max - radius};
    const double c = std::cos(X[vehicle::PSI]), s = std::sin(X[vehicle::PSI]);
    for (const Disc& disc : body_) {
      const double x = X[vehicle::X] + disc.ahead * c, y = X[vehicle::Y] + disc.ahead * s;
      region_ = {std::min(region_.x_min, x), std::max(region_.x_max, x), std::min(region_.y_min, y),
                 std::max(region_.y_max, y)};
    }
  }
  void add_track(const Obstacle& disc, double radius) {
    const double h = p_.dt / kParts;
    Track track{radius, {}};
    for (double k = 0; k * h <= p_.t_max + p_.dt; ++k)
      track.moments.push_back(
          {disc.x_at(k * h), disc.y_at(k * h), disc.present(k * h - h, k * h + h)});
    tracks_.push_back(std::move(track));
  }

  bool free(const Place& p) const {
    if (body_.size() == 1 && body_[0].ahead == 0) return free_disc(p.x, p.y, p.t);
    // The front wheels roll where the way leads; the body's axis is off that by their steering.
    const double psi = p.psi - wheelbase_ * p.kappa, c = std::cos(psi), s = std::sin(psi);
    return std::all_of(body_.begin(), body_.end(), [&](const Disc& disc) {
      return free_disc(p.x + disc.ahead * c, p.y + disc.ahead * s, p.t);
    });
  }
  bool free_disc(double x, double y, double t) const {
    return region_.contains(x, y) && clear(x, y, t);
  }

  bool clear(double x, double y, double t) const {
    const auto part = static_cast<std::size_t>(std::lround(t / p_.dt * kParts));
    return std::none_of(obstacles_.begin(), obstacles_.end(),
                        [&](const auto& o) {
                          const double dx = (x - o.x_at(t)) / o.a, dy = (y - o.y_at(t)) / o.b;
                          return dx * dx + dy * dy < 1;
                        }) &&
           std::none_of(tracks_.begin(), tracks_.end(), [&](const Track& track) {
             const auto& at = track.moments[std::min(part, track.moments.size() - 1)];
             return at.there && std::hypot(x - at.x, y - at.y) < track.radius;
           });
  }

  /// The place after dt; false where the vehicle cannot, or something is in the way.
  bool move(const Place& from, double kappa_rate, double push, Place& to) const {
    to = from;
    if (from.t >= p_.t_max) return false;
    const double h = p_.dt / kParts;
    // Speed and curvature do not depend on the place, and most moves fail by them: they come first.
    std::array<double, kParts> v, kappa;
    for (int part = 0; part < kParts; ++part) {
      v[part] = to.v = std::clamp(to.v + push * h, p_.v_min, p_.v_max);
      kappa[part] = to.kappa += kappa_rate * h;
    }
    const double most = std::min(p_.curvature, p_.lateral_acceleration / (to.v * to.v));
    if (std::fabs(to.kappa) > most) return false;
    for (int part = 0; part < kParts; ++part) {
      to.v = v[part];
      to.kappa = kappa[part];
      const double turned = to.v * to.kappa * h;
      to.x += to.v * h * std::cos(to.psi + turned / 2);
      to.y += to.v * h * std::sin(to.psi + turned / 2);
      to.psi += turned;
      to.t += h;
      if (!free(to)) return false;
    }
    return true;
  }

  void add(const Place& p) {
    std::uint64_t key = 1;  // no key is zero
    const auto mix = [&key](double value, double size, int bits) {
      const auto cell = static_cast<std::uint64_t>(std::llround(value / size));
      key = key << bits | (cell & ((1U << bits) - 1));
    };
    mix(p.x, kPlace, 14);
    mix(p.y, kPlace, 14);
    mix(p.psi, kHeading, 8);
    mix(p.v, kSpeed, 6);
    mix(p.kappa, kCurvature, 6);
    mix(p.t, kTime, 8);
    if (!seen_.insert(key)) return;
    const double left = std::max(0.0, std::hypot(p.x - goal_.x, p.y - goal_.y) - goal_.sigma);
    open_.push({p.t + kGreed * left / p_.v_max, static_cast<std::uint32_t>(seen_.size()), p});
  }

  const Goal goal_;
  Region region_;  ///< for the centres of the body's discs, once there is a start
  const double wheelbase_;
  const std::vector<Disc> body_;  ///< of one radius
  const PathSearch p_;
  std::vector<Obstacle> obstacles_;  ///< plain ones, grown
  std::vector<Track> tracks_;        ///< of the discs of others, grown
  std::priority_queue<Open> open_;
  CellSet seen_;
};

}  // namespace

bool path_exists(const Environment& environment, const vehicle::Parameters& vehicle,
                 const vehicle::State& start, const PathSearch& search) {
  return Search(environment, vehicle, search).run(start);
}

}  // namespace slalom::world
