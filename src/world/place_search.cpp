#include "place_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slalom::world {
namespace {

/// Of the goal's half-width, along its direction and across: a way that ends there is well inside
/// the square, whatever the direction.
constexpr double kAlong = 0.5, kAcross = 0.6;
constexpr double kRounding = 1e-4;  ///< of curvatures, relative
constexpr double kWayStep = 0.05;   ///< between a way's points [s]
/// A start nearer to the road's edge than ways are to be may come nearer by this [m].
constexpr double kNearerStart = 0.05;
/// A cell of curvatures is so many times what a move changes at the most: the first step to a side
/// is in another one.
constexpr double kStepsPerCell = 1.9;
constexpr int kDrivesOff = 25;  ///< moves in which what goes slowly has finer cells
/// Within this share of a goal's ranges a place meets them, and this far beyond a line across the
/// road it is there [m].
constexpr double kWithin = 0.7, kBeyondLine = 0.5;

/// Turns the unit vector (c, s) by a small angle: a series, for a move has twenty such.
void turn(double& c, double& s, double angle) {
  const double z = angle * angle;
  const double cosine = 1 - z * (0.5 - z * (1.0 / 24));
  const double sine = angle * (1 - z * (1.0 / 6 - z * (1.0 / 120)));
  const double c0 = c;
  c = c0 * cosine - s * sine;
  s = s * cosine + c0 * sine;
}

/// The cell of a value, in `bits` bits; so many cells apart values would be taken for one.
std::uint64_t cell(double value, double size, int bits) {
  const auto half = std::int64_t{1} << (bits - 1);
  const auto at = static_cast<std::int64_t>(std::floor(value / size + 0.5)) + half;
  return static_cast<std::uint64_t>(at) & ((std::uint64_t{1} << bits) - 1);
}

}  // namespace

PlaceSearch::PlaceSearch(const Goal& goal, const vehicle::Parameters& vehicle,
                         const std::vector<Disc>& body, const RoadField* road, double to_go)
    : goal_(goal),
      vehicle_(vehicle),
      frame_{std::cos(goal.psi), std::sin(goal.psi)},
      road_(road),
      to_go_(to_go) {
  for (const Disc& disc : body) {
    disc_radius_ = disc.radius;
    ahead_.push_back(disc.ahead);
    body_reach_ = std::max(body_reach_, std::fabs(disc.ahead));
  }
}

std::size_t PlaceSearch::moments(const WaySearch& search) {
  return static_cast<std::size_t>(std::ceil(search.t_max / search.dt)) + 1;
}

bool PlaceSearch::run(const Place& start, double t_start, const Region& region,
                      const std::vector<Ellipse>& obstacles, const std::vector<Moment>& moments,
                      const WaySearch& search, const std::optional<Standstill>& standing,
                      const std::function<bool()>& out_of_budget) {
  p_ = search;
  standing_ = standing;
  region_ = region;
  obstacles_.assign(obstacles.begin(), obstacles.end());
  moments_.assign(moments.begin(), moments.end());
  found_ = -1;
  looked_at_ = 0;
  places_.clear();
  open_.clear();
  cells_.clear();
  t_start_ = t_start;
  place_start(start);
  const int most_moves = static_cast<int>(std::ceil(p_.t_max / p_.dt));
  add(start);
  for (; !open_.empty() && looked_at_ < p_.max_places; ++looked_at_) {
    if (looked_at_ % WayFinder::kAskedEvery == 0 && out_of_budget && out_of_budget()) return false;
    std::pop_heap(open_.begin(), open_.end());
    const auto at = open_.back().place;
    open_.pop_back();
    const auto& place = places_[static_cast<std::size_t>(at)];
    if (is_end(place)) {
      found_ = at;
      return true;
    }
    if (place.moves < most_moves) go_on(at);
  }
  return false;
}

double PlaceSearch::most_curvature(double v) const {
  return std::min(p_.curvature, p_.lateral_acceleration / (v * v));
}

double PlaceSearch::braking_at(double v) const {
  return std::max(p_.braking, -p_.braking_share * vehicle_.ax_min_at(v));
}

bool PlaceSearch::meets_conditions(const Place& place) const {
  const auto within = [](double value, double lower, double upper) {
    const double by = (1 - kWithin) / 2 * (upper - lower);
    return std::isinf(by) ? value >= lower && value <= upper
                          : value >= lower + by && value <= upper - by;
  };
  constexpr double turn = 2 * std::numbers::pi;
  const double off = std::remainder(static_cast<double>(place.heading) - goal_.psi, turn);
  return std::fabs(off) <= kWithin * goal_.psi_tolerance &&
         within(static_cast<double>(place.v), goal_.ux_min, goal_.ux_max) &&
         in_time(t_start_ + place.moves * p_.dt);
}

/// Within the goal's window, or where that is narrower than a move, at the move's end that is
/// nearest to its middle: what follows the way comes at a time of its own.
bool PlaceSearch::in_time(double t) const {
  const double width = goal_.t_max - goal_.t_min;
  const double by = std::isinf(width) ? 0 : std::min((1 - kWithin) * width, width - p_.dt) / 2;
  return t >= goal_.t_min + by && t <= goal_.t_max - by;
}

bool PlaceSearch::is_end(const Place& place) const {
  return standing_ ? stands(place) : arrived(place);
}

bool PlaceSearch::arrived(const Place& place) const {
  if (!meets_conditions(place)) return false;
  const auto x = static_cast<double>(place.x), y = static_cast<double>(place.y);
  const auto inside = [&](double along, double across) {
    return std::fabs(frame_.u(x, y)) <= kAlong * along &&
           std::fabs(frame_.w(x, y)) <= kAcross * across;
  };
  switch (goal_.kind()) {
    case GoalKind::square:
      return inside(goal_.sigma, goal_.sigma);
    case GoalKind::rectangle:
      return inside(goal_.length / 2, goal_.width / 2);
    case GoalKind::line:
      return frame_.u(x, y) >= kBeyondLine && way_left(place) <= 0;
    case GoalKind::time:
      return t_start_ + place.moves * p_.dt >= goal_.time;
    case GoalKind::laps:
      break;
  }
  return false;
}

/// The time at which a way by this place would end, at best; what lies ahead counts more.
double PlaceSearch::rank(const Place& place) const {
  const auto v = static_cast<double>(place.v);
  const double ahead =
      standing_ ? std::max(0., v - p_.v_min) / p_.braking : way_left(place) / p_.v_max;
  return place.moves * p_.dt + p_.greed * ahead;
}

/// What the way ahead is ranked by, and how near to the road's edges a start may be.
void PlaceSearch::place_start(const Place& start) {
  const auto x = static_cast<double>(start.x), y = static_cast<double>(start.y);
  if (road_ == nullptr) {
    const bool square = goal_.kind() == GoalKind::square;
    field_.build(frame_, x, y, kAlong * (square ? goal_.sigma : goal_.length / 2),
                 kAcross * (square ? goal_.sigma : goal_.width / 2), region_, obstacles_);
    return;
  }
  const double s = road_->along(goal_.x + x, goal_.y + y);
  goal_s_ = s + by_the_lap(goal_, road_->road(), to_go_ - s);
  edge_ = disc_radius_ + p_.edge;
  const auto heading = static_cast<double>(start.heading);
  for (const double ahead : ahead_)
    edge_ = std::min(edge_, road_->edge_distance(goal_.x + x + ahead * std::cos(heading),
                                                 goal_.y + y + ahead * std::sin(heading)) -
                                kNearerStart);
}

bool PlaceSearch::on_road(double x, double y) const {
  return road_ == nullptr || road_->edge_distance(goal_.x + x, goal_.y + y) >= edge_;
}

/// Place::s, by that of where the place was come to from.
double PlaceSearch::along(const Place& place) const {
  const double s =
      road_->along(goal_.x + static_cast<double>(place.x), goal_.y + static_cast<double>(place.y));
  if (place.parent < 0) return s;
  const auto before = static_cast<double>(places_[static_cast<std::size_t>(place.parent)].s);
  return road_->road().unwrapped(s, before);
}

/// To the goal, along the road or around what stands [m]; of a time along the road what is beyond
/// its length counts less.
double PlaceSearch::way_left(const Place& place) const {
  if (road_ == nullptr) {
    const auto x = static_cast<double>(place.x), y = static_cast<double>(place.y);
    return field_(frame_.u(x, y), frame_.w(x, y));
  }
  const double left = goal_s_ - static_cast<double>(place.s);
  if (goal_.kind() == GoalKind::time) return left;
  return std::max(0., goal_.is_place() ? by_the_lap(goal_, road_->road(), left) : left);
}

void PlaceSearch::add(Place place) {
  const auto x = static_cast<double>(place.x), y = static_cast<double>(place.y);
  const auto v = static_cast<double>(place.v);
  const double u = frame_.u(x, y), w = frame_.w(x, y), t = place.moves * p_.dt;
  const double least = (std::sqrt(u * u + w * w) - goal_.sigma) / std::max(v, p_.v_max);
  if (road_ == nullptr && !standing_ && t + least > p_.t_max)
    return;               // straight on it is too late already
  std::uint64_t key = 1;  // no key is zero
  const auto mix = [&key](double value, double size, int bits) {
    key = key << bits | cell(value, size, bits);
  };
  mix(u, p_.cell_along, 14);
  mix(w, p_.cell_across, 14);
  mix(static_cast<double>(place.heading) - goal_.psi, p_.cell_heading, 10);
  mix(v, p_.cell_speed, 6);
  // What goes slowly and hardly moves would be in the cell of the place before it, and never begin
  // to turn.
  const bool slow = place.moves <= kDrivesOff && v * p_.cell_time < p_.cell_along;
  const double step = p_.curvature_rate * p_.dt * (slow ? 1 : kStepsPerCell);
  mix(static_cast<double>(place.kappa), std::min(p_.cell_curvature * most_curvature(v), step), 6);
  mix(t, slow ? std::min(p_.dt, p_.cell_time) : p_.cell_time, 10);
  if (!cells_.insert(key)) return;
  if (road_ != nullptr) place.s = static_cast<float>(along(place));
  places_.push_back(place);
  open_.push_back({rank(place), static_cast<std::int32_t>(places_.size() - 1)});
  std::push_heap(open_.begin(), open_.end());
}

/// Those that a move from here may meet: in each one's view the place goes ahead at a constant
/// velocity, but for what an acceleration makes of it within the move.
void PlaceSearch::find_near(const Place& from) {
  const auto x = static_cast<double>(from.x), y = static_cast<double>(from.y);
  const auto v = static_cast<double>(from.v), heading = static_cast<double>(from.heading);
  const double t = from.moves * p_.dt, c = std::cos(heading), s = std::sin(heading);
  const double push = p_.acceleration_share * vehicle_.ax_max_at(v);
  const double fast = v + std::max(push, 0.0) * p_.dt;
  const double brake = braking_at(v);
  const double slow = std::max(v - brake * p_.dt, std::min(p_.v_min, v));
  const double kappa = std::max(std::fabs(static_cast<double>(from.kappa)), most_curvature(slow));
  const double a = std::max(std::fabs(push), brake);
  const double aside = 0.5 * p_.dt * p_.dt * std::hypot(a, fast * fast * kappa);
  near_.clear();
  for (const auto& obstacle : obstacles_) {
    Ellipse o = obstacle;
    double dx = o.x + o.vx * t - x, dy = o.y + o.vy * t - y;
    if (o.moments >= 0) {
      const Moment& now = moments_[static_cast<std::size_t>(o.moments + from.moves)];
      const Moment& then = moments_[static_cast<std::size_t>(o.moments + from.moves + 1)];
      if (!now.there) continue;
      dx = now.x - x;
      dy = now.y - y;
      o.vx = (then.x - now.x) / p_.dt;
      o.vy = (then.y - now.y) / p_.dt;
      o.a += then.larger;
      o.b += then.larger;
    }
    const double vx = v * c - o.vx, vy = v * s - o.vy, square = vx * vx + vy * vy;
    const double ahead = square > 0 ? (dx * vx + dy * vy) / square : 0;
    const double at = std::clamp(ahead, 0.0, p_.dt);
    const double ex = dx - at * vx, ey = dy - at * vy,
                 reach = std::max(o.a, o.b) + aside + body_reach_;
    if (ex * ex + ey * ey < reach * reach)
      near_.push_back({x + dx, y + dy, o.vx, o.vy, 1 / o.a, 1 / o.b});
  }
}

bool PlaceSearch::is_free(const Motion& at, double after) const {
  if (body_reach_ == 0)
    return region_.contains(at.x, at.y) && on_road(at.x, at.y) && is_clear(at.x, at.y, after);
  // The front wheels roll where the way leads; the body's axis is off that by their steering.
  double c = at.c, s = at.s;
  turn(c, s, -(vehicle_.la + vehicle_.lb) * at.kappa);
  return std::all_of(ahead_.begin(), ahead_.end(), [&](double ahead) {
    const double x = at.x + ahead * c, y = at.y + ahead * s;
    return region_.contains(x, y) && on_road(x, y) && is_clear(x, y, after);
  });
}

bool PlaceSearch::is_clear(double x, double y, double after) const {
  for (const auto& o : near_) {
    const double dx = (x - o.x - o.vx * after) * o.per_a;
    const double dy = (y - o.y - o.vy * after) * o.per_b;
    if (dx * dx + dy * dy < 1) return false;
  }
  return true;
}

/// By the midpoint rule.
void PlaceSearch::advance(Motion& at, double a, double kappa_rate, double h, double v_least,
                          double v_most) const {
  const double v = std::clamp(at.v + a * h / 2, v_least, v_most);
  const double turned = v * (at.kappa + kappa_rate * h / 2) * h;
  turn(at.c, at.s, turned / 2);
  at.x += v * h * at.c;
  at.y += v * h * at.s;
  turn(at.c, at.s, turned / 2);
  at.heading += turned;
  at.v = std::clamp(at.v + a * h, v_least, v_most);
  at.kappa += kappa_rate * h;
}

bool PlaceSearch::move(Motion& at, double a, double kappa_rate, double v_least,
                       double v_most) const {
  const double h = p_.dt / kParts;
  for (int part = 1; part <= kParts; ++part) {
    advance(at, a, kappa_rate, h, v_least, v_most);
    if (!is_free(at, part * h)) return false;
  }
  return true;
}

void PlaceSearch::go_on(std::int32_t index) {
  const Place from = places_[static_cast<std::size_t>(index)];
  find_near(from);
  const auto x = static_cast<double>(from.x), y = static_cast<double>(from.y);
  const auto v = static_cast<double>(from.v), kappa = static_cast<double>(from.kappa);
  const auto heading = static_cast<double>(from.heading);
  const Motion here = {x, y, std::cos(heading), std::sin(heading), heading, v, kappa};
  const double v_least = std::min(p_.v_min, v), v_most = std::max(p_.v_max, v);
  const std::array<double, 3> pushes = {p_.acceleration_share * vehicle_.ax_max_at(v), 0,
                                        -braking_at(v)};
  const bool too_sharp = std::fabs(kappa) > (1 + 2 * kRounding) * most_curvature(v);
  for (const double share : {0.0, -1.0, 1.0, -0.4, 0.4})
    for (const double a : pushes) {
      const double most = most_curvature(std::clamp(v + a * p_.dt, v_least, v_most));
      const double rate =
          std::clamp((share * most - kappa) / p_.dt, -p_.curvature_rate, p_.curvature_rate);
      const double then = std::fabs(kappa + rate * p_.dt);
      if (then > (1 + kRounding) * most && !(too_sharp && then < std::fabs(kappa))) continue;
      Motion at = here;
      if (!move(at, a, rate, v_least, v_most)) continue;
      add({static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.heading),
           static_cast<float>(at.v), static_cast<float>(at.kappa), static_cast<float>(a), 0,
           from.moves + 1, index});
    }
}

void PlaceSearch::write(double t_start, Way& way) {
  chain_.clear();
  for (auto i = found_; i >= 0; i = places_[static_cast<std::size_t>(i)].parent)
    chain_.push_back(i);
  std::reverse(chain_.begin(), chain_.end());
  const int parts = std::max(1, static_cast<int>(std::lround(p_.dt / kWayStep)));
  way.clear();
  way.reserve((chain_.size() - 1) * static_cast<std::size_t>(parts) + 1);
  const auto put = [&](double after, const Motion& at, double a) {
    way.push_back({t_start + after, goal_.x + at.x, goal_.y + at.y, at.heading, at.v, at.kappa, a});
  };
  for (std::size_t k = 0; k < chain_.size(); ++k) {
    const auto& from = places_[static_cast<std::size_t>(chain_[k])];
    const auto heading = static_cast<double>(from.heading), v = static_cast<double>(from.v);
    Motion at = {static_cast<double>(from.x),
                 static_cast<double>(from.y),
                 std::cos(heading),
                 std::sin(heading),
                 heading,
                 v,
                 static_cast<double>(from.kappa)};
    const bool last = k + 1 == chain_.size();
    const auto& to = last ? from : places_[static_cast<std::size_t>(chain_[k + 1])];
    const auto a = static_cast<double>(to.a);
    put(from.moves * p_.dt, at, k == 0 ? a : static_cast<double>(from.a));
    if (last) break;
    const double h = p_.dt / parts;
    const double rate = (static_cast<double>(to.kappa) - at.kappa) / p_.dt;
    for (int part = 1; part < parts; ++part) {
      advance(at, a, rate, h, std::min(p_.v_min, v), std::max(p_.v_max, v));
      put(from.moves * p_.dt + part * h, at, a);
    }
  }
}

}  // namespace slalom::world
