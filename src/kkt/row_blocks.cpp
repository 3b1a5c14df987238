#include "slalom/kkt/row_blocks.hpp"

#include <algorithm>

#include "../base/kernel_choice.hpp"
#include "row_kernels.hpp"

namespace slalom::kkt {
namespace {

struct EntryRun {
  std::uint32_t value, count, row, col;
  std::int32_t row_stride, col_stride;
};

std::int32_t step(std::uint32_t from, std::uint32_t to) {
  return static_cast<std::int32_t>(to) - static_cast<std::int32_t>(from);
}

/// Longest stretches of entries in which row and column step along evenly; `row_step` is demanded
/// of rows, unless 0.
std::vector<EntryRun> find_runs(std::span<const std::uint32_t> row,
                                std::span<const std::uint32_t> col, std::int32_t row_step) {
  std::vector<EntryRun> runs;
  for (std::size_t t = 0; t < row.size();) {
    EntryRun run{static_cast<std::uint32_t>(t), 1, row[t], col[t], row_step, 0};
    std::size_t next = t + 1;
    if (next < row.size() && (row_step == 0 || step(row[t], row[next]) == row_step)) {
      run.row_stride = step(row[t], row[next]);
      run.col_stride = step(col[t], col[next]);
      while (next < row.size() && step(row[next - 1], row[next]) == run.row_stride &&
             step(col[next - 1], col[next]) == run.col_stride)
        ++next;
    }
    run.count = static_cast<std::uint32_t>(next - t);
    runs.push_back(run);
    t = next;
  }
  return runs;
}

}  // namespace

const RowKernels& row_kernels() {
  return in_use(kRowBaseline, kRowAvx2, kRowAvx512);
}

RowBlocks::RowBlocks(std::size_t rows, std::span<const std::uint32_t> row,
                     std::span<const std::uint32_t> col, std::span<const char> kind) {
  const auto runs = find_runs(row, col, 1);
  std::vector<char> cut(rows + 1, 0);
  cut.front() = cut.back() = 1;
  for (const auto& run : runs) cut[run.row] = cut[run.row + run.count] = 1;
  for (std::size_t r = 1; r < kind.size(); ++r)
    if (kind[r] != kind[r - 1]) cut[r] = 1;

  std::vector<std::vector<Entry>> entries_of(rows);  // by first row of a block
  for (const auto& run : runs)
    for (std::uint32_t i = 0; i < run.count; ++i)
      if (cut[run.row + i])
        entries_of[run.row + i].push_back(
            {run.value + i,
             static_cast<std::uint32_t>(static_cast<std::int64_t>(run.col) +
                                        static_cast<std::int64_t>(i) * run.col_stride),
             run.col_stride});
  for (std::size_t r = 0; r < rows;) {
    std::size_t end = r + 1;
    while (!cut[end]) ++end;
    const auto first = static_cast<std::uint32_t>(entries_.size());
    entries_.insert(entries_.end(), entries_of[r].begin(), entries_of[r].end());
    blocks_.push_back({static_cast<std::uint32_t>(r), static_cast<std::uint32_t>(end - r), first,
                       static_cast<std::uint32_t>(entries_.size())});
    r = end;
  }
}

void RowBlocks::multiply(std::span<const double> values, std::span<const double> x,
                         std::span<double> out) const {
  row_kernels().multiply(blocks_.data(), blocks_.size(), entries_.data(), values.data(), x.data(),
                         out.data());
}

void RowBlocks::add_transposed(std::span<const double> values, std::span<const double> y,
                               std::span<double> out) const {
  row_kernels().transposed(blocks_.data(), blocks_.size(), entries_.data(), values.data(), y.data(),
                           nullptr, out.data(), nullptr);
}

void RowBlocks::add_transposed(std::span<const double> values, std::span<const double> y,
                               std::span<const double> y2, std::span<double> out,
                               std::span<double> out2) const {
  row_kernels().transposed(blocks_.data(), blocks_.size(), entries_.data(), values.data(), y.data(),
                           y2.data(), out.data(), out2.data());
}

SymmetricRuns::SymmetricRuns(std::span<const std::uint32_t> row,
                             std::span<const std::uint32_t> col) {
  for (const auto& run : find_runs(row, col, 0)) {
    std::uint32_t on_diagonal = 0;
    for (std::uint32_t i = 0; i < run.count; ++i)
      on_diagonal += row[run.value + i] == col[run.value + i] ? 1 : 0;
    if (on_diagonal == 0 || on_diagonal == run.count) {
      runs_.push_back({run.value, run.count, run.row, run.col, run.row_stride, run.col_stride,
                       on_diagonal > 0});
      continue;
    }
    for (std::uint32_t i = run.value; i < run.value + run.count; ++i)
      runs_.push_back({i, 1, row[i], col[i], 1, 1, row[i] == col[i]});
  }
}

void SymmetricRuns::add_product(std::span<const double> values, std::span<const double> x,
                                std::span<double> out) const {
  row_kernels().symmetric(runs_.data(), runs_.size(), values.data(), x.data(), out.data());
}

}  // namespace slalom::kkt
