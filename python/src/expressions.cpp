#include <nanobind/operators.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "binding.hpp"
#include "slalom/base/error.hpp"
#include "slalom/expr/expr.hpp"
#include "slalom/expr/function.hpp"
#include "slalom/expr/spline.hpp"

namespace slalom::python {
namespace {

using expr::Expr;
using Unary = Expr (*)(const Expr&);
using Binary = Expr (*)(const Expr&, const Expr&);

/// One name for each elementary function: of the module, of Expr's method (which NumPy calls on
/// arrays of objects), and NumPy's own where it differs.
struct UnaryName {
  const char *name, *numpy;
  Unary function;
};
struct BinaryName {
  const char *name, *numpy;
  Binary function;
};

const UnaryName kUnary[] = {{"square", "square", expr::square}, {"sqrt", "sqrt", expr::sqrt},
                            {"exp", "exp", expr::exp},          {"log", "log", expr::log},
                            {"sin", "sin", expr::sin},          {"cos", "cos", expr::cos},
                            {"tan", "tan", expr::tan},          {"arcsin", "arcsin", expr::asin},
                            {"arccos", "arccos", expr::acos},   {"arctan", "arctan", expr::atan},
                            {"sinh", "sinh", expr::sinh},       {"cosh", "cosh", expr::cosh},
                            {"tanh", "tanh", expr::tanh},       {"absolute", "absolute", expr::abs},
                            {"sign", "sign", expr::sign}};

const BinaryName kBinary[] = {{"arctan2", "arctan2", expr::atan2},
                              {"minimum", "minimum", expr::min},
                              {"maximum", "maximum", expr::max},
                              {"power", "power", expr::pow}};

/// NumPy's functions that are operators here.
const std::map<std::string, std::function<Expr(const Expr&, const Expr&)>> kOperators = {
    {"add", [](const Expr& a, const Expr& b) { return a + b; }},
    {"subtract", [](const Expr& a, const Expr& b) { return a - b; }},
    {"multiply", [](const Expr& a, const Expr& b) { return a * b; }},
    {"divide", [](const Expr& a, const Expr& b) { return a / b; }},
    {"true_divide", [](const Expr& a, const Expr& b) { return a / b; }},
    {"float_power", [](const Expr& a, const Expr& b) { return pow(a, b); }},
    {"arctan2", expr::atan2},
    {"hypot", [](const Expr& a, const Expr& b) { return sqrt(square(a) + square(b)); }},
    {"minimum", expr::min},
    {"maximum", expr::max},
    {"fmin", expr::min},
    {"fmax", expr::max},
    {"power", [](const Expr& a, const Expr& b) { return pow(a, b); }}};

const std::map<std::string, std::function<Expr(const Expr&)>>& unary_by_numpy_name() {
  static const auto names = [] {
    std::map<std::string, std::function<Expr(const Expr&)>> map;
    for (const auto& each : kUnary) map[each.numpy] = each.function;
    map["fabs"] = expr::abs;
    map["negative"] = [](const Expr& a) { return -a; };
    map["positive"] = [](const Expr& a) { return a; };
    map["reciprocal"] = [](const Expr& a) { return 1 / a; };
    map["exp2"] = [](const Expr& a) { return pow(Expr(2.0), a); };
    map["expm1"] = [](const Expr& a) { return exp(a) - 1; };
    map["log1p"] = [](const Expr& a) { return log(1 + a); };
    map["log2"] = [](const Expr& a) { return log(a) * (1 / M_LN2); };
    map["log10"] = [](const Expr& a) { return log(a) * (1 / M_LN10); };
    map["cbrt"] = [](const Expr& a) { return sign(a) * pow(abs(a), Expr(1.0 / 3)); };
    map["deg2rad"] = map["radians"] = [](const Expr& a) { return a * (M_PI / 180); };
    map["rad2deg"] = map["degrees"] = [](const Expr& a) { return a * (180 / M_PI); };
    return map;
  }();
  return names;
}

const std::set<std::string> kComparisons = {"less",          "less_equal", "greater",
                                            "greater_equal", "equal",      "not_equal"};

bool refuse_order(const Expr&, nb::handle) {
  throw nb::type_error(
      "an expression is not compared: a row is path(name, x, upper=2) or boundary(name, x, "
      "equal=2), a bound state(name, upper=2), a choice slalom.select(x - 2, if_positive, "
      "otherwise)");
}

bool is_array(nb::handle value) {
  return nb::hasattr(value, "ndim") && nb::cast<int>(value.attr("ndim")) > 0;
}

Expr to_expr(nb::handle value) {
  if (nb::isinstance<Expr>(value)) return nb::cast<Expr>(value);
  return Expr(nb::cast<double>(nb::float_(nb::borrow(value))));
}

Expr clip(Expr value, nb::handle lower, nb::handle upper) {
  if (lower.is_valid() && !lower.is_none()) value = max(value, to_expr(lower));
  if (upper.is_valid() && !upper.is_none()) value = min(value, to_expr(upper));
  return value;
}

/// NumPy's function of one Expr and numbers; of arrays, element by element, an array of objects.
nb::object ufunc(const std::string& name, const nb::args& inputs) {
  for (const nb::handle input : inputs)
    if (is_array(input)) {
      const nb::module_ numpy = nb::module_::import_("numpy");
      const nb::object element =
          nb::cpp_function([name](const nb::args& items) { return ufunc(name, items); });
      // As arrays of objects all: NumPy would hand a bare Expr back to this very function.
      nb::list arrays;
      for (const nb::handle each : inputs)
        arrays.append(numpy.attr("asarray")(each, "dtype"_a = "object"));
      return numpy.attr("frompyfunc")(element, inputs.size(), 1)(*arrays);
    }
  if (inputs.size() == 1) {
    const auto found = unary_by_numpy_name().find(name);
    if (found != unary_by_numpy_name().end()) return nb::cast(found->second(to_expr(inputs[0])));
  } else if (inputs.size() == 2) {
    const auto found = kOperators.find(name);
    if (found != kOperators.end())
      return nb::cast(found->second(to_expr(inputs[0]), to_expr(inputs[1])));
  } else if (name == "clip" && inputs.size() == 3) {
    return nb::cast(clip(to_expr(inputs[0]), inputs[1], inputs[2]));
  }
  if (kComparisons.contains(name)) refuse_order({}, {});
  throw nb::type_error(("numpy." + name +
                        " is not known of expressions; what is: arithmetic, the elementary "
                        "functions (sqrt, exp, sin, ...), arctan2, hypot, minimum, maximum, clip; "
                        "slalom.select chooses by a condition")
                           .c_str());
}

nb::object array_ufunc(const Expr&, nb::handle function, const std::string& method,
                       const nb::args& inputs, const nb::kwargs& options) {
  const auto name = nb::cast<std::string>(function.attr("__name__"));
  if (method != "__call__" || options.size() != 0) return nb::steal(Py_NewRef(Py_NotImplemented));
  return ufunc(name, inputs);
}

std::string text(const Expr& e) {
  if (e.is_symbol()) return "Expr(" + e.name() + ")";
  if (e.is_constant())
    return "Expr(" + nb::cast<std::string>(nb::repr(nb::float_(e.value()))) + ")";
  std::string names;
  for (const auto& symbol : expr::symbols_of({e}))
    names += (names.empty() ? "" : ", ") + symbol.name();
  return "Expr(of " + names + ")";
}

/// The number an expression comes to where each symbol has a value.
double evaluate(const Expr& e, const std::vector<std::pair<Expr, double>>& values) {
  std::vector<Expr> symbols;
  std::vector<double> numbers;
  for (const auto& [symbol, number] : values) {
    symbols.push_back(symbol);
    numbers.push_back(number);
  }
  double result = 0;
  expr::Function(symbols, {}, {e})(numbers, {}, {&result, 1});
  return result;
}

/// A table of numbers or of expressions.
template <class Value>
void bind_spline(nb::module_& module) {
  static const std::string documentation = std::string(doc::expr_cubic_spline) +
                                           "\n\n`beyond` says how it goes on beyond its ends: "
                                           "\"line\", of which solve warns when an answer "
                                           "is there, or\n\"hold\" at the value there.";
  module.def(
      "cubic_spline",
      [](const Expr& x, const std::vector<double>& knots, const std::vector<Value>& values,
         const std::string& beyond) {
        if (beyond != "line" && beyond != "hold")
          throw InvalidValue("cubic_spline: beyond", "'" + beyond + "'", "'line' or 'hold'");
        return expr::cubic_spline(x, knots, values,
                                  beyond == "hold" ? expr::Beyond::hold : expr::Beyond::line);
      },
      "x"_a, "knots"_a, "values"_a, nb::kw_only(), "beyond"_a = "line", documentation.c_str());
}

}  // namespace

void bind_expressions(nb::module_& module) {
  auto type = nb::class_<Expr>(module, "Expr", doc::expr_Expr);
  type.def(nb::init<double>(), "value"_a)
      .def_static("symbol", &Expr::symbol, "name"_a, doc::expr_Expr_symbol)
      .def("__repr__", &text)
      .def("evaluate", &evaluate, "values"_a,
           "The number it comes to, given pairs (symbol, number). Raises Error for a symbol left "
           "out.")
      .def(nb::self + nb::self)
      .def(nb::self - nb::self)
      .def(nb::self * nb::self)
      .def(nb::self / nb::self)
      .def(
          "__radd__", [](const Expr& a, double b) { return b + a; }, nb::is_operator())
      .def(
          "__rsub__", [](const Expr& a, double b) { return b - a; }, nb::is_operator())
      .def(
          "__rmul__", [](const Expr& a, double b) { return b * a; }, nb::is_operator())
      .def(
          "__rtruediv__", [](const Expr& a, double b) { return b / a; }, nb::is_operator())
      .def(
          "__pow__", [](const Expr& a, const Expr& b) { return pow(a, b); }, nb::is_operator())
      .def(
          "__rpow__", [](const Expr& a, double b) { return pow(b, a); }, nb::is_operator())
      .def(-nb::self)
      .def("__pos__", [](const Expr& a) { return a; })
      .def(
          "__abs__", [](const Expr& a) { return abs(a); }, doc::expr_abs)
      .def("__bool__",
           [](const Expr&) -> bool {
             throw nb::type_error(
                 "an expression has no truth value; slalom.select(condition, if_positive, "
                 "otherwise) chooses by one");
           })
      .def("__float__",
           [](const Expr&) -> double {
             throw nb::type_error(
                 "an expression is no number: numpy's functions take it (numpy.sin), math's do "
                 "not; slalom.cubic_spline goes through a table");
           })
      .def(
          "clip",
          [](const Expr& a, nb::handle lower, nb::handle upper, const nb::kwargs&) {
            return clip(a, lower, upper);
          },
          "min"_a = nb::none(), "max"_a = nb::none(), "options"_a,
          "numpy.clip of an expression, by minimum and maximum.")
      .def("__lt__", &refuse_order)
      .def("__le__", &refuse_order)
      .def("__gt__", &refuse_order)
      .def("__ge__", &refuse_order)
      .def("__array_ufunc__", &array_ufunc, "function"_a, "method"_a, "inputs"_a, "options"_a);
  nb::implicitly_convertible<double, Expr>();
  nb::implicitly_convertible<int, Expr>();

  for (const auto& each : kUnary) {
    const auto documentation = std::string("numpy.") + each.numpy + " of an expression.";
    module.def(each.name, each.function, "a"_a, documentation.c_str());
    type.def(each.name, each.function, documentation.c_str());
  }
  for (const auto& each : kBinary) {
    const auto documentation = std::string("numpy.") + each.numpy + " of two expressions.";
    module.def(each.name, each.function, "a"_a, "b"_a, documentation.c_str());
  }
  module.def("select", &expr::select, "condition"_a, "if_positive"_a, "otherwise"_a,
             doc::expr_select);
  bind_spline<double>(module);
  bind_spline<Expr>(module);
}

}  // namespace slalom::python
