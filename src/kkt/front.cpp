#include "front.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "block.hpp"

namespace slalom::kkt {
namespace {

/// Least ratios of a pivot to the largest entry beside it, tried in turn before a row is passed on.
constexpr double kThresholds[] = {0.1, 1e-3, kFoundRatio};

}  // namespace

void Front::reset(const FrontStorage& storage, std::size_t size, std::size_t candidates) {
  a_ = storage.a;
  ld_ = storage.ld;
  ids_ = storage.ids;
  order_ = storage.order;
  size_ = size;
  candidates_ = candidates;
  eliminated_ = next_ = 0;
  for (std::size_t col = 0; col < size; ++col) std::fill_n(column(col), size, 0.0);
}

double Front::largest(std::size_t j, std::size_t skip) const {
  const auto [first, second] = std::minmax(j, skip);
  return std::max({largest_within(j, eliminated_, first), largest_within(j, first + 1, second),
                   largest_within(j, second + 1, size_)});
}

double Front::largest_within(std::size_t j, std::size_t from, std::size_t to) const {
  return to > from ? block_kernels().largest(to - from, column(j) + from) : 0;
}

/// Symmetric exchange of rows and columns i and j behind the eliminated ones.
void Front::swap(std::size_t i, std::size_t j) {
  if (i == j) return;
  std::swap_ranges(column(i) + eliminated_, column(i) + size_, column(j) + eliminated_);
  for (std::size_t col = eliminated_; col < size_; ++col) std::swap(column(col)[i], column(col)[j]);
  std::swap(ids_[i], ids_[j]);
}

bool Front::pick(std::size_t j, double threshold, Inertia& inertia) {
  const double candidates =
      std::max(largest_within(j, eliminated_, j), largest_within(j, j + 1, candidates_));
  const double others = largest_within(j, candidates_, size_);
  const double pivot = std::fabs(column(j)[j]);
  if (pivot > kTinyPivot && pivot >= threshold * std::max(candidates, others)) {
    swap(eliminated_, j);
    ++(column(eliminated_)[eliminated_] > 0 ? inertia.positive : inertia.negative);
    eliminate_one();
    return true;
  }
  return candidates > 0 && pick_two(j, candidates, others, threshold, inertia);
}

/// `beside`: the largest |entry| of column j among candidates, whose row is the partner; `others`:
/// among the rest.
bool Front::pick_two(std::size_t j, double beside, double others, double threshold,
                     Inertia& inertia) {
  const double* a_j = column(j);
  std::size_t partner = eliminated_;
  while (partner == j || std::fabs(a_j[partner]) != beside) ++partner;
  const double a = a_j[j], b = a_j[partner], c = column(partner)[partner];
  const double det = a * c - b * b;
  const double bound = std::fabs(det) / threshold;
  if (!(std::fabs(det) > kTinyPivot * kTinyPivot && std::fabs(b) * others <= bound)) return false;
  const double row_j = largest(j, partner), row_p = largest(partner, j);
  if (!(std::fabs(c) * row_j + std::fabs(b) * row_p <= bound &&
        std::fabs(b) * row_j + std::fabs(a) * row_p <= bound))
    return false;
  swap(eliminated_, j);
  swap(eliminated_ + 1, partner == eliminated_ ? j : partner);
  if (det < 0) {
    ++inertia.positive;
    ++inertia.negative;
  } else {
    (a > 0 ? inertia.positive : inertia.negative) += 2;
  }
  eliminate_two();
  return true;
}

/// Goes through the candidates in turn, on from the last pivot.
bool Front::pick_any(double threshold, Inertia& inertia) {
  for (std::size_t tried = eliminated_; tried < candidates_; ++tried, ++next_) {
    if (next_ < eliminated_ || next_ >= candidates_) next_ = eliminated_;
    if (pick(next_, threshold, inertia)) return true;
  }
  return false;
}

/// Nothing left passes.
void Front::force_one(Inertia& inertia) {
  std::size_t best = eliminated_;
  for (std::size_t j = eliminated_; j < candidates_; ++j)
    if (std::fabs(column(j)[j]) > std::fabs(column(best)[best])) best = j;
  swap(eliminated_, best);
  ++inertia.zero;
  column(eliminated_)[eliminated_] = std::numeric_limits<double>::max();
  eliminate_one();
}

void Front::eliminate_one() {
  const BlockKernels& kernels = block_kernels();
  const std::size_t p = eliminated_;
  double* pivot = column(p);
  const double inverse = 1 / pivot[p];
  order_[p] = 1;
  for (std::size_t i = p + 1; i < size_; ++i) {
    row0_[i] = pivot[i];
    pivot[i] *= inverse;
  }
  for (std::size_t col = p + 1; col < size_; ++col)
    if (row0_[col] != 0)
      kernels.subtract_one(size_ - p - 1, row0_[col], pivot + p + 1, column(col) + p + 1);
  ++eliminated_;
}

void Front::eliminate_two() {
  const BlockKernels& kernels = block_kernels();
  const std::size_t p = eliminated_;
  double *first = column(p), *second = column(p + 1);
  const double a = first[p], b = first[p + 1], c = second[p + 1];
  const double det = a * c - b * b;
  order_[p] = 2;
  order_[p + 1] = 0;
  for (std::size_t i = p + 2; i < size_; ++i) {
    row0_[i] = first[i];
    row1_[i] = second[i];
    first[i] = (c * row0_[i] - b * row1_[i]) / det;
    second[i] = (a * row1_[i] - b * row0_[i]) / det;
  }
  for (std::size_t col = p + 2; col < size_; ++col) {
    if (row0_[col] == 0 && row1_[col] == 0) continue;
    kernels.subtract_two(size_ - p - 2, row0_[col], first + p + 2, row1_[col], second + p + 2,
                         column(col) + p + 2);
  }
  eliminated_ += 2;
}

Inertia Front::eliminate(std::size_t most_left) {
  Inertia inertia;
  for (const double threshold : kThresholds)
    while (eliminated_ < candidates_ && pick_any(threshold, inertia)) {
    }
  while (candidates_ - eliminated_ > most_left) {
    bool picked = false;
    for (const double threshold : kThresholds) picked = picked || pick_any(threshold, inertia);
    if (!picked) force_one(inertia);
  }
  return inertia;
}

}  // namespace slalom::kkt
