#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slalom/kkt/system.hpp"

namespace slalom::kkt {

/// Where a front's matrix and the names of its rows are kept; both outlive the Front.
struct FrontStorage {
  double* a;           ///< square, column-major
  std::size_t ld;      ///< rows there is room for
  std::uint32_t* ids;  ///< of the rows
  std::uint8_t* order;
};

/// A dense symmetric matrix on which an order of pivots is found.
///
/// eliminate() applies to as many of the first `candidates` rows as have a stable pivot of order 1
/// or 2 (threshold pivoting, Duff & Reid, ACM TOMS 9(3), 1983, section 3), the most stable
/// thresholds first; the others stay, after the eliminated ones, in the Schur complement. Both of
/// its triangles are kept, for the search reads whole columns.
class Front {
 public:
  /// Room to work on matrices of up to `capacity` rows.
  explicit Front(std::size_t capacity) : row0_(capacity), row1_(capacity) {}

  /// Starts a matrix of zeros; `candidates` <= `size` <= storage.ld.
  void reset(const FrontStorage& storage, std::size_t size, std::size_t candidates);
  /// Adds to the entries at (i, j) and (j, i).
  void add(std::size_t i, std::size_t j, double number) {
    a_[j * ld_ + i] += number;
    if (i != j) a_[i * ld_ + j] += number;
  }
  std::size_t eliminated() const { return eliminated_; }

  /// Eliminates what it can, and then, for no more than `most_left` candidates may stay, pivots on
  /// the largest of what is left too, counting vanishing ones as zero.
  Inertia eliminate(std::size_t most_left);

 private:
  bool pick_any(double threshold, Inertia& inertia);
  /// Row j as a pivot, alone or with the candidate that its column is largest at.
  bool pick(std::size_t j, double threshold, Inertia& inertia);
  bool pick_two(std::size_t j, double beside, double others, double threshold, Inertia& inertia);
  void force_one(Inertia& inertia);
  void eliminate_one();
  void eliminate_two();
  void swap(std::size_t i, std::size_t j);
  double* column(std::size_t j) { return a_ + j * ld_; }
  const double* column(std::size_t j) const { return a_ + j * ld_; }
  /// Largest |entry| of column j among rows not eliminated, without rows `j` and `skip`.
  double largest(std::size_t j, std::size_t skip) const;
  double largest_within(std::size_t j, std::size_t from, std::size_t to) const;

  double* a_ = nullptr;
  std::uint32_t* ids_ = nullptr;
  std::uint8_t* order_ = nullptr;
  std::size_t ld_ = 0, size_ = 0, candidates_ = 0, eliminated_ = 0;
  std::size_t next_ = 0;             ///< where the search goes on
  std::vector<double> row0_, row1_;  ///< multipliers times pivot while updating
};

}  // namespace slalom::kkt
