// How a road is made: its line, and bounds of how its edges bend.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "road_line.hpp"
#include "slalom/base/error.hpp"
#include "slalom/world/road.hpp"

namespace slalom::world {
namespace {

constexpr std::size_t kMostPieces = 400;  ///< of one segment
/// Of the reciprocal of 1 - width * curvature, where the inner edge all but folds.
constexpr double kMostFold = 10;
/// Parts of a road that are nearer to each other along the line than this many widths are no two
/// branches.
constexpr double kOneBranch = 7;
constexpr double kFarthest = 1e9;   ///< of numbers [m]
constexpr double kLeastWay = 1e-3;  ///< of chords, what a line makes of way at the least [1]

void check_points(const std::vector<RoadPoint>& points, bool closed, const std::string& where) {
  const std::size_t least = closed ? 3 : 2;
  if (points.size() < least)
    throw InvalidValue(where, fmt::format("a road of {} points", points.size()),
                       fmt::format("at least {}", least));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const RoadPoint& p = points[i];
    const auto here = fmt::format("{}: point {} of the road", where, i + 1);
    for (const double number : {p.x, p.y, p.right, p.left})
      if (!(std::fabs(number) <= kFarthest))
        throw InvalidValue(
            here, std::isfinite(number) ? fmt::format("{:.6g} m", number) : "NaN or infinity",
            fmt::format("finite numbers up to {:g}", kFarthest));
    if (p.right < 0 || p.left < 0 || p.right + p.left == 0)
      throw InvalidValue(
          here, fmt::format("{:.6g} m to the right, {:.6g} m to the left", p.right, p.left),
          "widths of at least 0, and a sum above 0");
    const RoadPoint& next = points[(i + 1) % points.size()];
    if ((closed || i + 1 < points.size()) && std::hypot(next.x - p.x, next.y - p.y) < 1e-6)
      throw InvalidValue(here, fmt::format("({:.6g}, {:.6g}) twice in a row", p.x, p.y),
                         closed && i + 1 == points.size()
                             ? "a last point before the first, which a closed road joins by itself"
                             : "each point once");
  }
}

}  // namespace

Road::Road(std::vector<RoadPoint> points, bool closed, std::vector<std::vector<Point>> lanes,
           const std::string& where)
    : points_(std::move(points)), lanes_(std::move(lanes)), closed_(closed) {
  check_points(points_, closed_, where);
  for (const auto& lane : lanes_)
    for (const Point& p : lane)
      if (!std::isfinite(p.x) || !std::isfinite(p.y))
        throw InvalidValue(where, "NaN or infinity in a lane's line", "finite numbers");
  fit();
  divide();
  bound();
  check_apart(where);
}

/// The spline's pieces, and the slopes of the widths.
void Road::fit() {
  const std::size_t n = points_.size(), count = closed_ ? n : n - 1;
  std::vector<double> h, x, y, right, left, lengths;
  for (std::size_t i = 0; i < n; ++i) {
    const RoadPoint &p = points_[i], &q = points_[(i + 1) % n];
    if (i < count) h.push_back(std::hypot(q.x - p.x, q.y - p.y));
    x.push_back(p.x);
    y.push_back(p.y);
    right.push_back(p.right);
    left.push_back(p.left);
  }
  const auto mx = spline_curvatures(h, x), my = spline_curvatures(h, y);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t j = i + 1 < n ? i + 1 : 0;
    const Point p{x[i], y[i]}, q{x[j], y[j]}, m{mx[i], my[i]}, k{mx[j], my[j]};
    Segment one;
    one.h = h[i];
    one.a = p;
    one.b = (q - p) * (1 / h[i]) - (m * 2 + k) * (h[i] / 6);
    one.c = m * 0.5;
    one.d = (k - m) * (1 / (6 * h[i]));
    segments_.push_back(one);
  }
  for (Segment& one : segments_) {
    one.pieces = static_cast<std::size_t>(
        std::clamp(std::ceil(one.h / kPiece), 1., static_cast<double>(kMostPieces)));
    one.s = length_;
    const double dv = one.h / static_cast<double>(one.pieces);
    for (std::size_t k = 0; k < one.pieces; ++k)
      one.length += arc(one, static_cast<double>(k) * dv, static_cast<double>(k + 1) * dv);
    length_ += one.length;
    lengths.push_back(one.length);
  }
  right_slope_ = monotone_slopes(lengths, right);
  left_slope_ = monotone_slopes(lengths, left);
}

void Road::divide() {
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    Segment& one = segments_[i];
    one.first = pieces_.size();
    const double dv = one.h / static_cast<double>(one.pieces);
    double s = one.s;
    for (std::size_t k = 0; k < one.pieces; ++k) {
      const double v = static_cast<double>(k) * dv;
      pieces_.push_back({i, v, s, line(one, v), line(one, v + dv), 0});
      s += arc(one, v, v + dv);
    }
  }
  for (std::size_t i = 0; i < pieces_.size(); i += kBlock) {
    const std::size_t end = std::min(i + kBlock, pieces_.size());
    Point sum;
    for (std::size_t k = i; k < end; ++k) sum = sum + pieces_[k].begin;
    Block block{sum * (1 / static_cast<double>(end - i)), 0};
    for (std::size_t k = i; k < end; ++k)
      block.radius = std::max({block.radius, (pieces_[k].begin - block.middle).norm(),
                               (pieces_[k].end - block.middle).norm()});
    blocks_.push_back(block);
  }
}

/// How much the distance to an edge, w(s) - n, changes and bends along a straight line: s changes
/// by g = 1 / (1 - curvature n) at the most, and its own rate by 2 |curvature| g^2 and what the
/// curvature's change adds.
void Road::bound() {
  narrowest_ = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    Piece& piece = pieces_[i];
    const double end = i + 1 < pieces_.size() ? pieces_[i + 1].s : length_;
    for (const double s : {piece.s, end}) {
      const RoadPlace here = at_inside(s);
      narrowest_ = std::min(narrowest_, here.right + here.left);
      const double most = std::max(here.right, here.left), k = std::fabs(here.curvature);
      const double g = 1 / std::max(1 - k * most, 1 / kMostFold);
      const double slope = std::max(std::fabs(here.right_slope), std::fabs(here.left_slope));
      steepest_ = std::max(steepest_, slope * g);
      const double second =
          std::max(std::fabs(width(piece.segment, s, &RoadPoint::right, right_slope_).second),
                   std::fabs(width(piece.segment, s, &RoadPoint::left, left_slope_).second));
      piece.bend = std::max(piece.bend, k * g + second * g * g + 2 * slope * k * g * g);
      sharpest_ = std::max(sharpest_, piece.bend);
    }
  }
}

/// An edge that is nearer to another part of the line than to its own would lie within the corridor
/// of that part. Where an inner edge folds in a sharp curve, the corridor is as wide as it may be.
/// A line that turns about on the spot has no direction there, and no place can be looked up.
void Road::check_apart(const std::string& where) const {
  for (const Piece& piece : pieces_) {
    const Segment& one = segments_[piece.segment];
    const double dv = one.h / static_cast<double>(one.pieces);
    double least = (piece.end - piece.begin).norm() / dv;
    for (const double v : {piece.v, piece.v + dv / 2, piece.v + dv})
      least = std::min(least, (one.b + (one.c * 2 + one.d * (3 * v)) * v).norm());
    if (!(least > kLeastWay))
      throw InvalidValue(where,
                         fmt::format("a road that turns about on the spot at ({:.6g}, {:.6g})",
                                     piece.begin.x, piece.begin.y),
                         "points that lead on");
  }
  for (const Piece& piece : pieces_) {
    const RoadPlace here = at_inside(piece.s);
    const double most = std::max(here.right, here.left);
    for (const double n : {here.left, -here.right}) {
      const OnRoad on = project(here.point() + here.aside() * n);
      double apart = std::fabs(on.s - here.s);
      if (closed_) apart = std::min(apart, length_ - apart);
      if (apart < kOneBranch * most || std::fabs(on.n) > std::fabs(n) - 1e-3) continue;
      throw InvalidValue(
          where,
          fmt::format("a road whose edge {:.4g} m along it, at ({:.6g}, {:.6g}), lies on the road "
                      "{:.4g} m along it",
                      here.s, here.x, here.y, on.s),
          "a road that does not cross itself, nor come within its own width of itself");
    }
  }
}

}  // namespace slalom::world
