#include "slalom/vehicle/plausible.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "acceleration_limits.hpp"
#include "slalom/vehicle/derived.hpp"
#include "slalom/vehicle/model.hpp"

namespace slalom::vehicle {
namespace {

using Sentences = std::vector<std::string>;

constexpr double kLoadTolerance = 0.05;      // of the weight
constexpr double kTransferTolerance = 0.15;  // of m h
constexpr double kPull = 0.01;               // of the weight
constexpr double kMostFriction = 1.5;        // of a road tyre
/// Yaw inertia over m la lb; 1 for a dumb-bell of two masses at the axles.
constexpr double kLeastInertia = 0.4, kMostInertia = 2;

bool apart(double a, double b, double tolerance) {
  return std::fabs(a - b) > tolerance * std::fabs(b);
}

void static_loads(const Parameters& p, Sentences& found) {
  const double weight = p.m * kGravity, front = weight * p.lb / (p.la + p.lb);
  if (apart(p.FzF0 + p.FzR0, weight, kLoadTolerance))
    found.push_back(
        fmt::format("the static loads FzF0 + FzR0 = {:.0f} N are not the weight m g = {:.0f} N",
                    p.FzF0 + p.FzR0, weight));
  else if (std::fabs(p.FzF0 - front) > kLoadTolerance * weight)
    found.push_back(
        fmt::format("the static load of the front axle is FzF0 = {:.0f} N, but m g lb/(la + lb) "
                    "= {:.0f} N",
                    p.FzF0, front));
  const double wheel = std::min(p.FzF0, p.FzR0) / 2;
  if (p.Fz_min >= wheel)
    found.push_back(fmt::format("Fz_min = {:.0f} N is not below a wheel's static load of {:.0f} N",
                                p.Fz_min, wheel));
}

void load_transfer(const Parameters& p, Sentences& found) {
  const double moment = p.m * p.h;
  const double along = p.KZX * (p.la + p.lb), across = (p.KZYF + p.KZYR) * p.track;
  if (apart(along, moment, kTransferTolerance))
    found.push_back(
        fmt::format("KZX (la + lb) = {:.0f} kg m, but m h = {:.0f} kg m", along, moment));
  if (apart(across, moment, kTransferTolerance))
    found.push_back(
        fmt::format("(KZYF + KZYR) track = {:.0f} kg m, but m h = {:.0f} kg m", across, moment));
}

void body(const Parameters& p, Sentences& found) {
  const double rear = p.length - p.front_overhang - p.la - p.lb;
  if (p.front_overhang < 0 || rear < 0)
    found.push_back(fmt::format(
        "the body ends {:.2f} m {} of an axle (length, front_overhang, la + lb)",
        -std::min(p.front_overhang, rear), p.front_overhang < rear ? "short in front" : "ahead"));
  if (p.width < p.track)
    found.push_back(fmt::format("the body is {:.2f} m wide, less than the track of {:.2f} m",
                                p.width, p.track));
  const double inertia = p.Izz / (p.m * p.la * p.lb);
  if (inertia < kLeastInertia || inertia > kMostInertia)
    found.push_back(fmt::format("Izz is {:.2f} times m la lb, which is usually about 1", inertia));
}

/// Lateral friction: the formula's peak over load, at loads from half the lesser static one to
/// twice the greater.
void friction(const Parameters& p, Sentences& found) {
  const auto at = [&](double Fz) { return p.PDY1 + p.PDY2 * (Fz / p.FZ0 - 1); };
  const double light = at(std::min(p.FzF0, p.FzR0) / 2), heavy = at(2 * std::max(p.FzF0, p.FzR0));
  const auto [least, most] = std::minmax({light, heavy});
  if (least <= 0 || most > kMostFriction)
    found.push_back(fmt::format(
        "lateral friction (PDY1, PDY2) is {:.2f} for a light axle and {:.2f} for a heavy one",
        light, heavy));
  if (p.PDX1 > kMostFriction)
    found.push_back(fmt::format("longitudinal friction is PDX1 = {:.2f}", p.PDX1));
}

/// Whether the limits ask more of an axle than its friction, at any speed.
void accelerations(const Parameters& p, Sentences& found) {
  Parameters all = p;
  all.friction_share = 1;
  const double drive = acceleration::by_friction(all, 1, p.drive_front);
  const double brake = acceleration::by_friction(all, -1, p.brake_front);
  double most = 0, least = 0;
  constexpr int kSpeeds = 100;
  for (int i = 0; i <= kSpeeds; ++i) {
    const double ux = p.ux_min + (p.ux_max - p.ux_min) * i / kSpeeds;
    most = std::max(most, p.ax_max_at(ux));
    least = std::min(least, p.ax_min_at(ux));
  }
  const auto say = [&](const char* what, double wanted, const char* doing, double friction) {
    found.push_back(fmt::format(
        "{} is up to {:.1f} m/s^2, but {} takes all friction of an axle (PDX1, {}_front) at {:.1f} "
        "m/s^2",
        what, wanted, doing, doing[0] == 'd' ? "drive" : "brake", friction));
  };
  if (most > drive) say("ax_max", most, "driving", drive);
  if (-least > brake) say("-ax_min", -least, "braking", brake);
}

/// Driving straight on, and steady: critical speed of an oversteering vehicle, Rajamani, Vehicle
/// Dynamics and Control, section 3.3.
void handling(const Parameters& p, Sentences& found) {
  const double front = p.cornering_stiffness(p.FzF0), rear = p.cornering_stiffness(p.FzR0);
  if (front <= 0 || rear <= 0) {
    found.push_back("PKY1 is not negative: the tyres push to the side to which they slip");
    return;
  }
  const double L = p.la + p.lb, over = p.la * front - p.lb * rear;
  const double critical = over > 0 ? L * std::sqrt(front * rear / (p.m * over)) : HUGE_VAL;
  if (critical < p.ux_max)
    found.push_back(fmt::format(
        "the vehicle oversteers: above {:.1f} m/s, with ux_max at {:.3g} m/s, it spins by itself",
        critical, p.ux_max));
  State straight_on{};
  straight_on[UX] = 10;
  const auto forces = Dynamics(p).tyre_forces(straight_on);
  if (std::fabs(forces[0] + forces[1]) > kPull * p.m * kGravity)
    found.push_back(fmt::format(
        "the vehicle pulls to a side: {:.0f} N at no slip (F_offset_front, F_offset_rear)",
        forces[0] + forces[1]));
}

}  // namespace

Sentences implausible(const Parameters& parameters) {
  Sentences found;
  static_loads(parameters, found);
  load_transfer(parameters, found);
  body(parameters, found);
  friction(parameters, found);
  accelerations(parameters, found);
  handling(parameters, found);
  return found;
}

}  // namespace slalom::vehicle
