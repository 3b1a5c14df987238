#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "slalom/world/road.hpp"

namespace slalom::world {

/// A road as a search sees it, which asks for far more places than the road itself could be asked
/// for: distances to its edges and places along it on a square grid about the corridor and what is
/// near beyond the ends of an open road. Elsewhere the road itself is asked.
class RoadField {
 public:
  explicit RoadField(std::shared_ptr<const Road> road);

  /// How far a place is within the nearer edge [m]; linear between the grid's points. In a curve of
  /// radius R, kCell^2 / 4 R off at the most.
  double edge_distance(double x, double y) const;
  /// Along the road [m], by the nearest point of the grid; of a place on the road.
  double along(double x, double y) const;
  const Road& road() const { return *road_; }

  static constexpr double kCell = 0.5;  ///< [m]

 private:
  static constexpr int kSide = 16;  ///< cells of a block along x and y
  static constexpr int kPoints =
      kSide + 1;  ///< its points; those of its sides are its neighbours' too

  struct Spot {
    const float* block = nullptr;  ///< the first of its points; nullptr off the grid
    double i = 0, j = 0;           ///< within the block [cells]
  };
  Spot spot(double x, double y) const;
  void place();
  void fill();

  std::shared_ptr<const Road> road_;
  double x0_ = 0, y0_ = 0;
  int columns_ = 0, rows_ = 0;
  std::vector<std::int32_t> block_;  ///< by column and row, the number of its block or -1
  std::vector<float> edge_, along_;  ///< block by block, row by row
};

}  // namespace slalom::world
