#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slalom/kkt/system.hpp"

namespace slalom::kkt {

/// A dense symmetric matrix of which the first rows can be eliminated: lower triangle,
/// column-major.
///
/// eliminate() computes P A P' = L D L' for as many of the first `candidates` rows as have a stable
/// pivot of order 1 or 2 (threshold pivoting, Duff & Reid, ACM TOMS 9(3), 1983, section 3); the
/// others stay, after the eliminated ones, in the Schur complement.
class Front {
 public:
  /// Room for matrices of up to `capacity` rows.
  explicit Front(std::size_t capacity);

  /// Starts a matrix of zeros; `candidates` <= `size` <= capacity. ids name its rows.
  void reset(std::size_t size, std::size_t candidates);
  double& at(std::size_t row, std::size_t col) { return a_[col * ld_ + row]; }
  double at(std::size_t row, std::size_t col) const { return a_[col * ld_ + row]; }
  std::span<std::uint32_t> ids() { return {ids_.data(), size_}; }
  std::span<const std::uint32_t> ids() const { return {ids_.data(), size_}; }
  std::size_t size() const { return size_; }
  std::size_t eliminated() const { return eliminated_; }
  std::size_t remaining_candidates() const { return candidates_ - eliminated_; }

  /// Eliminates what it can; `force`: pivots on what is left too (the last front), counting
  /// vanishing ones as zero.
  Inertia eliminate(bool force);

  /// rhs is indexed by id. forward: L^-1 on the eliminated rows and their effect on the others;
  /// backward: D^-1, then L^-T.
  void forward(std::span<double> rhs) const;
  void backward(std::span<double> rhs) const;

 private:
  bool pick_pivot(bool force, Inertia& inertia);
  void eliminate_one(Inertia& inertia);
  void eliminate_two(Inertia& inertia);
  void swap(std::size_t i, std::size_t j);
  /// Largest |entry| of row/column j below the eliminated part, without rows `j` and `skip`.
  double largest(std::size_t j, std::size_t skip) const;
  double symmetric(std::size_t i, std::size_t j) const { return i >= j ? at(i, j) : at(j, i); }

  std::size_t ld_;
  std::size_t size_ = 0, candidates_ = 0, eliminated_ = 0;
  std::vector<double> a_;
  std::vector<std::uint32_t> ids_;
  std::vector<std::uint8_t> order_;  ///< of the pivot that starts at a row: 1 or 2; 0 inside a 2
  std::vector<double> row0_, row1_;  ///< multipliers times pivot while updating
  mutable std::vector<double> work_;
};

}  // namespace slalom::kkt
