#include <cmath>

#include "statement.hpp"

// Problems whose optimal control is singular on a part of the horizon.

namespace slalom::problems {
namespace {

Statement goddard() {
  Problem p("goddard");
  const double Tc = 3.5, hc = 500, vc = 620, mf = 0.6, c = 0.5;
  const Expr h = p.state("h", Bounds::at_least(1)), v = p.state("v", Bounds::at_least(0));
  const Expr m = p.state("m", {mf, 1}), T = p.control("T", {0, Tc});
  const Expr drag = 0.5 * vc * square(v) * exp(-hc * (h - 1));
  p.dynamics(h, v);
  p.dynamics(v, (T - drag) / m - 1 / square(h));
  p.dynamics(m, -T / c);
  starts(p, h, 1);
  starts(p, v, 0);
  fixed(p, m, 1, mf);
  p.final_time(Bounds::at_least(0.01), 1);
  p.mayer("height", -p.final(h));
  return {p};
}

Statement catalyst_mixing() {
  Problem p("catalyst mixing");
  const Expr x1 = p.state("x1"), x2 = p.state("x2"), u = p.control("u", {0, 1});
  const Expr exchange = u * (10 * x2 - x1);
  p.dynamics(x1, exchange);
  p.dynamics(x2, -exchange - (1 - u) * x2);
  starts(p, x1, 1);
  starts(p, x2, 0);
  p.mayer("loss", p.final(x1) + p.final(x2) - 1);
  return {p};
}

Statement coasting() {
  Problem p("singular double integrator");
  const Expr x = p.state("x"), v = p.state("v"), u = p.control("u", {-1, 1});
  p.dynamics(x, v);
  p.dynamics(v, u);
  p.lagrange("cost", (1 + square(v)) / 2);
  fixed(p, x, 2, 5);
  fixed(p, v, 0, 0);
  p.final_time({2, 8}, 5);
  return {p};
}

Statement aly() {
  Problem p("singular regulator");
  const Expr x = p.state("x"), v = p.state("v"), u = p.control("u", {-1, 1});
  p.dynamics(x, v);
  p.dynamics(v, u);
  p.lagrange("cost", (square(x) + square(v)) / 2);
  starts(p, x, 0);
  starts(p, v, 1);
  horizon(p, 5);
  return {p};
}

Statement fishing() {
  Problem p("Lotka-Volterra fishing");
  const Expr x = p.state("prey", {0, 5}), y = p.state("predators", {0, 5});
  const Expr w = p.control("w", {0, 1});
  p.dynamics(x, x - x * y - 0.4 * x * w);
  p.dynamics(y, -y + x * y - 0.2 * y * w);
  p.lagrange("deviation", square(x - 1) + square(y - 1));
  starts(p, x, 0.5);
  starts(p, y, 0.7);
  horizon(p, 12);
  return {p};
}

}  // namespace

Entries singular_arcs() {
  return {
      {.name = "goddard",
       .title = "Goddard's rocket, highest ascent",
       .source = "Goddard 1919; COPS 3.0, problem 10",
       .hard = "thrust full, then singular, then 0",
       .tags = {Tag::singular_arc, Tag::free_final_time},
       .maximised = true,
       .published = Published{"1.01283", "COPS 3.0"},
       .state = goddard},
      {.name = "catalyst-mixing",
       .title = "Mixing of two catalysts along a tubular reactor",
       .source = "Gunn & Thomas 1965; COPS 3.0, problem 14",
       .hard = "bang, singular, bang; little depends on the mixture",
       .tags = {Tag::singular_arc},
       .published = Published{"-4.80556e-2", "COPS 3.0"},
       .refinement = 3e-7,
       .state = catalyst_mixing},
      {.name = "singular-regulator",
       .title = "A regulator whose cost has no control",
       .source = "Aly, Int. J. Control 28(5), 1978",
       .hard = "bang, then a singular arc of order 1",
       .tags = {Tag::singular_arc},
       .closed_form = ClosedForm{3.769919302879714e-1, "DT QP Project, SecondOrderSingular"},
       .state = aly},
      {.name = "coasting",
       .title = "A double integrator pays for time and speed",
       .source = "Locatelli, Optimal Control of a Double Integrator, 2017, problem 11.2-1a",
       .hard = "full ahead, coasting (singular), full back",
       .tags = {Tag::singular_arc, Tag::free_final_time},
       .closed_form = ClosedForm{10.0 / 3, "10/3, tf = 4"},
       .state = coasting},
      {.name = "fishing",
       .title = "Lotka-Volterra fishing, relaxed",
       .source = "Sager 2005; mintOC",
       .hard = "bang, bang, singular",
       .tags = {Tag::singular_arc},
       .published = Published{"1.34408", "mintOC, relaxed"},
       .intervals = 80,
       .state = fishing},
  };
}

}  // namespace slalom::problems
