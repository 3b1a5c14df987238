#include "distance_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>

namespace slalom::world {
namespace {

/// The grid's step is this [m], and longer where it would have more points than kPoints.
constexpr double kStep = 1.5;
constexpr double kPoints = 60'000;
/// How far the grid goes beyond start and goal [m].
constexpr double kMargin = 45;
/// An obstacle slower than this stands [m/s].
constexpr double kStands = 0.3;
/// What a place off the grid is farther than the straight line, and one without a way [m].
constexpr double kOff = 20, kShut = 10;
constexpr float kUnreached = 1e9F;

constexpr std::array<std::array<int, 2>, 16> kNeighbours = {{{1, 0},
                                                             {-1, 0},
                                                             {0, 1},
                                                             {0, -1},
                                                             {1, 1},
                                                             {1, -1},
                                                             {-1, 1},
                                                             {-1, -1},
                                                             {2, 1},
                                                             {2, -1},
                                                             {-2, 1},
                                                             {-2, -1},
                                                             {1, 2},
                                                             {1, -2},
                                                             {-1, 2},
                                                             {-1, -2}}};

}  // namespace

void DistanceField::fill(double x, double y, const Goal& goal, const Region& region,
                         const std::vector<Obstacle>& obstacles) {
  goal_ = goal;
  const double left = std::max(std::min(x, goal.x) - kMargin, region.x_min);
  const double right = std::min(std::max(x, goal.x) + kMargin, region.x_max);
  const double below = std::max(std::min(y, goal.y) - kMargin, region.y_min);
  const double above = std::min(std::max(y, goal.y) + kMargin, region.y_max);
  x0_ = left;
  y0_ = below;
  const double width = std::max(0., right - left), height = std::max(0., above - below);
  step_ = std::max(kStep, std::sqrt(width * height / kPoints));
  nx_ = static_cast<int>(width / step_) + 1;
  ny_ = static_cast<int>(height / step_) + 1;
  const std::size_t points = cell(0, ny_);
  distance_.assign(points, kUnreached);
  shut_.assign(points, 0);
  open_.clear();
  for (const auto& o : obstacles) {
    if (std::hypot(o.vx, o.vy) >= kStands) continue;
    const int i0 = std::max(0, static_cast<int>((o.x - o.a - x0_) / step_));
    const int i1 = std::min(nx_ - 1, static_cast<int>((o.x + o.a - x0_) / step_) + 1);
    const int j0 = std::max(0, static_cast<int>((o.y - o.b - y0_) / step_));
    const int j1 = std::min(ny_ - 1, static_cast<int>((o.y + o.b - y0_) / step_) + 1);
    for (int j = j0; j <= j1; ++j)
      for (int i = i0; i <= i1; ++i) {
        const double dx = (x0_ + i * step_ - o.x) / o.a, dy = (y0_ + j * step_ - o.y) / o.b;
        if (dx * dx + dy * dy < 1) shut_[cell(i, j)] = 1;
      }
  }
  for (int j = 0; j < ny_; ++j)
    for (int i = 0; i < nx_; ++i)
      if (goal.outside(x0_ + i * step_, y0_ + j * step_) < -goal.sigma * 0.4 &&
          !shut_[cell(i, j)]) {
        distance_[cell(i, j)] = 0;
        open_.emplace_back(0.F, static_cast<int>(cell(i, j)));
      }
  spread();
}

void DistanceField::spread() {
  std::array<float, kNeighbours.size()> length{};
  for (std::size_t k = 0; k < length.size(); ++k)
    length[k] = static_cast<float>(step_ * std::hypot(kNeighbours[k][0], kNeighbours[k][1]));
  std::make_heap(open_.begin(), open_.end(), std::greater<>());
  while (!open_.empty()) {
    std::pop_heap(open_.begin(), open_.end(), std::greater<>());
    const auto [d, index] = open_.back();
    open_.pop_back();
    if (d > distance_[static_cast<std::size_t>(index)]) continue;
    const int ci = index % nx_, cj = index / nx_;
    for (std::size_t k = 0; k < length.size(); ++k) {
      const int i = ci + kNeighbours[k][0], j = cj + kNeighbours[k][1];
      if (i < 0 || j < 0 || i >= nx_ || j >= ny_ || shut_[cell(i, j)]) continue;
      const float there = d + length[k];
      if (there >= distance_[cell(i, j)]) continue;
      distance_[cell(i, j)] = there;
      open_.emplace_back(there, static_cast<int>(cell(i, j)));
      std::push_heap(open_.begin(), open_.end(), std::greater<>());
    }
  }
}

double DistanceField::at(double x, double y) const {
  const double line = std::max(0., std::hypot(x - goal_.x, y - goal_.y) - goal_.sigma / 2);
  const auto i = std::lround((x - x0_) / step_), j = std::lround((y - y0_) / step_);
  if (i < 0 || j < 0 || i >= nx_ || j >= ny_) return line + kOff;
  const float d = distance_[cell(static_cast<int>(i), static_cast<int>(j))];
  return d == kUnreached ? line + kShut : static_cast<double>(d);
}

}  // namespace slalom::world
