#pragma once

#include <memory>
#include <string>
#include <vector>

#include "slalom/world/pose.hpp"

namespace slalom::world {

/// What becomes of a body before the first row of its table, and after the last: it stands there;
/// goes on as it moved there; or is not there at all.
enum class BeyondEnd { stands, goes_on, absent };
/// "stands", "goes_on", "absent", in the enum's order.
const std::vector<std::string>& beyond_end_names();

/// One row of a table: absolute time t [s], place [m] and heading psi [rad].
struct TrajectoryRow {
  double t = 0, x = 0, y = 0, psi = 0;
};

/// Bounds of how a body moves over a time: the speed of its point of reference [m/s] and the size
/// of its turn rate [rad/s].
struct Rates {
  double speed = 0, omega = 0;
};

/// A given motion of a body through absolute time. Immutable.
class Trajectory {
 public:
  virtual ~Trajectory() = default;

  /// Where the body is at t [s]; where it is absent, where it last was or first will be.
  virtual Pose at(double t) const = 0;
  /// What speed and turn rate do not exceed from t0 to t1 >= t0 [s].
  virtual Rates fastest(double t0, double t1) const = 0;
  /// Whether the body is there at some time from t0 to t1 [s].
  virtual bool present(double, double) const { return true; }
};

/// The motion of a table, in order of time: place and heading are piecewise cubics whose slopes at
/// the rows are Akima's as modified in MATLAB's "makima" (H. Akima, "A new method of interpolation
/// and smooth curve fitting based on local procedures", J. ACM 17(4), 1970), which do not overshoot
/// where a body comes to rest; and 0 where it is at one place in two rows. Headings of neighbouring
/// rows differ by less than a half turn.
class TableTrajectory final : public Trajectory {
 public:
  /// Throws InvalidValue, naming `where` and the row, for fewer than two rows, numbers that are not
  /// finite, and times that do not rise.
  TableTrajectory(std::vector<TrajectoryRow> rows, BeyondEnd before, BeyondEnd after,
                  const std::string& where);

  Pose at(double t) const override;
  Rates fastest(double t0, double t1) const override;
  bool present(double t0, double t1) const override;

  const std::vector<TrajectoryRow>& rows() const { return rows_; }
  BeyondEnd before() const { return before_; }
  BeyondEnd after() const { return after_; }

 private:
  Pose in_interval(std::size_t k, double t) const;

  std::vector<TrajectoryRow> rows_;    ///< headings without jumps of whole turns
  std::vector<TrajectoryRow> slopes_;  ///< dx/dt, dy/dt, dpsi/dt at each row (t unused)
  std::vector<Rates> bounds_;          ///< of each interval
  BeyondEnd before_, after_;
};

/// A body that goes along a line of points at a speed [m/s] and an acceleration [m/s^2]: from the
/// first point at t = 0, until it stands or has come to the last, where it stands. Heading is the
/// line's direction; about a corner it turns evenly along a quarter of the shorter side, at most 2
/// m before and after.
class PathTrajectory final : public Trajectory {
 public:
  /// Throws InvalidValue, naming `where`, for fewer than two points, numbers that are not finite,
  /// neighbours at one place, a speed below 0, and a speed and an acceleration of 0.
  PathTrajectory(std::vector<Point> points, double speed, double acceleration,
                 const std::string& where);

  Pose at(double t) const override;
  Rates fastest(double t0, double t1) const override;

  const std::vector<Point>& points() const { return points_; }
  double speed() const { return speed_; }
  double acceleration() const { return acceleration_; }

 private:
  /// How far along it is at t, and how fast.
  struct Progress {
    double s, v;
  };
  Progress progress(double t) const;

  std::vector<Point> points_;
  double speed_, acceleration_;
  std::vector<double> length_;             ///< along the line to each point [m]
  std::vector<double> turn_s_, turn_psi_;  ///< heading is linear between these
  double sharpest_ = 0;                    ///< greatest |dpsi/ds| [rad/m]
};

/// The motion of a point fixed to a body that moves as `base`, at `offset` in the body's frame.
class OffsetTrajectory final : public Trajectory {
 public:
  OffsetTrajectory(std::shared_ptr<const Trajectory> base, Point offset)
      : base_(std::move(base)), offset_(offset) {}

  Pose at(double t) const override;
  Rates fastest(double t0, double t1) const override;
  bool present(double t0, double t1) const override { return base_->present(t0, t1); }

  const std::shared_ptr<const Trajectory>& base() const { return base_; }
  Point offset() const { return offset_; }

 private:
  std::shared_ptr<const Trajectory> base_;
  Point offset_;
};

/// The motion `base`, all of it moved by a vector of the world.
class MovedTrajectory final : public Trajectory {
 public:
  MovedTrajectory(std::shared_ptr<const Trajectory> base, Point by)
      : base_(std::move(base)), by_(by) {}

  Pose at(double t) const override;
  Rates fastest(double t0, double t1) const override { return base_->fastest(t0, t1); }
  bool present(double t0, double t1) const override { return base_->present(t0, t1); }

  const std::shared_ptr<const Trajectory>& base() const { return base_; }
  Point by() const { return by_; }

 private:
  std::shared_ptr<const Trajectory> base_;
  Point by_;
};

/// The motion `base`, `factor` times as fast about t0 [s]: as an observer believes it who measures
/// speed wrongly.
class RetimedTrajectory final : public Trajectory {
 public:
  RetimedTrajectory(std::shared_ptr<const Trajectory> base, double t0, double factor)
      : base_(std::move(base)), t0_(t0), factor_(factor) {}

  Pose at(double t) const override;
  Rates fastest(double t0, double t1) const override;
  bool present(double t0, double t1) const override;

  const std::shared_ptr<const Trajectory>& base() const { return base_; }
  double t0() const { return t0_; }
  double factor() const { return factor_; }

 private:
  double base_time(double t) const { return t0_ + factor_ * (t - t0_); }

  std::shared_ptr<const Trajectory> base_;
  double t0_, factor_;
};

/// From a pose at t0 [s] on at its velocity and turn rate: straight on, or along a circle.
class TurningTrajectory final : public Trajectory {
 public:
  TurningTrajectory(double t0, const Pose& pose) : t0_(t0), pose_(pose) {}

  Pose at(double t) const override;
  Rates fastest(double, double) const override {
    return {std::hypot(pose_.vx, pose_.vy), std::fabs(pose_.omega)};
  }

  double t0() const { return t0_; }
  const Pose& pose() const { return pose_; }

 private:
  double t0_;
  Pose pose_;
};

}  // namespace slalom::world
