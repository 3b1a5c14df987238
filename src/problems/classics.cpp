#include <cmath>

#include "statement.hpp"

// Smooth problems of the textbooks, most with a closed form.

namespace slalom::problems {
namespace {

Statement brachistochrone() {
  Problem p("brachistochrone");
  const double g = 9.8;
  const Expr x = p.state("x"), y = p.state("y"), v = p.state("v", Bounds::at_least(0));
  const Expr theta = p.control("theta", {0, 3});
  p.dynamics(x, v * sin(theta));
  p.dynamics(y, v * cos(theta));
  p.dynamics(v, g * cos(theta));
  fixed(p, x, 0, 2);
  fixed(p, y, 0, 2);
  starts(p, v, 0);
  least_time(p, {0.1, 10}, 1);
  return {p};
}

/// The cost to come from x to 0 in unlimited time (sign -1), or from 0 to x (+1): the
/// Hamilton-Jacobi equation at H = 0, integrated.
double hyper_sensitive_part(double x, int sign) {
  const double w = x * x;
  return sign * w * w / 4 + (w * std::sqrt(w * w + 1) + std::asinh(w)) / 4;
}

Statement hyper_sensitive() {
  Problem p("hyper-sensitive");
  const Expr x = p.state("x"), u = p.control("u");
  p.dynamics(x, u - pow(x, 3));
  p.lagrange("cost", (square(x) + square(u)) / 2);
  fixed(p, x, 1.5, 1);
  horizon(p, 10000);
  return {p};
}

Statement unicycle() {
  Problem p("unicycle");
  const Expr x = p.state("x", {-10, 10}), y = p.state("y", {-10, 10});
  const Expr psi = p.state("psi", {-M_PI, M_PI}), ux = p.state("ux", {0, 1});
  const Expr r = p.control("r", {-1, 1}), ax = p.control("ax", {-3, 3});
  p.dynamics(x, ux * cos(psi));
  p.dynamics(y, ux * sin(psi));
  p.dynamics(psi, r);
  p.dynamics(ux, ax);
  starts(p, x, 0);
  starts(p, y, 0);
  starts(p, psi, M_PI / 2);
  starts(p, ux, 0);
  p.mayer("distance", square(p.final(x) + 2) + square(p.final(y) - 4));
  horizon(p, 7);
  return {p};
}

Statement linear_tangent_steering() {
  Problem p("linear-tangent steering");
  const double a = 100;
  const Expr x = p.state("x"), y = p.state("y"), vx = p.state("vx"), vy = p.state("vy");
  const Expr theta = p.control("theta", {-M_PI / 2, M_PI / 2});
  p.dynamics(x, vx);
  p.dynamics(y, vy);
  p.dynamics(vx, a * cos(theta));
  p.dynamics(vy, a * sin(theta));
  starts(p, x, 0);
  fixed(p, y, 0, 5);
  fixed(p, vx, 0, 45);
  fixed(p, vy, 0, 0);
  least_time(p, {0.01, 10}, 1);
  return {p};
}

Statement zermelo() {
  Problem p("Zermelo");
  const Expr x = p.state("x"), y = p.state("y"), theta = p.control("theta", {0, 2 * M_PI});
  p.dynamics(x, cos(theta) - y);
  p.dynamics(y, sin(theta));
  fixed(p, x, 3.66, 0);
  fixed(p, y, -1.86, 0);
  least_time(p, {0.1, 20}, 4);
  return {p, {line(0, 4, {3.66, -1.86}, {0, 0}, {2}, {4})}};
}

Statement soap_film() {
  Problem p("soap film");
  const double l = 0.45;
  const Expr r = p.state("r", Bounds::at_least(0)), slope = p.control("slope");
  p.dynamics(r, slope);
  p.lagrange("area", 2 * M_PI * r * sqrt(1 + square(slope)));
  fixed(p, r, 1, 1);
  p.initial_time(Bounds::equal(-l), -l);
  horizon(p, l);
  return {p};
}

Statement isoperimetric() {
  Problem p("isoperimetric");
  const Expr x = p.state("x"), y = p.state("y"), theta = p.control("theta");
  p.dynamics(x, cos(theta));
  p.dynamics(y, sin(theta));
  p.lagrange("area", -(x * sin(theta) - y * cos(theta)) / 2);
  fixed(p, x, 0, 0);
  fixed(p, y, 0, 0);
  return {p, {line(0, 1, {0, 0}, {0, 0}, {0}, {5})}};
}

Statement hager() {
  Problem p("Hager");
  const Expr x = p.state("x"), u = p.control("u");
  p.dynamics(x, 0.5 * x + u);
  p.lagrange("cost", square(u) + x * u + 1.25 * square(x));
  starts(p, x, 1);
  return {p};
}

Statement hager_hou_rao() {
  Problem p("Hager, Hou & Rao");
  const Expr x1 = p.state("x1"), x2 = p.state("x2"), u1 = p.control("u1"), u2 = p.control("u2");
  p.dynamics(x1, x1 + u1 / x2 + x1 * x2 * u2);
  p.dynamics(x2, -x2 * (0.5 + x2 * u2));
  p.lagrange("cost",
             2 * square(x1) * square(x2) + 1.25 / square(x2) + u2 / x2 + square(u1) + square(u2));
  starts(p, x1, 1);
  starts(p, x2, 1);
  return {p, {line(0, 1, {1, 1}, {1, 1}, {0, 0}, {0, 0})}};
}

Statement garg() {
  Problem p("Garg's problem in one dimension");
  const Expr x = p.state("x", Bounds::at_least(1e-4)), u = p.control("u");
  p.dynamics(x, 2 * x + 2 * u * sqrt(x));
  p.lagrange("cost", (x + square(u)) / 2);
  fixed(p, x, 2, 1);
  horizon(p, 5);
  return {p};
}

Statement neuenhofen_kerrigan() {
  Problem p("Neuenhofen & Kerrigan X1");
  const Expr y = p.state("y"), u = p.control("u", {-1.5, 1});
  p.dynamics(y, square(y) / 2 + u);
  p.lagrange("cost", square(y) + cos(p.time()) * u);
  starts(p, y, 0);
  horizon(p, M_PI / 2);
  return {p};
}

Statement target_line() {
  Problem p("to a line by least energy");
  const Expr x = p.state("x"), v = p.state("v"), u = p.control("u");
  p.dynamics(x, v);
  p.dynamics(v, u);
  p.lagrange("energy", square(u) / 2);
  starts(p, x, 0);
  starts(p, v, 0);
  p.boundary("on the line", p.final(x) - 2 * p.final(v), Bounds::equal(1));
  return {p};
}

/// The linear tangent law (Bryson & Ho 1975): with
/// tan(theta) = tan(b)(1 - 2 t/tf), vx(tf) = a tf asinh(tan b)/tan b and
/// y(tf) = a tf^2/(4 tan b) (1/cos b - asinh(tan b)/tan b).
double steering_time(double a, double y, double vx) {
  const auto time = [&](double t) { return vx * t / (a * std::asinh(t)); };
  const auto height = [&](double t) {
    return a * time(t) * time(t) / (4 * t) * (std::hypot(1, t) - std::asinh(t) / t) - y;
  };
  double low = 1e-3, high = 100;
  for (int k = 0; k < 200; ++k) {
    const double middle = (low + high) / 2;
    (height(middle) < 0 ? low : high) = middle;
  }
  return time(low);
}

/// Bryson & Ho 1975: y and x as functions of the heading angle and of the
/// final one; time is the difference of their tangents.
double zermelo_time(double x, double y) {
  const auto sec = [](double a) { return 1 / std::cos(a); };
  const auto begin = [&](double end) { return std::acos(1 / (y + sec(end))); };
  const auto miss = [&](double end) {
    const double a = begin(end), t0 = std::tan(a), t1 = std::tan(end), s0 = sec(a), s1 = sec(end);
    return -0.5 * (s1 * (t1 - t0) - t0 * (s1 - s0) + std::log((t1 + s1) / (t0 + s0))) - x;
  };
  double low = 3.6, high = 4.6;  // between 206 and 264 degrees
  for (int k = 0; k < 200; ++k) {
    const double middle = (low + high) / 2;
    ((miss(middle) > 0) == (miss(low) > 0) ? low : high) = middle;
  }
  return std::tan(low) - std::tan(begin(low));
}

double soap_film_area(double l) {
  double h = 1;  // of h cosh(l/h) = 1, the larger root, by Newton's method
  for (int k = 0; k < 60; ++k) {
    const double s = l / h;
    h -= (h * std::cosh(s) - 1) / (std::cosh(s) - s * std::sinh(s));
  }
  const double s = l / h;
  return 2 * M_PI * (std::tanh(s) + s / (std::cosh(s) * std::cosh(s)));
}

}  // namespace

Entries classics() {
  const double r2 = std::sqrt(2.0);
  return {
      {.name = "brachistochrone",
       .title = "Fastest slide from (0, 0) to (2, 2), g = 9.8",
       .source = "Bernoulli 1696; Bryson & Ho 1975",
       .hard = "free final time; the speed is 0 at the start",
       .tags = {Tag::free_final_time},
       .published = Published{"0.824759143157", "PSOPT Application Examples 2026, table 1"},
       .closed_form = ClosedForm{0.824759143157, "cycloid, phi_f = 2.412011143914"},
       .state = brachistochrone},
      {.name = "hyper-sensitive",
       .title = "x' = u - x^3 over a horizon of 10 000",
       .source = "Rao & Mease, Optim. Control Appl. Meth. 21(1), 2000; NLOptControl's tutorial",
       .hard = "a boundary layer of length 1 at either end of a horizon of 10 000",
       .tags = {Tag::stiff},
       .closed_form = ClosedForm{hyper_sensitive_part(1.5, -1) + hyper_sensitive_part(1, 1),
                                 "costs of coming to 0 and of leaving it in unlimited time"},
       .refinement = 1e-7,
       .state = hyper_sensitive},
      {.name = "unicycle",
       .title = "A unicycle drives to a goal within 7 s",
       .source = "NLOptControl's tutorial",
       .hard = "the goal is reached by many ways: no unique answer, a singular Hessian",
       .tags = {Tag::local_optima},
       .closed_form = ClosedForm{0, "the goal, 4.5 m away, is within reach"},
       .remark = "the controls are not unique, so their polynomials may not meet",
       .resolve_controls = false,
       .state = unicycle},
      {.name = "linear-tangent-steering",
       .title = "Injection at given height and speed in least time",
       .source = "Bryson & Ho 1975; COPS 3.0, problem 9",
       .hard = "free final time",
       .tags = {Tag::free_final_time},
       .published = Published{"0.554577", "COPS 3.0, 200 intervals"},
       .closed_form = ClosedForm{steering_time(100, 5, 45), "the linear tangent law"},
       .remark = "the print is the trapezoidal rule's value on 200 intervals",
       .state = linear_tangent_steering},
      {.name = "zermelo",
       .title = "A ship crosses a current that grows across the way",
       .source = "Zermelo 1931; Bryson & Ho 1975",
       .hard = "free final time; headings differ by full turns",
       .tags = {Tag::free_final_time, Tag::local_optima},
       .closed_form = ClosedForm{zermelo_time(3.66, -1.86), "tan(theta_f) - tan(theta_0)"},
       .state = zermelo},
      {.name = "soap-film",
       .title = "The least surface between two rings",
       .source = "Bryson & Ho 1975, page 64",
       .hard = "near the distance at which the film breaks",
       .tags = {Tag::local_optima},
       .closed_form = ClosedForm{soap_film_area(0.45), "2 pi (tanh s + s / cosh^2 s), a catenary"},
       .state = soap_film},
      {.name = "isoperimetric",
       .title = "The largest area that a curve of length 1 encloses",
       .source = "Bryson & Ho 1975; Hall, YAPSS, isoperimetric",
       .hard = "the curve may be turned: no unique answer, a singular Hessian",
       .tags = {Tag::local_optima},
       .maximised = true,
       .closed_form = ClosedForm{1 / (4 * M_PI), "1 / (4 pi), a circle"},
       .state = isoperimetric},
      {.name = "hager",
       .title = "A linear regulator with a product term",
       .source = "Hager, Numer. Math. 87(2), 2000",
       .hard = "schemes of poor adjoints lose their order",
       .closed_form = ClosedForm{std::exp(-2.0) * (std::exp(4.0) - 1) * 1.049935854035065e-1,
                                 "1.049935854035065e-1 e^-2 (e^4 - 1)"},
       .state = hager},
      {.name = "hager-hou-rao",
       .title = "Two states, coupled to their controls nonlinearly",
       .source = "Hager, Hou & Rao, J. Optim. Theory Appl. 169(3), 2016",
       .hard = "not convex, and yet with an exact solution",
       .closed_form = ClosedForm{1.049935854035065e-1 * (std::exp(2.0) - std::exp(-2.0)) -
                                     1.654173135087694 * std::exp(-3.0) +
                                     8.200570518363271e-3 * std::exp(3.0) + 1.645972564569331,
                                 "DT QP Project, HagerHouRao1"},
       .state = hager_hou_rao},
      {.name = "garg",
       .title = "x' = 2 x + 2 u sqrt(x) over a horizon of 5",
       .source = "Garg et al., AIAA 2009-5989",
       .hard = "unstable in both directions of time",
       .tags = {Tag::stiff},
       .closed_form = ClosedForm{(r2 * 4.751785916162887e29 + 1.58646708497826e29) *
                                     (std::exp(r2 * 10) - 1) * 2.273462462219277e-36,
                                 "DT QP Project, Nonlinear1D"},
       .state = garg},
      {.name = "neuenhofen-kerrigan",
       .title = "A control that enters linearly, weighted by a cosine",
       .source = "Neuenhofen & Kerrigan, IEEE CDC 2020, X1",
       .hard = "the Hessian in the control is 0: collocation rings",
       .tags = {Tag::singular_arc},
       .published = Published{"-0.256996962561", "PSOPT Application Examples 2026, section 12"},
       .closed_form = ClosedForm{-0.256996962561, "y = -sin t / (2 - cos t)"},
       .state = neuenhofen_kerrigan},
      {.name = "target-line",
       .title = "A double integrator to a line by least energy",
       .source = "Locatelli 2017; PSOPT's example mineng_target_set",
       .hard = "an equation between final states",
       .closed_form = ClosedForm{3.0 / 14, "3/14"},
       .state = target_line},
  };
}

}  // namespace slalom::problems
