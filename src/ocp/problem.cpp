#include "slalom/ocp/problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "checks.hpp"
#include "slalom/base/error.hpp"
#include "slalom/base/options.hpp"

namespace slalom::ocp {
namespace {

void check_variable(const std::string& where, const Problem::Variable& variable) {
  check_bounds(where, variable.bounds);
  if (variable.scaled() && !(std::isfinite(variable.scale) && variable.scale > 0))
    throw InvalidValue(where, fmt::format("scale {}", variable.scale), "a scale > 0");
  if (!std::isfinite(variable.guess))
    throw InvalidValue(where, fmt::format("guess {}", variable.guess), "a finite guess");
}

/// A variable under a new symbol; throws InvalidValue for what check_variable refuses.
Problem::Variable declared(const std::string& problem, const char* kind, const std::string& name,
                           Bounds bounds, double scale, double guess) {
  Problem::Variable variable{Expr::symbol(name), name, bounds, scale, guess};
  check_variable(problem + ": " + kind + " " + name, variable);
  return variable;
}

void check_parameter(const std::string& problem, const std::string& name, double value) {
  if (!std::isfinite(value))
    throw InvalidValue(problem + ": parameter " + name, fmt::format("{}", value),
                       "a finite number");
}

InvalidValue unknown_name(const std::string& problem, const std::string& kind,
                          const std::string& name, const std::vector<std::string>& known) {
  const auto nearest = nearest_name(name, known);
  return {problem, "no " + kind + " '" + name + "'",
          nearest.empty() ? "a " + kind : "perhaps '" + nearest + "'"};
}

/// What stands where a variable should.
std::string found(const Expr& value) {
  return value.is_symbol() ? "'" + value.name() + "'" : "an expression";
}

}  // namespace

Problem::Problem(std::string name)
    : name_(std::move(name)),
      time_(Expr::symbol("time")),
      tau_(Expr::symbol("tau")),
      t0_(Expr::symbol("t0")),
      tf_(Expr::symbol("tf")),
      t0_variable_{t0_, "t0", Bounds::equal(0), kAutomaticScale, 0},
      tf_variable_{tf_, "tf", Bounds::equal(1), kAutomaticScale, 1} {}

void Problem::check_name(const std::string& name) const {
  if (name.empty()) throw InvalidValue(name_, "an empty name", "a name");
  for (const char* time : {"t", "time", "tau", "t0", "tf"})
    if (name == time)
      throw InvalidValue(name_, "the name '" + name + "'",
                         "another, for it stands for a time in guesses and answers");
  if (std::find(names_.begin(), names_.end(), name) != names_.end())
    throw InvalidValue(name_, "the name '" + name + "' twice", "names that differ");
}

void Problem::claim_cost_name(const std::string& name) const {
  if (name.empty()) throw InvalidValue(name_, "an empty name", "a name");
  for (const auto& cost : costs_)
    if (cost.name == name)
      throw InvalidValue(name_, "the cost term '" + name + "' twice", "names that differ");
}

Expr Problem::state(const std::string& name, Bounds bounds, double scale, Bounds initial,
                    Bounds final) {
  check_name(name);
  State state;
  static_cast<Variable&>(state) = declared(name_, "state", name, bounds, scale, 0);
  check_bounds(name_ + ": initial " + name, initial);
  check_bounds(name_ + ": final " + name, final);
  state.initial = initial;
  state.final = final;
  state.initial_symbol = Expr::symbol("initial(" + name + ")");
  state.final_symbol = Expr::symbol("final(" + name + ")");
  states_.push_back(state);
  names_.push_back(name);
  return state.symbol;
}

Expr Problem::control(const std::string& name, Bounds bounds, double scale) {
  check_name(name);
  controls_.push_back({declared(name_, "control", name, bounds, scale, 0)});
  names_.push_back(name);
  return controls_.back().symbol;
}

void Problem::control_form(const Expr& control, ControlForm form) {
  for (auto& known : controls_)
    if (known.symbol.same(control)) {
      known.form = form;
      return;
    }
  throw InvalidValue(name_ + ": control_form", found(control), "a control of this problem");
}

Expr Problem::static_parameter(const std::string& name, Bounds bounds, double guess, double scale) {
  check_name(name);
  static_parameters_.push_back(declared(name_, "static parameter", name, bounds, scale, guess));
  names_.push_back(name);
  return static_parameters_.back().symbol;
}

Expr Problem::slack(const std::string& name, End end, Bounds bounds, double guess) {
  check_name(name);
  Slack slack;
  static_cast<Variable&>(slack) = declared(name_, "slack", name, bounds, kAutomaticScale, guess);
  slack.end = end;
  slacks_.push_back(slack);
  names_.push_back(name);
  return slack.symbol;
}

Expr Problem::integral(const std::string& name, const Expr& integrand, Bounds bounds,
                       double scale) {
  check_name(name);
  Integral integral;
  static_cast<Variable&>(integral) = declared(name_, "integral", name, bounds, scale, 0);
  integral.integrand = integrand;
  integrals_.push_back(integral);
  names_.push_back(name);
  return integral.symbol;
}

void Problem::set_scale(const Expr& symbol, double scale) {
  const auto set = [&](Variable& variable) {
    if (!variable.symbol.same(symbol)) return false;
    Variable changed = variable;
    changed.scale = scale;
    check_variable(name_ + ": " + variable.name, changed);
    variable.scale = scale;
    return true;
  };
  const auto set_one = [&](auto& list) { return std::any_of(list.begin(), list.end(), set); };
  if (!(set_one(states_) || set_one(controls_) || set_one(static_parameters_) || set_one(slacks_) ||
        set_one(integrals_) || set(t0_variable_) || set(tf_variable_)))
    throw InvalidValue(name_ + ": set_scale", found(symbol), "a variable of this problem");
}

Expr Problem::parameter(const std::string& name, double value) {
  check_parameter(name_, name, value);
  check_name(name);
  parameters_.push_back({Expr::symbol(name), name, value});
  names_.push_back(name);
  return parameters_.back().symbol;
}

void Problem::set_parameter(const Expr& parameter, double value) {
  for (auto& known : parameters_)
    if (known.symbol.same(parameter)) {
      check_parameter(name_, known.name, value);
      known.value = value;
      return;
    }
  throw InvalidValue(name_, "set_parameter of something else", "a parameter of this problem");
}

std::size_t Problem::state_index(const Expr& state, const char* what) const {
  for (std::size_t i = 0; i < states_.size(); ++i)
    if (states_[i].symbol.same(state)) return i;
  throw InvalidValue(name_ + ": " + what, found(state), "a state of this problem");
}

Expr Problem::initial(const Expr& state) const {
  return states_[state_index(state, "initial")].initial_symbol;
}
Expr Problem::final(const Expr& state) const {
  return states_[state_index(state, "final")].final_symbol;
}

void Problem::dynamics(const Expr& state, const Expr& rate) {
  auto& target = states_[state_index(state, "dynamics")];
  if (target.has_rate)
    throw InvalidValue(name_ + ": dynamics", "a second rate of " + target.name,
                       "one for each state");
  target.rate = rate;
  target.has_rate = true;
}

void Problem::mayer(const std::string& name, const Expr& term) {
  claim_cost_name(name);
  costs_.push_back({name, term, false, true});
}

void Problem::lagrange(const std::string& name, const Expr& integrand) {
  claim_cost_name(name);
  costs_.push_back({name, integrand, true, true});
}

ConstraintId Problem::add(const char* what, Constraint row) {
  check_name(row.name);
  check_row_bounds(name_ + ": " + what + " " + row.name, row.bounds);
  names_.push_back(row.name);
  constraints_.push_back(std::move(row));
  return {constraints_.size() - 1};
}

ConstraintId Problem::path(const std::string& name, const Expr& value, Bounds bounds,
                           Points points) {
  return add("path", {name, Kind::path, value, bounds, points, true, {}, {}, {}, {}});
}

void Problem::cost_at(const std::string& name, const Expr& term, Moment moment) {
  claim_cost_name(name);
  costs_.push_back({name, term, false, true, moment});
}

ConstraintId Problem::path_at(const std::string& name, const Expr& value, Moment moment,
                              Bounds bounds) {
  Constraint row{name, Kind::moment, value, bounds, Points::all, true, {}, {}, {}, {}};
  row.moment = moment;
  return add("path", std::move(row));
}

double Problem::share_of(const std::string& what, Moment moment) const {
  const std::string where = name_ + ": " + what;
  if (moment.is_share) {
    if (!(moment.value >= 0 && moment.value <= 1))
      throw InvalidValue(where, fmt::format("the share {} of the horizon", moment.value),
                         "one from 0 to 1");
    return moment.value;
  }
  const Bounds &t0 = t0_variable_.bounds, &tf = tf_variable_.bounds;
  if (t0.lower != t0.upper || tf.lower != tf.upper)
    throw InvalidValue(where, fmt::format("the time {} where t0 or tf is free", moment.value),
                       "a share of the horizon, or fixed ends");
  if (!(moment.value >= t0.lower && moment.value <= tf.lower && t0.lower < tf.lower))
    throw InvalidValue(where, fmt::format("the time {}", moment.value),
                       fmt::format("one from t0 = {} to tf = {}", t0.lower, tf.lower));
  return (moment.value - t0.lower) / (tf.lower - t0.lower);
}

std::vector<double> Problem::moments() const {
  std::vector<double> shares;
  for (const auto& cost : costs_)
    if (cost.enabled && cost.moment) shares.push_back(share_of(cost.name, *cost.moment));
  for (const auto& row : constraints_)
    if (row.enabled && row.kind == Kind::moment) shares.push_back(share_of(row.name, row.moment));
  for (const Moment& moment : breakpoints_) shares.push_back(share_of("breakpoint", moment));
  std::sort(shares.begin(), shares.end());
  return shares;
}

ConstraintId Problem::boundary(const std::string& name, const Expr& value, Bounds bounds) {
  return add("boundary", {name, Kind::boundary, value, bounds, Points::all, true, {}, {}, {}, {}});
}

ConstraintId Problem::path_family(const std::string& name, const std::vector<Expr>& symbols,
                                  const Expr& value, Bounds bounds, Points points) {
  return add("path family", {name, Kind::family, value, bounds, points, true, symbols, {}, {}, {}});
}

bool Problem::Constraint::by_point() const {
  return std::any_of(member_values.begin(), member_values.end(),
                     [&](const auto& numbers) { return numbers.size() > symbols.size(); });
}

std::span<const double> Problem::Constraint::numbers_at(std::size_t member,
                                                        std::size_t point) const {
  const auto& numbers = member_values[member];
  const std::size_t first = numbers.size() > symbols.size() ? point * symbols.size() : 0;
  return {numbers.data() + first, symbols.size()};
}

Problem::Constraint& Problem::constraint(ConstraintId id) {
  if (id.index >= constraints_.size())
    throw InvalidValue(name_, fmt::format("constraint {}", id.index),
                       fmt::format("one of the {} constraints", constraints_.size()));
  return constraints_[id.index];
}

void Problem::set_members(ConstraintId family, std::vector<std::string> names,
                          std::vector<std::vector<double>> values) {
  auto& target = constraint(family);
  const std::string where = name_ + ": family " + target.name;
  if (target.kind != Kind::family) throw InvalidValue(where, "a single constraint", "a family");
  if (names.size() != values.size())
    throw InvalidValue(where, fmt::format("{} names, {} members", names.size(), values.size()),
                       "one name a member");
  for (const auto& numbers : values) {
    const std::size_t once = target.symbols.size();
    if (numbers.size() != once && (once == 0 || numbers.empty() || numbers.size() % once != 0))
      throw InvalidValue(where, fmt::format("a member with {} numbers", numbers.size()),
                         fmt::format("{}, one for each symbol, or so many for each point", once));
    if (!std::all_of(numbers.begin(), numbers.end(), [](double v) { return std::isfinite(v); }))
      throw InvalidValue(where, "a member with NaN or infinity", "finite numbers");
  }
  target.members = std::move(names);
  target.member_values = std::move(values);
}

void Problem::set_scale(ConstraintId id, double scale) {
  auto& target = constraint(id);
  if (!(std::isfinite(scale) && scale > 0))
    throw InvalidValue(name_ + ": " + target.name, fmt::format("scale {}", scale), "a scale > 0");
  target.scale = scale;
}

void check(const Soft& soft, const std::string& where) {
  const auto check = [&](const char* what, double value, bool good, const char* expected) {
    if (!good || !std::isfinite(value))
      throw InvalidValue(where + ": " + what, fmt::format("{}", value), expected);
  };
  check("weight", soft.weight, soft.weight > 0, "a finite number > 0");
  check("tolerance", soft.tolerance, soft.tolerance >= 0, "a finite number >= 0");
}

void Problem::soften(ConstraintId id, Soft soft) {
  auto& target = constraint(id);
  check(soft, name_ + ": " + target.name);
  target.soft = soft;
}

void Problem::harden(ConstraintId id) {
  constraint(id).soft.reset();
}

ConstraintId Problem::constraint_named(const std::string& name) const {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    if (constraints_[i].name == name) return {i};
    known.push_back(constraints_[i].name);
  }
  throw unknown_name(name_, "constraint", name, known);
}

void Problem::enable(ConstraintId id, bool enabled) {
  constraint(id).enabled = enabled;
}

void Problem::enable_cost(const std::string& name, bool enabled) {
  std::vector<std::string> known;
  for (auto& term : costs_) {
    if (term.name == name) {
      term.enabled = enabled;
      return;
    }
    known.push_back(term.name);
  }
  throw unknown_name(name_, "cost term", name, known);
}

void Problem::set_time(Variable& time, Bounds bounds, double guess) {
  Variable changed = time;
  changed.bounds = bounds;
  changed.guess = guess;
  check_variable(name_ + ": " + time.name, changed);
  time = changed;
}

void Problem::initial_bounds(const Expr& state, Bounds bounds) {
  auto& target = states_[state_index(state, "initial_bounds")];
  check_bounds(name_ + ": initial " + target.name, bounds);
  target.initial = bounds;
}

void Problem::final_bounds(const Expr& state, Bounds bounds) {
  auto& target = states_[state_index(state, "final_bounds")];
  check_bounds(name_ + ": final " + target.name, bounds);
  target.final = bounds;
}

void Problem::fix(const Expr& state, double initial, double final) {
  initial_bounds(state, Bounds::equal(initial));
  final_bounds(state, Bounds::equal(final));
}

}  // namespace slalom::ocp
