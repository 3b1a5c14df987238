#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "slalom/expr/expr.hpp"

namespace slalom::ocp {

using expr::Expr;

/// The value of a scale that is not given: solve() finds one.
inline constexpr double kAutomaticScale = 0;
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// lower <= value <= upper; equal for an equation, infinite for an absent side.
struct Bounds {
  double lower = -kInfinity;
  double upper = kInfinity;

  /// Whether either side is present.
  bool bounded() const { return lower > -kInfinity || upper < kInfinity; }

  static Bounds equal(double value) { return {value, value}; }
  static Bounds at_least(double value) { return {value, kInfinity}; }
  static Bounds at_most(double value) { return {-kInfinity, value}; }
};

/// The points at which a path constraint holds.
enum class Points { all, after_first };

/// The end of the horizon at which a slack lives.
enum class End { initial, final };

/// A moment within the horizon: a time, which needs fixed ends of the horizon, or a share of it.
struct Moment {
  double value = 0;
  bool is_share = false;

  static Moment time(double t) { return {t, false}; }
  static Moment share(double tau) { return {tau, true}; }  ///< 0 at t0, 1 at tf
  bool operator==(const Moment&) const = default;
};

/// The form of a control within an interval of the mesh.
enum class ControlForm {
  scheme,    ///< as the scheme's polynomial through the collocated points
  linear,    ///< a line from the interval's start to its end
  constant,  ///< held over the interval; a node's value is that of the next interval
};

/// The cost of the excess e over a soft constraint's bounds: `weight` e (l1) or `weight` e^2 (l2),
/// integrated over time for a path row.
enum class Norm { l1, l2 };

/// How a constraint is softened: an excess over its bounds by more than `tolerance` [its unit]
/// costs. An l1 cost with a weight above the hard constraint's multiplier does not change the
/// optimum (exact penalty; Nocedal & Wright 2006, section 17.2); an l2 cost always allows a small
/// excess.
struct Soft {
  Norm norm = Norm::l1;
  double weight = 1;
  double tolerance = 0;
};
/// Throws InvalidValue for a weight or a tolerance that is none; `where` says of what.
void check(const Soft& soft, const std::string& where);

/// Handle of a constraint, to switch it, soften it or change a family's members.
struct ConstraintId {
  std::size_t index;
};

/// An optimal-control problem of one phase in continuous time:
///
///   min  Mayer(initial, final, t0, tf, p) + integral of Lagrange(x, u, t, p) dt
///   x' = f(x, u, t, p),  path rows, boundary rows, bounds, t0 <= t <= tf
///
/// States, controls and everything else are symbols; terms are expressions of them. All set-up
/// errors are exceptions that name the problem and the offending item; what is refused leaves the
/// problem as it was.
class Problem {
 public:
  explicit Problem(std::string name);

  // --- variables ---------------------------------------------------------------------------
  /// A state with bounds at every point; `scale` is its typical size (solver sees value / scale);
  /// `initial` and `final` are what initial_bounds() and final_bounds() set.
  Expr state(const std::string& name, Bounds bounds = {}, double scale = kAutomaticScale,
             Bounds initial = {}, Bounds final = {});
  /// A control with bounds at every point.
  Expr control(const std::string& name, Bounds bounds = {}, double scale = kAutomaticScale);
  /// Sets the form of a control between the nodes; ControlForm::scheme if never called.
  void control_form(const Expr& control, ControlForm form);
  /// A constant to optimise.
  Expr static_parameter(const std::string& name, Bounds bounds, double guess,
                        double scale = kAutomaticScale);
  /// An additional variable at one end of the horizon, for softened boundary conditions.
  Expr slack(const std::string& name, End end, Bounds bounds, double guess = 0);

  /// The integral of `integrand` over time, with bounds (an isoperimetric constraint). The result
  /// may be used wherever a static parameter may.
  Expr integral(const std::string& name, const Expr& integrand, Bounds bounds = {},
                double scale = kAutomaticScale);

  /// Sets the scale of any variable, t0 and tf included.
  void set_scale(const Expr& variable, double scale);

  // --- given quantities --------------------------------------------------------------------
  /// A run-time parameter: a number that set_parameter changes between solves without a new
  /// transcription.
  Expr parameter(const std::string& name, double value);
  /// Changes a run-time parameter; throws InvalidValue for another symbol or a number not finite.
  void set_parameter(const Expr& parameter, double value);

  Expr time() const { return time_; }  ///< t of the point [time unit of t0, tf]
  Expr tau() const { return tau_; }    ///< (t - t0) / (tf - t0), 0 ... 1
  Expr initial_time() const { return t0_; }
  Expr final_time() const { return tf_; }
  /// A state's value at t0, which may be used anywhere (also at other points).
  Expr initial(const Expr& state) const;
  /// A state's value at tf, likewise.
  Expr final(const Expr& state) const;

  // --- dynamics, cost, constraints ---------------------------------------------------------
  /// The time derivative of a state; each state needs one.
  void dynamics(const Expr& state, const Expr& rate);
  /// A cost term at the ends: an expression of initial(), final(), slacks, t0, tf, static
  /// parameters and integrals.
  void mayer(const std::string& name, const Expr& term);
  /// A cost term that is integrated over time.
  void lagrange(const std::string& name, const Expr& integrand);
  /// A constraint at the points of the mesh, on an expression of states, controls, time and
  /// everything that mayer may use.
  ConstraintId path(const std::string& name, const Expr& value, Bounds bounds,
                    Points points = Points::all);
  /// A cost term at one moment; it may use what path() may use. Every mesh gets a node there.
  void cost_at(const std::string& name, const Expr& term, Moment moment);
  /// A constraint at one moment; it may use what path() may use. Every mesh gets a node there.
  ConstraintId path_at(const std::string& name, const Expr& value, Moment moment, Bounds bounds);
  /// Puts a node of every mesh at a moment, such as one at which the dynamics step.
  void breakpoint(Moment moment) { breakpoints_.push_back(moment); }
  /// A constraint on an expression that may use what mayer may use.
  ConstraintId boundary(const std::string& name, const Expr& value, Bounds bounds);

  /// One path row for each member: `value` is an expression of `symbols` (made by Expr::symbol),
  /// which take each member's numbers. Thirty-eight obstacles, for example, are one family.
  ConstraintId path_family(const std::string& name, const std::vector<Expr>& symbols,
                           const Expr& value, Bounds bounds, Points points = Points::all);
  /// Sets the members' names and numbers: one list for each member, with one number for each
  /// symbol, or with one number for each symbol at each point of the mesh, point by point. With
  /// numbers by point, the mesh must have this number of points. The number of members may change
  /// between transcriptions, their numbers between solves.
  void set_members(ConstraintId family, std::vector<std::string> names,
                   std::vector<std::vector<double>> values);

  /// A constraint's typical size: the solver sees value / scale.
  void set_scale(ConstraintId constraint, double scale);
  /// Makes a constraint soft, with a cost term "soft NAME", or hard again. Between the solves of
  /// one transcription, only the weight may change.
  void soften(ConstraintId constraint, Soft soft);
  void harden(ConstraintId constraint);

  /// The constraint of that name. Throws InvalidValue for an unknown name, naming the nearest.
  ConstraintId constraint_named(const std::string& name) const;
  /// Switches a constraint on or off. If off, it is absent from the next transcription, not zeroed.
  void enable(ConstraintId constraint, bool enabled);
  /// The same for a cost term.
  void enable_cost(const std::string& name, bool enabled);

  // --- ends --------------------------------------------------------------------------------
  /// Bounds of t0, and its guess; fixed at 0 if never called.
  void initial_time(Bounds bounds, double guess) { set_time(t0_variable_, bounds, guess); }
  /// Bounds of tf, and its guess; fixed at 1 if never called. Whatever the bounds, tf >= t0.
  void final_time(Bounds bounds, double guess) { set_time(tf_variable_, bounds, guess); }
  /// Additional bounds of a state at t0; Bounds::equal fixes it.
  void initial_bounds(const Expr& state, Bounds bounds);
  /// Additional bounds of a state at tf; Bounds::equal fixes it.
  void final_bounds(const Expr& state, Bounds bounds);
  /// Fixes a state at both ends.
  void fix(const Expr& state, double initial, double final);

  // --- what a transcription reads ----------------------------------------------------------
  struct Variable {
    Expr symbol;
    std::string name;
    Bounds bounds;
    double scale = kAutomaticScale;
    double guess = 0;

    bool scaled() const { return scale != kAutomaticScale; }
    double unit() const { return scaled() ? scale : 1; }  ///< what the solver takes as 1
  };
  struct State : Variable {
    Bounds initial, final;
    Expr initial_symbol, final_symbol;
    Expr rate;
    bool has_rate = false;
  };
  struct Control : Variable {
    ControlForm form = ControlForm::scheme;
  };
  struct Slack : Variable {
    End end = End::initial;
  };
  struct Integral : Variable {
    Expr integrand;
  };
  struct Parameter {
    Expr symbol;
    std::string name;
    double value;
  };
  struct CostTerm {
    std::string name;
    Expr value;
    bool lagrange = false;
    bool enabled = true;
    std::optional<Moment> moment = std::nullopt;  ///< of cost_at

    bool at_end() const { return !lagrange && !moment; }  ///< of mayer
  };
  enum class Kind { path, family, moment, boundary };
  struct Constraint {
    std::string name;
    Kind kind;
    Expr value;
    Bounds bounds;
    Points points = Points::all;
    bool enabled = true;
    std::vector<Expr> symbols;  ///< of a family
    std::vector<std::string> members;
    std::vector<std::vector<double>> member_values;
    std::optional<Soft> soft;
    double scale = kAutomaticScale;
    Moment moment = {};  ///< of path_at

    /// Whether a member of the family has numbers of its own at each point.
    bool by_point() const;
    /// The numbers of a member at a point of the mesh.
    std::span<const double> numbers_at(std::size_t member, std::size_t point = 0) const;
    /// Whether it is held along the horizon.
    bool over_time() const { return kind == Kind::path || kind == Kind::family; }
    double unit() const { return scale != kAutomaticScale ? scale : 1; }
  };

  const std::string& name() const { return name_; }
  const std::vector<State>& states() const { return states_; }
  const std::vector<Control>& controls() const { return controls_; }
  const std::vector<Variable>& static_parameters() const { return static_parameters_; }
  const std::vector<Slack>& slacks() const { return slacks_; }
  const std::vector<Integral>& integrals() const { return integrals_; }
  const std::vector<Parameter>& parameters() const { return parameters_; }
  const std::vector<CostTerm>& costs() const { return costs_; }
  const std::vector<Constraint>& constraints() const { return constraints_; }
  /// The increasing shares of the horizon at which enabled rows and cost terms, and breakpoints,
  /// need a node. Throws InvalidValue for a moment outside the horizon, and for a time if an end of
  /// the horizon is free.
  std::vector<double> moments() const;
  /// The share of one of them.
  double share_of(const std::string& what, Moment moment) const;
  const Variable& t0() const { return t0_variable_; }
  const Variable& tf() const { return tf_variable_; }
  /// Whether the bounds of t0 and tf alone keep tf from being before t0.
  bool runs_forward() const { return t0_variable_.bounds.upper <= tf_variable_.bounds.lower; }

 private:
  /// Throws InvalidValue if the name is taken; cost terms have separate names.
  void check_name(const std::string& name) const;
  void claim_cost_name(const std::string& name) const;
  std::size_t state_index(const Expr& state, const char* what) const;
  /// Appends a row once it is known to be sound; `what` it is called in messages.
  ConstraintId add(const char* what, Constraint row);
  void set_time(Variable& time, Bounds bounds, double guess);
  Constraint& constraint(ConstraintId id);

  std::string name_;
  Expr time_, tau_, t0_, tf_;
  Variable t0_variable_, tf_variable_;
  std::vector<State> states_;
  std::vector<Control> controls_;
  std::vector<Variable> static_parameters_;
  std::vector<Slack> slacks_;
  std::vector<Integral> integrals_;
  std::vector<Parameter> parameters_;
  std::vector<CostTerm> costs_;
  std::vector<Constraint> constraints_;
  std::vector<Moment> breakpoints_;
  std::vector<std::string> names_;
};

}  // namespace slalom::ocp
