#include "separation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "slalom/world/obstacle.hpp"

namespace slalom::planner {

using ocp::Expr;
using world::Point;

namespace {

constexpr std::array kExponents = {2., 2.5, 3., 3.5, 4., 5., 6., 8., 11., 16., 23., 32., 45., 64.};
/// The exponent P of the sharp norm of the two rectangles' frames, and what rounds |cos| and |sin|.
constexpr double kSharp = 64, kRounding = 1. / 160;
/// Beyond the least margin, at which `most` is looked for too [m]. It falls as margins grow, but
/// for long ellipses.
constexpr std::array kMargins = {0., 0.5, 2., 8.};
/// By what samples of turns and directions may miss the greatest of the norm.
constexpr double kSpare = 1e-3;
/// Turns of the other within a right angle, and directions within half a turn, that are looked at:
/// finely for `most`, coarsely for the excess.
constexpr int kTurns = 24, kDirections = 64;
constexpr int kFewTurns = 6, kFewDirections = 32;
/// Smaller margins are as none [m].
constexpr double kLeast = 0.05;
/// Answers that are kept, by each thread.
constexpr std::size_t kMostKnown = 4096;

/// The two, at one turn.
class Pair {
 public:
  Pair(const HalfSides& one, const HalfSides& other, Outline outline, double turn)
      : one_(one), other_(other), outline_(outline), c_(std::cos(turn)), s_(std::sin(turn)) {}

  /// Where the other's middle is, of places at which the two are m apart, farthest in a direction.
  Point just_apart(Point n, double margin) const {
    const double mx = n.x * c_ + n.y * s_, my = n.y * c_ - n.x * s_;  // in the other's frame
    const double ox = std::copysign(other_.length, mx), oy = std::copysign(other_.width, my);
    Point p{std::copysign(one_.length, n.x), std::copysign(one_.width, n.y)};
    if (outline_ == Outline::ellipse) {
      const double reach = std::hypot(one_.length * n.x, one_.width * n.y);
      p = {one_.length * one_.length * n.x / reach, one_.width * one_.width * n.y / reach};
    }
    return p + Point{ox * c_ - oy * s_, ox * s_ + oy * c_} + n * margin;
  }
  double shares(Point z, double margin, double exponent) const {
    const double c = other_.is_place() ? 0 : std::hypot(c_, kRounding);
    const double s = other_.is_place() ? 0 : std::hypot(s_, kRounding);
    const HalfSides &a = one_, &b = other_;
    const auto share = [&](double along, double reach) {
      return std::pow(std::fabs(along) / (reach + margin), exponent);
    };
    const double along_one = share(z.x, a.length + b.length * c + b.width * s) +
                             share(z.y, a.width + b.length * s + b.width * c);
    if (b.is_place()) return std::pow(along_one, 1 / exponent);
    const double along_other = share(z.x * c_ + z.y * s_, b.length + a.length * c + a.width * s) +
                               share(z.y * c_ - z.x * s_, b.width + a.length * s + a.width * c);
    const double power = kSharp / exponent;
    return std::pow(std::pow(along_one, power) + std::pow(along_other, power), 1 / kSharp);
  }
  /// The true distance between them.
  double distance(const world::Obstacle& one, Point z) const {
    if (other_.is_place()) return world::distance(one, z.x, z.y, 0);
    std::vector<Point> corners;
    for (const auto& [x, y] : {std::pair(1, -1), {1, 1}, {-1, 1}, {-1, -1}})
      corners.push_back(z + Point{x * other_.length * c_ - y * other_.width * s_,
                                  x * other_.length * s_ + y * other_.width * c_});
    return world::distance(one, corners, 0);
  }

 private:
  const HalfSides &one_, &other_;
  const Outline outline_;
  const double c_, s_;
};

/// What is looked at: turns within a right angle, directions within half a turn; both bodies are
/// symmetric.
template <class Look>
void for_each(const HalfSides& one, const HalfSides& other, Outline outline, int turns,
              int directions, const Look& look) {
  if (other.is_place()) {  // one quarter is as the others, and there are no turns
    turns = 0;
    directions *= 2;
  }
  for (int i = 0; i <= turns; ++i) {
    const Pair pair(one, other, outline, turns == 0 ? 0 : i * std::numbers::pi / 2 / turns);
    for (int k = 0; k <= directions; ++k) {
      const double angle = k * std::numbers::pi / directions;
      look(pair, Point{std::cos(angle), std::sin(angle)});
    }
  }
}

/// Of one exponent.
Separation of(double exponent, const HalfSides& one, const HalfSides& other, double margin,
              Outline outline) {
  Separation result{exponent, 0, 0};
  for_each(one, other, outline, kTurns, kDirections, [&](const Pair& pair, Point n) {
    for (const double more : kMargins)
      result.most = std::max(
          result.most, pair.shares(pair.just_apart(n, margin + more), margin + more, exponent));
  });
  result.most *= 1 + kSpare;
  world::Obstacle body{.name = "", .a = one.length, .b = one.width};
  if (outline == Outline::rectangle)
    body.outline = std::make_shared<const world::Polygon>(
        world::Polygon::rectangle(2 * one.length, 2 * one.width));
  for_each(one, other, outline, kFewTurns, kFewDirections, [&](const Pair& pair, Point n) {
    const double out = result.most / pair.shares(n, margin, exponent);
    result.excess = std::max(result.excess, pair.distance(body, n * out) - margin);
  });
  return result;
}

/// Climbs from an exponent whose norm is about as round at a corner as a margin is.
Separation search(const HalfSides& one, const HalfSides& other, double margin, Outline outline) {
  const double half = std::min(one.length, one.width) + std::min(other.length, other.width);
  const double round = std::numbers::ln2 / std::log((half + margin) / (half + margin * M_SQRT1_2));
  std::size_t at = 0;
  while (at + 1 < kExponents.size() && kExponents[at] < round) ++at;
  Separation best = of(kExponents[at], one, other, margin, outline);
  for (const bool up : {true, false}) {
    const std::size_t begin = at;
    while (up ? at + 1 < kExponents.size() : at > 0) {
      const Separation next = of(kExponents[up ? at + 1 : at - 1], one, other, margin, outline);
      if (next.excess >= best.excess) break;
      best = next;
      up ? ++at : --at;
    }
    if (at != begin) break;
  }
  return best;
}

}  // namespace

Separation separate(const HalfSides& one, const HalfSides& other, double least_margin,
                    Outline outline) {
  const double margin =
      least_margin < kLeast ? 0 : std::exp2(std::floor(std::log2(least_margin) * 4) / 4);
  using Key = std::tuple<double, double, double, double, double, Outline>;
  thread_local std::map<Key, Separation> known;
  const Key key{one.length, one.width, other.length, other.width, margin, outline};
  if (const auto found = known.find(key); found != known.end()) return found->second;
  if (known.size() >= kMostKnown) known.clear();
  return known[key] = search(one, other, margin, outline);
}

namespace {

/// In logarithms' arguments, which are 0 at the middle.
constexpr double kTiny = 1e-12, kLeastSum = 1e-100;

/// Of the squares of two shares, in parts of what exp(whole) is: the sum of their powers. Such
/// parts are neither too great for their powers, far away, nor are all too small, near the middle.
Expr sum_of_powers(const std::array<Expr, 2>& squares, const Expr& whole, const Expr& half) {
  return exp(half * (log(squares[0] + kTiny) - whole)) +
         exp(half * (log(squares[1] + kTiny) - whole));
}

}  // namespace

Expr square_of_shares(const Expr& dx, const Expr& dy, const Expr& cos, const Expr& sin,
                      const Expr& length, const Expr& width, const Expr& half) {
  const std::array squares = {square((cos * dx + sin * dy) / length),
                              square((cos * dy - sin * dx) / width)};
  const Expr whole = log(squares[0] + squares[1] + kTiny);
  return exp(whole + log(sum_of_powers(squares, whole, half)) / half);
}

Expr square_of_shares(const Frame& one, const Sides& of_one, const Frame& other,
                      const Sides& of_other, const Expr& margin, const Expr& half) {
  const Expr dx = other.x - one.x, dy = other.y - one.y;
  const Expr turn_cos = one.cos * other.cos + one.sin * other.sin;
  const Expr turn_sin = one.cos * other.sin - one.sin * other.cos;
  const Expr c = sqrt(square(turn_cos) + kRounding * kRounding);
  const Expr s = sqrt(square(turn_sin) + kRounding * kRounding);
  const auto squares = [&](const Frame& frame, const Sides& own, const Sides& others) {
    const Expr length = own.length + others.length * c + others.width * s + margin;
    const Expr width = own.width + others.length * s + others.width * c + margin;
    return std::array{square((frame.cos * dx + frame.sin * dy) / length),
                      square((frame.cos * dy - frame.sin * dx) / width)};
  };
  const auto a = squares(one, of_one, of_other), b = squares(other, of_other, of_one);
  const Expr whole = log(a[0] + a[1] + b[0] + b[1] + kTiny);
  const Expr power = kSharp / 2 / half;
  const Expr sum = exp(power * log(sum_of_powers(a, whole, half) + kLeastSum)) +
                   exp(power * log(sum_of_powers(b, whole, half) + kLeastSum));
  return exp(whole + log(sum) / (kSharp / 2));
}

}  // namespace slalom::planner
