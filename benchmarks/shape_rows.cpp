#include "shape_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "separation.hpp"
#include "slalom/base/error.hpp"
#include "slalom/world/obstacle.hpp"
#include "smooth_box.hpp"

namespace slalom::bench {
namespace {

using ocp::Bounds;
using ocp::Expr;
using world::Point;

/// A place or a direction in the plane.
struct Vector {
  Expr x, y;
};
Expr dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y;
}
/// A frame: its origin and the direction of its x axis.
struct Frame {
  Vector origin;
  Expr c, s;

  Vector out(const Vector& p) const {
    return {origin.x + c * p.x - s * p.y, origin.y + s * p.x + c * p.y};
  }
  Vector in(const Vector& p) const {
    const Expr dx = p.x - origin.x, dy = p.y - origin.y;
    return {c * dx + s * dy, c * dy - s * dx};
  }
};

/// What all forms know.
struct Parts {
  ocp::Problem& problem;
  const ShapeScene& scene;
  const Vehicle& vehicle;
  Frame body;  ///< the vehicle's
  Expr psi;

  double half_length() const { return vehicle.parameters.length / 2; }
  double half_width() const { return vehicle.parameters.width / 2; }
  /// Of the body's middle ahead of the front axle [m].
  double middle() const { return vehicle.parameters.front_overhang - half_length(); }
};

/// A family of rows over bodies: symbols of a body's pose, and what else a member has.
struct Family {
  std::vector<Expr> symbols;
  std::vector<std::string> names;
  std::vector<std::vector<double>> members;
  Frame frame;

  Family(const Parts& parts, std::vector<Expr> own) {
    const Expr x = Expr::symbol("xo"), y = Expr::symbol("yo"), vx = Expr::symbol("vxo"),
               vy = Expr::symbol("vyo"), t = parts.problem.time();
    symbols = {x, y, vx, vy};
    if (parts.scene.turns()) {
      const Expr psi = Expr::symbol("psio"), omega = Expr::symbol("omega");
      symbols.insert(symbols.end(), {psi, omega});
      frame = {{x + vx * t, y + vy * t}, cos(psi + omega * t), sin(psi + omega * t)};
    } else {
      const Expr c = Expr::symbol("co"), s = Expr::symbol("so");
      symbols.insert(symbols.end(), {c, s});
      frame = {{x + vx * t, y + vy * t}, c, s};
    }
    symbols.insert(symbols.end(), own.begin(), own.end());
  }
  void add(const Parts& parts, const Body& body, const std::vector<double>& own) {
    const world::Pose& p = body.pose;
    std::vector<double> row = {p.x, p.y, p.vx, p.vy};
    if (parts.scene.turns())
      row.insert(row.end(), {p.psi, p.omega});
    else
      row.insert(row.end(), {std::cos(p.psi), std::sin(p.psi)});
    row.insert(row.end(), own.begin(), own.end());
    names.push_back(std::to_string(names.size()));
    members.push_back(row);
  }
  void state(const Parts& parts, const std::string& name, const Expr& value) const {
    parts.problem.set_members(parts.problem.path_family(name, symbols, value, Bounds::at_least(0)),
                              names, members);
  }
};

constexpr int kNoMost = 10000;

/// Rows without variables of their own.
class RowsAlone : public ShapeRows {
 public:
  std::size_t rows() const override { return rows_; }
  std::size_t variables() const override { return 0; }
  void guess(ocp::Guess& /*guess*/, const PoseAt& /*pose*/) const override {}

 protected:
  std::size_t rows_ = 0;
};

/// Circles that cover a body (world::covering_discs), and the smooth distance of the vehicle's
/// rectangle (SmoothBox).
class Discs final : public RowsAlone {
 public:
  Discs(const Parts& parts, double excess) {
    const SmoothBox box(parts.vehicle.footprint, excess);
    const Expr u = Expr::symbol("u"), v = Expr::symbol("v"), r = Expr::symbol("r");
    Family family(parts, {u, v, r});
    for (const Body& body : parts.scene.bodies) {
      world::Obstacle shape;
      shape.outline = std::make_shared<const world::Polygon>(
          world::Polygon::rectangle(body.length, body.width));
      shape.a = shape.b = shape.outline->reach();
      for (const auto& disc : world::covering_discs(shape, excess, kNoMost))
        family.add(parts, body, {disc.x, disc.y, box.smooth_radius(disc.a) + kKept});
    }
    const Vector at = family.frame.out({u, v});
    family.state(
        parts, "disc",
        box.square_of_distance(at.x - parts.body.origin.x, at.y - parts.body.origin.y, parts.psi) /
                square(r) -
            1);
    rows_ = family.members.size();
  }
};

/// The superellipse |u/a|^p + |v/b|^p = 1 that holds a rectangle grown by kKept and sticks out of
/// each side's middle by the same, as little as possible.
struct Superellipse {
  double a, b;

  Superellipse(double half_length, double half_width, double power) {
    const double l = half_length + kKept, w = half_width + kKept;
    double less = 0, more = l;
    while (more - less > 1e-9) {
      const double out = (less + more) / 2;
      double most = 0;  // about the rounded corner
      for (int k = 0; k <= 64; ++k) {
        const double angle = M_PI / 2 * k / 64;
        most =
            std::max(most, std::pow((half_length + kKept * std::cos(angle)) / (l + out), power) +
                               std::pow((half_width + kKept * std::sin(angle)) / (w + out), power));
      }
      (most > 1 ? less : more) = out;
    }
    a = l + more;
    b = w + more;
  }
};

/// In the root of a superellipse's row, which has no derivative at the middle.
constexpr double kRound = 1e-6;

/// Two rectangles are nearest to each other at a corner of one of them: so the corners of each stay
/// out of a superellipse about the other.
class Superellipses final : public RowsAlone {
 public:
  Superellipses(const Parts& parts, double power) {
    const Expr u = Expr::symbol("u"), v = Expr::symbol("v"), a = Expr::symbol("a"),
               b = Expr::symbol("b");
    Family ours(parts, {u, v, a, b}), theirs(parts, {u, v});
    for (const Body& body : parts.scene.bodies) {
      const Superellipse about(body.length / 2, body.width / 2, power);
      for (const Point& p : parts.vehicle.footprint.corners())
        ours.add(parts, body, {p.x, p.y, about.a, about.b});
      for (const Point& p : body.corners()) theirs.add(parts, body, {p.x, p.y});
    }
    const auto outside = [power](const Vector& p, const Expr& a_, const Expr& b_) {
      return pow(pow(p.x / a_, power) + pow(p.y / b_, power) + kRound, 1 / power) - 1;
    };
    ours.state(parts, "corner", outside(ours.frame.in(parts.body.out({u, v})), a, b));
    const Superellipse about(parts.half_length(), parts.half_width(), power);
    Vector at = parts.body.in(theirs.frame.out({u, v}));
    at.x = at.x - parts.middle();
    theirs.state(parts, "corner of theirs", outside(at, about.a, about.b));
    rows_ = ours.members.size() + theirs.members.size();
  }
};

/// As the planner has them: one smooth number of how far two rectangles are apart
/// (planner::Separation).
class Separations final : public RowsAlone {
 public:
  explicit Separations(const Parts& parts) {
    const Expr l = Expr::symbol("l"), w = Expr::symbol("w"), half = Expr::symbol("half"),
               most = Expr::symbol("most");
    Family family(parts, {l, w, half, most});
    const planner::HalfSides ours{parts.half_length(), parts.half_width()};
    for (const Body& body : parts.scene.bodies) {
      const planner::HalfSides theirs{body.length / 2, body.width / 2};
      const auto found = planner::separate(theirs, ours, kKept);
      family.add(parts, body, {theirs.length, theirs.width, found.exponent / 2, found.most});
    }
    const Vector middle = parts.body.out({parts.middle(), 0});
    family.state(parts, "separation",
                 planner::square_of_shares(
                     {family.frame.origin.x, family.frame.origin.y, family.frame.c, family.frame.s},
                     {l, w}, {middle.x, middle.y, parts.body.c, parts.body.s},
                     {ours.length, ours.width}, kKept, half) /
                         square(most) -
                     1);
    rows_ = family.members.size();
  }
};

/// A line between two rectangles: the direction of its normal, from theirs to ours, in their frame
/// [rad], and how far it is from their middle along it [m]. Of those along a side of either the one
/// that parts them most (C. Ericson, "Real-time collision detection", 2005, section 5.2).
struct Line {
  double angle = 0, offset = 0, apart = -INFINITY;

  Line(const Body& body, const Vehicle& vehicle, const world::Pose& at, double t) {
    const world::Pose frame = body.at(t);
    std::vector<Point> ours;
    for (const Point& p : vehicle.corners_at(at)) ours.push_back(frame.to_body(p));
    for (int k = 0; k < 4; ++k)
      for (const double turned : {0., at.psi - frame.psi}) {
        const double direction = turned + k * M_PI / 2;
        const Point n{std::cos(direction), std::sin(direction)};
        double near = INFINITY, far = -INFINITY;
        for (const Point& p : ours) near = std::min(near, world::dot(n, p));
        for (const Point& p : body.corners()) far = std::max(far, world::dot(n, p));
        if (near - far > apart) *this = {direction, (near + far) / 2, near - far};
      }
    angle = std::remainder(angle, 2 * M_PI);
  }

 private:
  Line(double angle_, double offset_, double apart_)
      : angle(angle_), offset(offset_), apart(apart_) {}
};

/// Adds guesses of a line's numbers over time; an angle goes on from one time to the next.
void guess_line(ocp::Guess& guess, const std::string& name, const Body& body,
                const Vehicle& vehicle, const ShapeRows::PoseAt& pose,
                const std::function<double(const Line&)>& value) {
  guess.function(name, [=](double t) { return value(Line(body, vehicle, pose(t), t)); });
}

/// A line between the vehicle and each body at each point, its angle and its offset variables.
class Lines final : public ShapeRows {
 public:
  explicit Lines(const Parts& parts) : bodies_(parts.scene.bodies), vehicle_(parts.vehicle) {
    const Expr t = parts.problem.time();
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      const auto of = " " + std::to_string(k);
      const world::Pose& o = bodies_[k].pose;
      const Expr angle = parts.problem.control("angle" + of, {-7, 7}, 1);
      const Expr offset = parts.problem.control("offset" + of, {}, 1);
      const Expr turned = o.psi + o.omega * t;
      const Frame frame{{o.x + o.vx * t, o.y + o.vy * t}, cos(turned), sin(turned)};
      const Vector n{cos(angle), sin(angle)};
      for (const Point& p : bodies_[k].corners())
        parts.problem.path("theirs" + of + name(), offset - dot(n, {p.x, p.y}),
                           Bounds::at_least(0));
      for (const Point& p : parts.vehicle.footprint.corners())
        parts.problem.path("ours" + of + name(),
                           dot(n, frame.in(parts.body.out({p.x, p.y}))) - offset,
                           Bounds::at_least(kKept));
    }
  }
  std::size_t rows() const override { return 8 * bodies_.size(); }
  std::size_t variables() const override { return 2 * bodies_.size(); }
  void guess(ocp::Guess& guess, const PoseAt& pose) const override {
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      const auto of = " " + std::to_string(k);
      guess_line(guess, "angle" + of, bodies_[k], vehicle_, pose,
                 [](const Line& l) { return l.angle; });
      guess_line(guess, "offset" + of, bodies_[k], vehicle_, pose,
                 [](const Line& l) { return l.offset; });
    }
  }

 private:
  std::string name() { return " corner " + std::to_string(named_++); }

  std::vector<Body> bodies_;
  const Vehicle& vehicle_;
  int named_ = 0;
};

/// The dual of the distance (X. Zhang, A. Liniger, F. Borrelli, "Optimization-based collision
/// avoidance", IEEE Trans. Control Systems Technology 29(3), 2021, Eqn. 17): of their sides A p <=
/// b in their frame and ours G p <= g in ours, l, m >= 0 with (A q - b)^T l - g^T m >= kept for our
/// middle q, G^T m + R^T A^T l = 0 with R turning our frame into theirs, and |A^T l| <= 1.
class Duals final : public ShapeRows {
 public:
  explicit Duals(const Parts& parts) : bodies_(parts.scene.bodies), vehicle_(parts.vehicle) {
    const Expr t = parts.problem.time();
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      const auto of = " " + std::to_string(k);
      std::array<Expr, 4> l, m;
      for (std::size_t i = 0; i < 4; ++i) {
        l[i] = parts.problem.control("l" + std::to_string(i) + of, Bounds::at_least(0), 1);
        m[i] = parts.problem.control("m" + std::to_string(i) + of, Bounds::at_least(0), 1);
      }
      const world::Pose& o = bodies_[k].pose;
      const Expr turned = o.psi + o.omega * t;
      const Frame frame{{o.x + o.vx * t, o.y + o.vy * t}, cos(turned), sin(turned)};
      const Vector q = frame.in(parts.body.out({parts.middle(), 0}));
      const Expr c = cos(parts.psi - turned), s = sin(parts.psi - turned);
      const Vector n{l[0] - l[1], l[2] - l[3]};  // A^T l: the normal of a line between them
      parts.problem.path(
          "apart" + of,
          dot(n, q) - bodies_[k].length / 2 * (l[0] + l[1]) - bodies_[k].width / 2 * (l[2] + l[3]) -
              parts.half_length() * (m[0] + m[1]) - parts.half_width() * (m[2] + m[3]),
          Bounds::at_least(kKept));
      parts.problem.path("along" + of, m[0] - m[1] + c * n.x + s * n.y, Bounds::equal(0));
      parts.problem.path("aside" + of, m[2] - m[3] + c * n.y - s * n.x, Bounds::equal(0));
      parts.problem.path("length" + of, square(n.x) + square(n.y), Bounds::at_most(1));
    }
  }
  std::size_t rows() const override { return 4 * bodies_.size(); }
  std::size_t variables() const override { return 8 * bodies_.size(); }
  void guess(ocp::Guess& guess, const PoseAt& pose) const override {
    for (std::size_t k = 0; k < bodies_.size(); ++k)
      for (std::size_t i = 0; i < 4; ++i) {
        const auto of = std::to_string(i) + " " + std::to_string(k);
        const Body body = bodies_[k];
        const auto side = [i](double angle) {
          return std::max(0., std::cos(angle - std::array{0., M_PI, M_PI / 2, -M_PI / 2}[i]));
        };
        guess_line(guess, "l" + of, body, vehicle_, pose,
                   [=](const Line& l) { return side(l.angle); });
        guess.function("m" + of, [=, this](double t) {
          const world::Pose at = pose(t);
          return side(Line(body, vehicle_, at, t).angle + body.at(t).psi - at.psi + M_PI);
        });
      }
  }

 private:
  std::vector<Body> bodies_;
  const Vehicle& vehicle_;
};

}  // namespace

const std::vector<std::string>& shape_forms() {
  static const std::vector<std::string> forms = {
      "discs-0.4",      "discs-0.2",       "discs-0.1", "discs-0.05", "superellipse-4",
      "superellipse-8", "superellipse-16", "axes",      "line",       "dual"};
  return forms;
}

std::unique_ptr<ShapeRows> make_rows(const std::string& form, const ShapeScene& scene,
                                     ocp::Problem& problem, const Vehicle& vehicle, const Expr& x,
                                     const Expr& y, const Expr& psi) {
  const Parts parts{problem, scene, vehicle, {{x, y}, cos(psi), sin(psi)}, psi};
  const auto dash = form.find('-');
  const std::string kind = form.substr(0, dash);
  const double number = dash == std::string::npos ? 0 : std::stod(form.substr(dash + 1));
  if (kind == "discs") return std::make_unique<Discs>(parts, number);
  if (kind == "superellipse") return std::make_unique<Superellipses>(parts, number);
  if (kind == "axes") return std::make_unique<Separations>(parts);
  if (kind == "line") return std::make_unique<Lines>(parts);
  if (kind == "dual") return std::make_unique<Duals>(parts);
  throw InvalidValue("form", form, "discs-E, superellipse-P, axes, line or dual", {});
}

}  // namespace slalom::bench
