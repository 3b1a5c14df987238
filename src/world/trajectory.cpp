#include "slalom/world/trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "slalom/base/error.hpp"

namespace slalom::world {
namespace {

/// A body turns about a corner of its line within this share of the shorter side, and this far [m].
constexpr double kTurnShare = 0.25, kTurnMost = 2;

double wrapped(double angle) {
  return std::remainder(angle, 2 * std::numbers::pi);
}

/// Slopes at the knots by the modified weights: |d[k+1] - d[k]| + |d[k+1] + d[k]| / 2.
std::vector<double> akima_slopes(const std::vector<double>& t, const std::vector<double>& y) {
  const std::size_t n = t.size();
  std::vector<double> d(n + 3);  // of the intervals, two more before and after
  for (std::size_t k = 0; k + 1 < n; ++k) d[k + 2] = (y[k + 1] - y[k]) / (t[k + 1] - t[k]);
  d[1] = n > 2 ? 2 * d[2] - d[3] : d[2];
  d[0] = 2 * d[1] - d[2];
  d[n + 1] = n > 2 ? 2 * d[n] - d[n - 1] : d[n];
  d[n + 2] = 2 * d[n + 1] - d[n];
  std::vector<double> slope(n);
  const auto weight = [](double a, double b) { return std::fabs(b - a) + std::fabs(b + a) / 2; };
  for (std::size_t k = 0; k < n; ++k) {
    const double after = weight(d[k + 2], d[k + 3]), before = weight(d[k], d[k + 1]);
    slope[k] = after + before > 0 ? (after * d[k + 1] + before * d[k + 2]) / (after + before) : 0;
  }
  return slope;
}

/// A body that is at one place in two rows stands there between them, where the slopes of what
/// comes before and after would have it go back and forth; and so does a heading.
void hold_what_stands(const std::vector<TrajectoryRow>& rows, std::vector<TrajectoryRow>& slopes) {
  for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
    const TrajectoryRow &here = rows[k], &next = rows[k + 1];
    if (here.x != next.x || here.y != next.y) continue;
    for (auto* slope : {&slopes[k], &slopes[k + 1]}) {
      slope->x = slope->y = 0;
      if (here.psi == next.psi) slope->psi = 0;
    }
  }
}

/// A cubic by values and slopes at both ends of an interval of `length`: value and slope at a
/// share.
struct Cubic {
  double y0, y1, s0, s1, length;

  double value(double u) const {
    const double h00 = (1 + 2 * u) * (1 - u) * (1 - u), h10 = u * (1 - u) * (1 - u);
    return h00 * y0 + (1 - h00) * y1 + length * (h10 * s0 + u * u * (u - 1) * s1);
  }
  double slope(double u) const {
    return 6 * u * (1 - u) * (y1 - y0) / length + (1 - u) * (1 - 3 * u) * s0 + u * (3 * u - 2) * s1;
  }
  /// The middle one of the slope's three Bernstein coefficients; the others are s0 and s1.
  double middle() const { return 3 * (y1 - y0) / length - s0 - s1; }
};

Cubic cubic(const std::vector<TrajectoryRow>& rows, const std::vector<TrajectoryRow>& slopes,
            std::size_t k, double TrajectoryRow::*of) {
  return {rows[k].*of, rows[k + 1].*of, slopes[k].*of, slopes[k + 1].*of,
          rows[k + 1].t - rows[k].t};
}

void check_finite(const std::vector<double>& numbers, const std::string& where) {
  if (!std::all_of(numbers.begin(), numbers.end(), [](double v) { return std::isfinite(v); }))
    throw InvalidValue(where, "NaN or infinity", "finite numbers");
}

}  // namespace

const std::vector<std::string>& beyond_end_names() {
  static const std::vector<std::string> names = {"stands", "goes_on", "absent"};
  return names;
}

TableTrajectory::TableTrajectory(std::vector<TrajectoryRow> rows, BeyondEnd before, BeyondEnd after,
                                 const std::string& where)
    : rows_(std::move(rows)), slopes_(rows_.size()), before_(before), after_(after) {
  if (rows_.size() < 2)
    throw InvalidValue(
        where, fmt::format("a table with {} row{}", rows_.size(), rows_.size() == 1 ? "" : "s"),
        "two or more; an obstacle that stands needs no table");
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    auto& row = rows_[k];
    const auto place = fmt::format("{}: row {}", where, k + 1);
    check_finite({row.t, row.x, row.y, row.psi}, place);
    if (k == 0) continue;
    const auto& last = rows_[k - 1];
    if (!(row.t > last.t))
      throw InvalidValue(place, fmt::format("t = {:.9g} after {:.9g}", row.t, last.t),
                         "times that rise");
    // What lies within a half turn keeps its bits, so that rows read again are the same.
    if (std::fabs(row.psi - last.psi) > std::numbers::pi)
      row.psi = last.psi + wrapped(row.psi - last.psi);
  }
  std::vector<double> t, y;
  for (const auto& row : rows_) t.push_back(row.t);
  for (const auto of : {&TrajectoryRow::x, &TrajectoryRow::y, &TrajectoryRow::psi}) {
    y.clear();
    for (const auto& row : rows_) y.push_back(row.*of);
    const auto slope = akima_slopes(t, y);
    for (std::size_t k = 0; k < slope.size(); ++k) slopes_[k].*of = slope[k];
  }
  hold_what_stands(rows_, slopes_);
  for (std::size_t k = 0; k + 1 < rows_.size(); ++k) {
    const auto x = cubic(rows_, slopes_, k, &TrajectoryRow::x);
    const auto yy = cubic(rows_, slopes_, k, &TrajectoryRow::y);
    const auto psi = cubic(rows_, slopes_, k, &TrajectoryRow::psi);
    bounds_.push_back({std::max({std::hypot(x.s0, yy.s0), std::hypot(x.middle(), yy.middle()),
                                 std::hypot(x.s1, yy.s1)}),
                       std::max({std::fabs(psi.s0), std::fabs(psi.middle()), std::fabs(psi.s1)})});
  }
}

Pose TableTrajectory::in_interval(std::size_t k, double t) const {
  const auto x = cubic(rows_, slopes_, k, &TrajectoryRow::x);
  const auto y = cubic(rows_, slopes_, k, &TrajectoryRow::y);
  const auto psi = cubic(rows_, slopes_, k, &TrajectoryRow::psi);
  const double u = (t - rows_[k].t) / x.length;
  return {x.value(u), y.value(u), psi.value(u), x.slope(u), y.slope(u), psi.slope(u)};
}

Pose TableTrajectory::at(double t) const {
  const auto next =
      std::upper_bound(rows_.begin(), rows_.end(), t,
                       [](double at, const TrajectoryRow& row) { return at < row.t; });
  if (next != rows_.begin() && next != rows_.end())
    return in_interval(static_cast<std::size_t>(next - rows_.begin()) - 1, t);
  const bool early = next == rows_.begin();
  const auto& row = early ? rows_.front() : rows_.back();
  const auto& slope = early ? slopes_.front() : slopes_.back();
  if ((early ? before_ : after_) != BeyondEnd::goes_on) return {row.x, row.y, row.psi};
  return TurningTrajectory(row.t, {row.x, row.y, row.psi, slope.x, slope.y, 0}).at(t);
}

Rates TableTrajectory::fastest(double t0, double t1) const {
  Rates most;
  const auto take = [&](const Rates& rates) {
    most = {std::max(most.speed, rates.speed), std::max(most.omega, rates.omega)};
  };
  const auto beyond = [&](const TrajectoryRow& slope, BeyondEnd rule) {
    if (rule == BeyondEnd::goes_on) take({std::hypot(slope.x, slope.y), 0});
  };
  if (t0 < rows_.front().t) beyond(slopes_.front(), before_);
  if (t1 > rows_.back().t) beyond(slopes_.back(), after_);
  auto k = static_cast<std::size_t>(
      std::upper_bound(rows_.begin(), rows_.end(), t0,
                       [](double at, const TrajectoryRow& row) { return at < row.t; }) -
      rows_.begin());
  for (k = k > 0 ? k - 1 : 0; k + 1 < rows_.size() && rows_[k].t <= t1; ++k) take(bounds_[k]);
  return most;
}

bool TableTrajectory::present(double t0, double t1) const {
  return !(before_ == BeyondEnd::absent && t1 < rows_.front().t) &&
         !(after_ == BeyondEnd::absent && t0 > rows_.back().t);
}

PathTrajectory::PathTrajectory(std::vector<Point> points, double speed, double acceleration,
                               const std::string& where)
    : points_(std::move(points)), speed_(speed), acceleration_(acceleration), length_{0} {
  if (points_.size() < 2)
    throw InvalidValue(
        where, fmt::format("a path of {} point{}", points_.size(), points_.size() == 1 ? "" : "s"),
        "two or more");
  for (const auto& p : points_) check_finite({p.x, p.y}, where);
  check_finite({speed, acceleration}, where);
  if (speed < 0 || (speed == 0 && acceleration <= 0))
    throw InvalidValue(where,
                       fmt::format("a path at {:.6g} m/s and {:.6g} m/s^2", speed, acceleration),
                       "a speed, or an acceleration from rest");
  std::vector<double> direction;
  for (std::size_t k = 1; k < points_.size(); ++k) {
    const Point along = points_[k] - points_[k - 1];
    if (!(along.norm() > 0))
      throw InvalidValue(where, fmt::format("a path with points {} and {} at one place", k, k + 1),
                         "places that differ");
    length_.push_back(length_.back() + along.norm());
    const double psi = std::atan2(along.y, along.x);
    direction.push_back(k == 1 ? psi : direction.back() + wrapped(psi - direction.back()));
  }
  turn_s_ = {0};
  turn_psi_ = {direction[0]};
  for (std::size_t k = 1; k < direction.size(); ++k) {
    const double sides = std::min(length_[k] - length_[k - 1], length_[k + 1] - length_[k]);
    const double half = std::min(kTurnShare * sides, kTurnMost);
    turn_s_.insert(turn_s_.end(), {length_[k] - half, length_[k] + half});
    turn_psi_.insert(turn_psi_.end(), {direction[k - 1], direction[k]});
    sharpest_ = std::max(sharpest_, std::fabs(direction[k] - direction[k - 1]) / (2 * half));
  }
}

PathTrajectory::Progress PathTrajectory::progress(double t) const {
  t = std::max(t, 0.0);
  if (acceleration_ < 0) t = std::min(t, -speed_ / acceleration_);  // then it stands
  const double s = speed_ * t + acceleration_ * t * t / 2;
  if (s >= length_.back()) return {length_.back(), 0};
  return {s, speed_ + acceleration_ * t};
}

Pose PathTrajectory::at(double t) const {
  const auto [s, v] = progress(t);
  const bool moves = t >= 0;
  const auto next = static_cast<std::size_t>(
      std::upper_bound(length_.begin() + 1, length_.end() - 1, s) - length_.begin());
  const Point from = points_[next - 1];
  const double side = length_[next] - length_[next - 1];
  const Point along = (points_[next] - from) * (1 / side);
  const Point here = from + along * (s - length_[next - 1]);
  Pose pose{here.x, here.y, turn_psi_.back()};
  const auto turn = static_cast<std::size_t>(std::upper_bound(turn_s_.begin(), turn_s_.end(), s) -
                                             turn_s_.begin());
  double per_metre = 0;
  if (turn < turn_s_.size()) {
    const double length = turn_s_[turn] - turn_s_[turn - 1];
    per_metre = (turn_psi_[turn] - turn_psi_[turn - 1]) / length;
    pose.psi = turn_psi_[turn - 1] + per_metre * (s - turn_s_[turn - 1]);
  }
  if (moves) {
    pose.vx = along.x * v;
    pose.vy = along.y * v;
    pose.omega = per_metre * v;
  }
  return pose;
}

Rates PathTrajectory::fastest(double t0, double t1) const {
  const double speed = std::max(progress(t0).v, progress(t1).v);
  // It may come to the line's end, where it stops at once, between.
  const double at_end =
      t1 > 0 && progress(t1).s >= length_.back()
          ? std::sqrt(std::max(speed_ * speed_ + 2 * acceleration_ * length_.back(), 0.0))
          : 0;
  const double most = std::max(speed, progress(t0).s < length_.back() ? at_end : 0);
  return {most, sharpest_ * most};
}

Pose OffsetTrajectory::at(double t) const {
  Pose pose = base_->at(t);
  const Point place = pose.to_world(offset_);
  const double dx = place.x - pose.x, dy = place.y - pose.y;
  pose.x = place.x;
  pose.y = place.y;
  pose.vx -= pose.omega * dy;
  pose.vy += pose.omega * dx;
  return pose;
}

Rates OffsetTrajectory::fastest(double t0, double t1) const {
  Rates rates = base_->fastest(t0, t1);
  rates.speed += rates.omega * offset_.norm();
  return rates;
}

Pose MovedTrajectory::at(double t) const {
  Pose pose = base_->at(t);
  pose.x += by_.x;
  pose.y += by_.y;
  return pose;
}

Pose RetimedTrajectory::at(double t) const {
  Pose pose = base_->at(base_time(t));
  pose.vx *= factor_;
  pose.vy *= factor_;
  pose.omega *= factor_;
  return pose;
}

Rates RetimedTrajectory::fastest(double t0, double t1) const {
  const auto [begin, end] = std::minmax({base_time(t0), base_time(t1)});
  const Rates rates = base_->fastest(begin, end);
  return {std::fabs(factor_) * rates.speed, std::fabs(factor_) * rates.omega};
}

bool RetimedTrajectory::present(double t0, double t1) const {
  const auto [begin, end] = std::minmax({base_time(t0), base_time(t1)});
  return base_->present(begin, end);
}

Pose TurningTrajectory::at(double t) const {
  const double after = t - t0_, angle = pose_.omega * after;
  // The velocity turns evenly; its integral is the chord, a sinc of half the angle long.
  const double half = angle / 2, sinc = half == 0 ? 1 : std::sin(half) / half;
  const double c = std::cos(half), s = std::sin(half);
  Pose pose = pose_;
  pose.x += after * sinc * (c * pose_.vx - s * pose_.vy);
  pose.y += after * sinc * (s * pose_.vx + c * pose_.vy);
  pose.psi += angle;
  pose.vx = std::cos(angle) * pose_.vx - std::sin(angle) * pose_.vy;
  pose.vy = std::sin(angle) * pose_.vx + std::cos(angle) * pose_.vy;
  return pose;
}

}  // namespace slalom::world
