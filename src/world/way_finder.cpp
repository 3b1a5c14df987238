#include "slalom/world/way_finder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "distance_field.hpp"

namespace slalom::world {
namespace {

constexpr double kMove = 0.4;  ///< [s]
constexpr int kParts = 10;     ///< of a move, each checked
constexpr int kPoints = 8;     ///< of a way in each move
/// Cells within which places count as one: along and across the goal's direction [m], heading
/// [rad], speed [m/s], share of the most curvature, time [s].
constexpr double kAlong = 2, kAcross = 1, kHeading = 0.04, kSpeed = 3, kCurvature = 0.4,
                 kTime = 0.8;
/// A way ends this deep within the goal's square, in half-widths.
constexpr double kDeep = 0.4;
/// Kept from the region's sides [m].
constexpr double kInset = 0.5;
/// Below this speed curvature is not that of the yaw rate [m/s].
constexpr double kSlow = 1;
constexpr int kPoll = 256;

constexpr std::array kTurns = {0., -1., 1., -0.4, 0.4};

struct Place {
  float x, y, heading, v, kappa, t, a;
  std::int32_t parent;
};

/// By rank, then age.
struct Open {
  double rank;
  std::int32_t place;
  bool operator<(const Open& other) const {
    return rank > other.rank || (rank == other.rank && place > other.place);
  }
};

/// A set of keys, in one table that is cleared and not freed.
class Keys {
 public:
  void clear() {
    if (table_.empty()) table_.resize(1U << 16U);
    std::fill(table_.begin(), table_.end(), kNone);
    count_ = 0;
  }
  /// False if it is there already.
  bool insert(std::uint64_t key) {
    if (2 * (count_ + 1) > table_.size()) grow();
    const bool added = put(key);
    count_ += added;
    return added;
  }

 private:
  static constexpr std::uint64_t kNone = ~std::uint64_t{0};

  bool put(std::uint64_t key) {
    const std::size_t mask = table_.size() - 1;
    // Fibonacci hashing (D. Knuth, The Art of Computer Programming 3, section 6.4).
    for (std::size_t i = key * 0x9E3779B97F4A7C15ULL >> 20U;; ++i) {
      std::uint64_t& slot = table_[i & mask];
      if (slot == key) return false;
      if (slot != kNone) continue;
      slot = key;
      return true;
    }
  }
  void grow() {
    std::vector<std::uint64_t> old(2 * table_.size(), kNone);
    old.swap(table_);
    for (const std::uint64_t key : old)
      if (key != kNone) put(key);
  }

  std::vector<std::uint64_t> table_;
  std::size_t count_ = 0;
};

/// A point on its way through a move.
struct Moving {
  double x, y, heading, v, kappa, t;
  Moving(const Place& p) : x(p.x), y(p.y), heading(p.heading), v(p.v), kappa(p.kappa), t(p.t) {}

  void go(double h, double a, double kappa_rate, double v_min, double v_max) {
    v = std::clamp(v + a * h, v_min, v_max);
    kappa += kappa_rate * h;
    const double turned = v * kappa * h;
    x += v * h * std::cos(heading + turned / 2);
    y += v * h * std::sin(heading + turned / 2);
    heading += turned;
    t += h;
  }
};

}  // namespace

class WayFinder::Impl {
 public:
  Impl(const Environment& environment, const vehicle::Parameters& vehicle)
      : goal_(environment.goal), region_(environment.region), vehicle_(vehicle) {
    region_.x_min += kInset;
    region_.y_min += kInset;
    region_.x_max -= kInset;
    region_.y_max -= kInset;
  }

  std::optional<Way> find(const vehicle::State& start, double t_start,
                          const std::vector<Obstacle>& obstacles, const WaySearch& search,
                          const std::function<bool()>& over) {
    search_ = search;
    t_start_ = t_start;
    begin(start, obstacles);
    for (looked_at_ = 0; !open_.empty() && looked_at_ < search.max_places; ++looked_at_) {
      if (looked_at_ % kPoll == kPoll - 1 && over && over()) break;
      std::pop_heap(open_.begin(), open_.end());
      const std::int32_t index = open_.back().place;
      open_.pop_back();
      const Place from = places_[static_cast<std::size_t>(index)];
      if (goal_.outside(from.x, from.y) <= -kDeep * goal_.sigma) return way_to(index);
      if (from.t < t_start_ + search_.t_max) move_on(from, index);
    }
    return std::nullopt;
  }

  int looked_at() const { return looked_at_; }

 private:
  void begin(const vehicle::State& X, const std::vector<Obstacle>& obstacles) {
    using namespace vehicle;
    places_.clear();
    open_.clear();
    keys_.clear();
    obstacles_.clear();
    const double front = X[V] + vehicle_.la * X[R];
    const double v = std::hypot(X[UX], front);
    for (const auto& o : obstacles) {
      Obstacle grown = o.grown(search_.clearance);
      grown.name.clear();
      obstacles_.push_back(std::move(grown));
    }
    field_.fill(X[vehicle::X], X[Y], goal_, region_, obstacles_);
    add({static_cast<float>(X[vehicle::X]), static_cast<float>(X[Y]),
         static_cast<float>(X[PSI] + std::atan2(front, std::max(X[UX], 0.3))),
         static_cast<float>(std::max(v, search_.v_min)),
         static_cast<float>(v > kSlow ? X[R] / v : 0), static_cast<float>(t_start_), 0, -1});
  }

  double most_curvature(double v) const {
    return std::min(search_.curvature, search_.lateral_acceleration / (v * v));
  }

  static bool within(const Obstacle& o, double x, double y, double t) {
    const double dx = (x - o.x_at(t)) / o.a, dy = (y - o.y_at(t)) / o.b;
    return dx * dx + dy * dy < 1;
  }

  bool free(const Moving& m) const {
    return region_.contains(m.x, m.y) &&
           std::none_of(nearby_.begin(), nearby_.end(),
                        [&](const Obstacle* o) { return within(*o, m.x, m.y, m.t); });
  }

  /// Those obstacles that a move from here may touch. What the start lies in does not hinder it
  /// from leaving.
  void find_nearby(const Place& from) {
    nearby_.clear();
    for (const auto& o : obstacles_) {
      const double reach = (from.v + 2 + std::hypot(o.vx, o.vy)) * kMove + std::max(o.a, o.b);
      const double dx = from.x - o.x_at(from.t), dy = from.y - o.y_at(from.t);
      if (dx * dx + dy * dy < reach * reach && !within(o, from.x, from.y, from.t))
        nearby_.push_back(&o);
    }
  }

  void move_on(const Place& from, std::int32_t index) {
    find_nearby(from);
    const double v_top = std::max(search_.v_max, static_cast<double>(from.v));
    const double most = most_curvature(from.v);
    const std::array pushes = {search_.acceleration_share * vehicle_.ax_max_at(from.v), 0.,
                               -search_.braking};
    for (const double turn : kTurns) {
      const double rate = std::clamp((turn * most - from.kappa) / kMove, -search_.curvature_rate,
                                     search_.curvature_rate);
      for (const double a : pushes) {
        Moving m(from);
        bool clear = true;
        for (int part = 0; part < kParts && clear; ++part) {
          m.go(kMove / kParts, a, rate, search_.v_min, v_top);
          clear = free(m);
        }
        constexpr double slack = 1.02;
        if (!clear || (std::fabs(m.kappa) > slack * most_curvature(m.v) &&
                       std::fabs(m.kappa) > std::fabs(from.kappa)))
          continue;
        add({static_cast<float>(m.x), static_cast<float>(m.y), static_cast<float>(m.heading),
             static_cast<float>(m.v), static_cast<float>(m.kappa), static_cast<float>(m.t),
             static_cast<float>(a), index});
      }
    }
  }

  void add(const Place& p) {
    std::uint64_t key = 0;
    const auto mix = [&key](double value, double size, unsigned bits) {
      const auto cell = static_cast<std::uint64_t>(std::llround(value / size));
      key = key << bits | (cell & ((1U << bits) - 1));
    };
    const double c = std::cos(goal_.psi), s = std::sin(goal_.psi);
    const double dx = p.x - goal_.x, dy = p.y - goal_.y;
    mix(c * dx + s * dy, kAlong, 14);
    mix(c * dy - s * dx, kAcross, 14);
    mix(p.heading, kHeading, 8);
    mix(p.v, kSpeed, 6);
    mix(p.kappa / most_curvature(p.v), kCurvature, 4);
    mix(p.t - t_start_, kTime, 8);
    if (!keys_.insert(key)) return;
    const double left = field_.at(p.x, p.y);
    places_.push_back(p);
    open_.push_back({p.t + search_.greed * left / search_.v_max,
                     static_cast<std::int32_t>(places_.size() - 1)});
    std::push_heap(open_.begin(), open_.end());
  }

  Way way_to(std::int32_t last) {
    std::vector<std::int32_t> chain;
    for (auto i = last; i >= 0; i = places_[static_cast<std::size_t>(i)].parent) chain.push_back(i);
    std::reverse(chain.begin(), chain.end());
    const Place& first = places_[static_cast<std::size_t>(chain.front())];
    Way way{{t_start_, first.x, first.y, first.heading, first.v, first.kappa, 0}};
    for (std::size_t k = 1; k < chain.size(); ++k) {
      const Place& from = places_[static_cast<std::size_t>(chain[k - 1])];
      const Place& to = places_[static_cast<std::size_t>(chain[k])];
      const double v_top = std::max(search_.v_max, static_cast<double>(from.v));
      const double rate = (to.kappa - from.kappa) / kMove;
      Moving m(from);
      m.t = t_start_ + kMove * static_cast<double>(k - 1);
      for (int part = 0; part < kPoints; ++part) {
        m.go(kMove / kPoints, to.a, rate, search_.v_min, v_top);
        way.push_back({m.t, m.x, m.y, m.heading, m.v, m.kappa, to.a});
      }
    }
    return way;
  }

  const Goal goal_;
  Region region_;  ///< smaller by the inset
  const vehicle::Parameters vehicle_;
  WaySearch search_;
  double t_start_ = 0;
  int looked_at_ = 0;
  std::vector<Obstacle> obstacles_;  ///< grown
  std::vector<const Obstacle*> nearby_;
  DistanceField field_;
  std::vector<Place> places_;
  std::vector<Open> open_;
  Keys keys_;
};

WayFinder::WayFinder(const Environment& environment, const vehicle::Parameters& vehicle)
    : impl_(std::make_unique<Impl>(environment, vehicle)) {}
WayFinder::~WayFinder() = default;

std::optional<Way> WayFinder::find(const vehicle::State& start, double t_start,
                                   const std::vector<Obstacle>& obstacles, const WaySearch& search,
                                   const std::function<bool()>& over) {
  return impl_->find(start, t_start, obstacles, search, over);
}

int WayFinder::looked_at() const {
  return impl_->looked_at();
}

}  // namespace slalom::world
