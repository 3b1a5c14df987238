#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace slalom::kkt {

/// A sparse matrix seen as blocks of consecutive rows of one shape. Products run over vectors where
/// entries come in runs, row after row, with columns that stay the same or move on by a fixed step.
/// Any other order of entries works too, but slower.
class RowBlocks {
 public:
  /// Entry t stands at (row[t], col[t]); each place once. Rows of different `kind` share no block.
  RowBlocks(std::size_t rows, std::span<const std::uint32_t> row,
            std::span<const std::uint32_t> col, std::span<const char> kind = {});

  /// out = A x; `out` has one number for each row.
  void multiply(std::span<const double> values, std::span<const double> x,
                std::span<double> out) const;
  /// out += A' y.
  void add_transposed(std::span<const double> values, std::span<const double> y,
                      std::span<double> out) const;
  /// out += A' y and out2 += A' y2 in one pass.
  void add_transposed(std::span<const double> values, std::span<const double> y,
                      std::span<const double> y2, std::span<double> out,
                      std::span<double> out2) const;

  /// An entry of every row of a block: row i's value is `value` + i, its column col + i stride.
  struct Entry {
    std::uint32_t value, col;
    std::int32_t stride;
  };
  struct Block {
    std::uint32_t row, count;
    std::uint32_t begin, end;  ///< its entries
  };
  const std::vector<Block>& blocks() const { return blocks_; }
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::vector<Block> blocks_;
  std::vector<Entry> entries_;
};

/// A symmetric matrix given by one triangle, seen as runs in the same way.
class SymmetricRuns {
 public:
  SymmetricRuns(std::span<const std::uint32_t> row, std::span<const std::uint32_t> col);
  /// out += A x.
  void add_product(std::span<const double> values, std::span<const double> x,
                   std::span<double> out) const;

  struct Run {
    std::uint32_t value, count, row, col;
    std::int32_t row_stride, col_stride;
    bool diagonal;  ///< row = col throughout: counts once
  };

 private:
  std::vector<Run> runs_;
};

}  // namespace slalom::kkt
