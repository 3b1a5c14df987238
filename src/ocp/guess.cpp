#include "slalom/ocp/guess.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "between_points.hpp"
#include "slalom/base/error.hpp"
#include "slalom/base/options.hpp"
#include "slalom/ocp/interpolant.hpp"

namespace slalom::ocp {
namespace {

using Vector = std::vector<double>;

template <class List>
std::optional<std::size_t> find(const List& list, const std::string& name) {
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i].name == name) return i;
  return std::nullopt;
}

std::string place(const Problem& problem) {
  return problem.name() + ": guess";
}

InvalidValue unknown(const Problem& problem, const std::string& name, bool over_time) {
  std::vector<std::string> known;
  const auto add = [&](const auto& list) {
    for (const auto& item : list) known.push_back(item.name);
  };
  add(problem.states());
  add(problem.controls());
  if (!over_time) {
    add(problem.static_parameters());
    add(problem.slacks());
    add(problem.integrals());
  }
  const std::string nearest = nearest_name(name, known);
  const char* kind = over_time ? "a state or control" : "a variable";
  return {place(problem), fmt::format("no {} '{}'", kind + 2, name),
          nearest.empty() ? fmt::format("{} of this problem", kind) : "perhaps '" + nearest + "'"};
}

void check_known(const Problem& problem, const std::string& name) {
  if (!find(problem.states(), name) && !find(problem.controls(), name) &&
      !find(problem.static_parameters(), name) && !find(problem.slacks(), name) &&
      !find(problem.integrals(), name))
    throw unknown(problem, name, false);
}

}  // namespace

Guess::Guess(const Problem& problem, int points)
    : problem_(problem), once_(straight_guess(problem)) {
  if (points < 2) throw InvalidValue(place(problem), fmt::format("{} points", points), ">= 2");
  for (int k = 0; k < points; ++k) tau_.push_back(static_cast<double>(k) / (points - 1));
  for (const auto& parameter : problem.static_parameters())
    once_.static_parameters.push_back(parameter.guess);
  for (const auto& slack : problem.slacks()) once_.slacks.push_back(slack.guess);
  once_.integrals.assign(problem.integrals().size(), 0.0);
  states_.resize(problem.states().size());
  controls_.resize(problem.controls().size());
  for (std::size_t i = 0; i < states_.size(); ++i)
    line(problem.states()[i].name, once_.states[0][i], once_.states[1][i]);
  for (std::size_t i = 0; i < controls_.size(); ++i)
    constant(problem.controls()[i].name, once_.controls[0][i]);
}

Guess::Value& Guess::over_time(const std::string& name) {
  if (const auto i = find(problem_.states(), name)) return states_[*i];
  if (const auto i = find(problem_.controls(), name)) return controls_[*i];
  throw unknown(problem_, name, true);
}

Guess& Guess::times(double t0, double tf) {
  once_.t0 = t0;
  once_.tf = tf;
  return *this;
}

Guess& Guess::constant(const std::string& name, double value) {
  if (const auto p = find(problem_.static_parameters(), name))
    once_.static_parameters[*p] = value;
  else if (const auto s = find(problem_.slacks(), name))
    once_.slacks[*s] = value;
  else if (const auto g = find(problem_.integrals(), name))
    once_.integrals[*g] = value;
  else if (find(problem_.states(), name) || find(problem_.controls(), name))
    over_time(name) = [value](double, double) { return value; };
  else
    throw unknown(problem_, name, false);
  return *this;
}

Guess& Guess::line(const std::string& name, double first, double last) {
  over_time(name) = [first, last](double tau, double) { return first + tau * (last - first); };
  return *this;
}

Guess& Guess::function(const std::string& name, std::function<double(double t)> value) {
  over_time(name) = [value = std::move(value)](double, double t) { return value(t); };
  return *this;
}

Guess& Guess::from(const Problem& earlier, const Solution& solution, const Carry& carry) {
  const auto between = std::make_shared<const Interpolant>(earlier, solution.trajectory,
                                                           solution.mesh, solution.scheme);
  const double t0 = solution.trajectory.t0, tf = solution.trajectory.tf;
  const auto at = [t0, tf, by_time = carry.by_time](double tau, double t) {
    return by_time ? t : t0 + tau * (tf - t0);
  };
  take(
      earlier, solution.trajectory,
      [between, at](double tau, double t) { return between->states(at(tau, t)); },
      [between, at](double tau, double t) { return between->controls(at(tau, t)); }, carry);
  return *this;
}

Guess& Guess::from(const Problem& earlier, const Trajectory& trajectory, const Carry& carry) {
  check_guess(trajectory, earlier);
  const auto given = std::make_shared<const Trajectory>(trajectory);
  const auto row = [given, by_time = carry.by_time](const std::vector<Vector>& rows, double tau,
                                                    double t) {
    const double span = given->tf - given->t0;
    if (by_time) tau = span > 0 ? (t - given->t0) / span : 0;
    Vector values;
    for (std::size_t i = 0; i < rows.front().size(); ++i)
      values.push_back(between_points(given->tau, rows, i, tau));
    return values;
  };
  take(
      earlier, trajectory,
      [given, row](double tau, double t) { return row(given->states, tau, t); },
      [given, row](double tau, double t) { return row(given->controls, tau, t); }, carry);
  return *this;
}

void Guess::take(const Problem& earlier, const Trajectory& ends, const Row& states,
                 const Row& controls, const Carry& carry) {
  for (const auto& [ours, theirs] : carry.names) {
    check_known(problem_, ours);
    check_known(earlier, theirs);
  }
  const auto theirs = [&](const std::string& ours) {
    const auto renamed = carry.names.find(ours);
    return renamed == carry.names.end() ? ours : renamed->second;
  };
  const auto take_over_time = [&](const auto& variables, std::vector<Value>& values) {
    for (std::size_t i = 0; i < variables.size(); ++i) {
      const std::string name = theirs(variables[i].name);
      const auto state = find(earlier.states(), name), control = find(earlier.controls(), name);
      if (!state && !control) continue;
      const std::size_t place = state ? *state : *control;
      values[i] = [row = state ? states : controls, place](double tau, double t) {
        return row(tau, t)[place];
      };
    }
  };
  take_over_time(problem_.states(), states_);
  take_over_time(problem_.controls(), controls_);
  const auto take_once = [&](const auto& variables, Vector& values, const auto& others,
                             const Vector& given) {
    for (std::size_t i = 0; i < variables.size(); ++i)
      if (const auto other = find(others, theirs(variables[i].name));
          other && *other < given.size())
        values[i] = given[*other];
  };
  take_once(problem_.static_parameters(), once_.static_parameters, earlier.static_parameters(),
            ends.static_parameters);
  take_once(problem_.slacks(), once_.slacks, earlier.slacks(), ends.slacks);
  take_once(problem_.integrals(), once_.integrals, earlier.integrals(), ends.integrals);
  if (carry.by_time) return;
  times(ends.t0, ends.tf);
  tau_.insert(tau_.end(), ends.tau.begin(), ends.tau.end());
}

Guess& Guess::simulated(const std::vector<double>& x0, const Controls& controls, double tolerance) {
  const auto simulation =
      simulate(problem_, x0, controls,
               {.t0 = once_.t0,
                .tf = once_.tf,
                .steps = static_cast<int>(std::max<std::size_t>(tau_.size(), 2)) - 1,
                .tolerance = tolerance});
  if (!simulation.complete)
    throw InvalidValue(place(problem_), simulation.message, "a simulation that comes to tf");
  Trajectory course = simulation.trajectory;
  course.static_parameters.clear();
  return from(problem_, course);
}

Trajectory Guess::trajectory() const {
  Trajectory guess = once_;
  guess.tau = tau_;
  std::sort(guess.tau.begin(), guess.tau.end());
  guess.tau.erase(std::unique(guess.tau.begin(), guess.tau.end()), guess.tau.end());
  guess.states.clear();
  guess.controls.clear();
  for (const double tau : guess.tau) {
    const double t = guess.time_at(tau);
    auto& x = guess.states.emplace_back();
    for (const auto& state : states_) x.push_back(state(tau, t));
    auto& u = guess.controls.emplace_back();
    for (const auto& control : controls_) u.push_back(control(tau, t));
  }
  check_guess(guess, problem_);
  return guess;
}

}  // namespace slalom::ocp
