#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/kinks.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <variant>

#include <nanobind/stl/variant.h>

#include "binding.hpp"
#include "bounds.hpp"
#include "slalom/base/error.hpp"
#include "solved.hpp"

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

ocp::ControlForm form_of(const std::string& word) {
  if (word == "scheme") return ocp::ControlForm::scheme;
  if (word == "linear") return ocp::ControlForm::linear;
  if (word == "constant") return ocp::ControlForm::constant;
  throw InvalidValue("form of a control", "'" + word + "'", "'scheme', 'linear' or 'constant'");
}

ocp::Norm norm_of(const std::string& word) {
  if (word == "l1") return ocp::Norm::l1;
  if (word == "l2") return ocp::Norm::l2;
  throw InvalidValue("norm of a soft constraint", "'" + word + "'", "'l1' or 'l2'");
}

/// A constraint by its handle or name.
using Which = std::variant<ConstraintId, std::string>;

ConstraintId constraint(const Problem& problem, const Which& which) {
  if (const auto* id = std::get_if<ConstraintId>(&which)) return *id;
  return named([&] { return problem.constraint_named(std::get<std::string>(which)); });
}

/// A time, or a share of the horizon.
using At = std::optional<double>;

std::optional<ocp::Moment> moment_of(const std::string& what, const At& time, const At& share) {
  if (time && share)
    throw InvalidValue(what, "both at and at_share", "a time or a share of the horizon");
  if (time) return ocp::Moment::time(*time);
  if (share) return ocp::Moment::share(*share);
  return std::nullopt;
}

/// What softens a constraint, if Python names a norm.
using Softness = std::optional<std::string>;

/// Declares a constraint, soft if a norm says so. What softens it is checked first, so that what is
/// refused is not there.
template <class Declare>
ConstraintId declared(Problem& problem, const std::string& name, const Softness& norm,
                      double weight, double tolerance, const Declare& declare) {
  std::optional<ocp::Soft> soft;
  if (norm) {
    soft = ocp::Soft{norm_of(*norm), weight, tolerance};
    check(*soft, problem.name() + ": " + name);
  }
  const ConstraintId id = declare();
  if (soft) problem.soften(id, *soft);
  return id;
}

/// C++ takes 0 for no scale.
double scale_of(Limit scale) {
  if (scale && *scale == 0) throw InvalidValue("scale", "0", "a number > 0, or None");
  return scale.value_or(ocp::kAutomaticScale);
}

Expr state(Problem& problem, const std::string& name, Limit lower, Limit upper,
           const std::optional<EndBounds>& initial, const std::optional<EndBounds>& final,
           Limit scale) {
  const auto at_end = [](const std::optional<EndBounds>& end) {
    return end ? bounds(*end) : ocp::Bounds();
  };
  return problem.state(name, bounds(lower, upper), scale_of(scale), at_end(initial), at_end(final));
}

/// The guess that is given, else the value that the bounds leave, their middle, or the finite one.
double guess_of(const std::optional<double>& guess, const ocp::Bounds& limits) {
  if (guess) return *guess;
  const bool below = std::isfinite(limits.lower), above = std::isfinite(limits.upper);
  if (below && above) return limits.lower + (limits.upper - limits.lower) / 2;
  return below ? limits.lower : above ? limits.upper : 1;
}

void bind_variables(nb::class_<Problem>& type) {
  const auto control_doc = std::string(doc::ocp_Problem_control) + "\n\n`form`: " + "scheme (" +
                           doc::ocp_ControlForm_scheme + "), linear (" +
                           doc::ocp_ControlForm_linear + ") or constant (" +
                           doc::ocp_ControlForm_constant + ").";
  type.def("state", &state, "name"_a, nb::kw_only(), "lower"_a = nb::none(), "upper"_a = nb::none(),
           "initial"_a = nb::none(), "final"_a = nb::none(), "scale"_a = nb::none(),
           doc::ocp_Problem_state)
      .def(
          "control",
          [](Problem& p, const std::string& name, Limit lower, Limit upper, Limit scale,
             const std::string& form) {
            const auto how = form_of(form);
            const Expr symbol = p.control(name, bounds(lower, upper), scale_of(scale));
            p.control_form(symbol, how);
            return symbol;
          },
          "name"_a, nb::kw_only(), "lower"_a = nb::none(), "upper"_a = nb::none(),
          "scale"_a = nb::none(), "form"_a = "scheme", control_doc.c_str())
      .def(
          "static_parameter",
          [](Problem& p, const std::string& name, Limit lower, Limit upper,
             std::optional<double> guess, Limit scale) {
            const auto limits = bounds(lower, upper);
            return p.static_parameter(name, limits, guess_of(guess, limits), scale_of(scale));
          },
          "name"_a, nb::kw_only(), "lower"_a = nb::none(), "upper"_a = nb::none(),
          "guess"_a = nb::none(), "scale"_a = nb::none(), doc::ocp_Problem_static_parameter)
      .def(
          "slack",
          [](Problem& p, const std::string& name, const std::string& end, Limit lower, Limit upper,
             double guess) { return p.slack(name, end_of(end), bounds(lower, upper), guess); },
          "name"_a, "end"_a, nb::kw_only(), "lower"_a = nb::none(), "upper"_a = nb::none(),
          "guess"_a = 0.0, doc::ocp_Problem_slack)
      .def(
          "integral",
          [](Problem& p, const std::string& name, const Expr& integrand, Limit lower, Limit upper,
             Limit equal, Limit scale) {
            return p.integral(name, integrand, bounds(lower, upper, equal), scale_of(scale));
          },
          "name"_a, "integrand"_a, nb::kw_only(), "lower"_a = nb::none(), "upper"_a = nb::none(),
          "equal"_a = nb::none(), "scale"_a = nb::none(), doc::ocp_Problem_integral)
      .def("set_scale", nb::overload_cast<const Expr&, double>(&Problem::set_scale), "variable"_a,
           "scale"_a, doc::ocp_Problem_set_scale)
      .def(
          "set_scale",
          [](Problem& p, const Which& which, double scale) {
            p.set_scale(constraint(p, which), scale);
          },
          "constraint"_a, "scale"_a, "Likewise of a constraint.")
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

/// Adds what constraints of all kinds take: bounds, and what softens them.
template <class Add, class... Extra>
void def_constraint(nb::class_<Problem>& type, const char* name, const Add& add,
                    const char* documentation, const Extra&... arguments) {
  static const std::string soft = std::string("\n\n`soft`, \"l1\" or \"l2\", makes it soft. ") +
                                  doc::ocp_Soft + "\n\nThe norm: " + doc::ocp_Norm;
  type.def(name, add, arguments..., "lower"_a = nb::none(), "upper"_a = nb::none(),
           "equal"_a = nb::none(), "soft"_a = nb::none(), "weight"_a = 1.0, "tolerance"_a = 0.0,
           (documentation + soft).c_str());
}

void bind_constraints(nb::class_<Problem>& type) {
  static const std::string path_doc = std::string(doc::ocp_Problem_path) +
                                      "\nWith `at`, a time, or `at_share` of the horizon, at that "
                                      "moment alone; every mesh gets a node "
                                      "there.";
  def_constraint(
      type, "path",
      [](Problem& p, const std::string& name, const Expr& value, bool after_first, const At& at,
         const At& at_share, Limit lower, Limit upper, Limit equal, const Softness& soft,
         double weight, double tolerance) {
        const auto row = bounds(lower, upper, equal);
        const auto moment = moment_of("path " + name, at, at_share);
        return declared(p, name, soft, weight, tolerance, [&] {
          return moment ? p.path_at(name, value, *moment, row)
                        : p.path(name, value, row, points_of(after_first));
        });
      },
      path_doc.c_str(), "name"_a, "value"_a, nb::kw_only(), "after_first"_a = false,
      "at"_a = nb::none(), "at_share"_a = nb::none());
  def_constraint(
      type, "boundary",
      [](Problem& p, const std::string& name, const Expr& value, Limit lower, Limit upper,
         Limit equal, const Softness& soft, double weight, double tolerance) {
        const auto row = bounds(lower, upper, equal);
        return declared(p, name, soft, weight, tolerance,
                        [&] { return p.boundary(name, value, row); });
      },
      doc::ocp_Problem_boundary, "name"_a, "value"_a, nb::kw_only());
  def_constraint(
      type, "path_family",
      [](Problem& p, const std::string& name, const std::vector<Expr>& symbols, const Expr& value,
         bool after_first, Limit lower, Limit upper, Limit equal, const Softness& soft,
         double weight, double tolerance) {
        const auto row = bounds(lower, upper, equal);
        return declared(p, name, soft, weight, tolerance, [&] {
          return p.path_family(name, symbols, value, row, points_of(after_first));
        });
      },
      doc::ocp_Problem_path_family, "name"_a, "symbols"_a, "value"_a, nb::kw_only(),
      "after_first"_a = false);
  type.def("set_members", &Problem::set_members, "family"_a, "names"_a, "values"_a,
           doc::ocp_Problem_set_members)
      .def(
          "soften",
          [](Problem& p, const Which& which, const std::string& norm, double weight,
             double tolerance) {
            p.soften(constraint(p, which), {norm_of(norm), weight, tolerance});
          },
          "constraint"_a, "norm"_a = "l1", nb::kw_only(), "weight"_a = 1.0, "tolerance"_a = 0.0,
          doc::ocp_Problem_soften)
      .def(
          "harden", [](Problem& p, const Which& which) { p.harden(constraint(p, which)); },
          "constraint"_a, "Makes a constraint hard again.")
      .def(
          "enable",
          [](Problem& p, const Which& which, bool enabled) {
            p.enable(constraint(p, which), enabled);
          },
          "constraint"_a, "enabled"_a, doc::ocp_Problem_enable)
      .def(
          "enable_cost",
          [](Problem& p, const std::string& name, bool enabled) {
            named([&] { return p.enable_cost(name, enabled), 0; });
          },
          "name"_a, "enabled"_a, doc::ocp_Problem_enable_cost);
}

void bind_terms(nb::class_<Problem>& type) {
  type.def("smooth_kinks", &ocp::smooth_kinks, doc::ocp_smooth_kinks);
  static const std::string at_moment =
      "\nWith `at`, a time, or `at_share` of the horizon, it is a cost at that moment, of what "
      "path may "
      "use.";
  static const std::string mayer_doc = std::string(doc::ocp_Problem_mayer) + kMaximised + at_moment;
  static const std::string lagrange_doc = std::string(doc::ocp_Problem_lagrange) + kMaximised;
  type.def("dynamics", &Problem::dynamics, "state"_a, "rate"_a, doc::ocp_Problem_dynamics)
      .def(
          "mayer",
          [](Problem& p, const std::string& name, const Expr& value, bool maximise, const At& at,
             const At& at_share) {
            const Expr term = maximise ? -value : value;
            if (const auto moment = moment_of("mayer " + name, at, at_share))
              p.cost_at(name, term, *moment);
            else
              p.mayer(name, term);
          },
          "name"_a, "term"_a, nb::kw_only(), "maximise"_a = false, "at"_a = nb::none(),
          "at_share"_a = nb::none(), mayer_doc.c_str())
      .def(
          "lagrange",
          [](Problem& p, const std::string& name, const Expr& value, bool maximise) {
            p.lagrange(name, maximise ? -value : value);
          },
          "name"_a, "integrand"_a, nb::kw_only(), "maximise"_a = false, lagrange_doc.c_str())
      .def(
          "breakpoint",
          [](Problem& p, const At& at, const At& at_share) {
            const auto moment = moment_of("breakpoint", at, at_share);
            if (!moment)
              throw InvalidValue(p.name() + ": breakpoint", "no moment", "at or at_share");
            p.breakpoint(*moment);
          },
          "at"_a = nb::none(), nb::kw_only(), "at_share"_a = nb::none(),
          doc::ocp_Problem_breakpoint);
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
  bind_constraints(type);
  bind_ends(type);
}

}  // namespace slalom::python
