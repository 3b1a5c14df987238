#include <cmath>

#include "statement.hpp"

// Problems whose optimal control jumps between its bounds.

namespace slalom::problems {
namespace {

Statement moon_lander() {
  Problem p("moon lander");
  const Expr h = p.state("h"), v = p.state("v"), T = p.control("T", {0, 3});
  p.dynamics(h, v);
  p.dynamics(v, T - 1.5);
  p.lagrange("fuel", T);
  fixed(p, h, 10, 0);
  fixed(p, v, -2, 0);
  p.final_time({0.1, 100}, 5);
  return {p};
}

/// Thrust 3 from the switch at s on until rest: v(s)^2 = 2 (3 - g) h(s).
double moon_lander_fuel() {
  const double g = 1.5, a = 3 - g, c = g + a;
  const double s = (-2 * c + std::sqrt(4 * c * c - g * c * (4 - 2 * a * 10))) / (g * c);
  return 3 * (g * s + 2) / a;
}

Statement robot_arm() {
  Problem p("robot arm");
  const double L = 5;
  const Expr rho = p.state("rho", {0, L}), theta = p.state("theta", {-M_PI, M_PI}),
             phi = p.state("phi", {0, M_PI});
  const Expr vr = p.state("rho_rate"), vt = p.state("theta_rate"), vp = p.state("phi_rate");
  const Expr ur = p.control("u_rho", {-1, 1}), ut = p.control("u_theta", {-1, 1}),
             up = p.control("u_phi", {-1, 1});
  const Expr inertia = (pow(L - rho, 3) + pow(rho, 3)) / 3;
  p.dynamics(rho, vr);
  p.dynamics(theta, vt);
  p.dynamics(phi, vp);
  p.dynamics(vr, ur / L);
  p.dynamics(vt, ut / (inertia * square(sin(phi))));
  p.dynamics(vp, up / inertia);
  fixed(p, rho, 4.5, 4.5);
  fixed(p, theta, 0, 2 * M_PI / 3);
  fixed(p, phi, M_PI / 4, M_PI / 4);
  for (const auto& rate : {vr, vt, vp}) fixed(p, rate, 0, 0);
  least_time(p, {0.1, 100}, 1);
  return {p};
}

Statement least_time_integrator() {
  Problem p("double integrator, least time");
  const Expr x = p.state("x"), v = p.state("v"), u = p.control("u", {-1, 1});
  p.dynamics(x, v);
  p.dynamics(v, u);
  fixed(p, x, 0, 1);
  fixed(p, v, 0, 0);
  least_time(p, {0.1, 10}, 3);
  return {p};
}

Statement least_fuel_integrator() {
  Problem p("double integrator, least fuel");
  const Expr x = p.state("x"), v = p.state("v");
  const Expr ahead = p.control("ahead", {0, 1}), back = p.control("back", {0, 1});
  p.dynamics(x, v);
  p.dynamics(v, ahead - back);
  p.lagrange("fuel", ahead + back);
  fixed(p, x, 0.1, 0);
  fixed(p, v, 0.5, 0);
  horizon(p, 1.5);
  return {p};
}

Statement two_link_arm() {
  Problem p("two-link arm");
  const Expr x1 = p.state("x1"), x2 = p.state("x2"), x3 = p.state("x3"), x4 = p.state("x4");
  const Expr u1 = p.control("u1", {-1, 1}), u2 = p.control("u2", {-1, 1});
  const Expr den = 31.0 / 36 + 9.0 / 4 * square(sin(x3));
  p.dynamics(x1, (sin(x3) * (9.0 / 4 * cos(x3) * square(x1) + 2 * square(x2)) +
                  4.0 / 3 * (u1 - u2) - 1.5 * cos(x3) * u2) /
                     den);
  p.dynamics(x2, -(sin(x3) * (3.5 * square(x1) + 9.0 / 4 * cos(x3) * square(x2)) - 7.0 / 3 * u2 +
                   1.5 * cos(x3) * (u1 - u2)) /
                     den);
  p.dynamics(x3, x2 - x1);
  p.dynamics(x4, x1);
  fixed(p, x1, 0, 0);
  fixed(p, x2, 0, 0);
  fixed(p, x3, 0.5, 0.5);
  fixed(p, x4, 0, 0.522);
  least_time(p, {1, 10}, 3);
  return {p};
}

Statement free_flying_robot() {
  Problem p("free-flying robot");
  const Expr x = p.state("x"), y = p.state("y"), theta = p.state("theta");
  const Expr vx = p.state("vx"), vy = p.state("vy"), omega = p.state("omega");
  const Bounds one_way = Bounds::at_least(0);
  const Expr u1 = p.control("u1", one_way), u2 = p.control("u2", one_way);
  const Expr u3 = p.control("u3", one_way), u4 = p.control("u4", one_way);
  const Expr T1 = u1 - u2, T2 = u3 - u4;
  p.dynamics(x, vx);
  p.dynamics(y, vy);
  p.dynamics(theta, omega);
  p.dynamics(vx, (T1 + T2) * cos(theta));
  p.dynamics(vy, (T1 + T2) * sin(theta));
  p.dynamics(omega, 0.2 * T1 - 0.2 * T2);
  p.lagrange("fuel", u1 + u2 + u3 + u4);
  p.path("first pair", u1 + u2, Bounds::at_most(1));
  p.path("second pair", u3 + u4, Bounds::at_most(1));
  fixed(p, x, -10, 0);
  fixed(p, y, -10, 0);
  fixed(p, theta, M_PI / 2, 0);
  for (const auto& rate : {vx, vy, omega}) fixed(p, rate, 0, 0);
  horizon(p, 12);
  return {p};
}

Statement reorientation() {
  Problem p("reorientation");
  const double Ix = 5621, Iy = 4547, Iz = 2364, half = 75 * M_PI / 180;
  const Expr q1 = p.state("q1"), q2 = p.state("q2"), q3 = p.state("q3"), q4 = p.state("q4");
  const Expr w1 = p.state("w1"), w2 = p.state("w2"), w3 = p.state("w3");
  const Expr u1 = p.control("u1", {-50, 50}), u2 = p.control("u2", {-50, 50}),
             u3 = p.control("u3", {-50, 50});
  p.dynamics(q1, (w1 * q4 - w2 * q3 + w3 * q2) / 2);
  p.dynamics(q2, (w1 * q3 + w2 * q4 - w3 * q1) / 2);
  p.dynamics(q3, (-w1 * q2 + w2 * q1 + w3 * q4) / 2);
  p.dynamics(q4, (-w1 * q1 - w2 * q2 - w3 * q3) / 2);
  p.dynamics(w1, u1 / Ix - (Iz - Iy) / Ix * w2 * w3);
  p.dynamics(w2, u2 / Iy - (Ix - Iz) / Iy * w1 * w3);
  p.dynamics(w3, u3 / Iz - (Iy - Ix) / Iz * w1 * w2);
  fixed(p, q1, 0, std::sin(half));
  fixed(p, q2, 0, 0);
  fixed(p, q3, 0, 0);
  starts(p, q4, 1);  // its end follows, for the norm stays 1
  p.final_bounds(q4, Bounds::at_least(0));
  for (const auto& rate : {w1, w2, w3}) fixed(p, rate, 0, 0);
  least_time(p, {10, 60}, 30);
  return {p,
          {line(0, 30, {0, 0, 0, 1, 0, 0, 0}, {std::sin(half), 0, 0, std::cos(half), 0, 0, 0},
                {25, 25, 25}, {25, 25, 25})}};
}

}  // namespace

Entries bang_bang() {
  return {
      {.name = "moon-lander",
       .title = "Soft landing by least fuel",
       .source = "Meditch, IEEE Trans. Autom. Control 9(4), 1964; NLOptControl's benchmark",
       .hard = "thrust off, then full",
       .tags = {Tag::bang_bang, Tag::free_final_time},
       .closed_form = ClosedForm{moon_lander_fuel(), "3 (g s + 2) / (3 - g), s the switch"},
       .state = moon_lander},
      {.name = "robot-arm",
       .title = "A robot's arm turned in least time",
       .source = "Moessner-Beigel 1995; COPS 3.0, problem 8",
       .hard = "three controls with five jumps, at times of their own",
       .tags = {Tag::bang_bang, Tag::free_final_time},
       .published = Published{"9.14093620", "Betts, A Collection of Optimal Control Test Problems"},
       .remark = "COPS 3.0 prints 9.14138, of the trapezoidal rule on 200 intervals",
       .state = robot_arm},
      {.name = "least-time",
       .title = "A double integrator from rest to rest in least time",
       .source = "Bushaw 1952; Bryson & Ho 1975",
       .hard = "full ahead, then full back",
       .tags = {Tag::bang_bang, Tag::free_final_time},
       .closed_form = ClosedForm{2, "2, switched at 1"},
       .state = least_time_integrator},
      {.name = "least-fuel",
       .title = "A double integrator to rest at 0 by least fuel",
       .source = "Bryson & Ho 1975, page 116",
       .hard = "full back, coasting, full ahead",
       .tags = {Tag::bang_bang},
       .closed_form = ClosedForm{1.5 - std::sqrt(0.1), "tf - sqrt((tf - v0)^2 - 4 x0 - 2 v0^2)"},
       .state = least_fuel_integrator},
      {.name = "two-link-arm",
       .title = "An arm of two links moved in least time",
       .source = "Luus, Iterative Dynamic Programming, 2000, section 12.4.2",
       .hard = "two controls with jumps",
       .tags = {Tag::bang_bang, Tag::free_final_time},
       .published = Published{"2.98866", "PSOPT, all examples 2026, twolinkarm"},
       .converged = 2.982281,
       .remark =
           "the print is of 40 nodes; HS and LGR refined to 1e-8 end at 2.9822813 and 2.9822820",
       .state = two_link_arm},
      {.name = "free-flying-robot",
       .title = "A robot in space flown by least fuel",
       .source = "Sakawa, Optim. Control Appl. Meth. 20(5), 1999; Betts 2010, section 6.13",
       .hard = "four thrusters that are off or full, with singular-like arcs",
       .tags = {Tag::bang_bang, Tag::local_optima},
       .published = Published{"7.910154646", "Betts 2010, by SOCS"},
       .state = free_flying_robot},
      {.name = "reorientation",
       .title = "A rigid body turned by 150 degrees in least time",
       .source = "Fleming, Sekhavat & Ross 2008; PSOPT's example",
       .hard = "three controls with jumps; not about the axis of turn alone",
       .tags = {Tag::bang_bang, Tag::local_optima, Tag::free_final_time},
       .published = Published{"28.63041", "PSOPT, all examples 2026, reorientation"},
       .state = reorientation},
  };
}

}  // namespace slalom::problems
