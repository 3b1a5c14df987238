#include "road_line.hpp"

#include <algorithm>
#include <cstddef>

namespace slalom::world {
namespace {

using Vector = std::vector<double>;

/// Solves a symmetric tridiagonal system, diagonally dominant, by elimination.
Vector tridiagonal(const Vector& off, Vector diagonal, Vector rhs) {
  const std::size_t n = diagonal.size();
  for (std::size_t i = 1; i < n; ++i) {
    const double factor = off[i - 1] / diagonal[i - 1];
    diagonal[i] -= factor * off[i - 1];
    rhs[i] -= factor * rhs[i - 1];
  }
  for (std::size_t i = n; i-- > 0;) {
    if (i + 1 < n) rhs[i] -= off[i] * rhs[i + 1];
    rhs[i] /= diagonal[i];
  }
  return rhs;
}

}  // namespace

Vector spline_curvatures(const Vector& h, const Vector& y) {
  const std::size_t n = y.size();
  const bool closed = h.size() == n;
  const auto chord = [&](std::size_t i) { return (y[(i + 1) % n] - y[i]) / h[i]; };
  if (!closed) {
    Vector m(n, 0);
    if (n < 3) return m;
    Vector off, diagonal, rhs;
    for (std::size_t i = 1; i + 1 < n; ++i) {
      if (i > 1) off.push_back(h[i - 1]);
      diagonal.push_back(2 * (h[i - 1] + h[i]));
      rhs.push_back(6 * (chord(i) - chord(i - 1)));
    }
    const Vector inner = tridiagonal(off, diagonal, rhs);
    std::copy(inner.begin(), inner.end(), m.begin() + 1);
    return m;
  }
  // Cyclic: a tridiagonal matrix and one of rank one (Sherman and Morrison).
  Vector off, diagonal, rhs;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = (i + n - 1) % n;
    if (i > 0) off.push_back(h[before]);
    diagonal.push_back(2 * (h[before] + h[i]));
    rhs.push_back(6 * (chord(i) - chord(before)));
  }
  const double corner = h[n - 1], gamma = -diagonal[0];
  diagonal[0] -= gamma;
  diagonal[n - 1] -= corner * corner / gamma;
  Vector u(n, 0);
  u[0] = gamma;
  u[n - 1] = corner;
  Vector m = tridiagonal(off, diagonal, rhs);
  const Vector z = tridiagonal(off, diagonal, u);
  const double share = (m[0] + corner / gamma * m[n - 1]) / (1 + z[0] + corner / gamma * z[n - 1]);
  for (std::size_t i = 0; i < n; ++i) m[i] -= share * z[i];
  return m;
}

Vector monotone_slopes(const Vector& h, const Vector& y) {
  const std::size_t n = y.size(), intervals = h.size();
  const bool closed = intervals == n;
  Vector slopes(n, 0);
  const auto chord = [&](std::size_t i) { return (y[(i + 1) % n] - y[i]) / h[i]; };
  for (std::size_t i = 0; i < n; ++i) {
    if (!closed && (i == 0 || i + 1 == n)) continue;  // widths are constant beyond the ends
    const std::size_t before = (i + intervals - 1) % intervals;
    const double a = chord(before), b = chord(i);
    if (a * b <= 0) continue;
    const double w1 = 2 * h[i] + h[before], w2 = h[i] + 2 * h[before];
    slopes[i] = (w1 + w2) / (w1 / a + w2 / b);
  }
  return slopes;
}

}  // namespace slalom::world
