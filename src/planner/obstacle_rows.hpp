#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "separation.hpp"
#include "slalom/ocp/problem.hpp"
#include "slalom/world/footprint.hpp"
#include "slalom/world/obstacle.hpp"

namespace slalom::planner {

/// Of a rectangle about the body's point of reference, or an ellipse's semi-axes.
HalfSides half_sides(const world::Obstacle& obstacle);

/// Rows of an OCP that keep a vehicle off obstacles as stand_ins() leaves them, one for each pair.
/// A point keeps off the paper's ellipses as in its Eqn. 7, and off all else by a Separation; so
/// does a body, of which circles are places with a margin.
class ObstacleRows {
 public:
  /// Each kind is a family of rows.
  enum class Kind {
    round,  ///< plain ellipses; of a body circles alone
    shaped  ///< rectangles; of a point turned ellipses too
  };
  static constexpr Kind kKinds[] = {Kind::round, Kind::shaped};
  static Kind kind_of(const world::Obstacle& obstacle);
  /// How many there are of each kind, and whether any turns, 1 or 0.
  using Counts = std::array<std::size_t, 3>;
  static Counts counts(const std::vector<world::Obstacle>& obstacles);
  /// Of a family; names of rows begin with it.
  static const char* name(Kind kind) {
    return kind == Kind::round ? "obstacle" : "shaped obstacle";
  }

  /// Rows are asked for no smaller margin than `least_margin` [m]. Those of what turns cost more.
  ObstacleRows(const world::Footprint& footprint, double least_margin, bool turns);

  /// The symbols of a row: those of a place first, then of what moves from there.
  std::vector<ocp::Expr> symbols(Kind kind, bool moves) const;
  /// Where an obstacle with a row's numbers is at t [s]; x(), y(), vx() and vy() are symbols.
  ocp::Expr x_at(const ocp::Expr& t) const { return xo_ + vx_ * t; }
  ocp::Expr y_at(const ocp::Expr& t) const { return yo_ + vy_ * t; }
  const ocp::Expr& x() const { return xo_; }
  const ocp::Expr& y() const { return yo_; }
  const ocp::Expr& vx() const { return vx_; }
  const ocp::Expr& vy() const { return vy_; }

  /// At least 0 where a vehicle with heading psi, whose front axle's centre lies (dx, dy) from the
  /// obstacle's, keeps a margin beyond what the numbers have. Without a time, the obstacle does not
  /// turn.
  ocp::Expr outside(Kind kind, const ocp::Expr& dx, const ocp::Expr& dy, const ocp::Expr& psi,
                    const ocp::Expr& margin, const std::optional<ocp::Expr>& t) const;

  struct Moment {
    double t = 0;       ///< absolute [s]
    double around = 0;  ///< a body counts that is there within so long before or after [s]
    bool held = false;  ///< it stands where it is then
  };
  /// The numbers of a row about a moment, in the order of symbols(): of a body that passes with the
  /// obstacle's velocities where it is then. Where it is absent, of one far from everything.
  std::vector<double> numbers(const world::Obstacle& obstacle, const Moment& moment,
                              bool moves) const;
  /// The numbers of one far from everything.
  std::vector<double> nowhere(Kind kind, bool moves) const;

 private:
  ocp::Expr to_shape(const ocp::Expr& dx, const ocp::Expr& dy, const ocp::Expr& psi,
                     const ocp::Expr& margin, const std::optional<ocp::Expr>& t) const;

  bool point_, turns_;
  HalfSides vehicle_;
  double middle_ = 0;  ///< of the vehicle's rectangle ahead of the front axle [m]
  double least_margin_;
  /// a, b: what shares are of along and across, margins in them; of two rectangles theirs alone.
  ocp::Expr xo_, yo_, a_, b_, vx_, vy_;
  ocp::Expr grown_, co_, so_, omega_, at_;  ///< margins; direction, at the time `at`; turn rate
  ocp::Expr half_, share_;                  ///< p/2, and 1/most^2
};

}  // namespace slalom::planner
