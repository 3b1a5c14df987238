#pragma once

#include <cstddef>
#include <cstdint>

namespace slalom::nlp::ipm {

/// Consecutive entries of w with the same sides bounded.
struct Segment {
  std::uint32_t begin, end;
  bool lower, upper;
};

/// The segments that have bounds.
struct Segments {
  const Segment* first;
  std::size_t count;
};

/// What the loops over bounds read: w within lower and upper, its multipliers, and 1 / slack of
/// each side (0 where there is none).
struct BoundedVector {
  const double *w, *lower, *upper, *zl, *zu;
  const double *over_lower, *over_upper;
};

/// Products slack * multiplier over all bounds.
struct Complementarity {
  double largest_gap = 0;               ///< of |s z - mu|
  double least = 0, most = 0, sum = 0;  ///< of s z
};

/// How far a step may go: 1 / (largest alpha that leaves every slack, every multiplier >= 0).
struct StepReach {
  double primal = 0, dual = 0;
};

/// The loops over bounds and rows, compiled for each instruction set.
struct VectorKernels {
  /// over_lower = 1 / (w - lower), over_upper = 1 / (upper - w)
  void (*reciprocals)(Segments segments, const BoundedVector& v, double* over_lower,
                      double* over_upper);
  /// sigma = zl / (w - lower) + zu / (upper - w);  slope = mu / (upper - w) - mu / (w - lower)
  void (*barrier)(Segments segments, const BoundedVector& v, double mu, double* sigma,
                  double* slope);
  Complementarity (*complementarity)(Segments segments, const BoundedVector& v, double mu);
  /// dzl = mu / s - zl - zl dw / s, dzu likewise (Waechter & Biegler 2006, eq. 12).
  StepReach (*dual_step)(Segments segments, const BoundedVector& v, double mu, const double* dw,
                         double* dzl, double* dzu);
  /// Sum of the products slack * multiplier after a step of these lengths.
  double (*products_after)(Segments segments, const BoundedVector& v, double alpha_primal,
                           double alpha_dual, const double* dw, const double* dzl,
                           const double* dzu);
  /// What a step adds to the products beyond first order, over the slack: cl = dw dzl / s,
  /// cu = -dw dzu / s; slope += cl - cu.
  void (*second_order)(Segments segments, const BoundedVector& v, const double* dw,
                       const double* dzl, const double* dzu, double* cl, double* cu, double* slope);
  /// dzl -= cl, dzu -= cu.
  StepReach (*correct_duals)(Segments segments, const BoundedVector& v, const double* dw,
                             const double* cl, const double* cu, double* dzl, double* dzu);
  /// Sum of the logarithms of all slacks; -infinity unless all are positive and normal.
  double (*log_slacks)(Segments segments, const BoundedVector& v);
  /// z += alpha dz, kept within mu / (kappa s) ... kappa mu / s (eq. 16).
  void (*move_duals)(Segments segments, const BoundedVector& v, double mu, double alpha,
                     double kappa, const double* dzl, const double* dzu, double* zl, double* zu);
  /// to = a + alpha b
  void (*combine)(std::size_t n, const double* a, double alpha, const double* b, double* to);
  /// to = c + a b
  void (*multiply_add)(std::size_t n, const double* a, const double* b, const double* c,
                       double* to);
  double (*dot)(std::size_t n, const double* a, const double* b);
  double (*sum_magnitudes)(std::size_t n, const double* a);
  double (*largest_magnitude)(std::size_t n, const double* a);
  /// Largest of max(scale lower - a, a - scale upper, 0) * unit.
  double (*most_outside)(std::size_t n, const double* a, const double* lower, const double* upper,
                         const double* scale, const double* unit);
};

extern const VectorKernels kVectorBaseline;
extern const VectorKernels kVectorAvx2;
extern const VectorKernels kVectorAvx512;
const VectorKernels& vector_kernels();  ///< of the kernel set in use

}  // namespace slalom::nlp::ipm
