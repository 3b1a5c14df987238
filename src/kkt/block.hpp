#pragma once

#include <cstddef>
#include <cstdint>

#include "slalom/kkt/system.hpp"

namespace slalom::kkt {

/// Doubles in the widest vector of any instruction set.
inline constexpr std::size_t kMostLanes = 8;

/// A dense symmetric matrix whose first rows are eliminated in a given order of pivots: lower
/// triangle, column-major, leading dimension a multiple of kMostLanes. After factor_block the first
/// `eliminated` columns hold L without its unit diagonal (zero on and above it), the others the
/// Schur complement.
struct Block {
  double* a;
  std::size_t ld, size, eliminated;
  const std::uint8_t* order;  ///< 1 or 2 where a pivot of that order starts, 0 inside a 2
  double* inverse;            ///< D^-1: [2p] the diagonal, [2p + 1] what couples p with p + 1
  double* panel;              ///< room for 4 columns
  double least_ratio;         ///< of a pivot to the largest entry beside it, for factor
};

/// Least ratio of a pivot to the largest entry beside it that a factorisation puts up with. Small,
/// for the systems are refined; large enough to bound the growth in one step by 1e6.
inline constexpr double kLeastRatio = 1e-6;
/// The same of an order just found, with room for it to be kept a while.
inline constexpr double kFoundRatio = 1e-5;
inline constexpr double kTinyPivot = 1e-20;

/// The loops over one block, compiled for each instruction set.
struct BlockKernels {
  /// P A P' = L D L' in the order given; counts the pivots' signs. False as soon as a pivot is not
  /// stable by least_ratio (Duff & Reid, ACM TOMS 9(3), 1983, section 3).
  bool (*factor)(const Block& block, Inertia& inertia);
  /// y <- L^-1 y on the eliminated rows, and their effect on the others. y has ld entries.
  void (*forward)(const Block& block, double* y);
  /// y <- D^-1 y, then L^-T y, on the eliminated rows.
  void (*backward)(const Block& block, double* y);

  // While an order is searched for.
  /// Largest |a| of n numbers; 0 of none.
  double (*largest)(std::size_t n, const double* a);
  /// to -= f x
  void (*subtract_one)(std::size_t n, double f, const double* x, double* to);
  /// to -= f x + g y
  void (*subtract_two)(std::size_t n, double f, const double* x, double g, const double* y,
                       double* to);
};

extern const BlockKernels kBlockBaseline;
extern const BlockKernels kBlockAvx2;
extern const BlockKernels kBlockAvx512;
const BlockKernels& block_kernels();  ///< of the kernel set in use

}  // namespace slalom::kkt
