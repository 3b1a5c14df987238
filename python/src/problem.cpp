#include "slalom/ocp/problem.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <variant>

#include <nanobind/stl/variant.h>

#include "binding.hpp"
#include "bounds.hpp"
#include "slalom/base/error.hpp"

namespace slalom::python {
namespace {

using ocp::ConstraintId;
using ocp::Expr;
using ocp::Problem;

/// The end of the horizon as a word.
ocp::End end_of(const std::string& word) {
  if (word == "initial") return ocp::End::initial;
  if (word == "final") return ocp::End::final;
  throw InvalidValue("end of a slack", "'" + word + "'", "'initial' or 'final'");
}

ocp::Points points_of(bool after_first) {
  return after_first ? ocp::Points::after_first : ocp::Points::all;
}

Expr state(Problem& problem, const std::string& name, Limit lower, Limit upper,
           const std::optional<EndBounds>& initial, const std::optional<EndBounds>& final,
           double scale) {
  const Expr symbol = problem.state(name, bounds(lower, upper), scale);
  if (initial) problem.initial_bounds(symbol, bounds(*initial));
  if (final) problem.final_bounds(symbol, bounds(*final));
  return symbol;
}

/// The guess that is given, else the value that the bounds leave, their middle, or the finite one.
double guess_of(const std::optional<double>& guess, const ocp::Bounds& limits) {
  if (guess) return *guess;
  const bool below = std::isfinite(limits.lower), above = std::isfinite(limits.upper);
  if (below && above) return limits.lower + (limits.upper - limits.lower) / 2;
  return below ? limits.lower : above ? limits.upper : 1;
}

void bind_variables(nb::class_<Problem>& type) {
  type.def("state", &state, "name"_a, nb::kw_only(), "lower"_a = nb::none(), "upper"_a = nb::none(),
           "initial"_a = nb::none(), "final"_a = nb::none(), "scale"_a = 1.0,
           doc::ocp_Problem_state)
      .def(
          "control",
          [](Problem& p, const std::string& name, Limit lower, Limit upper, double scale) {
            return p.control(name, bounds(lower, upper), scale);
          },
          "name"_a, nb::kw_only(), "lower"_a = nb::none(), "upper"_a = nb::none(), "scale"_a = 1.0,
          doc::ocp_Problem_control)
      .def(
          "static_parameter",
          [](Problem& p, const std::string& name, Limit lower, Limit upper,
             std::optional<double> guess, double scale) {
            const auto limits = bounds(lower, upper);
            return p.static_parameter(name, limits, guess_of(guess, limits), scale);
          },
          "name"_a, nb::kw_only(), "lower"_a = nb::none(), "upper"_a = nb::none(),
          "guess"_a = nb::none(), "scale"_a = 1.0, doc::ocp_Problem_static_parameter)
      .def(
          "slack",
          [](Problem& p, const std::string& name, const std::string& end, Limit lower, Limit upper,
             double guess) { return p.slack(name, end_of(end), bounds(lower, upper), guess); },
          "name"_a, "end"_a, nb::kw_only(), "lower"_a = nb::none(), "upper"_a = nb::none(),
          "guess"_a = 0.0, doc::ocp_Problem_slack)
      .def(
          "integral",
          [](Problem& p, const std::string& name, const Expr& integrand, Limit lower, Limit upper,
             Limit equal, double scale) {
            return p.integral(name, integrand, bounds(lower, upper, equal), scale);
          },
          "name"_a, "integrand"_a, nb::kw_only(), "lower"_a = nb::none(), "upper"_a = nb::none(),
          "equal"_a = nb::none(), "scale"_a = 1.0, doc::ocp_Problem_integral)
      .def("parameter", &Problem::parameter, "name"_a, "value"_a, doc::ocp_Problem_parameter)
      .def("set_parameter", &Problem::set_parameter, "parameter"_a, "value"_a,
           doc::ocp_Problem_set_parameter);
}

void bind_symbols(nb::class_<Problem>& type) {
  type.def_prop_ro("name", &Problem::name)
      .def_prop_ro("time", &Problem::time, doc::ocp_Problem_time)
      .def_prop_ro("tau", &Problem::tau, doc::ocp_Problem_tau)
      .def_prop_ro("t0", nb::overload_cast<>(&Problem::initial_time, nb::const_),
                   "The initial time, as a symbol.")
      .def_prop_ro("tf", nb::overload_cast<>(&Problem::final_time, nb::const_),
                   "The final time, as a symbol.")
      .def("initial", &Problem::initial, "state"_a, doc::ocp_Problem_initial)
      .def("final", &Problem::final, "state"_a, doc::ocp_Problem_final);
}

void bind_terms(nb::class_<Problem>& type) {
  type.def("dynamics", &Problem::dynamics, "state"_a, "rate"_a, doc::ocp_Problem_dynamics)
      .def("mayer", &Problem::mayer, "name"_a, "term"_a, doc::ocp_Problem_mayer)
      .def("lagrange", &Problem::lagrange, "name"_a, "integrand"_a, doc::ocp_Problem_lagrange)
      .def(
          "path",
          [](Problem& p, const std::string& name, const Expr& value, Limit lower, Limit upper,
             Limit equal, bool after_first) {
            return p.path(name, value, bounds(lower, upper, equal), points_of(after_first));
          },
          "name"_a, "value"_a, nb::kw_only(), "lower"_a = nb::none(), "upper"_a = nb::none(),
          "equal"_a = nb::none(), "after_first"_a = false, doc::ocp_Problem_path)
      .def(
          "boundary",
          [](Problem& p, const std::string& name, const Expr& value, Limit lower, Limit upper,
             Limit equal) { return p.boundary(name, value, bounds(lower, upper, equal)); },
          "name"_a, "value"_a, nb::kw_only(), "lower"_a = nb::none(), "upper"_a = nb::none(),
          "equal"_a = nb::none(), doc::ocp_Problem_boundary)
      .def(
          "path_family",
          [](Problem& p, const std::string& name, const std::vector<Expr>& symbols,
             const Expr& value, Limit lower, Limit upper, Limit equal, bool after_first) {
            return p.path_family(name, symbols, value, bounds(lower, upper, equal),
                                 points_of(after_first));
          },
          "name"_a, "symbols"_a, "value"_a, nb::kw_only(), "lower"_a = nb::none(),
          "upper"_a = nb::none(), "equal"_a = nb::none(), "after_first"_a = false,
          doc::ocp_Problem_path_family)
      .def("set_members", &Problem::set_members, "family"_a, "names"_a, "values"_a,
           doc::ocp_Problem_set_members)
      .def("enable", &Problem::enable, "constraint"_a, "enabled"_a, doc::ocp_Problem_enable)
      .def("enable_cost", &Problem::enable_cost, "name"_a, "enabled"_a,
           doc::ocp_Problem_enable_cost);
}

void bind_ends(nb::class_<Problem>& type) {
  using SetTime = void (Problem::*)(ocp::Bounds, double);
  const auto setter = [](SetTime set) {
    return [set](Problem& p, Limit lower, Limit upper, Limit equal, std::optional<double> guess) {
      const auto limits = bounds(lower, upper, equal);
      (p.*set)(limits, guess_of(guess, limits));
    };
  };
  type.def("initial_time", setter(&Problem::initial_time), nb::kw_only(), "lower"_a = nb::none(),
           "upper"_a = nb::none(), "equal"_a = nb::none(), "guess"_a = nb::none(),
           doc::ocp_Problem_initial_time)
      .def("final_time", setter(&Problem::final_time), nb::kw_only(), "lower"_a = nb::none(),
           "upper"_a = nb::none(), "equal"_a = nb::none(), "guess"_a = nb::none(),
           doc::ocp_Problem_final_time)
      .def(
          "initial_bounds",
          [](Problem& p, const Expr& state, Limit lower, Limit upper, Limit equal) {
            p.initial_bounds(state, bounds(lower, upper, equal));
          },
          "state"_a, nb::kw_only(), "lower"_a = nb::none(), "upper"_a = nb::none(),
          "equal"_a = nb::none(), doc::ocp_Problem_initial_bounds)
      .def(
          "final_bounds",
          [](Problem& p, const Expr& state, Limit lower, Limit upper, Limit equal) {
            p.final_bounds(state, bounds(lower, upper, equal));
          },
          "state"_a, nb::kw_only(), "lower"_a = nb::none(), "upper"_a = nb::none(),
          "equal"_a = nb::none(), doc::ocp_Problem_final_bounds);
}

}  // namespace

void bind_problem(nb::module_& module) {
  nb::class_<ConstraintId>(module, "ConstraintId", doc::ocp_ConstraintId);
  auto type = nb::class_<Problem>(module, "Problem", doc::ocp_Problem);
  type.def(nb::init<std::string>(), "name"_a);
  bind_variables(type);
  bind_symbols(type);
  bind_terms(type);
  bind_ends(type);
}

}  // namespace slalom::python
