#pragma once

#include <memory>
#include <string>
#include <vector>

#include "slalom/nlp/problem.hpp"
#include "slalom/nlp/solver.hpp"

namespace slalom::nlp {

/// How a number p enters a problem: derivatives by p at an answer, whose x and y are held. Sizes
/// follow Structure.
struct Dependence {
  double objective = 0;          ///< of f
  std::vector<double> gradient;  ///< of the slope of the Lagrangian f + y' g, one for each variable
  std::vector<double> rows;      ///< of g
  Limits limits;                 ///< of the bounds; read where these are finite
};

/// No dependence at all, in the sizes of `shape`.
Dependence no_dependence(const Structure& shape);

/// d/dp of an answer.
struct Sensitivity {
  Start point;           ///< of x, y, zl and zu
  double objective = 0;  ///< of f at x
};

/// Whether an answer has sensitivities.
enum class Regularity {
  regular,
  /// The KKT matrix is singular, since rows depend on each other or nothing determines a variable,
  /// or the answer is no strict minimum.
  irregular,
  invalid_number,  ///< a function gave NaN or infinity
};

/// Parametric sensitivities of answers to problems of one structure, by the implicit function
/// theorem on the primal-dual equations of a barrier parameter mu (Fiacco, Introduction to
/// Sensitivity and Stability Analysis in Nonlinear Programming, 1983, chapter 3; Pirnay,
/// Lopez-Negrete & Biegler, Math. Prog. Comp. 4, 2012, eq. 9 to 12):
///
///   [ H    J'  -I       I     ] [ dx  ]     [ d(gradient of the Lagrangian)/dp ]
///   [ J    0    0       0     ] [ dy  ] = - [ dg/dp less that of the bounds    ]
///   [ Zl   0    X - Xl  0     ] [ dzl ]     [ -Zl dxl/dp                       ]
///   [ -Zu  0    0       Xu - X] [ dzu ]     [  Zu dxu/dp                       ]
///
/// with the rows' slacks likewise. At a floor these are the derivatives of the central point, which
/// moves smoothly. Without one, mu is next to 0 and they are those of the active set: they hold for
/// changes that leave it as it is, and where a bound is about to become active or to leave they lie
/// between those of its two sides. They are as accurate as the answer.
///
/// An answer of any back end will do: the matrix is factorised anew at its point, once for all p.
/// Not thread-safe.
class Sensitivities {
 public:
  /// Takes all memory; `problem` outlives this. Its equations and fixed variables stay those.
  explicit Sensitivities(Problem& problem);
  ~Sensitivities();
  Sensitivities(Sensitivities&&) noexcept;
  Sensitivities& operator=(Sensitivities&&) noexcept;

  /// Evaluates and factorises at an answer, which was solved with `options`, and takes the limits
  /// that the problem has now. Throws InvalidValue for wrong sizes.
  [[nodiscard]] Regularity factorize(const Start& answer, const Options& options);
  /// After Regularity::irregular: the variable or row, by name, that moves most in the
  /// direction in which the equations say least. Empty where none was found.
  std::string undetermined() const;
  /// For Regularity::invalid_number.
  const Fault& fault() const;

  /// Fills `out` for one p, after Regularity::regular. False when rounding spoils it, as in a
  /// matrix that is singular but for rounding.
  [[nodiscard]] bool solve(const Dependence& dependence, Sensitivity& out);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace slalom::nlp
