#pragma once

#include <vector>

#include "slalom/ocp/problem.hpp"

namespace slalom::planner {

/// Half the length along its own x axis and half the width of a rectangle about its frame's origin
/// [m]; a place has none of either, and no axes.
struct HalfSides {
  double length = 0, width = 0;
  bool is_place() const { return length == 0 && width == 0; }
};

/// How far two convex bodies are apart, in one smooth number. Two rectangles are apart where they
/// are along an axis of one of them (the separating axis theorem: C. Ericson, "Real-time collision
/// detection", 2005, section 5.2). Along each axis i their middles are z_i apart, and both take up
/// r_i: the half side of the one whose axis it is, and what the other reaches along it, |cos| times
/// its one half side and |sin| times the other, of the angle between them. With a margin m that is
/// to be between them, of
///
///     n = (sum over i of |z_i / (r_i + m)|^p)^(1/p),
///
/// which is smooth, goes up from nothing at the middle and is the greatest of its shares for a
/// great p, n >= `most` keeps them m apart: `most` is the greatest n of bodies that are just m
/// apart. To a place there are the two axes of the rectangle alone: a superellipse about it
/// (exponent 2: an ellipse).
struct Separation {
  double exponent = 2;  ///< p
  double most = 1;      ///< as above, for all margins from the least one on
  double excess = 0;    ///< farther apart than m, where n = most, by at most this [m]

  /// What rounds |cos| and |sin| of an exponent: sqrt(cos^2 + rounding^2) and so on.
  static double rounding(double exponent);
};

/// The shape of a body that keeps off.
enum class Outline { rectangle, ellipse };

/// The Separation of a body and another, which is a rectangle or a place, at a least margin [m]: of
/// the exponents from 2 to 32 the least whose excess is at most what is allowed [m]; where none's
/// is, that of the least excess. The first may be an ellipse with these semi-axes if the other is a
/// place.
Separation separate(const HalfSides& one, const HalfSides& other, double least_margin,
                    double allowed, Outline outline = Outline::rectangle);

/// A frame in the plane: its origin and the direction of its x axis.
struct Frame {
  ocp::Expr x, y, cos, sin;
};

/// The square of n to a place that lies (dx, dy) from a rectangle's middle, whose axis has the
/// direction (cos, sin); `length` and `width` are r + m along it and across it, `half` is p / 2.
ocp::Expr square_of_shares(const ocp::Expr& dx, const ocp::Expr& dy, const ocp::Expr& cos,
                           const ocp::Expr& sin, const ocp::Expr& length, const ocp::Expr& width,
                           const ocp::Expr& half);

/// Half sides in an OCP.
struct Sides {
  ocp::Expr length, width;
};
/// The square of n of two rectangles in frames at their middles, a margin [m] between them;
/// `rounding` is Separation's.
ocp::Expr square_of_shares(const Frame& one, const Sides& of_one, const Frame& other,
                           const Sides& of_other, const ocp::Expr& margin, const ocp::Expr& half,
                           const ocp::Expr& rounding);

}  // namespace slalom::planner
