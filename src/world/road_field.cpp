#include "road_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace slalom::world {
namespace {

/// Blocks within this of the corridor have a grid [m]; its line is looked at this often, and of an
/// open road so far beyond its ends.
constexpr double kBeyond = 2, kStep = 2, kBeyondEnds = 30;

}  // namespace

RoadField::RoadField(std::shared_ptr<const Road> road) : road_(std::move(road)) {
  place();
  fill();
}

/// The blocks that the corridor touches.
void RoadField::place() {
  constexpr double side = kSide * kCell;
  std::vector<Point> places;
  const double from = road_->closed() ? 0 : -kBeyondEnds, length = road_->length() - 2 * from;
  const double parts = std::ceil(length / kStep);
  for (double k = 0; k <= parts; ++k) {
    const RoadPlace at = road_->at(from + length * k / parts);
    for (double n = -at.right - kBeyond; n < at.left + kBeyond + kStep; n += kStep)
      places.push_back(at.point() + at.aside() * n);
  }
  constexpr double inf = std::numeric_limits<double>::infinity();
  Point least{inf, inf}, most{-inf, -inf};
  for (const Point& p : places) {
    least = {std::min(least.x, p.x), std::min(least.y, p.y)};
    most = {std::max(most.x, p.x), std::max(most.y, p.y)};
  }
  x0_ = least.x - side;
  y0_ = least.y - side;
  columns_ = static_cast<int>((most.x - x0_) / side) + 2;
  rows_ = static_cast<int>((most.y - y0_) / side) + 2;
  block_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), -1);
  std::int32_t count = 0;
  for (const Point& p : places)
    for (const double dx : {-kStep, kStep})
      for (const double dy : {-kStep, kStep}) {
        const auto i = static_cast<std::size_t>((p.x + dx - x0_) / side);
        const auto j = static_cast<std::size_t>((p.y + dy - y0_) / side);
        auto& block = block_[j * static_cast<std::size_t>(columns_) + i];
        if (block < 0) block = count++;
      }
}

void RoadField::fill() {
  constexpr std::size_t points = std::size_t{kPoints} * std::size_t{kPoints};
  const auto blocks = static_cast<std::size_t>(
      std::count_if(block_.begin(), block_.end(), [](auto b) { return b >= 0; }));
  edge_.resize(blocks * points);
  along_.resize(blocks * points);
  for (std::size_t at = 0; at < block_.size(); ++at) {
    if (block_[at] < 0) continue;
    const std::size_t column = at % static_cast<std::size_t>(columns_);
    const std::size_t row = at / static_cast<std::size_t>(columns_);
    std::size_t to = static_cast<std::size_t>(block_[at]) * points;
    for (std::size_t j = 0; j < kPoints; ++j)
      for (std::size_t i = 0; i < kPoints; ++i, ++to) {
        const Point p{x0_ + kCell * static_cast<double>(column * kSide + i),
                      y0_ + kCell * static_cast<double>(row * kSide + j)};
        edge_[to] = static_cast<float>(road_->edge_distance(p));
        along_[to] = static_cast<float>(road_->project(p).s);
      }
  }
}

RoadField::Spot RoadField::spot(double x, double y) const {
  const double u = (x - x0_) / kCell, v = (y - y0_) / kCell;
  const double column = std::floor(u / kSide), row = std::floor(v / kSide);
  if (!(column >= 0 && row >= 0 && column < columns_ && row < rows_)) return {};
  const auto block = block_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                            static_cast<std::size_t>(column)];
  if (block < 0) return {};
  return {edge_.data() + std::ptrdiff_t{block} * kPoints * kPoints, u - kSide * column,
          v - kSide * row};
}

double RoadField::edge_distance(double x, double y) const {
  const Spot at = spot(x, y);
  if (at.block == nullptr) return road_->edge_distance({x, y});
  const auto i = static_cast<std::ptrdiff_t>(at.i), j = static_cast<std::ptrdiff_t>(at.j);
  const double u = at.i - static_cast<double>(i), v = at.j - static_cast<double>(j);
  const float *low = at.block + j * kPoints + i, *high = low + kPoints;
  const auto across = [u](const float* p) {
    return (1 - u) * static_cast<double>(p[0]) + u * static_cast<double>(p[1]);
  };
  return (1 - v) * across(low) + v * across(high);
}

double RoadField::along(double x, double y) const {
  const Spot at = spot(x, y);
  if (at.block == nullptr) return road_->project({x, y}).s;
  const std::ptrdiff_t i = std::lround(at.i), j = std::lround(at.j);
  return static_cast<double>(
      along_[static_cast<std::size_t>(at.block - edge_.data() + j * kPoints + i)]);
}

}  // namespace slalom::world
