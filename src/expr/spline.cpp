#include "slalom/expr/spline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>

#include "op.hpp"
#include "slalom/base/error.hpp"

namespace slalom::expr {
namespace {

using Vector = std::vector<double>;

void check(const Vector& knots, std::size_t values) {
  const std::string where = "spline";
  if (knots.size() < 2)
    throw InvalidValue(where, fmt::format("{} knots", knots.size()), "at least 2");
  if (values != knots.size())
    throw InvalidValue(where, fmt::format("{} values", values),
                       fmt::format("{}, one for each knot", knots.size()));
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!std::isfinite(knots[i]))
      throw InvalidValue(where, fmt::format("knot {} = {}", i, knots[i]), "finite numbers");
    if (i > 0 && !(knots[i] > knots[i - 1]))
      throw InvalidValue(where, fmt::format("knot {} = {} after {}", i, knots[i], knots[i - 1]),
                         "strictly increasing knots");
  }
}

/// Second derivatives at the knots: tridiagonal, diagonally dominant, by elimination.
Vector curvatures(const Vector& x, const Vector& y) {
  const std::size_t n = x.size();
  Vector m(n, 0.0), factor(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = x[i] - x[i - 1], after = x[i + 1] - x[i];
    const double slope_change = (y[i + 1] - y[i]) / after - (y[i] - y[i - 1]) / before;
    const double pivot = 2 * (before + after) - before * factor[i - 1];
    factor[i] = after / pivot;
    m[i] = (6 * slope_change - before * m[i - 1]) / pivot;
  }
  for (std::size_t i = n - 2; i > 0; --i) m[i] -= factor[i] * m[i + 1];
  return m;
}

/// From so many pieces on they are looked up instead of chosen between: a few choices are faster,
/// for they need no branches.
constexpr std::size_t kManyPieces = 64;

/// list[k] for the piece k that x lies in: pieces begin at `begins`. The choice has derivative 0,
/// so that the derivative is that of the piece.
Expr pick(const Expr& x, const Vector& begins, const std::vector<Expr>& list, std::size_t first,
          std::size_t last) {
  if (first == last) return list[first];
  const std::size_t middle = (first + last + 1) / 2;
  return select(x - begins[middle], pick(x, begins, list, middle, last),
                pick(x, begins, list, first, middle - 1));
}

Expr pick(const Expr& x, const Vector& begins, const std::vector<Expr>& list) {
  const bool constant =
      std::all_of(list.begin(), list.end(), [](const Expr& e) { return e.is_constant(); });
  if (!constant || list.size() < kManyPieces) return pick(x, begins, list, 0, list.size() - 1);
  auto steps = std::make_shared<Steps>();
  steps->begins = begins;
  for (const Expr& value : list) steps->values.push_back(value.value());
  return Expr::apply(std::move(steps), x);
}

/// The spline of these values and second derivatives at the knots.
Expr assemble(const Expr& at_x, const Vector& knots, const std::vector<Expr>& values,
              const std::vector<Expr>& m, Beyond beyond) {
  const Expr x = beyond == Beyond::hold ? min(max(at_x, knots.front()), knots.back()) : at_x;
  const std::size_t last = knots.size() - 1;
  // Pieces: the line before the first knot, one from each knot on, the last a line again.
  Vector begins;
  std::vector<Expr> at, value, slope, second, third;
  const auto add = [&](double begin, std::size_t i, const Expr& first_derivative,
                       const Expr& curvature, const Expr& jerk) {
    begins.push_back(begin);
    at.emplace_back(knots[i]);
    value.push_back(values[i]);
    slope.push_back(first_derivative);
    second.push_back(curvature / 2);
    third.push_back(jerk / 6);
  };
  for (std::size_t i = 0; i < last; ++i) {
    const double h = knots[i + 1] - knots[i];
    const Expr chord = (values[i + 1] - values[i]) / h;
    const Expr begin = chord - h * (2 * m[i] + m[i + 1]) / 6;
    if (i == 0) add(knots[0], 0, begin, 0, 0);
    add(knots[i], i, begin, m[i], (m[i + 1] - m[i]) / h);
    if (i + 1 == last) add(knots[last], last, chord + h * (m[i] + 2 * m[i + 1]) / 6, 0, 0);
  }
  const auto chosen = [&](const std::vector<Expr>& list) { return pick(x, begins, list); };
  const Expr d = x - chosen(at);
  const Expr spline =
      chosen(value) + d * (chosen(slope) + d * (chosen(second) + d * chosen(third)));
  if (beyond == Beyond::hold) return spline;
  // Of one value either way, so that Function leaves it away: room_in_tables() knows a table by it.
  return select(min(x - knots.front(), knots.back() - x), spline, spline);
}

}  // namespace

Expr cubic_spline(const Expr& x, const Vector& knots, const Vector& values, Beyond beyond) {
  check(knots, values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      throw InvalidValue("spline", fmt::format("{} at knot {}", values[i], i), "finite numbers");
  const Vector m = curvatures(knots, values);
  return assemble(x, knots, {values.begin(), values.end()}, {m.begin(), m.end()}, beyond);
}

Expr cubic_spline(const Expr& x, const Vector& knots, const std::vector<Expr>& values,
                  Beyond beyond) {
  check(knots, values.size());
  std::vector<Expr> m(knots.size(), Expr(0));  // linear in the values
  for (std::size_t j = 0; j < knots.size(); ++j) {
    Vector unit(knots.size(), 0.0);
    unit[j] = 1;
    const Vector effect = curvatures(knots, unit);
    for (std::size_t i = 0; i < knots.size(); ++i)
      if (effect[i] != 0) m[i] = m[i] + effect[i] * values[j];
  }
  return assemble(x, knots, values, m, beyond);
}

std::vector<Expr> room_in_tables(const std::vector<Expr>& outputs) {
  std::vector<Expr> rooms;
  for (const Node* node : topological_order(outputs))
    if (node->op() == Op::select && node->args()[1].same(node->args()[2]))
      rooms.push_back(node->args()[0]);
  return rooms;
}

std::vector<Expr> without_lookups(const std::vector<Expr>& outputs) {
  std::unordered_map<const Node*, Expr> image;
  const auto of = [&](const Expr& arg) {
    const auto found = image.find(arg.node());
    return found != image.end() ? found->second : arg;
  };
  for (const Node* node : topological_order(outputs)) {
    const auto& args = node->args();
    if (const auto& steps = node->steps()) {
      const std::vector<Expr> values(steps->values.begin(), steps->values.end());
      image.emplace(node, pick(of(args[0]), steps->begins, values, 0, values.size() - 1));
    } else if (std::any_of(args.begin(), args.end(),
                           [&](const Expr& arg) { return image.contains(arg.node()); })) {
      image.emplace(node, args.size() == 1 ? Expr::apply(node->op(), of(args[0]))
                          : args.size() == 2
                              ? Expr::apply(node->op(), of(args[0]), of(args[1]))
                              : Expr::apply(node->op(), of(args[0]), of(args[1]), of(args[2])));
    }
  }
  std::vector<Expr> result;
  for (const Expr& output : outputs) result.push_back(of(output));
  return result;
}

}  // namespace slalom::expr
