#include <cmath>

#include "statement.hpp"

// Problems with constraints on the states that hold the optimum.

namespace slalom::problems {
namespace {

Statement bryson_denham() {
  Problem p("Bryson-Denham");
  const Expr x = p.state("x", Bounds::at_most(1.0 / 9)), v = p.state("v"), u = p.control("u");
  p.dynamics(x, v);
  p.dynamics(v, u);
  p.lagrange("effort", square(u) / 2);
  fixed(p, x, 0, 0);
  fixed(p, v, 1, -1);
  return {p};
}

Statement beam() {
  Problem p("beam");
  const Expr x = p.state("x", {-0.05, 0.05}), angle = p.state("angle", {-1, 1}), u = p.control("u");
  p.dynamics(x, sin(angle));
  p.dynamics(angle, u);
  p.lagrange("energy", square(u) + 350 * cos(angle));
  fixed(p, x, 0, 0);
  fixed(p, angle, 0, 0);
  return {p,
          {{0,
            1,
            {0, 0.25, 0.75, 1},
            {{0, 0}, {0, 0.1}, {0, -0.1}, {0, 0}},
            {{0.4}, {0.4}, {-0.4}, {-0.4}},
            {},
            {}}}};
}

Statement jacobson_lele() {
  Problem p("Jacobson & Lele");
  const Expr x1 = p.state("x1"), x2 = p.state("x2"), u = p.control("u", {-20, 20});
  p.dynamics(x1, x2);
  p.dynamics(x2, -x2 + u);
  p.lagrange("cost", square(x1) + square(x2) + 0.005 * square(u));
  p.path("parabola", x2 - 8 * square(p.time() - 0.5) + 0.5, Bounds::at_most(0));
  starts(p, x1, 0);
  starts(p, x2, -1);
  return {p};
}

Statement alp_rider() {
  Problem p("alp rider");
  const Expr y1 = p.state("y1"), y2 = p.state("y2"), y3 = p.state("y3"), y4 = p.state("y4");
  const Expr u1 = p.control("u1"), u2 = p.control("u2");
  const auto hill = [&](double at, double width) { return exp(-width * square(p.time() - at)); };
  const Expr height = square(y1) + square(y2) + square(y3) + square(y4);
  p.dynamics(y1, -10 * y1 + u1 + u2);
  p.dynamics(y2, -2 * y2 + u1 + 2 * u2);
  p.dynamics(y3, -3 * y3 + 5 * y4 + u1 - u2);
  p.dynamics(y4, 5 * y3 - 3 * y4 + u1 + 3 * u2);
  p.lagrange("cost", 100 * height + 0.01 * (square(u1) + square(u2)));
  p.path("terrain",
         height - 3 * hill(3, 12) - 3 * hill(6, 10) - 3 * hill(10, 6) - 8 * hill(15, 4) - 0.01,
         Bounds::at_least(0));
  fixed(p, y1, 2, 2);
  fixed(p, y2, 1, 3);
  fixed(p, y3, 2, 1);
  fixed(p, y4, 1, -2);
  horizon(p, 20);
  return {p};
}

Statement container_crane() {
  Problem p("container crane");
  const Expr x1 = p.state("x1"), x2 = p.state("x2"), x3 = p.state("x3");
  const Expr x4 = p.state("x4", {-2.5, 2.5}), x5 = p.state("x5", {-1, 1}), x6 = p.state("x6");
  const Expr u1 = p.control("u1", {-2.83374, 2.83374}), u2 = p.control("u2", {-0.80865, 0.71265});
  p.dynamics(x1, x4);
  p.dynamics(x2, x5);
  p.dynamics(x3, x6);
  p.dynamics(x4, u1 + 17.2656 * x3);
  p.dynamics(x5, u2);
  p.dynamics(x6, -(u1 + 27.0756 * x3 + 2 * x5 * x6) / x2);
  p.lagrange("swing", 0.5 * (square(x3) + square(x6) + 0.01 * (square(u1) + square(u2))));
  fixed(p, x1, 0, 10);
  fixed(p, x2, 22, 14);
  fixed(p, x3, 0, 0);
  fixed(p, x4, 0, 2.5);
  fixed(p, x5, -1, 0);
  fixed(p, x6, 0, 0);
  horizon(p, 9);
  return {p};
}

Statement robbins() {
  Problem p("Robbins");
  const Expr x1 = p.state("x1", Bounds::at_least(0)), x2 = p.state("x2"), x3 = p.state("x3");
  const Expr u = p.control("u");
  p.dynamics(x1, x2);
  p.dynamics(x2, x3);
  p.dynamics(x3, u);
  p.lagrange("cost", 3 * x1 + square(u) / 2);
  fixed(p, x1, 1, 0);
  fixed(p, x2, -2, 0);
  fixed(p, x3, 0, 0);
  horizon(p, 10);
  return {p};
}

Statement rayleigh() {
  Problem p("Rayleigh");
  const Expr x1 = p.state("x1"), x2 = p.state("x2"), u = p.control("u");
  p.dynamics(x1, x2);
  p.dynamics(x2, -x1 + x2 * (1.4 - 0.14 * square(x2)) + 4 * u);
  p.lagrange("cost", square(u) + square(x1));
  p.path("mixed", u + x1 / 6, Bounds::at_most(0));
  starts(p, x1, -5);
  starts(p, x2, -5);
  horizon(p, 4.5);
  return {p};
}

}  // namespace

Entries state_constraints() {
  return {
      {.name = "bryson-denham",
       .title = "A point turned back by least effort before x = 1/9",
       .source = "Bryson, Denham & Dreyfus 1963; Bryson & Ho 1975, section 3.11",
       .hard = "a state constraint of second order",
       .tags = {Tag::high_order_constraint},
       .closed_form = ClosedForm{4, "4 / (9 l), l = 1/9"},
       .state = bryson_denham},
      {.name = "beam",
       .title = "A beam, compressed by a force of 350, between two walls",
       .source =
           "Maurer & Mittelmann, Optim. Control Appl. Meth. 12(1), 1991; NLOptControl's tutorial",
       .hard = "the straight beam is a saddle point; buckled, it leans on a wall",
       .tags = {Tag::local_optima, Tag::high_order_constraint},
       .published = Published{"350", "NLOptControl's test"},
       .converged = 344.8761,
       .remark = "the print is of the straight beam, no minimum; CUTEst's CLNLBEAM prints 344.8788 "
                 "on 1000 "
                 "intervals; refined to 1e-8, LGR ends at 344.87612",
       .state = beam},
      {.name = "jacobson-lele",
       .title = "A regulator below a parabola in time",
       .source = "Jacobson & Lele, IEEE Trans. Autom. Control 14(5), 1969",
       .hard = "a state constraint of first order that holds for a while",
       .tags = {Tag::state_constraint},
       .published = Published{"0.169818", "PSOPT, all examples 2026, stc1"},
       .converged = 0.16982054,
       .remark = "the print is of 50 nodes; refined to 1e-8, HS and LGR end at 0.16982054",
       .state = jacobson_lele},
      {.name = "alp-rider",
       .title = "Follow a terrain of four hills",
       .source = "Betts 2010, pages 163-165",
       .hard = "stiff, and a state constraint touches at each hill",
       .tags = {Tag::stiff, Tag::state_constraint},
       .published = Published{"2030.85609", "Betts, A Collection of Optimal Control Test Problems"},
       .intervals = 200,
       .state = alp_rider},
      {.name = "container-crane",
       .title = "A container moved with little swing",
       .source = "Sakawa & Shindo, Automatica 18(3), 1982; Augustin & Maurer 2001",
       .hard = "bounds of speeds and of controls hold",
       .tags = {Tag::state_constraint},
       .published = Published{"0.0375195", "Betts, A Collection of Optimal Control Test Problems"},
       .state = container_crane},
      {.name = "robbins",
       .title = "A triple integrator held above 0",
       .source = "Robbins 1980; Bocop's example",
       .hard = "a state constraint of third order: it touches ever more often",
       .tags = {Tag::high_order_constraint},
       .converged = 19.431784,
       .remark =
           "HS and LGR end at 19.431783 and 19.431790 by 1e-9, where x1 no longer dips below 0 "
           "between points; 16000 equal intervals of HS give 19.431781",
       .refinement = 1e-9,
       .state = robbins},
      {.name = "rayleigh",
       .title = "An electric oscillator under a mixed constraint",
       .source = "Maurer & Augustin 2001; Betts 2010, example 4.6",
       .hard = "a constraint on control and state together",
       .published = Published{"44.8044433", "Betts, A Collection of Optimal Control Test Problems"},
       .state = rayleigh},
  };
}

}  // namespace slalom::problems
