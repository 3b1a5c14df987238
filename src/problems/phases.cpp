#include <cmath>
#include <string>

#include "statement.hpp"

// Problems of several phases.

namespace slalom::problems {
namespace {

/// x' = u, least integral of x^2 + u^2, x(0.75) given.
Statement interior_point() {
  PhasedProblem all("interior point");
  const auto stretch = [](const char* name, double t0, double tf, double from, double to) {
    Problem p(name);
    const Expr x = p.state("x", {-1, 1}), u = p.control("u", {-1, 1});
    p.dynamics(x, u);
    p.lagrange("cost", square(x) + square(u));
    fixed(p, x, from, to);
    p.initial_time(Bounds::equal(t0), t0);
    horizon(p, tf);
    return p;
  };
  all.add(stretch("before", 0, 0.75, 1, 0.9));
  all.add(stretch("after", 0.75, 1, 0.9, 0.75));
  all.connect(0, 1);
  return {all};
}

/// x'' = x between given values: (a^2 + b^2) coth T - 2 a b / sinh T.
double regulated_cost(double a, double b, double T) {
  return (a * a + b * b) / std::tanh(T) - 2 * a * b / std::sinh(T);
}

Statement schwartz() {
  PhasedProblem all("Schwartz");
  for (const bool first : {true, false}) {
    Problem p(first ? "around the ellipse" : "to the origin");
    const Expr x = p.state("x", {-20, 10}), v = p.state("v", {first ? -0.8 : -10, 10});
    const Expr u = p.control("u", {first ? -1.0 : -50.0, first ? 1.0 : 50.0});
    p.dynamics(x, v);
    p.dynamics(v, u - 0.1 * (1 + 2 * square(x)) * v);
    if (first) {
      starts(p, x, 1);
      starts(p, v, 1);
      p.path("ellipse", 9 * square(x - 1) + square((v - 0.4) / 0.3), Bounds::at_least(1));
      horizon(p, 1);
    } else {
      p.mayer("distance", 5 * (square(p.final(x)) + square(p.final(v))));
      p.initial_time(Bounds::equal(1), 1);
      horizon(p, 2.9);
    }
    all.add(p);
  }
  all.connect(0, 1);
  return {all, {line(0, 1, {1, 1}, {1, 1}, {0}, {0}), line(1, 2.9, {1, 1}, {1, 1}, {0}, {0})}};
}

Statement two_phase_robot() {
  PhasedProblem all("two-phase robot");
  for (const bool first : {true, false}) {
    Problem p(first ? "along x" : "along y");
    const Expr x = p.state("x"), y = p.state("y"), vx = p.state("vx"), vy = p.state("vy");
    const Expr ux = p.control("ux", {-10, 10}), uy = p.control("uy", {-10, 10});
    p.dynamics(x, vx);
    p.dynamics(y, vy);
    p.dynamics(vx, ux);
    p.dynamics(vy, uy);
    const Expr t = p.time();
    const Expr xr = first ? t / 2 : Expr(0.5), yr = first ? Expr(0) : (t - 1) / 2;
    p.lagrange("deviation",
               100 * (square(x - xr) + square(y - yr)) +
                   500 * (square(vx - (first ? 0.5 : 0)) + square(vy - (first ? 0 : 0.5))));
    const double ends_at[] = {0.5, 0.5, 0, 0.5}, begin_at[] = {0, 0, 0.5, 0};
    int i = 0;
    for (const auto& each : {x, y, vx, vy}) {
      if (first)
        starts(p, each, begin_at[i++]);
      else
        ends(p, each, ends_at[i++]);
    }
    p.initial_time(Bounds::equal(first ? 0 : 1), first ? 0 : 1);
    horizon(p, first ? 1 : 2);
    all.add(p);
  }
  all.connect(0, 1);
  return {all};
}

/// Goddard's rocket over a flat earth: full thrust, singular arc, none. The thrust of the arc is
/// the feedback that keeps it (Betts 2010, example 10.47). Feet, slugs, seconds.
Statement goddard_in_phases() {
  PhasedProblem all("goddard in three phases");
  const double Tm = 193.044, g = 32.174, sigma = 5.4915348492338101e-5, c = 1580.9425279876559,
               h0 = 23800;
  const char* names[] = {"boost", "singular arc", "coast"};
  const double masses[] = {3, 2.3, 1.7, 1};
  std::vector<ocp::Trajectory> guesses;
  for (int k = 0; k < 3; ++k) {
    Problem p(names[k]);
    const Expr h = p.state("h", {0, 30000}), v = p.state("v", {0, 10000}), m = p.state("m", {1, 3});
    const Expr drag = sigma * square(v) * exp(-h / h0);
    const Expr w = c / v;
    const Expr singular =
        drag + m * g +
        m * g / (1 + 4 * w + 2 * square(w)) * (c * c / (h0 * g) * (1 + v / c) - 1 - 2 * w);
    const Expr T = k == 0 ? Expr(Tm) : k == 1 ? singular : Expr(0);
    p.dynamics(h, v);
    p.dynamics(v, (T - drag) / m - g);
    p.dynamics(m, -T / c);
    if (k == 0) {
      starts(p, h, 0);
      starts(p, v, 0);
      starts(p, m, 3);
    }
    if (k == 1) {
      const Expr h1 = p.initial(h), v1 = p.initial(v), m1 = p.initial(m);
      p.boundary("singular", m1 * g - (1 + v1 / c) * sigma * square(v1) * exp(-h1 / h0),
                 Bounds::equal(0));
    }
    if (k == 2) {
      ends(p, m, 1);
      p.mayer("height", -p.final(h));
    }
    if (k > 0) p.initial_time({1, 60}, 15 * k);
    p.final_time({1, 100}, 15 * (k + 1));
    all.add(p);
    guesses.push_back(line(15 * k, 15 * (k + 1), {6000.0 * k, 500, masses[k]},
                           {6000.0 * (k + 1), 500, masses[k + 1]}, {}, {}));
  }
  all.connect(0, 1);
  all.connect(1, 2);
  return {all, guesses};
}

/// A unit mass slides from 0 to 1 in least time, the way cut in four.
Statement sliding_mass() {
  PhasedProblem all("sliding mass");
  std::vector<ocp::Trajectory> guesses;
  const int count = 4;
  for (int k = 0; k < count; ++k) {
    Problem p("quarter " + std::to_string(k + 1));
    const double from = k / 4.0, to = (k + 1) / 4.0;
    const Expr x = p.state("x", {from, to}), v = p.state("v", {0, 10}),
               f = p.control("f", {-20, 20});
    p.dynamics(x, v);
    p.dynamics(v, f);
    fixed(p, x, from, to);
    if (k == 0) starts(p, v, 0);
    if (k > 0) p.initial_time({0, 1}, from);
    p.final_time({0, 1}, to);
    if (k == count - 1) {
      ends(p, v, 0);
      p.mayer("arrival", p.final_time());
    }
    all.add(p);
    guesses.push_back(line(from, to, {from, 1}, {to, 1}, {0}, {0}));
  }
  for (std::size_t k = 0; k + 1 < count; ++k) all.connect(k, k + 1);
  return {all, guesses};
}

}  // namespace

Entries phases() {
  return {
      {.name = "interior-point",
       .title = "A regulator with a value given at t = 0.75",
       .source = "Jennings et al., MISER3 manual; PSOPT's example",
       .hard = "the control jumps where the value is given",
       .tags = {Tag::phases},
       .published = Published{"0.9205314414730", "PSOPT Application Examples 2026, section 6"},
       .closed_form = ClosedForm{regulated_cost(1, 0.9, 0.75) + regulated_cost(0.9, 0.75, 0.25),
                                 "(a^2 + b^2) coth T - 2 a b / sinh T, twice"},
       .intervals = 20,
       .state = interior_point},
      {.name = "schwartz",
       .title = "Around an ellipse, then to the origin",
       .source = "Schwartz 1989; Rutquist & Edvall, PROPT manual 2009",
       .hard = "the constraint is that of one phase",
       .tags = {Tag::phases, Tag::local_optima},
       .closed_form = ClosedForm{0, "the origin is within reach"},
       .remark = "the control of the second phase is not unique, so its polynomials may not meet",
       .resolve_controls = false,
       .intervals = 20,
       .state = schwartz},
      {.name = "two-phase-robot",
       .title = "A robot follows a path with a corner",
       .source = "Rutquist & Edvall, PROPT manual 2009; PSOPT's example",
       .hard = "bang arcs around the corner, singular ones elsewhere",
       .tags = {Tag::phases, Tag::singular_arc},
       .published = Published{"1.0426", "PSOPT, all examples 2026, twophase_robot"},
       .converged = 1.0416864,
       .remark =
           "the print is of 30 nodes a phase; refined to 1e-8, HS and LGR end at 1.0416862 and "
           "1.0416865",
       .state = two_phase_robot},
      {.name = "goddard-in-phases",
       .title = "Goddard's rocket: boost, singular arc, coast",
       .source = "Betts 2010, example 10.47; Hall, YAPSS",
       .hard = "the arc begins where its condition holds, and ends with the fuel",
       .tags = {Tag::phases, Tag::singular_arc, Tag::free_final_time},
       .maximised = true,
       .published = Published{"18550.8718638", "Hall, YAPSS, goddard_problem_3_phase"},
       .intervals = 20,
       .state = goddard_in_phases},
      {.name = "sliding-mass",
       .title = "A mass slides in least time, in four phases",
       .source = "Brockie, Pycollo's example multiphase_point_move",
       .hard = "all times between phases free; the control jumps between two",
       .tags = {Tag::phases, Tag::bang_bang, Tag::free_final_time},
       .published = Published{"0.4472136", "Pycollo's test"},
       .closed_form = ClosedForm{2 / std::sqrt(20.0), "2 / sqrt(20)"},
       .intervals = 10,
       .state = sliding_mass},
  };
}

}  // namespace slalom::problems
