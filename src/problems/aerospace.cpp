#include <cmath>

#include "statement.hpp"

// Flight through the air and in space.

namespace slalom::problems {
namespace {

constexpr double kDegree = M_PI / 180;

Statement orbit_raising() {
  Problem p("orbit raising");
  const Expr r = p.state("r", {1, 10}), vr = p.state("vr"), vt = p.state("vt");
  const Expr phi = p.control("phi");
  const Expr a = 0.1405 / (1 - 0.0749 * p.time());
  p.dynamics(r, vr);
  p.dynamics(vr, square(vt) / r - 1 / square(r) + a * sin(phi));
  p.dynamics(vt, -vr * vt / r + a * cos(phi));
  starts(p, r, 1);
  fixed(p, vr, 0, 0);
  starts(p, vt, 1);
  p.boundary("circular", square(p.final(vt)) * p.final(r), Bounds::equal(1));
  p.mayer("radius", -p.final(r));
  horizon(p, 3.32);
  return {p, {line(0, 3.32, {1, 0, 1}, {1.5, 0, 0.8}, {0}, {2 * M_PI})}};
}

/// Feet, seconds, slugs, radians (Betts 2010, section 6.1, without the limit on heat).
Statement shuttle_reentry() {
  Problem p("shuttle re-entry");
  const double Re = 20902900, mu = 0.14076539e17, rho0 = 0.002378, hr = 23800, S = 2690;
  const double mass = 203000 / 32.174;
  const Expr h = p.state("h", Bounds::at_least(0)), phi = p.state("phi");
  const Expr theta = p.state("theta", {-89 * kDegree, 89 * kDegree});
  const Expr v = p.state("v", Bounds::at_least(1));
  const Expr gamma = p.state("gamma", {-89 * kDegree, 89 * kDegree}), psi = p.state("psi");
  const Expr alpha = p.control("alpha", {-90 * kDegree, 90 * kDegree});
  const Expr beta = p.control("beta", {-89 * kDegree, 1 * kDegree});
  const Expr degrees = alpha / kDegree, r = Re + h, g = mu / square(r);
  const Expr pressure = rho0 * exp(-h / hr) * square(v) / 2;
  const Expr lift = pressure * S * (-0.20704 + 0.029244 * degrees);
  const Expr drag = pressure * S * (0.07854 - 0.61592e-2 * degrees + 0.621408e-3 * square(degrees));
  p.dynamics(h, v * sin(gamma));
  p.dynamics(phi, v / r * cos(gamma) * sin(psi) / cos(theta));
  p.dynamics(theta, v / r * cos(gamma) * cos(psi));
  p.dynamics(v, -drag / mass - g * sin(gamma));
  p.dynamics(gamma, lift / (mass * v) * cos(beta) + cos(gamma) * (v / r - g / v));
  p.dynamics(psi, lift * sin(beta) / (mass * v * cos(gamma)) +
                      v / (r * cos(theta)) * cos(gamma) * sin(psi) * sin(theta));
  fixed(p, h, 260000, 80000);
  starts(p, phi, 0);
  starts(p, theta, 0);
  fixed(p, v, 25600, 2500);
  fixed(p, gamma, -1 * kDegree, -5 * kDegree);
  starts(p, psi, 90 * kDegree);
  p.final_time({100, 4000}, 1000);
  p.mayer("cross-range [deg]", -p.final(theta) / kDegree);
  return {p,
          {line(0, 1000, {260000, 0, 0, 25600, -1 * kDegree, 90 * kDegree},
                {80000, 0, 0, 2500, -5 * kDegree, 90 * kDegree}, {0, 0}, {0, 0})}};
}

Statement hang_glider() {
  Problem p("hang glider");
  const double uc = 2.5, R = 100, m = 100, g = 9.81, c0 = 0.034, c1 = 0.069662, S = 14, rho = 1.13;
  const Expr x = p.state("x", Bounds::at_least(0)), y = p.state("y");
  const Expr vx = p.state("vx", Bounds::at_least(0)), vy = p.state("vy");
  const Expr cl = p.control("cL", {0, 1.4});
  const Expr X = square(x / R - 2.5), w = vy - uc * (1 - X) * exp(-X);
  const Expr v = sqrt(square(vx) + square(w));
  const Expr drag = 0.5 * (c0 + c1 * square(cl)) * rho * S * v, lift = 0.5 * cl * rho * S * v;
  p.dynamics(x, vx);
  p.dynamics(y, vy);
  p.dynamics(vx, (-lift * w - drag * vx) / m);
  p.dynamics(vy, (lift * vx - drag * w) / m - g);
  starts(p, x, 0);
  fixed(p, y, 1000, 900);
  fixed(p, vx, 13.23, 13.23);
  fixed(p, vy, -1.288, -1.288);
  p.final_time({1, 200}, 100);
  p.mayer("range", -p.final(x));
  return {p, {line(0, 100, {0, 1000, 13.23, -1.288}, {1323, 900, 13.23, -1.288}, {0.7}, {0.7})}};
}

/// Least gradient of the wind in which a glider stays up without power. Feet, slugs, seconds.
Statement dynamic_soaring() {
  Problem p("dynamic soaring");
  const double g = 32.2, cd0 = 0.00873, rho = 0.002378, m = 5.6, S = 45.09703, k = 0.045;
  const double weight = m * g;
  const Expr x = p.state("x", {-1500, 1500}), y = p.state("y", {-1000, 1000}),
             h = p.state("h", {0, 1000}), v = p.state("v", {10, 350}),
             gamma = p.state("gamma", {-75 * kDegree, 75 * kDegree}),
             psi = p.state("psi", {-225 * kDegree, 225 * kDegree});
  const Expr cl = p.control("CL", {0, 1.5}), phi = p.control("phi", {-75 * kDegree, 75 * kDegree});
  const Expr beta = p.static_parameter("beta", {0.005, 0.15}, 0.08);
  const Expr q = rho * square(v) / 2 * S, lift = q * cl, drag = q * (cd0 + k * square(cl));
  const Expr wind = beta * h, gust = beta * v * sin(gamma);
  p.dynamics(x, v * cos(gamma) * sin(psi) + wind);
  p.dynamics(y, v * cos(gamma) * cos(psi));
  p.dynamics(h, v * sin(gamma));
  p.dynamics(v, -drag / m - g * sin(gamma) - gust * cos(gamma) * sin(psi));
  p.dynamics(gamma,
             (lift * cos(phi) - weight * cos(gamma) + m * gust * sin(gamma) * sin(psi)) / (m * v));
  p.dynamics(psi, (lift * sin(phi) - m * gust * cos(psi)) / (m * v * cos(gamma)));
  p.path("load", q * cl / weight, {-2, 5});
  for (const auto& each : {x, y, h}) fixed(p, each, 0, 0);
  p.boundary("same speed", p.final(v) - p.initial(v), Bounds::equal(0));
  p.boundary("same slope", p.final(gamma) - p.initial(gamma), Bounds::equal(0));
  p.boundary("one turn", p.final(psi) - p.initial(psi), Bounds::equal(2 * M_PI));
  p.final_time({10, 30}, 24);
  p.mayer("gradient", beta);
  return {p,
          {{0,
            24,
            {0, 0.25, 0.5, 0.75, 1},
            {{0, 0, 0, 150, 0, -M_PI},
             {-600, -200, 420, 150, 0, -M_PI / 2},
             {-1200, 0, 840, 150, 0, 0},
             {-600, 200, 420, 150, 0, M_PI / 2},
             {0, 0, 0, 150, 0, M_PI}},
            {{0.5, M_PI / 4}, {0.5, M_PI / 4}, {0.5, M_PI / 4}, {0.5, M_PI / 4}, {0.5, M_PI / 4}},
            {0.08},
            {}}}};
}

}  // namespace

Entries aerospace() {
  return {
      {.name = "orbit-raising",
       .title = "The largest circular orbit in a given time of thrust",
       .source = "Moyer & Pinkham 1964; Bryson & Ho 1975, pages 66-69",
       .hard = "the thrust turns round quickly half-way",
       .maximised = true,
       .published = Published{"1.5252777", "Hall, YAPSS, orbit_raising"},
       .intervals = 120,
       .state = orbit_raising},
      {.name = "shuttle-reentry",
       .title = "The largest cross-range of a re-entry [deg]",
       .source = "Betts 2010, section 6.1",
       .hard = "long, with phugoid swings; sizes from 1e-6 to 1e5",
       .tags = {Tag::free_final_time},
       .maximised = true,
       .published = Published{"34.1412", "Betts 2010, section 6.1; PSOPT, all examples 2026"},
       .state = shuttle_reentry},
      {.name = "hang-glider",
       .title = "The longest flight through a thermal",
       .source = "Bulirsch et al. 1993; COPS 3.0, problem 11",
       .hard = "lift nearly singular, at a thermal's edge",
       .tags = {Tag::local_optima, Tag::free_final_time},
       .maximised = true,
       .published = Published{"1255.05", "COPS 3.0, 100 intervals"},
       .converged = 1247.987,
       .remark = "the print is the trapezoidal rule's value on 100 intervals; refined to 1e-8, HS "
                 "and LGR "
                 "end at 1247.9873 and 1247.9850",
       .intervals = 100,
       .state = hang_glider},
      {.name = "dynamic-soaring",
       .title = "The least wind gradient that keeps a glider aloft",
       .source = "Zhao, Optim. Control Appl. Meth. 25(2), 2004",
       .hard = "a cycle: ends equal and free; a parameter to optimise",
       .tags = {Tag::local_optima, Tag::free_final_time},
       .published = Published{"0.0635869566", "Hall, YAPSS, dynamic_soaring"},
       .refinement = 1e-7,
       .state = dynamic_soaring},
  };
}

}  // namespace slalom::problems
