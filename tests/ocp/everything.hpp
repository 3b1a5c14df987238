#pragma once

#include <functional>
#include <string>
#include <vector>

#include "slalom/ocp/problem.hpp"

namespace slalom::ocp {

/// A number by its name, and how a user sets it.
struct Change {
  std::string number;
  std::function<void(Problem&, double by)> add;
};

/// Everything a problem may have, in a form that has one answer: numbers of all kinds, a free end,
/// end values away from their ends, a slack, an integral, families, soft rows, a moment.
struct Everything {
  /// Bounds that stand where they are declared.
  struct Declared {
    double lower_x = -4, upper_v = 0.9, lower_u = -2.5, upper_work = 40, arrival = 2, power = 0.8;
    double upper_disc = 3;
  };
  Declared given;
  Problem problem{"everything"};
  Expr x = problem.state("x", {given.lower_x, 3}, 2);
  Expr v = problem.state("v", Bounds::at_most(given.upper_v));
  Expr u = problem.control("u", {given.lower_u, 4}, 3);
  Expr mass = problem.parameter("mass", 1.2);
  Expr drag = problem.parameter("drag", 0.3);
  Expr gain = problem.static_parameter("gain", {0.2, 5}, 1, 2);
  Expr late = problem.slack("late", End::final, Bounds::at_least(0), 0.1);
  Expr work = problem.integral("work", square(u), Bounds::at_most(given.upper_work));
  ConstraintId discs, limit, wall, fence;

  Everything() : Everything(Declared()) {}
  explicit Everything(Declared declared) : given(declared) {
    const Expr t = problem.time();
    problem.dynamics(x, v);
    problem.dynamics(v, u / mass - drag * v * sqrt(square(v) + 0.1) + 0.1 * problem.initial(x) * t);
    problem.lagrange("effort", square(u) / gain + 0.2 * square(x - 1));
    problem.mayer("time", mass * problem.final_time() + 3 * square(late) + late);
    problem.mayer("gain", 0.4 * gain);
    problem.mayer("work", 0.05 * work * drag);
    problem.initial_bounds(x, Bounds::equal(0.1));
    problem.initial_bounds(v, Bounds::equal(0));
    problem.final_bounds(v, {-0.2, 0.05});
    problem.boundary("arrival", problem.final(x) + late, Bounds::equal(given.arrival));
    problem.final_time({0.5, 8}, 3);
    const Expr a = Expr::symbol("a"), b = Expr::symbol("b");
    discs = problem.path_family("disc", {a, b}, x - a + b * v, {-6, given.upper_disc});
    problem.set_members(discs, {"one", "two"}, {{0.2, 0.5}, {-0.3, 0.4}});
    limit = problem.path("power", u * v, Bounds::at_most(given.power), Points::after_first);
    wall = problem.path("wall", v - 0.3 * mass * t, Bounds::at_most(0.2));
    problem.soften(wall, {Norm::l2, 5, 0.01});
    fence = problem.path("fence", u + drag * x, {-1.5, 2});
    problem.soften(fence, {Norm::l1, 0.6, 0});
    problem.path_at("half", v - u / 20, Moment::share(0.5), Bounds::at_most(0.7));
  }

  std::vector<Change> changes() const {
    const auto parameter = [](const Expr& symbol, double value) {
      return [symbol, value](Problem& p, double by) { p.set_parameter(symbol, value + by); };
    };
    const auto member = [this](std::size_t m, std::size_t i) {
      return [this, m, i](Problem& p, double by) {
        auto values = p.constraints()[discs.index].member_values;
        values[m][i] += by;
        p.set_members(discs, p.constraints()[discs.index].members, values);
      };
    };
    const auto declared = [](double Declared::*bound) {
      return [bound](Problem& p, double by) {
        Declared moved;
        moved.*bound += by;
        p = Everything(moved).problem;
      };
    };
    return {
        {"lower x", declared(&Declared::lower_x)},
        {"upper v", declared(&Declared::upper_v)},
        {"lower u", declared(&Declared::lower_u)},
        {"upper work", declared(&Declared::upper_work)},
        {"arrival", declared(&Declared::arrival)},
        {"upper power", declared(&Declared::power)},
        {"upper disc", declared(&Declared::upper_disc)},
        {"mass", parameter(mass, 1.2)},
        {"drag", parameter(drag, 0.3)},
        {"initial x",
         [this](Problem& p, double by) { p.initial_bounds(x, Bounds::equal(0.1 + by)); }},
        {"initial v", [this](Problem& p, double by) { p.initial_bounds(v, Bounds::equal(by)); }},
        {"upper final v",
         [this](Problem& p, double by) {
           p.final_bounds(v, {-0.2, 0.05 + by});
         }},
        {"lower final v",
         [this](Problem& p, double by) {
           p.final_bounds(v, {-0.2 + by, 0.05});
         }},
        {"lower tf",
         [](Problem& p, double by) {
           p.final_time({0.5 + by, 8}, 3);
         }},
        {"upper tf",
         [](Problem& p, double by) {
           p.final_time({0.5, 8 + by}, 3);
         }},
        {"disc[one].a", member(0, 0)},
        {"disc[two].b", member(1, 1)},
        {"weight of wall",
         [this](Problem& p, double by) {
           p.soften(wall, {Norm::l2, 5 + by, 0.01});
         }},
    };
  }
};

}  // namespace slalom::ocp
