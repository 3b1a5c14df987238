#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "slalom/world/pose.hpp"

namespace slalom::world {

/// A point of a road's reference line, and how far the road reaches to the right and to the left of
/// it [m].
struct RoadPoint {
  double x = 0, y = 0, right = 0, left = 0;
};

/// What a road is like at s [m] along its reference line: the line's place [m], its direction psi
/// [rad], its curvature [1/m], left positive, and the widths to both sides with their slopes.
struct RoadPlace {
  double s = 0, x = 0, y = 0, psi = 0, curvature = 0;
  double right = 0, left = 0, right_slope = 0, left_slope = 0;

  Point point() const { return {x, y}; }
  Point ahead() const { return {std::cos(psi), std::sin(psi)}; }
  Point aside() const { return {-std::sin(psi), std::cos(psi)}; }  ///< to the left
};

/// Where a place lies on a road: the nearest point of the reference line is s [m] along it, and the
/// place is n [m] off, positive to the left.
struct OnRoad {
  double s = 0, n = 0;
};

/// A road: a reference line with a width to each side. The line is a cubic spline through its
/// points by chord length, periodic where it is closed and natural where it is open, so that its
/// curvature is continuous (C. de Boor, A Practical Guide to Splines, 2001, chapter IV); widths are
/// monotone between the points (F. Fritsch and J. Butland, SIAM J. Sci. Stat. Comput. 5(2), 1984).
/// The corridor is every place whose n lies between the widths. Beyond its ends an open road goes
/// on straight. Immutable.
class Road {
 public:
  /// Throws InvalidValue, naming `where`, for fewer than two points (three of a closed road),
  /// numbers beyond 1e9, neighbours at one place, widths below 0 or of sum 0, a line that turns
  /// about on the spot, and one within its own width of itself. `lanes` are lines that are drawn.
  Road(std::vector<RoadPoint> points, bool closed, std::vector<std::vector<Point>> lanes,
       const std::string& where);

  const std::vector<RoadPoint>& points() const { return points_; }
  const std::vector<std::vector<Point>>& lanes() const { return lanes_; }
  bool closed() const { return closed_; }
  double length() const { return length_; }        ///< of the reference line [m]
  double narrowest() const { return narrowest_; }  ///< sum of both widths where it is least [m]

  /// The road at s [m]; of a closed one any whole number of laps more is the same.
  RoadPlace at(double s) const;
  /// Where a place lies. By the nearest point of the whole line; or of what is within kWindow of
  /// `hint` [m], for what follows one branch of a road that bends back on itself.
  OnRoad project(Point p) const;
  OnRoad project(Point p, double hint) const;
  static constexpr double kWindow = 30;  ///< [m]
  /// s, on a closed road by as many laps more or less as bring it nearest to `near` [m].
  double unwrapped(double s, double near) const {
    return closed_ ? near + std::remainder(s - near, length_) : s;
  }

  /// How far a place is from the nearer edge [m], negative off the road. Exact where widths are
  /// constant; where they change, up to 1 - 1 / hypot(1, steepest) of it too little, never too
  /// much.
  double edge_distance(Point p) const;
  /// The same of all of a convex polygon, at most kSag too little in a curve. Its first corner is
  /// looked for on the whole line, and the others near to it.
  double edge_distance(const std::vector<Point>& corners) const;
  static constexpr double kSag = 0.002;  ///< [m]
  /// What an edge's width changes by at the most along the edge [m/m].
  double steepest() const { return steepest_; }
  /// What the distance to an edge bends by at the most along a straight line on the road [1/m].
  double sharpest() const { return sharpest_; }

  /// Points along an edge, at most `step` [m] of the line apart: for drawing.
  std::vector<Point> edge(bool left, double step) const;
  /// The same road elsewhere.
  std::shared_ptr<const Road> moved(Point by) const;

 private:
  struct Segment {
    Point a, b, c, d;  ///< place = a + v (b + v (c + v d))
    double h = 0;      ///< v goes from 0 to h
    double s = 0, length = 0;
    std::size_t first = 0, pieces = 1;  ///< of pieces_
  };
  /// A part of a segment, so short that it is all but straight.
  struct Piece {
    std::size_t segment;
    double v, s;
    Point begin, end;
    double bend;  ///< bound of what the distance to an edge bends by along a straight line [1/m]
  };
  struct Block {
    Point middle;
    double radius;
  };
  struct Width {
    double value, slope, second;
  };
  struct Foot {
    OnRoad on;
    std::size_t piece;
  };

  static constexpr std::size_t kBlock = 16;  ///< pieces that share a circle about them
  static constexpr double kPiece = 1;        ///< of which none is longer [m]

  void fit();
  void divide();
  void bound();
  void check_apart(const std::string& where) const;
  Point line(const Segment& segment, double v) const;
  double arc(const Segment& segment, double v0, double v1) const;
  Width width(std::size_t segment, double s, double RoadPoint::*side,
              const std::vector<double>& slopes) const;
  std::size_t nearest_piece(Point p) const;
  std::size_t nearest_piece(Point p, std::size_t from, std::size_t count) const;
  std::size_t piece_at(double s) const;
  struct Range {
    std::size_t from, count;
  };
  Range around(double s, std::size_t at, double within) const;
  Foot foot(Point p, std::size_t piece) const;
  double to_edges(const OnRoad& on) const;
  RoadPlace at_inside(double s) const;

  std::vector<RoadPoint> points_;
  std::vector<std::vector<Point>> lanes_;
  bool closed_;
  double length_ = 0, narrowest_ = 0, steepest_ = 0, sharpest_ = 0;
  std::vector<Segment> segments_;
  std::vector<double> right_slope_, left_slope_;  ///< at the points [m/m]
  std::vector<Piece> pieces_;
  std::vector<Block> blocks_;
};

}  // namespace slalom::world
