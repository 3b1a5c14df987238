#include "goal_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace slalom::world {
namespace {

constexpr double kCell = 1.5;           ///< [m]; twice, four times ... that for a far goal
constexpr double kMargin = 45;          ///< of the box around start and goal [m]
constexpr double kMostCells = 1 << 16;  ///< of the box
constexpr double kStands = 0.3;         ///< what is slower stands [m/s]

struct Neighbour {
  int di, dj;
  float length;  ///< in cells
};
constexpr float kRoot2 = 1.41421356F, kRoot5 = 2.23606798F;
constexpr std::array<Neighbour, 16> kNeighbours = {{{-1, -2, kRoot5},
                                                    {1, -2, kRoot5},
                                                    {-2, -1, kRoot5},
                                                    {-1, -1, kRoot2},
                                                    {0, -1, 1},
                                                    {1, -1, kRoot2},
                                                    {2, -1, kRoot5},
                                                    {-1, 0, 1},
                                                    {1, 0, 1},
                                                    {-2, 1, kRoot5},
                                                    {-1, 1, kRoot2},
                                                    {0, 1, 1},
                                                    {1, 1, kRoot2},
                                                    {2, 1, kRoot5},
                                                    {-1, 2, kRoot5},
                                                    {1, 2, kRoot5}}};

}  // namespace

void GoalField::build(const Frame& frame, double start_x, double start_y, double half_u,
                      double half_w, const Region& region, const std::vector<Ellipse>& obstacles) {
  half_u_ = half_u;
  place_box(frame.u(start_x, start_y), frame.w(start_x, start_y));
  shut(frame, region, obstacles);
  open_.clear();
  const int in_u = static_cast<int>(half_u / h_), in_w = static_cast<int>(half_w / h_);
  for (int j = std::max(-in_w - j0_, 0); j <= std::min(in_w - j0_, rows_ - 1); ++j)
    for (int i = std::max(-in_u - i0_, 0); i <= std::min(in_u - i0_, columns_ - 1); ++i)
      if (const auto at = j * columns_ + i; !shut_[static_cast<std::size_t>(at)]) {
        length_[static_cast<std::size_t>(at)] = 0;
        open_.emplace_back(0.0F, at);
      }
  std::make_heap(open_.begin(), open_.end(), std::greater<>());
  spread();
}

void GoalField::place_box(double start_u, double start_w) {
  const double u0 = std::min(start_u, 0.0) - kMargin, u1 = std::max(start_u, 0.0) + kMargin;
  const double w0 = std::min(start_w, 0.0) - kMargin, w1 = std::max(start_w, 0.0) + kMargin;
  h_ = kCell;
  while ((u1 - u0) / h_ * ((w1 - w0) / h_) > kMostCells) h_ *= 2;
  i0_ = static_cast<int>(std::floor(u0 / h_));
  j0_ = static_cast<int>(std::floor(w0 / h_));
  columns_ = static_cast<int>(std::ceil(u1 / h_)) - i0_ + 1;
  rows_ = static_cast<int>(std::ceil(w1 / h_)) - j0_ + 1;
}

void GoalField::shut(const Frame& frame, const Region& region,
                     const std::vector<Ellipse>& obstacles) {
  const auto cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  length_.assign(cells, 2 * kFar);
  shut_.resize(cells);
  std::size_t at = 0;
  for (int j = j0_; j < j0_ + rows_; ++j)
    for (int i = i0_; i < i0_ + columns_; ++i, ++at)
      shut_[at] = !region.contains(frame.x(i * h_, j * h_), frame.y(i * h_, j * h_));
  for (const auto& o : obstacles)
    if (o.moments < 0 && o.vx * o.vx + o.vy * o.vy < kStands * kStands) shut(frame, o);
}

void GoalField::shut(const Frame& frame, const Ellipse& obstacle) {
  const double reach = std::max(obstacle.a, obstacle.b) / h_;
  const double i = frame.u(obstacle.x, obstacle.y) / h_ - i0_;
  const double j = frame.w(obstacle.x, obstacle.y) / h_ - j0_;
  const auto first = [](double at) { return static_cast<int>(std::ceil(std::max(at, 0.0))); };
  const auto last = [](double at, int count) {
    return static_cast<int>(std::floor(std::min(at, count - 1.0)));
  };
  for (int row = first(j - reach); row <= last(j + reach, rows_); ++row)
    for (int column = first(i - reach); column <= last(i + reach, columns_); ++column) {
      const int at = row * columns_ + column;
      const double u = (column + i0_) * h_, w = (row + j0_) * h_;
      if (obstacle.contains(frame.x(u, w), frame.y(u, w))) shut_[static_cast<std::size_t>(at)] = 1;
    }
}

void GoalField::spread() {
  while (!open_.empty()) {
    std::pop_heap(open_.begin(), open_.end(), std::greater<>());
    const auto [length, at] = open_.back();
    open_.pop_back();
    if (length > length_[static_cast<std::size_t>(at)]) continue;
    const int i = at % columns_, j = at / columns_;
    for (const auto& n : kNeighbours) {
      if (i + n.di < 0 || i + n.di >= columns_ || j + n.dj < 0 || j + n.dj >= rows_) continue;
      const int to = at + n.dj * columns_ + n.di;
      const float longer = length + n.length * static_cast<float>(h_);
      if (shut_[static_cast<std::size_t>(to)] || longer >= length_[static_cast<std::size_t>(to)])
        continue;
      length_[static_cast<std::size_t>(to)] = longer;
      open_.emplace_back(longer, to);
      std::push_heap(open_.begin(), open_.end(), std::greater<>());
    }
  }
}

}  // namespace slalom::world
