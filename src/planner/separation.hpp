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
/// detection", 2005, section 5.2). Along an axis their middles are z apart, and both take up r: the
/// half side of the one whose axis it is, and what the other reaches along it, its one half side
/// times |cos| and its other times |sin| of the angle between them. With a margin m to be kept, the
/// share of an axis is |z| / (r + m), and
///
///     n_i = (share^p + share^p)^(1/p)  of the two axes of rectangle i,
///     n = (n_1^P + n_2^P)^(1/P),  P = 64,
///
/// is smooth and grows in proportion from nothing at the middle: p rounds corners as a margin about
/// them does. n >= `most` keeps them m apart, where `most` is the greatest n of bodies just m
/// apart. Of a rectangle and a place n is n_1 alone: a superellipse about the rectangle, whose
/// exponent 2 is an ellipse. |cos| is sqrt(cos^2 + e^2), e = 1/160, and so is |sin|.
struct Separation {
  double exponent = 2;  ///< p
  double most = 1;      ///< as above, for all margins from the least one on
  double excess = 0;    ///< n = most where they are farther apart than m by at most this [m]
};

/// The shape of a body that keeps off.
enum class Outline { rectangle, ellipse };

/// The Separation of a body and another, which is a rectangle or a place, for all margins from a
/// least one on [m], which is rounded down to a fourth root of a power of 2: by the exponent from 2
/// to 64 of the least excess there. The first may be an ellipse with these semi-axes if the other
/// is a place. Found by trial, in milliseconds; what was asked before is known.
Separation separate(const HalfSides& one, const HalfSides& other, double least_margin,
                    Outline outline = Outline::rectangle);

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
/// The square of n of two rectangles in frames at their middles, for a margin [m] between them.
ocp::Expr square_of_shares(const Frame& one, const Sides& of_one, const Frame& other,
                           const Sides& of_other, const ocp::Expr& margin, const ocp::Expr& half);

}  // namespace slalom::planner
