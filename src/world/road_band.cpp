#include "road_band.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace slalom::world {
namespace {

/// Steps of the splitting method at the most, and the residual at which it ends [m].
constexpr int kSteps = 120;
constexpr double kResidual = 0.005;
/// The length that belongs to its penalty [m]: bends as long are found soonest.
constexpr double kPenaltyLength = 4;
/// The bounds follow the bends of so many answers, taken over so many metres about a place.
constexpr int kRounds = 3;
constexpr std::ptrdiff_t kAround = 4;
/// The sharpest bend that bounds allow for [1/m].
constexpr double kSharpest = 0.3;

/// A symmetric matrix with two bands beside its diagonal, as L D L'.
class Pentadiagonal {
 public:
  explicit Pentadiagonal(std::size_t size) : d_(size), e_(size), f_(size) {}
  double& at(std::size_t k, std::size_t band) {
    return band == 0 ? d_[k] : band == 1 ? e_[k] : f_[k];
  }

  void factorise() {
    for (std::size_t k = 0; k < d_.size(); ++k) {
      if (k >= 1) d_[k] -= e_[k - 1] * e_[k - 1] * d_[k - 1];
      if (k >= 2) d_[k] -= f_[k - 2] * f_[k - 2] * d_[k - 2];
      // e_[k] and f_[k] couple k to k + 1 and k + 2.
      if (k >= 1) e_[k] -= e_[k - 1] * f_[k - 1] * d_[k - 1];
      e_[k] /= d_[k];
      f_[k] /= d_[k];
    }
  }
  void solve(std::vector<double>& x) const {
    const std::size_t n = d_.size();
    for (std::size_t k = 0; k < n; ++k) {
      if (k >= 1) x[k] -= e_[k - 1] * x[k - 1];
      if (k >= 2) x[k] -= f_[k - 2] * x[k - 2];
    }
    for (std::size_t k = 0; k < n; ++k) x[k] /= d_[k];
    for (std::size_t k = n; k-- > 0;) {
      if (k + 1 < n) x[k] -= e_[k] * x[k + 1];
      if (k + 2 < n) x[k] -= f_[k] * x[k + 2];
    }
  }

 private:
  std::vector<double> d_, e_, f_;
};

/// The problem in the offsets n: places of the line and the directions aside of it, and bounds.
struct Problem {
  std::vector<Point> line, aside;
  std::vector<double> right, left, lower, upper;

  /// The curvature of the line's and of the offsets' path about a place.
  double bend(const std::vector<double>& n, std::size_t k) const {
    const auto last = static_cast<std::ptrdiff_t>(line.size()) - 1;
    const auto at = [&](std::ptrdiff_t j) {
      const auto i = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(j, 0, last));
      return line[i] + aside[i] * n[i];
    };
    const auto here = static_cast<std::ptrdiff_t>(k);
    const Point a = at(here) - at(here - kAround), b = at(here + kAround) - at(here);
    const double length = (a.norm() + b.norm()) / 2;
    if (!(length > 0)) return 0;
    return std::clamp(std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y) / length, -kSharpest,
                      kSharpest);
  }
};

/// Where the front axle's centre may be: the body's ends are off its path in a bend, the rear axle
/// inside, the front end outside.
void set_bounds(Problem& problem, const std::vector<double>& n, const vehicle::Parameters& p,
                const RoadBand& band) {
  const bool point = p.footprint == vehicle::FootprintKind::point;
  const double half = point ? 0 : p.width / 2, axles = p.la + p.lb;
  const double inside = point ? 0 : axles * axles / 2;
  const double outside = point ? 0 : p.front_overhang * (axles + p.front_overhang / 2);
  for (std::size_t k = 0; k < n.size(); ++k) {
    const double bend = problem.bend(n, k), to_left = std::max(bend, 0.),
                 to_right = std::max(-bend, 0.);
    double right = band.spare - problem.right[k], left = problem.left[k] - band.spare;
    const double s = band.from + RoadBand::kStep * static_cast<double>(k);
    for (const Narrowing& narrow : band.narrowings) {
      if (s < narrow.from || s > narrow.to) continue;
      if (narrow.on_the_left)
        left = std::min(left, narrow.edge);
      else
        right = std::max(right, narrow.edge);
    }
    problem.lower[k] = right + half + to_right * inside + to_left * outside;
    problem.upper[k] = left - half - to_left * inside - to_right * outside;
    if (problem.lower[k] > problem.upper[k])
      problem.lower[k] = problem.upper[k] = (problem.lower[k] + problem.upper[k]) / 2;
  }
}

/// Alternating directions (S. Boyd et al., "Distributed optimization and statistical learning via
/// the alternating direction method of multipliers", 2011, section 5.2) for the squares of bends
/// and of distances from the offset wanted, within the bounds. The first places are kept.
void relax(const Problem& problem, const RoadBand& band, std::vector<double>& n) {
  constexpr std::size_t kept = 3;
  const std::size_t size = n.size();
  if (size <= kept) return;
  const double h4 = std::pow(RoadBand::kStep, 4);
  const double drawn = h4 / std::pow(band.over / 2, 4),
               penalty = h4 / std::pow(kPenaltyLength / 2, 4);
  Pentadiagonal matrix(size - kept);
  std::vector<double> rhs(size - kept, drawn * band.wanted);
  for (std::size_t k = 0; k + kept < size; ++k) matrix.at(k, 0) = drawn + penalty;
  constexpr std::array weight = {1., -2., 1.};
  for (std::size_t k = 1; k + 1 < size; ++k) {
    const Point line = problem.line[k - 1] - problem.line[k] * 2 + problem.line[k + 1];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t row = k - 1 + i;
      if (row < kept) continue;
      const Point ni = problem.aside[row] * weight[i];
      rhs[row - kept] -= ni.x * line.x + ni.y * line.y;
      for (std::size_t j = 0; j < 3; ++j) {
        const std::size_t column = k - 1 + j;
        const Point nj = problem.aside[column] * weight[j];
        const double product = ni.x * nj.x + ni.y * nj.y;
        if (column < kept)
          rhs[row - kept] -= product * n[column];
        else if (column >= row)
          matrix.at(row - kept, column - row) += product;
      }
    }
  }
  matrix.factorise();
  std::vector<double> x(size - kept), z(size - kept), u(size - kept, 0);
  for (std::size_t k = 0; k < z.size(); ++k)
    z[k] = std::clamp(n[k + kept], problem.lower[k + kept], problem.upper[k + kept]);
  for (int step = 0; step < kSteps; ++step) {
    for (std::size_t k = 0; k < x.size(); ++k) x[k] = rhs[k] + penalty * (z[k] - u[k]);
    matrix.solve(x);
    double residual = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      const double to = std::clamp(x[k] + u[k], problem.lower[k + kept], problem.upper[k + kept]);
      residual = std::max({residual, std::fabs(x[k] - to), std::fabs(to - z[k])});
      z[k] = to;
      u[k] += x[k] - to;
    }
    if (residual < kResidual) break;
  }
  // Smooth, where the bounds are kept but for the residual.
  for (std::size_t k = 0; k < x.size(); ++k) n[k + kept] = x[k];
}

}  // namespace

std::vector<double> offsets_of(const RoadBand& band, const Road& road,
                               const vehicle::Parameters& vehicle, std::size_t count) {
  Problem problem;
  for (std::size_t k = 0; k < count; ++k) {
    const RoadPlace at = road.at(band.from + RoadBand::kStep * static_cast<double>(k));
    problem.line.push_back(at.point());
    problem.aside.push_back(at.aside());
    problem.right.push_back(at.right);
    problem.left.push_back(at.left);
  }
  problem.lower.resize(count);
  problem.upper.resize(count);
  std::vector<double> n(count, band.wanted);
  std::copy(band.first.begin(), band.first.end(), n.begin());
  for (int round = 0; round < kRounds; ++round) {
    set_bounds(problem, n, vehicle, band);
    relax(problem, band, n);
  }
  return n;
}

}  // namespace slalom::world
