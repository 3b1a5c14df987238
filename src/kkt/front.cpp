#include "front.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "block.hpp"

namespace slalom::kkt {
namespace {

/// Least ratios of a pivot to the largest entry beside it, tried in turn before a row is passed on;
/// the last leaves kLeastRatio room for rounding.
constexpr double kThresholds[] = {0.1, 1e-3, 10 * kLeastRatio};
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

}  // namespace

Front::Front(std::size_t capacity)
    : ld_(capacity),
      a_(ld_ * capacity),
      ids_(capacity),
      order_(capacity),
      row0_(capacity),
      row1_(capacity) {}

void Front::reset(std::size_t size, std::size_t candidates) {
  size_ = size;
  candidates_ = candidates;
  eliminated_ = 0;
  for (std::size_t col = 0; col < size; ++col) std::fill_n(&a_[col * ld_ + col], size - col, 0.0);
}

double Front::largest(std::size_t j, std::size_t skip) const {
  double largest = 0;
  for (std::size_t i = eliminated_; i < size_; ++i)
    if (i != skip && i != j) largest = std::max(largest, std::fabs(at(i, j)));
  return largest;
}

/// Symmetric exchange of rows and columns i < j behind the eliminated ones.
void Front::swap(std::size_t i, std::size_t j) {
  if (i == j) return;
  if (i > j) std::swap(i, j);
  for (std::size_t k = eliminated_; k < size_; ++k)
    if (k != i && k != j) std::swap(at(k, i), at(k, j));
  std::swap(at(i, i), at(j, j));
  std::swap(ids_[i], ids_[j]);
}

bool Front::pick_one(std::size_t j, double threshold, Inertia& inertia) {
  const double pivot = std::fabs(at(j, j));
  if (!(pivot > kTinyPivot && pivot >= threshold * largest(j, kNone))) return false;
  swap(eliminated_, j);
  ++(at(eliminated_, eliminated_) > 0 ? inertia.positive : inertia.negative);
  eliminate_one();
  return true;
}

bool Front::pick_two(std::size_t j, double threshold, Inertia& inertia) {
  std::size_t partner = kNone;
  double best = 0;
  for (std::size_t i = eliminated_; i < candidates_; ++i)
    if (i != j && std::fabs(at(i, j)) > best) {
      best = std::fabs(at(i, j));
      partner = i;
    }
  if (partner == kNone) return false;
  const double a = at(j, j), b = at(partner, j), c = at(partner, partner);
  const double det = a * c - b * b;
  const double row_j = largest(j, partner), row_p = largest(partner, j);
  const double bound = std::fabs(det) / threshold;
  if (!(std::fabs(det) > kTinyPivot * kTinyPivot &&
        std::fabs(c) * row_j + std::fabs(b) * row_p <= bound &&
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

bool Front::pick_pivot(double threshold, Inertia& inertia) {
  for (std::size_t j = eliminated_; j < candidates_; ++j)
    if (pick_one(j, threshold, inertia) || pick_two(j, threshold, inertia)) return true;
  return false;
}

/// Nothing left passes: only the last front comes here, and what remains is singular.
void Front::force_one(Inertia& inertia) {
  std::size_t best = eliminated_;
  for (std::size_t j = eliminated_; j < candidates_; ++j)
    if (std::fabs(at(j, j)) > std::fabs(at(best, best))) best = j;
  swap(eliminated_, best);
  ++inertia.zero;
  at(eliminated_, eliminated_) = std::numeric_limits<double>::max();
  eliminate_one();
}

void Front::eliminate_one() {
  const std::size_t p = eliminated_;
  double* column = &a_[p * ld_];
  const double inverse = 1 / column[p];
  order_[p] = 1;
  for (std::size_t i = p + 1; i < size_; ++i) {
    row0_[i] = column[i];
    column[i] *= inverse;
  }
  for (std::size_t c = p + 1; c < size_; ++c) {
    const double factor = row0_[c];
    if (factor == 0) continue;
    double* to = &a_[c * ld_];
    for (std::size_t i = c; i < size_; ++i) to[i] -= factor * column[i];
  }
  ++eliminated_;
}

void Front::eliminate_two() {
  const std::size_t p = eliminated_;
  double* first = &a_[p * ld_];
  double* second = &a_[(p + 1) * ld_];
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
    const double f0 = row0_[col], f1 = row1_[col];
    if (f0 == 0 && f1 == 0) continue;
    double* to = &a_[col * ld_];
    for (std::size_t i = col; i < size_; ++i) to[i] -= f0 * first[i] + f1 * second[i];
  }
  eliminated_ += 2;
}

Inertia Front::eliminate(bool force) {
  Inertia inertia;
  for (const double threshold : kThresholds)
    while (eliminated_ < candidates_ && pick_pivot(threshold, inertia)) {
    }
  if (force)
    while (eliminated_ < candidates_) {
      bool picked = false;
      for (const double threshold : kThresholds) picked = picked || pick_pivot(threshold, inertia);
      if (!picked) force_one(inertia);
    }
  return inertia;
}

}  // namespace slalom::kkt
