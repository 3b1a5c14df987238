#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slalom/kkt/system.hpp"

namespace slalom::kkt {

/// A dense symmetric matrix on which an order of pivots is found: lower triangle, column-major.
///
/// eliminate() applies to as many of the first `candidates` rows as have a stable pivot of order 1
/// or 2 (threshold pivoting, Duff & Reid, ACM TOMS 9(3), 1983, section 3), the most stable
/// thresholds first; the others stay, after the eliminated ones, in the Schur complement.
class Front {
 public:
  /// Room for matrices of up to `capacity` rows.
  explicit Front(std::size_t capacity);

  /// Starts a matrix of zeros; `candidates` <= `size` <= capacity. ids name its rows.
  void reset(std::size_t size, std::size_t candidates);
  /// Entry of the lower triangle at either (i, j) or (j, i).
  double& at(std::size_t i, std::size_t j) { return i >= j ? a_[j * ld_ + i] : a_[i * ld_ + j]; }
  double at(std::size_t i, std::size_t j) const {
    return i >= j ? a_[j * ld_ + i] : a_[i * ld_ + j];
  }
  std::span<std::uint32_t> ids() { return {ids_.data(), size_}; }
  std::span<const std::uint32_t> ids() const { return {ids_.data(), size_}; }
  /// Of the pivot that starts at a row: 1 or 2; 0 inside a 2.
  std::span<const std::uint8_t> order() const { return {order_.data(), eliminated_}; }
  std::size_t size() const { return size_; }
  std::size_t eliminated() const { return eliminated_; }
  std::size_t remaining_candidates() const { return candidates_ - eliminated_; }

  /// Eliminates what it can; `force`: pivots on what is left too (the last front), counting
  /// vanishing ones as zero.
  Inertia eliminate(bool force);

 private:
  bool pick_pivot(double threshold, Inertia& inertia);
  bool pick_one(std::size_t j, double threshold, Inertia& inertia);
  bool pick_two(std::size_t j, double threshold, Inertia& inertia);
  void force_one(Inertia& inertia);
  void eliminate_one();
  void eliminate_two();
  void swap(std::size_t i, std::size_t j);
  /// Largest |entry| of row/column j below the eliminated part, without rows `j` and `skip`.
  double largest(std::size_t j, std::size_t skip) const;

  std::size_t ld_;
  std::size_t size_ = 0, candidates_ = 0, eliminated_ = 0;
  std::vector<double> a_;
  std::vector<std::uint32_t> ids_;
  std::vector<std::uint8_t> order_;
  std::vector<double> row0_, row1_;  ///< multipliers times pivot while updating
};

}  // namespace slalom::kkt
