#pragma once

#include <memory>
#include <span>
#include <vector>

#include "iterate.hpp"
#include "slalom/kkt/condensed_hessian.hpp"
#include "slalom/kkt/row_blocks.hpp"
#include "slalom/kkt/system.hpp"
#include "slalom/nlp/problem.hpp"
#include "vector_kernels.hpp"

namespace slalom::nlp::ipm {

class RowElimination;

/// The problem as the method sees it, in slack form,
///
///   min f(x)   s.t.   g(x) - s = 0,   wl <= w <= wu,   w = (x, s),
///
/// the slack of an equation being its constant (Waechter & Biegler 2006, eq. 2 and section 3.4).
/// ElasticForm adds elastic parts of the rows to w.
class SlackForm {
 public:
  explicit SlackForm(Problem& problem) : SlackForm(problem, 0) {}
  virtual ~SlackForm() = default;
  SlackForm(const SlackForm&) = delete;

  /// Whether the limits of a problem of this structure can be taken over: the same equations and
  /// fixed variables, and bounds on the same sides.
  bool fits(const Limits& limits) const;
  /// Takes the problem's limits anew, and another problem of the same structure if given one.
  void refresh(Problem& problem);
  /// Scales objective and rows (Waechter & Biegler 2006, section 3.8); all 1 by default.
  void set_scale(double objective, std::span<const double> rows);
  double objective_scale() const { return objective_scale_; }
  /// How far both sides of every inequality move outwards, for rows that leave no interior: rows by
  /// `least`, in the problem's units, bounds of variables by this share of their size, `most` at
  /// most.
  struct Room {
    double least = 0, most = 0;
  };
  /// Takes effect at the next refresh.
  void set_room(Room room) { room_ = room; }
  Room room() const { return room_; }
  std::span<const double> row_scale() const { return row_scale_; }

  Problem& problem() const { return *problem_; }
  const Structure& shape() const { return *shape_; }
  std::size_t variables() const { return shape_->variables; }
  std::size_t rows() const { return shape_->rows; }
  std::size_t primal() const { return lower_.size(); }  ///< entries of w
  std::size_t slack(std::size_t r) const { return variables() + r; }
  bool equation(std::size_t r) const { return equation_[r] != 0; }
  bool fixed(std::size_t i) const { return fixed_[i] != 0; }
  std::span<const char> fixed() const { return fixed_; }
  /// Bounds of w; infinite where there is none, and for what does not move.
  std::span<const double> lower() const { return lower_; }
  std::span<const double> upper() const { return upper_; }
  /// Values of what does not move: fixed variables, equations' slacks.
  double constant(std::size_t i) const { return constants_[i]; }
  Segments segments() const { return {segments_.data(), segments_.size()}; }
  const kkt::RowBlocks& row_blocks() const { return row_blocks_; }
  const kkt::SymmetricRuns& hessian_runs() const { return hessian_runs_; }
  const kkt::CondensedHessian& condensed() const { return condensed_; }
  /// Number of each equation among the equations, and their rows.
  const std::vector<std::uint32_t>& equations() const { return equations_; }
  kkt::Pattern pattern() const;
  /// How the Newton step leaves out the rows' slacks.
  virtual std::unique_ptr<RowElimination> elimination() const;

  /// Evaluates at (w, y); false when a function gave a number that is not finite (see fault()).
  [[nodiscard]] virtual bool evaluate(const Iterate& at, Parts parts, Evaluation& out);
  /// What evaluate() would give of `out`, which was evaluated with all scales 1.
  void scale(Parts parts, Evaluation& out) const;
  const Fault& fault() const { return fault_; }
  /// Counts how often what evaluate() gives at the same (w, y) has changed: all of it, or no more
  /// than the objective and its gradient.
  struct Revision {
    std::uint64_t functions = 1, objective = 1;
  };
  const Revision& revision() const { return revision_; }

  /// Row residuals g - s; returns their 1-norm.
  virtual double residuals(const Evaluation& e, std::span<const double> w,
                           std::span<double> out) const;
  /// Gradient of f + y' (g - s), one for each entry of w.
  virtual void lagrangian_gradient(const Evaluation& e, std::span<const double> y,
                                   std::span<double> out) const;
  /// Change of f + slope' w along dw.
  virtual double derivative_along(const Evaluation& e, std::span<const double> slope,
                                  std::span<const double> dw) const;
  /// Largest violation of a row in the user's units, and the row where it stands.
  double violation(const Evaluation& e) const;
  std::size_t worst_row(const Evaluation& e) const;
  /// Whether every row is met to `tolerance` in the user's unit, or to the rounding of the row's
  /// own terms at w, below which no tolerance can be asked for.
  bool met_to_rounding(const Evaluation& e, std::span<const double> w, double tolerance);
  /// How many sides of variables and slacks have a bound.
  double bounds() const;

 protected:
  /// With `more` entries of w after the slacks, each >= 0.
  SlackForm(Problem& problem, std::size_t more);
  /// Evaluates with the Hessian of objective_factor f + y' g.
  [[nodiscard]] bool evaluate_functions(double objective_factor, const Iterate& at, Parts parts,
                                        Evaluation& out);
  void objective_changed() { ++revision_.objective; }

 private:
  void find_segments();

  Problem* problem_;
  const Structure* shape_;
  std::vector<char> equation_, fixed_;
  std::vector<std::uint32_t> equations_, constant_;  ///< rows; entries of w that do not move
  std::vector<double> lower_, upper_, constants_;
  std::vector<Segment> segments_;
  kkt::RowBlocks row_blocks_;
  kkt::SymmetricRuns hessian_runs_;
  kkt::CondensedHessian condensed_;
  double objective_scale_ = 1;
  Room room_;
  std::vector<double> row_scale_, users_unit_;  ///< by row; users_unit_: user's value / e.rows
  std::vector<double> entry_scale_;             ///< by entry of the Jacobian: that of its row
  std::vector<double> scaled_y_, row_size_;
  bool scaled_ = false;
  Fault fault_;
  Revision revision_;
};

}  // namespace slalom::nlp::ipm
