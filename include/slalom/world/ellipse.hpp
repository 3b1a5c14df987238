#pragma once

namespace slalom::world {

/// Signed Euclidean distance [m] from a point to the edge of an axis-aligned ellipse: negative
/// inside. (dx, dy) is the point relative to the centre [m]; a, b > 0 are the semi-axes along x and
/// y [m]. Accurate to rounding for any aspect ratio, on the axes and at the centre too.
///
/// Source: D. Eberly, "Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid",
/// Geometric Tools, section 2 (the robust bisection).
double signed_distance_to_ellipse(double dx, double dy, double a, double b);

}  // namespace slalom::world
