#include "obstacle_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace slalom::planner {

using ocp::Expr;

namespace {

/// Longer than any drive, before or after its start [s].
constexpr double kAllTime = 1e6;
/// The numbers of one far from everything: its place, and what it takes up.
constexpr std::array kNowhere = {1e5, 1e5, 1e3, 1e3};

}  // namespace

HalfSides half_sides(const world::Obstacle& o) {
  if (!o.outline) return {o.a, o.b};
  HalfSides half;
  for (const world::Point& p : o.outline->corners())
    half = {std::max(half.length, p.x), std::max(half.width, p.y)};
  return half;
}

ObstacleRows::Kind ObstacleRows::kind_of(const world::Obstacle& o) {
  const bool along_axes = !o.trajectory && o.psi == 0;
  return !o.outline && (o.a == o.b || along_axes) ? Kind::round : Kind::shaped;
}

ObstacleRows::Counts ObstacleRows::counts(const std::vector<world::Obstacle>& obstacles) {
  Counts result{};
  for (const auto& o : obstacles) {
    ++result[static_cast<std::size_t>(kind_of(o))];
    if (kind_of(o) == Kind::shaped && o.trajectory &&
        o.trajectory->fastest(-kAllTime, kAllTime).omega > 0)
      result[2] = 1;
  }
  return result;
}

ObstacleRows::ObstacleRows(const world::Footprint& footprint, double least_margin, bool turns)
    : point_(footprint.is_point()), turns_(turns), least_margin_(least_margin) {
  if (!point_) {
    const double front = footprint.corners()[0].x, back = footprint.corners()[1].x;
    vehicle_ = {(front - back) / 2, footprint.corners()[0].y};
    middle_ = (front + back) / 2;
  }
  const auto names = {std::pair(&xo_, "xo"), {&yo_, "yo"}, {&a_, "a"},       {&b_, "b"},
                      {&vx_, "vx"},          {&vy_, "vy"}, {&co_, "co"},     {&so_, "so"},
                      {&omega_, "omega"},    {&at_, "at"}, {&half_, "half"}, {&share_, "share"},
                      {&grown_, "grown"}};
  for (const auto& [symbol, name] : names) *symbol = Expr::symbol(name);
}

std::vector<Expr> ObstacleRows::symbols(Kind kind, bool moves) const {
  std::vector<Expr> result = {xo_, yo_, a_, b_};
  const auto add = [&](std::initializer_list<Expr> more) { result.insert(result.end(), more); };
  if (kind == Kind::shaped) add({co_, so_});
  if (kind == Kind::shaped && !point_) add({grown_});
  if (kind == Kind::shaped || !point_) add({half_, share_});
  if (moves) add({vx_, vy_});
  if (moves && kind == Kind::shaped && turns_) add({omega_, at_});
  return result;
}

Expr ObstacleRows::outside(Kind kind, const Expr& dx, const Expr& dy, const Expr& psi,
                           const Expr& margin, const std::optional<Expr>& t) const {
  if (kind == Kind::shaped) return to_shape(dx, dy, psi, margin, t);
  if (point_) return square(dx / (a_ + margin)) + square(dy / (b_ + margin)) - 1;
  const Expr c = cos(psi), s = sin(psi);
  return share_ * square_of_shares(-dx - middle_ * c, -dy - middle_ * s, c, s, a_ + margin,
                                   b_ + margin, half_) -
         1;
}

Expr ObstacleRows::to_shape(const Expr& dx, const Expr& dy, const Expr& psi, const Expr& margin,
                            const std::optional<Expr>& t) const {
  // On by an angle whose tangent is omega (t - at): omega (t - at) itself to second order.
  Expr co = co_, so = so_;
  if (t && turns_) {
    const Expr turned = omega_ * (*t - at_);
    const Expr length = sqrt(1 + square(turned));
    co = (co_ - turned * so_) / length;
    so = (so_ + turned * co_) / length;
  }
  if (point_) return share_ * square_of_shares(dx, dy, co, so, a_ + margin, b_ + margin, half_) - 1;
  const Expr c = cos(psi), s = sin(psi);
  const Frame theirs{0, 0, co, so}, ours{dx + middle_ * c, dy + middle_ * s, c, s};
  return share_ * square_of_shares(theirs, {a_, b_}, ours, {vehicle_.length, vehicle_.width},
                                   grown_ + margin, half_) -
         1;
}

std::vector<double> ObstacleRows::numbers(const world::Obstacle& o, const Moment& moment,
                                          bool moves) const {
  const Kind kind = kind_of(o);
  const double t = moment.t;
  if (!o.present(t - moment.around, t + moment.around)) return nowhere(kind, moves);
  world::Pose at = o.pose_at(t);
  if (moment.held) at.vx = at.vy = at.omega = 0;
  const double more = o.margin(t) + o.rounding;
  // A body that goes straight has its place at t = 0 as it is, to the last bit.
  std::vector<double> result = {at.x - at.vx * t, at.y - at.vy * t, o.a + more, o.b + more};
  if (!o.trajectory && !moment.held) {
    result[0] = o.x;
    result[1] = o.y;
  }
  Separation found;
  if (kind == Kind::round && !point_) {
    found = separate(vehicle_, {}, least_margin_ + o.a + o.margin_start);
    result[2] = vehicle_.length + o.a + more;
    result[3] = vehicle_.width + o.a + more;
  } else if (kind == Kind::shaped) {
    const HalfSides half = half_sides(o);
    found = separate(half, vehicle_, least_margin_ + o.margin_start + o.rounding,
                     o.outline ? Outline::rectangle : Outline::ellipse);
    result[2] = half.length + (point_ ? more : 0);
    result[3] = half.width + (point_ ? more : 0);
    result.insert(result.end(), {std::cos(at.psi), std::sin(at.psi)});
    if (!point_) result.push_back(more);
  }
  if (kind == Kind::shaped || !point_)
    result.insert(result.end(), {found.exponent / 2, 1 / (found.most * found.most)});
  if (moves) result.insert(result.end(), {at.vx, at.vy});
  if (moves && kind == Kind::shaped && turns_) result.insert(result.end(), {at.omega, t});
  return result;
}

std::vector<double> ObstacleRows::nowhere(Kind kind, bool moves) const {
  std::vector<double> result(kNowhere.begin(), kNowhere.end());
  const auto add = [&](std::initializer_list<double> more) { result.insert(result.end(), more); };
  if (kind == Kind::shaped) add({1, 0});
  if (kind == Kind::shaped && !point_) add({0});
  if (kind == Kind::shaped || !point_) add({1, 1});
  if (moves) add({0, 0});
  if (moves && kind == Kind::shaped && turns_) add({0, 0});
  return result;
}

}  // namespace slalom::planner
