#include "slalom/kkt/condensed_hessian.hpp"

#include <algorithm>

#include "../base/open_index.hpp"
#include "row_kernels.hpp"

namespace slalom::kkt {
namespace {

/// Finds or makes the place of a pair, of whichever triangle H has it in.
class PlaceIndex {
 public:
  explicit PlaceIndex(std::vector<Pattern::Place>& places) : places_(places) {
    for (std::size_t t = 0; t < places.size(); ++t) add();
  }
  std::uint32_t of(std::uint32_t a, std::uint32_t b) {
    const std::uint64_t wanted = key(a, b);
    const std::size_t found =
        index_.find(wanted, [&](std::size_t t) { return key_of(t) == wanted; });
    if (found != OpenIndex::kNone) return static_cast<std::uint32_t>(found);
    places_.push_back({std::max(a, b), std::min(a, b)});
    add();
    return static_cast<std::uint32_t>(places_.size() - 1);
  }

 private:
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
    return (std::uint64_t{std::max(a, b)} << 32) | std::min(a, b);
  }
  std::uint64_t key_of(std::size_t t) const { return key(places_[t].row, places_[t].col); }
  void add() {
    index_.add([&](std::size_t t) { return key_of(t); });
  }

  std::vector<Pattern::Place>& places_;
  OpenIndex index_;
};

std::uint32_t column(const RowBlocks::Entry& entry, std::uint32_t i) {
  return static_cast<std::uint32_t>(static_cast<std::int64_t>(entry.col) +
                                    static_cast<std::int64_t>(i) * entry.stride);
}

/// 1 or 0 when the targets step evenly by that, else -1.
std::int32_t step_of(const std::vector<std::uint32_t>& targets) {
  for (const std::uint32_t step : {1u, 0u}) {
    bool even = true;
    for (std::size_t i = 1; i < targets.size(); ++i)
      even = even && targets[i] == targets[i - 1] + step;
    if (even) return static_cast<std::int32_t>(step);
  }
  return -1;
}

}  // namespace

CondensedHessian::CondensedHessian(std::span<const std::uint32_t> hessian_row,
                                   std::span<const std::uint32_t> hessian_col,
                                   const RowBlocks& rows, std::span<const char> inequality) {
  for (std::size_t t = 0; t < hessian_row.size(); ++t)
    places_.push_back({hessian_row[t], hessian_col[t]});
  PlaceIndex index(places_);
  std::vector<std::uint32_t> targets;
  for (const auto& block : rows.blocks()) {
    if (!inequality[block.row]) continue;
    for (auto e = block.begin; e < block.end; ++e)
      for (auto f = block.begin; f <= e; ++f) {
        const auto &first = rows.entries()[e], &second = rows.entries()[f];
        targets.clear();
        for (std::uint32_t i = 0; i < block.count; ++i)
          targets.push_back(index.of(column(first, i), column(second, i)));
        Product product{block.row,    block.count, first.value,
                        second.value, targets[0],  step_of(targets)};
        if (product.step < 0) {
          product.target = static_cast<std::uint32_t>(index_.size());
          index_.insert(index_.end(), targets.begin(), targets.end());
        }
        products_.push_back(product);
      }
  }
}

void CondensedHessian::sum(std::span<const double> hessian, std::span<const double> jacobian,
                           std::span<const double> weights, std::span<double> out) const {
  std::copy(hessian.begin(), hessian.end(), out.begin());
  std::fill(out.begin() + static_cast<std::ptrdiff_t>(hessian.size()), out.end(), 0.0);
  row_kernels().condense(products_.data(), products_.size(), index_.data(), jacobian.data(),
                         weights.data(), out.data());
}

}  // namespace slalom::kkt
