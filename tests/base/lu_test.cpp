#include "../../src/base/lu.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace slalom {
namespace {

TEST(Lu, SolvesWhatNeedsPivots) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    Square<6> matrix;
    std::array<std::array<double, 2>, 6> x, right{};
    for (std::size_t i = 0; i < 6; ++i) {
      for (double& entry : matrix[i]) entry = std::fabs(any(random)) < 0.3 ? 0 : any(random);
      x[i] = {any(random), any(random)};
    }
    matrix[0][0] = 0;
    for (std::size_t i = 0; i < 6; ++i) matrix[(i + 1) % 6][i] += 3;  // regular
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j)
        for (std::size_t c = 0; c < 2; ++c) right[i][c] += matrix[i][j] * x[j][c];
    Lu<6>(matrix).solve(right);
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t c = 0; c < 2; ++c) EXPECT_NEAR(right[i][c], x[i][c], 1e-12);
  }
}

TEST(Lu, ASingularMatrixGivesNoNumbers) {
  std::array<std::array<double, 1>, 2> right{{{1}, {1}}};
  Lu<2>(Square<2>{{{1, 1}, {1, 1}}}).solve(right);
  EXPECT_FALSE(std::isfinite(right[0][0]));
}

}  // namespace
}  // namespace slalom
