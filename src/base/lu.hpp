#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace slalom {

/// Small dense matrices as rows.
template <std::size_t N>
using Square = std::array<std::array<double, N>, N>;

/// M = P L U by Gaussian elimination with partial pivoting (G. Golub and C. Van Loan, Matrix
/// Computations, 4th ed. 2013, algorithm 3.4.1). A singular matrix gives infinities or NaN.
template <std::size_t N>
class Lu {
 public:
  explicit Lu(const Square<N>& matrix) : factors_(matrix) {
    for (std::size_t k = 0; k < N; ++k) {
      pivot_[k] = k;
      for (std::size_t i = k + 1; i < N; ++i)
        if (std::fabs(factors_[i][k]) > std::fabs(factors_[pivot_[k]][k])) pivot_[k] = i;
      std::swap(factors_[k], factors_[pivot_[k]]);
      for (std::size_t i = k + 1; i < N; ++i) {
        const double factor = factors_[i][k] /= factors_[k][k];
        if (factor == 0) continue;
        for (std::size_t j = k + 1; j < N; ++j) factors_[i][j] -= factor * factors_[k][j];
      }
    }
  }

  /// M^-1 times the columns of `right`, in place.
  template <std::size_t Columns>
  void solve(std::array<std::array<double, Columns>, N>& right) const {
    for (std::size_t k = 0; k < N; ++k) std::swap(right[k], right[pivot_[k]]);
    for (std::size_t k = 0; k < N; ++k)
      for (std::size_t i = k + 1; i < N; ++i)
        if (const double factor = factors_[i][k]; factor != 0)
          for (std::size_t j = 0; j < Columns; ++j) right[i][j] -= factor * right[k][j];
    for (std::size_t k = N; k-- > 0;)
      for (std::size_t j = 0; j < Columns; ++j) {
        double value = right[k][j];
        for (std::size_t i = k + 1; i < N; ++i) value -= factors_[k][i] * right[i][j];
        right[k][j] = value / factors_[k][k];
      }
  }

 private:
  Square<N> factors_;
  std::array<std::size_t, N> pivot_;
};

}  // namespace slalom
