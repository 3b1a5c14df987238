#include "slalom/world/road.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace slalom::world {
namespace {

/// Faster than std::hypot; nothing here comes near the ends of the range.
double length_of(Point p) {
  return std::sqrt(dot(p, p));
}

}  // namespace

Point Road::line(const Segment& one, double v) const {
  return one.a + (one.b + (one.c + one.d * v) * v) * v;
}

/// Length of the line between two parameters of a segment, by Gauss and Legendre's rule of five
/// points.
double Road::arc(const Segment& one, double v0, double v1) const {
  constexpr std::array<double, 3> at = {0, 0.5384693101056831, 0.9061798459386640};
  constexpr std::array<double, 3> weight = {0.5688888888888889, 0.4786286704993665,
                                            0.2369268850561891};
  const double middle = (v0 + v1) / 2, half = (v1 - v0) / 2;
  const auto speed = [&](double v) { return length_of(one.b + (one.c * 2 + one.d * (3 * v)) * v); };
  double sum = weight[0] * speed(middle);
  for (std::size_t k = 1; k < at.size(); ++k)
    sum += weight[k] * (speed(middle - half * at[k]) + speed(middle + half * at[k]));
  return sum * half;
}

Road::Width Road::width(std::size_t segment, double s, double RoadPoint::*side,
                        const std::vector<double>& slopes) const {
  const Segment& one = segments_[segment];
  const std::size_t next = (segment + 1) % points_.size();
  const double u = std::clamp((s - one.s) / one.length, 0., 1.);
  const double y0 = points_[segment].*side, y1 = points_[next].*side;
  const double s0 = slopes[segment] * one.length, s1 = slopes[next] * one.length, d = y1 - y0;
  const double c2 = 3 * d - 2 * s0 - s1, c3 = s0 + s1 - 2 * d;
  return {y0 + u * (s0 + u * (c2 + u * c3)), (s0 + u * (2 * c2 + u * 3 * c3)) / one.length,
          (2 * c2 + 6 * u * c3) / (one.length * one.length)};
}

std::size_t Road::piece_at(double s) const {
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), s,
                                      [](double at, const Piece& p) { return at < p.s; });
  return after == pieces_.begin() ? 0 : static_cast<std::size_t>(after - pieces_.begin()) - 1;
}

RoadPlace Road::at_inside(double s) const {
  const Piece& piece = pieces_[piece_at(s)];
  const Segment& one = segments_[piece.segment];
  double v = piece.v + (s - piece.s);  // the spline's speed is near 1
  for (int k = 0; k < 4; ++k) {
    const double speed = length_of(one.b + (one.c * 2 + one.d * (3 * v)) * v);
    const double step = (s - piece.s - arc(one, piece.v, v)) / speed;
    v += step;
    if (std::fabs(step) < 1e-9) break;  // the rest is its square
  }
  const Point first = one.b + (one.c * 2 + one.d * (3 * v)) * v,
              second = one.c * 2 + one.d * (6 * v);
  const Point p = line(one, v);
  const Width right = width(piece.segment, s, &RoadPoint::right, right_slope_);
  const Width left = width(piece.segment, s, &RoadPoint::left, left_slope_);
  return {s,
          p.x,
          p.y,
          std::atan2(first.y, first.x),
          cross(first, second) / std::pow(length_of(first), 3),
          right.value,
          left.value,
          right.slope,
          left.slope};
}

RoadPlace Road::at(double s) const {
  if (closed_) {
    const double on = s - length_ * std::floor(s / length_);
    return at_inside(std::min(on, length_));
  }
  RoadPlace place = at_inside(std::clamp(s, 0., length_));
  const double beyond = s - place.s;
  if (beyond == 0) return place;
  place.s = s;
  place.x += beyond * std::cos(place.psi);
  place.y += beyond * std::sin(place.psi);
  place.curvature = 0;
  return place;
}

std::size_t Road::nearest_piece(Point p, std::size_t from, std::size_t count) const {
  const std::size_t all = pieces_.size();
  std::size_t nearest = from;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = from + k < all ? from + k : from + k - all;
    const Point side = pieces_[i].end - pieces_[i].begin, off = p - pieces_[i].begin;
    const double share = std::clamp(dot(off, side) / dot(side, side), 0., 1.);
    const Point gap = off - side * share;
    const double square = dot(gap, gap);
    if (square < least) {
      least = square;
      nearest = i;
    }
  }
  return nearest;
}

/// By the blocks that can have it.
std::size_t Road::nearest_piece(Point p) const {
  const auto bound = [&](const Block& block) { return length_of(p - block.middle); };
  double least = std::numeric_limits<double>::infinity();
  for (const Block& block : blocks_) least = std::min(least, bound(block) + block.radius);
  std::size_t nearest = 0;
  double nearest_gap = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (bound(blocks_[b]) - blocks_[b].radius > std::min(least, nearest_gap)) continue;
    const std::size_t from = b * kBlock;
    const std::size_t i = nearest_piece(p, from, std::min(kBlock, pieces_.size() - from));
    const Point side = pieces_[i].end - pieces_[i].begin, off = p - pieces_[i].begin;
    const double gap = length_of(off - side * std::clamp(dot(off, side) / dot(side, side), 0., 1.));
    if (gap < nearest_gap) {
      nearest_gap = gap;
      nearest = i;
    }
  }
  return nearest;
}

/// Newton's method from a piece on, across the segments' ends.
Road::Foot Road::foot(Point p, std::size_t piece) const {
  std::size_t i = pieces_[piece].segment;
  const Point side = pieces_[piece].end - pieces_[piece].begin;
  const double share = std::clamp(dot(p - pieces_[piece].begin, side) / dot(side, side), 0., 1.);
  double v = pieces_[piece].v + share * length_of(side);
  Point first, off;
  for (int k = 0; k < 12; ++k) {
    while (v < 0 && (closed_ || i > 0)) {
      i = (i + segments_.size() - 1) % segments_.size();
      v += segments_[i].h;
    }
    while (v > segments_[i].h && (closed_ || i + 1 < segments_.size())) {
      v -= segments_[i].h;
      i = (i + 1) % segments_.size();
    }
    const Segment& one = segments_[i];
    const double on = std::clamp(v, 0., one.h);  // beyond an end the line is straight
    first = one.b + (one.c * 2 + one.d * (3 * on)) * on;
    const Point second = v == on ? one.c * 2 + one.d * (6 * on) : Point{};
    off = p - (line(one, on) + first * (v - on));
    const double square = dot(first, first), slope = square - dot(off, second);
    const double step = dot(off, first) / (slope > 0.05 * square ? slope : square);
    if (std::fabs(step) < 1e-11) break;
    // Beyond an end the line is straight, and the step goes all the way.
    const bool beyond = v != on && (v + step < 0 || v + step > one.h);
    v += beyond ? step : std::clamp(step, -2., 2.);
  }
  const Segment& one = segments_[i];
  const double on = std::clamp(v, 0., one.h);
  const double dv = one.h / static_cast<double>(one.pieces);
  const std::size_t at = one.first + std::min(static_cast<std::size_t>(on / dv), one.pieces - 1);
  const double s =
      pieces_[at].s + arc(one, pieces_[at].v, on) + (v - on) * (v == on ? 0 : length_of(first));
  return {{s, std::copysign(length_of(off), cross(first, off))}, at};
}

OnRoad Road::project(Point p) const {
  return foot(p, nearest_piece(p)).on;
}

/// The pieces that begin within so much [m] of s, which lies on the piece `at`.
Road::Range Road::around(double s, std::size_t at, double within) const {
  const auto far = [&](std::size_t i) {
    double apart = std::fabs(pieces_[i].s - s);
    if (closed_) apart = std::min(apart, length_ - apart);
    return apart > within;
  };
  Range range{at, 1};
  while (range.count < pieces_.size() && (closed_ || range.from > 0)) {
    const std::size_t before = (range.from + pieces_.size() - 1) % pieces_.size();
    if (far(before)) break;
    range.from = before;
    ++range.count;
  }
  for (std::size_t i = at + 1; range.count < pieces_.size() && (closed_ || i < pieces_.size());
       ++i) {
    if (far(i % pieces_.size())) break;
    ++range.count;
  }
  return range;
}

OnRoad Road::project(Point p, double hint) const {
  const double s = closed_ ? hint - length_ * std::floor(hint / length_) : hint;
  const auto [from, count] = around(s, piece_at(closed_ ? s : std::clamp(s, 0., length_)), kWindow);
  return foot(p, nearest_piece(p, from, count)).on;
}

double Road::to_edges(const OnRoad& on) const {
  const double s = closed_ ? on.s : std::clamp(on.s, 0., length_);
  const std::size_t segment = pieces_[piece_at(s)].segment;
  return std::min(width(segment, s, &RoadPoint::left, left_slope_).value - on.n,
                  width(segment, s, &RoadPoint::right, right_slope_).value + on.n);
}

double Road::edge_distance(Point p) const {
  const double across = to_edges(project(p));
  return across > 0 ? across / std::hypot(1, steepest_) : across;
}

double Road::edge_distance(const std::vector<Point>& corners) const {
  double reach = 0;
  for (const Point& p : corners) reach = std::max(reach, (p - corners[0]).norm());
  const Foot first = foot(corners[0], nearest_piece(corners[0]));
  // What is near to the first corner along the line.
  const std::size_t all = pieces_.size();
  const auto [from, count] = around(pieces_[first.piece].s, first.piece, 2 * reach + 2 * kPiece);
  double bend = 0;
  for (std::size_t k = 0; k < count; ++k) bend = std::max(bend, pieces_[(from + k) % all].bend);
  const double step = bend > 0 ? std::sqrt(8 * kSag / bend) : reach;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const Point side = corners[(c + 1) % corners.size()] - corners[c];
    const double parts = std::max(1., std::ceil(length_of(side) / std::max(step, 1e-3)));
    for (double k = 0; k < parts; ++k) {
      const Point p = corners[c] + side * (k / parts);
      least = std::min(least, to_edges(foot(p, nearest_piece(p, from, count)).on));
    }
  }
  if (bend > 0) least -= kSag;
  return least > 0 ? least / std::hypot(1, steepest_) : least;
}

std::vector<Point> Road::edge(bool left, double step) const {
  std::vector<Point> points;
  const double parts = std::ceil(length_ / step);
  for (double k = 0; k <= parts; ++k) {
    const RoadPlace here = at_inside(length_ * k / parts);
    points.push_back(here.point() + here.aside() * (left ? here.left : -here.right));
  }
  return points;
}

std::shared_ptr<const Road> Road::moved(Point by) const {
  auto road = std::make_shared<Road>(*this);
  for (auto& p : road->points_) p.x += by.x, p.y += by.y;
  for (auto& lane : road->lanes_)
    for (auto& p : lane) p = p + by;
  for (auto& one : road->segments_) one.a = one.a + by;
  for (auto& piece : road->pieces_) piece.begin = piece.begin + by, piece.end = piece.end + by;
  for (auto& block : road->blocks_) block.middle = block.middle + by;
  return road;
}

}  // namespace slalom::world
