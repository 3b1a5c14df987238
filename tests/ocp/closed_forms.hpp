#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/trajectory.hpp"

namespace slalom::ocp {

/// A problem whose solution is known on paper.
struct ClosedForm {
  std::string name;
  Problem problem;
  double objective;
  /// States at time t, and costates where there are any to compare; empty functions otherwise.
  std::function<std::vector<double>(double t)> states, costates;
  std::string limit = "";  ///< why the scheme's order is not reached; empty where it is
  Trajectory guess = {};   ///< empty: straight lines
};

inline void fix(Problem& problem, const Expr& state, double from, double to) {
  problem.fix(state, from, to);
}

/// x'' = u, v from 1 to -1, x <= l, least half of the integral of u^2 (Bryson and Ho 1975, 3.11).
inline ClosedForm bryson_denham(double l) {
  Problem p("Bryson-Denham");
  const Expr x = p.state("x", Bounds::at_most(l)), v = p.state("v"), u = p.control("u");
  p.dynamics(x, v);
  p.dynamics(v, u);
  p.lagrange("effort", square(u) / 2);
  fix(p, x, 0, 0);
  fix(p, v, 1, -1);
  const double objective =
      l <= 1.0 / 6 ? 4 / (9 * l) : (l <= 0.25 ? 2 + 6 * (1 - 4 * l) * (1 - 4 * l) : 2);
  const auto half = [l](double t) -> std::vector<double> {  // 0 <= t <= 1/2
    if (l > 0.25) return {t - t * t, 1 - 2 * t};
    if (l <= 1.0 / 6) {
      const double s = std::min(t / (3 * l), 1.0);
      return {l * (1 - std::pow(1 - s, 3)), (1 - s) * (1 - s)};
    }
    const double a = 24 * (1 - 4 * l), b = -2 - a / 4;  // u = b + a t, v(1/2) = 0
    return {t + b * t * t / 2 + a * t * t * t / 6, 1 + b * t + a * t * t / 2};
  };
  const auto states = [half](double t) {
    auto x = half(std::min(t, 1 - t));
    if (t > 0.5) x[1] = -x[1];
    return x;
  };
  return {"Bryson-Denham, l = " + std::string(l < 0.15   ? "1/9"
                                              : l < 0.22 ? "1/5"
                                                         : "1/2"),
          p,
          objective,
          states,
          {},
          l > 0.25   ? ""
          : l < 0.15 ? "kinks of u where x enters and leaves its bound, at 1/3 and 2/3"
                     : "a kink of u where x touches its bound, at 1/2"};
}

/// x'' = u from rest to rest, least half of the integral of u^2: u = 6 - 12 t.
inline ClosedForm least_energy() {
  Problem p("double integrator, least energy");
  const Expr x = p.state("x"), v = p.state("v"), u = p.control("u");
  p.dynamics(x, v);
  p.dynamics(v, u);
  p.lagrange("effort", square(u) / 2);
  fix(p, x, 0, 1);
  fix(p, v, 0, 0);
  return {p.name(), p, 6,
          [](double t) -> std::vector<double> {
            return {t * t * (3 - 2 * t), 6 * t * (1 - t)};
          },
          [](double t) -> std::vector<double> {
            return {-12, 12 * t - 6};
          }};
}

/// x'' = u, |u| <= 1, from rest to rest in least time: full ahead, full back, switched at t = 1.
inline ClosedForm least_time() {
  Problem p("double integrator, least time");
  const Expr x = p.state("x"), v = p.state("v"), u = p.control("u", {-1, 1});
  p.dynamics(x, v);
  p.dynamics(v, u);
  p.mayer("final time", p.final_time());
  p.final_time({0.1, 10}, 3);
  fix(p, x, 0, 1);
  fix(p, v, 0, 0);
  return {p.name(), p, 2, {}, {}, "u jumps at 1/2, where a continuous u has to slope"};
}

/// Least fuel to land softly under gravity 1.5 with thrust up to 3, from 10 up at 2 down: free
/// fall, then full thrust (Meditch 1964).
inline ClosedForm moon_lander() {
  Problem p("moon lander");
  const Expr h = p.state("h", {}, 10), v = p.state("v", {}, 3), u = p.control("u", {0, 3});
  p.dynamics(h, v);
  p.dynamics(v, u - 1.5);
  p.lagrange("fuel", u);
  p.final_time({0.5, 20}, 5);
  fix(p, h, 10, 0);
  fix(p, v, -2, 0);
  const double g = 1.5, a = 3 - g, c = g + a;
  // Braking from the switch on: (v0 - g s)^2 = 2 a (h0 + v0 s - g s^2 / 2).
  const double s = (-2 * c + std::sqrt(4 * c * c - g * c * (4 - 2 * a * 10))) / (g * c);
  return {p.name(), p,  3 * (g * s + 2) / a,
          {},       {}, "u jumps at a third of the time, about, where a continuous u has to slope"};
}

/// Fastest slide from (0, 0) to a point below: a cycloid of radius 1 up to the angle 2 (Bernoulli
/// 1696). y points down; theta is the slope's angle from the vertical.
inline ClosedForm brachistochrone() {
  Problem p("brachistochrone");
  const double g = 9.81, angle = 2, rate = std::sqrt(g) / 2;  // theta = rate t, cycloid angle twice
  const Expr x = p.state("x"), y = p.state("y"), v = p.state("v", Bounds::at_least(-1));
  const Expr theta = p.control("theta", {-1, 3});
  p.dynamics(x, v * sin(theta));
  p.dynamics(y, v * cos(theta));
  p.dynamics(v, g * cos(theta));
  p.mayer("final time", p.final_time());
  p.final_time({0.1, 5}, 1);
  fix(p, x, 0, angle - std::sin(angle));
  fix(p, y, 0, 1 - std::cos(angle));
  p.initial_bounds(v, Bounds::equal(0));
  return {p.name(),
          p,
          angle / std::sqrt(g),
          [=](double t) -> std::vector<double> {
            const double phi = 2 * rate * t;
            return {phi - std::sin(phi), 1 - std::cos(phi), std::sqrt(2 * g * (1 - std::cos(phi)))};
          },
          {},
          "",
          {0, 1, {0, 1}, {{0, 0, 0}, {1, 1, 5}}, {{0.1}, {1}}, {}, {}}};
}

/// x' = u, least half of the integral of x^2 + u^2, x(0) = 1, x(1) free: x = cosh(1-t)/cosh(1).
inline ClosedForm regulator() {
  Problem p("linear regulator");
  const Expr x = p.state("x"), u = p.control("u");
  p.dynamics(x, u);
  p.lagrange("cost", (square(x) + square(u)) / 2);
  p.initial_bounds(x, Bounds::equal(1));
  return {p.name(), p, std::tanh(1) / 2,
          [](double t) -> std::vector<double> { return {std::cosh(1 - t) / std::cosh(1)}; },
          [](double t) -> std::vector<double> { return {std::sinh(1 - t) / std::cosh(1)}; }};
}

/// x' = u from 0 to 0 over a given area under x, least half of the integral of u^2: x = 6 A t (1 -
/// t).
inline ClosedForm isoperimetric() {
  Problem p("given area");
  const double area = 0.5;
  const Expr x = p.state("x"), u = p.control("u");
  p.dynamics(x, u);
  p.integral("area", x, Bounds::equal(area));
  p.lagrange("effort", square(u) / 2);
  fix(p, x, 0, 0);
  return {p.name(),
          p,
          6 * area * area,
          [=](double t) -> std::vector<double> { return {6 * area * t * (1 - t)}; },
          {}};
}

inline std::vector<ClosedForm> closed_forms() {
  return {regulator(),        brachistochrone(),      least_energy(),         isoperimetric(),
          bryson_denham(0.5), bryson_denham(1.0 / 5), bryson_denham(1.0 / 9), least_time(),
          moon_lander()};
}

}  // namespace slalom::ocp
