#include "front.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace slalom::kkt {
namespace {

/// Least ratio of a pivot to the largest entry beside it. Small, for the systems are refined; large
/// enough to bound the growth in one step by 1e6.
constexpr double kThreshold = 1e-6;
constexpr double kTiny = 1e-20;
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

}  // namespace

Front::Front(std::size_t capacity)
    : ld_((capacity + 3) / 4 * 4),
      a_(ld_ * capacity),
      ids_(capacity),
      order_(capacity),
      row0_(capacity),
      row1_(capacity),
      work_(capacity) {}

void Front::reset(std::size_t size, std::size_t candidates) {
  size_ = size;
  candidates_ = candidates;
  eliminated_ = 0;
  for (std::size_t col = 0; col < size; ++col)
    std::fill(&a_[col * ld_ + col], &a_[col * ld_ + size], 0.0);
}

double Front::largest(std::size_t j, std::size_t skip) const {
  double largest = 0;
  for (std::size_t i = eliminated_; i < j; ++i)
    if (i != skip) largest = std::max(largest, std::fabs(at(j, i)));
  const double* column = &a_[j * ld_];
  for (std::size_t i = j + 1; i < size_; ++i)
    if (i != skip) largest = std::max(largest, std::fabs(column[i]));
  return largest;
}

/// Symmetric exchange of rows and columns i < j, eliminated columns included.
void Front::swap(std::size_t i, std::size_t j) {
  if (i == j) return;
  if (i > j) std::swap(i, j);
  for (std::size_t c = 0; c < i; ++c) std::swap(at(i, c), at(j, c));
  for (std::size_t k = i + 1; k < j; ++k) std::swap(at(k, i), at(j, k));
  for (std::size_t r = j + 1; r < size_; ++r) std::swap(at(r, i), at(r, j));
  std::swap(at(i, i), at(j, j));
  std::swap(ids_[i], ids_[j]);
}

bool Front::pick_pivot(bool force, Inertia& inertia) {
  for (std::size_t j = eliminated_; j < candidates_; ++j) {
    const double beside = largest(j, kNone);
    const double pivot = std::fabs(at(j, j));
    if (pivot > kTiny && pivot >= kThreshold * beside) {
      swap(eliminated_, j);
      eliminate_one(inertia);
      return true;
    }
    std::size_t partner = kNone;
    double best = 0;
    for (std::size_t i = eliminated_; i < candidates_; ++i)
      if (i != j && std::fabs(symmetric(i, j)) > best) {
        best = std::fabs(symmetric(i, j));
        partner = i;
      }
    if (partner == kNone) continue;
    const double a = at(j, j), b = symmetric(partner, j), c = at(partner, partner);
    const double det = a * c - b * b;
    const double row_j = largest(j, partner), row_p = largest(partner, j);
    const double bound = std::fabs(det) / kThreshold;
    const bool stable = std::fabs(det) > kTiny * kTiny &&
                        std::fabs(c) * row_j + std::fabs(b) * row_p <= bound &&
                        std::fabs(b) * row_j + std::fabs(a) * row_p <= bound;
    if (!stable) continue;
    swap(eliminated_, j);
    swap(eliminated_ + 1, partner == eliminated_ ? j : partner);
    eliminate_two(inertia);
    return true;
  }
  if (!force || eliminated_ == candidates_) return false;
  // Nothing left passes: only the last front comes here, and what remains is singular.
  std::size_t largest_diagonal = eliminated_;
  for (std::size_t j = eliminated_; j < candidates_; ++j)
    if (std::fabs(at(j, j)) > std::fabs(at(largest_diagonal, largest_diagonal)))
      largest_diagonal = j;
  swap(eliminated_, largest_diagonal);
  ++inertia.zero;
  Inertia ignored;
  at(eliminated_, eliminated_) = std::numeric_limits<double>::max();
  eliminate_one(ignored);
  return true;
}

void Front::eliminate_one(Inertia& inertia) {
  const std::size_t p = eliminated_;
  double* column = &a_[p * ld_];
  const double pivot = column[p], inverse = 1 / pivot;
  ++(pivot > 0 ? inertia.positive : inertia.negative);
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

void Front::eliminate_two(Inertia& inertia) {
  const std::size_t p = eliminated_;
  double* first = &a_[p * ld_];
  double* second = &a_[(p + 1) * ld_];
  const double a = first[p], b = first[p + 1], c = second[p + 1];
  const double det = a * c - b * b;
  if (det < 0) {
    ++inertia.positive;
    ++inertia.negative;
  } else {
    (a > 0 ? inertia.positive : inertia.negative) += 2;
  }
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
  while (eliminated_ < candidates_ && pick_pivot(force, inertia)) {
  }
  return inertia;
}

void Front::forward(std::span<double> rhs) const {
  for (std::size_t i = 0; i < size_; ++i) work_[i] = rhs[ids_[i]];
  for (std::size_t p = 0; p < eliminated_; ++p) {
    const double value = work_[p];
    if (value == 0) continue;
    // The second row of a 2x2 pivot is not coupled to the first by L.
    const double* column = &a_[p * ld_];
    for (std::size_t i = p + (order_[p] == 2 ? 2 : 1); i < size_; ++i)
      work_[i] -= column[i] * value;
  }
  for (std::size_t i = 0; i < size_; ++i) rhs[ids_[i]] = work_[i];
}

void Front::backward(std::span<double> rhs) const {
  for (std::size_t i = 0; i < size_; ++i) work_[i] = rhs[ids_[i]];
  for (std::size_t p = 0; p < eliminated_; ++p) {
    if (order_[p] == 1) {
      work_[p] /= at(p, p);
    } else if (order_[p] == 2) {
      const double a = at(p, p), b = at(p + 1, p), c = at(p + 1, p + 1);
      const double det = a * c - b * b, r0 = work_[p], r1 = work_[p + 1];
      work_[p] = (c * r0 - b * r1) / det;
      work_[p + 1] = (a * r1 - b * r0) / det;
    }
  }
  for (std::size_t p = eliminated_; p-- > 0;) {
    const double* column = &a_[p * ld_];
    double sum = 0;
    for (std::size_t i = p + (order_[p] == 2 ? 2 : 1); i < size_; ++i) sum += column[i] * work_[i];
    work_[p] -= sum;
  }
  for (std::size_t i = 0; i < eliminated_; ++i) rhs[ids_[i]] = work_[i];
}

}  // namespace slalom::kkt
