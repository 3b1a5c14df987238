#include "line_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "in_terms_of.hpp"
#include "slalom/base/error.hpp"
#include "slalom/expr/function.hpp"
#include "slalom/expr/spline.hpp"
#include "slalom/vehicle/agility.hpp"
#include "slalom/vehicle/model.hpp"
#include "slalom/world/footprint.hpp"

namespace slalom::planner {

using namespace vehicle;
using ocp::Bounds;
using ocp::Expr;
using vehicle::State;

namespace {

/// Between the knots of the tables of curvature and widths [m], and how far they go on beyond the
/// road's ends [m]: the body's length at the least.
constexpr double kKnot = 2, kBeyond = 25;
/// Heading relative to the line [rad], and the slowest that is planned [m/s].
constexpr double kMostXi = 1.2, kSlowest = 0.5;
/// Rows of wheel loads are in kilonewtons, of one size with the others.
constexpr double kKilo = 1e-3;
/// Of the slip at which the rear tyres' force is greatest: beyond it a vehicle spins, and hardly
/// any force is lost before.
constexpr double kSlipShare = 0.8;
/// Rows of slip are in tenths of a radian.
constexpr double kTenths = 10;

double around(double s, double length) {
  const double rest = std::fmod(s, length);
  return rest < 0 ? rest + length : rest;
}

/// The rear axle's slip angle [rad] at which its tyres' lateral force at the static load is
/// greatest: by the shape factor and the stiffness of the Magic Formula, without its curvature
/// factor (docs/formulation.md, section 2).
double peak_slip(const Parameters& p) {
  const double B = p.cornering_stiffness(p.FzR0) / (p.PCY1 * p.PDY1 * p.FzR0);
  return std::tan(std::numbers::pi / (2 * p.PCY1)) / B;
}

}  // namespace

LineProblem::LineProblem(const world::Road& road, const Parameters& vehicle, double length,
                         const LineSettings& settings)
    : road_(road),
      vehicle_(vehicle),
      length_(length),
      slowest_(std::max(vehicle.ux_min, kSlowest)),
      settings_(settings),
      problem_("along a line") {
  if (!(road.narrowest() > vehicle.width + 2 * settings.margin))
    throw InvalidValue(
        "road", fmt::format("{:.4g} m wide where it is narrowest", road.narrowest()),
        fmt::format(
            "more than the vehicle's width of {:.4g} m and {:.4g} m to be kept on each side",
            vehicle.width, settings.margin));
  start_ = problem_.parameter("start", 0);
  s_ = start_ + problem_.time();
  problem_.initial_time(Bounds::equal(0), 0);
  problem_.final_time(Bounds::equal(length), length);
  tabulate(road.closed() ? road.length() + length : road.length());
  add_motion();
  add_limits();
  add_edges();
}

/// What the mesh alone decides is looked up once and not in each iteration: so at a corner of the
/// body, widths are those here and their slopes.
void LineProblem::tabulate(double until) {
  std::vector<double> knots;
  std::array<std::vector<double>, 5> values;
  for (double s = -kBeyond; s < until + kBeyond; s += kKnot) {
    const auto place = road_.at(s);
    knots.push_back(s);
    const std::array row = {place.curvature, place.left, place.left_slope, place.right,
                            place.right_slope};
    for (std::size_t k = 0; k < row.size(); ++k) values[k].push_back(row[k]);
    widest_ = std::max({widest_, place.left, place.right});
  }
  const auto table = [&](std::size_t k) { return expr::cubic_spline(s_, knots, values[k]); };
  kappa_ = table(0);
  left_ = {table(1) - settings_.margin, table(2)};
  right_ = {table(3) - settings_.margin, table(4)};
}

void LineProblem::add_motion() {
  const Parameters& p = vehicle_;
  std::array<Bounds, kStates> bounds;
  bounds[SA] = {-p.sa_max(), p.sa_max()};
  bounds[UX] = {slowest_, p.ux_max};
  x_[N] = problem_.state("n", {-widest_, widest_});
  x_[XI] = problem_.state("xi", {-kMostXi, kMostXi});
  X_[X] = X_[Y] = 0;
  X_[PSI] = x_[XI];  // the model's frame is the line's
  for (std::size_t i = 0; i < kOfVehicle.size(); ++i)
    X_[kOfVehicle[i]] = x_[FIRST_OF_VEHICLE + i] =
        problem_.state(kStateNames[kOfVehicle[i]], bounds[kOfVehicle[i]]);
  U_[SR] = problem_.control("sr", {-p.sr_max(), p.sr_max()});
  U_[JX] = problem_.control("jx", {-p.jx_max, p.jx_max});
  const Model model = make_model(p);
  const auto rate = in_terms_of(model.derivative, model, X_, U_);
  s_dot_ = rate[X] / (1 - x_[N] * kappa_);
  problem_.dynamics(x_[N], rate[Y] / s_dot_);
  problem_.dynamics(x_[XI], rate[PSI] / s_dot_ - kappa_);
  for (std::size_t i = 0; i < kOfVehicle.size(); ++i)
    problem_.dynamics(x_[FIRST_OF_VEHICLE + i], rate[kOfVehicle[i]] / s_dot_);
  problem_.lagrange("time", settings_.w_t / s_dot_);
  problem_.lagrange("control_effort",
                    settings_.w_t * settings_.w_control *
                        (square(U_[SR] / p.sr_max()) + square(U_[JX] / p.jx_max)) / s_dot_);
}

/// A row that is at least 0 after the beginning, where the vehicle is as it is.
void LineProblem::add_limit(const std::string& name, const Expr& room) {
  const auto row = problem_.path(name, room, Bounds::at_least(0), ocp::Points::after_first);
  if (settings_.w_excess > 0)
    problem_.soften(row, {ocp::Norm::l1, settings_.w_t * settings_.w_excess, 0});
}

void LineProblem::add_limits() {
  const Model model = make_model(vehicle_);
  const auto limits = in_terms_of(std::array{model.ax_min, model.ax_max}, model, X_, U_);
  problem_.path("ax above ax_min", X_[AX] - limits[0], Bounds::at_least(0),
                ocp::Points::after_first);
  problem_.path("ax below ax_max", limits[1] - X_[AX], Bounds::at_least(0),
                ocp::Points::after_first);
  const auto Fz = in_terms_of(model.wheel_loads, model, X_, U_);
  for (std::size_t w = 0; w < kWheels; ++w)
    add_limit(std::string("wheel load ") + kWheelNames[w], kKilo * (Fz[w] - vehicle_.Fz_min));
  const Expr slip = (X_[V] - vehicle_.lb * X_[R]) / X_[UX];
  const double most = kSlipShare * peak_slip(vehicle_);
  add_limit("rear slip to the right", kTenths * (most - slip));
  add_limit("rear slip to the left", kTenths * (most + slip));
}

void LineProblem::add_edges() {
  Parameters body = vehicle_;
  body.footprint = FootprintKind::rectangle;
  const auto corners = world::Footprint(body).corners();
  const char* names[] = {"front left", "rear left", "rear right", "front right"};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto [ahead, aside] = corners[k];
    const Expr along = ahead * cos(x_[XI]) - aside * sin(x_[XI]);
    const Expr across = x_[N] + ahead * sin(x_[XI]) + aside * cos(x_[XI]);
    // The line ahead bends away from its tangent by about kappa along^2 / 2.
    const Expr offset = across - kappa_ * square(along) / 2;
    const bool left = aside > 0;
    const Expr width = (left ? left_ : right_)[0] + (left ? left_ : right_)[1] * along;
    const Expr room = left ? width - offset : width + offset;
    add_limit(std::string("edge at ") + names[k], room);
  }
}

std::vector<std::array<double, 5>> LineProblem::along(const std::vector<double>& s) const {
  const expr::Function road({}, {start_, problem_.time()},
                            {kappa_, left_[0], left_[1], right_[0], right_[1]});
  std::vector<std::array<double, 5>> list(s.size());
  for (std::size_t k = 0; k < s.size(); ++k) road({}, std::array{0., s[k]}, list[k]);
  return list;
}

LineProblem::LineState LineProblem::cornering(double s, double speed, double acceleration) const {
  const Parameters& p = vehicle_;
  const double kappa = road_.at(s).curvature, r = speed * kappa;
  const double sa = std::clamp(std::atan((p.la + p.lb) * kappa), -p.sa_max(), p.sa_max());
  return {0, -std::atan2((p.la + p.lb) * r, speed), p.lb * r, r, sa, speed, acceleration};
}

double LineProblem::progress(double s, const LineState& x) const {
  const double front = x[FIRST_OF_VEHICLE] + vehicle_.la * x[FIRST_OF_VEHICLE + 1];
  const double ux = x[SPEED];
  return (ux * std::cos(x[XI]) - front * std::sin(x[XI])) / (1 - x[N] * road_.at(s).curvature);
}

LineProblem::LineState LineProblem::to_line(double s, const State& state) const {
  const auto place = road_.at(s);
  LineState x;
  x[N] = (state[Y] - place.y) * std::cos(place.psi) - (state[X] - place.x) * std::sin(place.psi);
  x[XI] = std::remainder(state[PSI] - place.psi, 2 * std::numbers::pi);
  for (std::size_t i = 0; i < kOfVehicle.size(); ++i)
    x[FIRST_OF_VEHICLE + i] = state[kOfVehicle[i]];
  return x;
}

State LineProblem::to_world(double s, const LineState& x, double near) const {
  const auto place = road_.at(s);
  State state{};
  state[X] = place.x - x[N] * std::sin(place.psi);
  state[Y] = place.y + x[N] * std::cos(place.psi);
  const double psi = place.psi + x[XI];
  state[PSI] = near + std::remainder(psi - near, 2 * std::numbers::pi);
  for (std::size_t i = 0; i < kOfVehicle.size(); ++i)
    state[kOfVehicle[i]] = x[FIRST_OF_VEHICLE + i];
  return state;
}

LineProblem::Motion LineProblem::to_world(const ocp::Trajectory& found, double start, double t0,
                                          double psi) const {
  Motion motion;
  std::vector<double> slowness;
  for (std::size_t k = 0; k < found.tau.size(); ++k) {
    const double s = start + found.time(k);
    LineState x;
    std::copy_n(found.states[k].begin(), x.size(), x.begin());
    slowness.push_back(1 / progress(s, x));
    motion.s.push_back(s);
    motion.states.push_back(to_world(s, x, psi));
    psi = motion.states.back()[PSI];
    motion.controls.push_back({found.controls[k][SR], found.controls[k][JX]});
  }
  motion.t.assign(found.tau.size(), t0);
  for (std::size_t k = 0; k + 2 < found.tau.size(); k += 2) {
    const double h = motion.s[k + 2] - motion.s[k];
    const double a = slowness[k], b = slowness[k + 1], c = slowness[k + 2];
    motion.t[k + 1] = motion.t[k] + h * (5 * a + 8 * b - c) / 24;
    motion.t[k + 2] = motion.t[k] + h * (a + 4 * b + c) / 6;
  }
  return motion;
}

SpeedProfile::SpeedProfile(const world::Road& road, const Parameters& vehicle, double lateral_share,
                           double braking_share)
    : SpeedProfile(road, vehicle, lateral_share, braking_share, [&](double s) {
        return !road.closed() && s >= road.length() ? 0 : vehicle.ux_max;
      }) {}

SpeedProfile::SpeedProfile(const world::Road& road, const Parameters& vehicle, double lateral_share,
                           double braking_share, const std::function<double(double)>& limit)
    : closed_(road.closed()) {
  const double parts = std::ceil(road.length() / kKnot);
  step_ = road.length() / parts;
  const auto count = static_cast<std::size_t>(parts) + (closed_ ? 0 : 1);
  const double lateral = lateral_share * most_lateral(vehicle);
  for (std::size_t k = 0; k < count; ++k) {
    const double s =
        static_cast<double>(k) < parts ? step_ * static_cast<double>(k) : road.length();
    const double kappa = std::fabs(road.at(s).curvature);
    speed_.push_back(
        std::min({vehicle.ux_max, std::sqrt(lateral / std::max(kappa, 1e-9)), limit(s)}));
  }
  // What the turn takes of the tyres, braking lacks: a friction ellipse.
  const auto slow_down = [&](std::size_t k, std::size_t next) {
    const double kappa = road.at(step_ * static_cast<double>(k)).curvature;
    const double turning = std::min(1., speed_[next] * speed_[next] * std::fabs(kappa) / lateral);
    const double braking =
        -braking_share * vehicle.ax_min_at(speed_[next]) * std::sqrt(1 - turning * turning);
    speed_[k] = std::min(speed_[k], std::sqrt(speed_[next] * speed_[next] + 2 * braking * step_));
  };
  for (int pass = 0; pass < (closed_ ? 2 : 1); ++pass) {
    if (closed_) slow_down(count - 1, 0);
    for (std::size_t k = count - 1; k-- > 0;) slow_down(k, k + 1);
  }
}

double SpeedProfile::at(double s) const {
  const double length = step_ * static_cast<double>(speed_.size() - (closed_ ? 0 : 1));
  if (!closed_ && s >= length) return speed_.back();
  const double at = closed_ ? around(s, length) / step_ : std::max(s, 0.) / step_;
  const auto k = static_cast<std::size_t>(at) % speed_.size();
  const double share = at - std::floor(at);
  return (1 - share) * speed_[k] + share * speed_[(k + 1) % speed_.size()];
}

double SpeedProfile::slowest() const {
  return *std::min_element(speed_.begin(), speed_.end());
}

}  // namespace slalom::planner
