#pragma once

#include <cstddef>
#include <cstdint>

#include "slalom/kkt/condensed_hessian.hpp"
#include "slalom/kkt/row_blocks.hpp"

namespace slalom::kkt {

/// The loops over rows, compiled for each instruction set. `y2`, `out2` may be null.
struct RowKernels {
  void (*multiply)(const RowBlocks::Block* blocks, std::size_t count,
                   const RowBlocks::Entry* entries, const double* values, const double* x,
                   double* out);
  void (*transposed)(const RowBlocks::Block* blocks, std::size_t count,
                     const RowBlocks::Entry* entries, const double* values, const double* y,
                     const double* y2, double* out, double* out2);
  void (*symmetric)(const SymmetricRuns::Run* runs, std::size_t count, const double* values,
                    const double* x, double* out);
  void (*condense)(const CondensedHessian::Product* products, std::size_t count,
                   const std::uint32_t* index, const double* jacobian, const double* weights,
                   double* out);
};

extern const RowKernels kRowBaseline;
extern const RowKernels kRowAvx2;
extern const RowKernels kRowAvx512;
const RowKernels& row_kernels();  ///< of the kernel set in use

}  // namespace slalom::kkt
