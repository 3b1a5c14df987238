#include <algorithm>
#include <string>

#include "settings.hpp"
#include "slalom/base/error.hpp"
#include "slalom/base/options.hpp"
#include "slalom/ocp/guess.hpp"
#include "solved.hpp"

namespace slalom::python {
namespace {

using ocp::Trajectory;

/// Points of a guess whose dictionary has no times of its own.
constexpr std::size_t kPoints = 101;

/// `numbers` at equal steps over 0 ... 1, linear between them, at tau.
double at_equal_steps(const std::vector<double>& numbers, double tau) {
  if (numbers.size() == 1) return numbers.front();
  const double place = tau * static_cast<double>(numbers.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(place), numbers.size() - 2);
  return numbers[k] + (place - static_cast<double>(k)) * (numbers[k + 1] - numbers[k]);
}

/// One number a point of `guess`: of a number, numbers or a function of times.
std::vector<double> numbers_at(nb::handle given, const Trajectory& guess, bool at_times,
                               const std::string& name) {
  std::vector<double> times;
  for (std::size_t k = 0; k < guess.tau.size(); ++k) times.push_back(guess.time(k));
  nb::object value = nb::borrow(given);
  const bool function = PyCallable_Check(value.ptr()) != 0;
  if (function) value = value(to_numpy(times));
  double constant = 0;
  if (nb::try_cast(value, constant)) return std::vector<double>(times.size(), constant);
  const auto numbers = as<std::vector<double>>(value, "guess of " + name,
                                               "a number, numbers, or a function of times");
  if (numbers.size() == times.size()) return numbers;
  if (at_times || function || numbers.empty())
    throw InvalidValue("guess of " + name, std::to_string(numbers.size()) + " numbers",
                       std::to_string(times.size()) + ", one for each time");
  std::vector<double> spread;
  for (const double tau : guess.tau) spread.push_back(at_equal_steps(numbers, tau));
  return spread;
}

/// The lines between the ends' bounds, at `points` equal steps.
Trajectory straight(const Trajectory& ends, std::size_t points) {
  Trajectory guess = ends;
  guess.tau.clear();
  guess.states.clear();
  guess.controls.clear();
  for (std::size_t k = 0; k < points; ++k) {
    const double tau = static_cast<double>(k) / static_cast<double>(points - 1);
    const auto between = [tau](std::vector<double> a, const std::vector<double>& b) {
      for (std::size_t i = 0; i < a.size(); ++i) a[i] += tau * (b[i] - a[i]);
      return a;
    };
    guess.tau.push_back(tau);
    guess.states.push_back(between(ends.states.front(), ends.states.back()));
    guess.controls.push_back(between(ends.controls.front(), ends.controls.back()));
  }
  return guess;
}

std::vector<double> times_of(const nb::dict& given) {
  return as<std::vector<double>>(given["t"], "guess: t", "times");
}

void set_times(const nb::dict& given, Trajectory& guess) {
  if (given.contains("t0")) guess.t0 = as<double>(given["t0"], "guess of t0", "a number");
  if (given.contains("tf")) guess.tf = as<double>(given["tf"], "guess of tf", "a number");
  if (!given.contains("t")) return;
  const auto t = times_of(given);
  if (!std::is_sorted(t.begin(), t.end()) || !(t.back() > t.front()))
    throw InvalidValue("guess", "times 't' that do not rise", "rising times from t0 to tf");
  guess.t0 = t.front();
  guess.tf = t.back();
  for (std::size_t k = 0; k < t.size(); ++k)
    guess.tau[k] = (t[k] - guess.t0) / (guess.tf - guess.t0);
  guess.tau.back() = 1;
}

template <class List>
std::size_t place_of(const List& list, const std::string& name) {
  return static_cast<std::size_t>(
      std::find_if(list.begin(), list.end(), [&](const auto& v) { return v.name == name; }) -
      list.begin());
}

/// Stores what stands under `name`; false where nothing has that name.
bool set(const ocp::Problem& problem, const std::string& name, nb::handle value, bool at_times,
         Trajectory& guess) {
  const auto column = [&](const auto& list, auto& rows) {
    const auto i = place_of(list, name);
    if (i == list.size()) return false;
    const auto numbers = numbers_at(value, guess, at_times, name);
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k][i] = numbers[k];
    return true;
  };
  const auto number = [&](const auto& list, auto& numbers) {
    const auto i = place_of(list, name);
    if (i == list.size()) return false;
    numbers[i] = as<double>(value, "guess of " + name, "a number");
    return true;
  };
  return column(problem.states(), guess.states) || column(problem.controls(), guess.controls) ||
         number(problem.static_parameters(), guess.static_parameters) ||
         number(problem.slacks(), guess.slacks);
}

[[noreturn]] void unknown(const ocp::Problem& problem, const std::string& name) {
  std::vector<std::string> names{"t", "t0", "tf"};
  const auto add = [&](const auto& list) {
    for (const auto& each : list) names.push_back(each.name);
  };
  add(problem.states());
  add(problem.controls());
  add(problem.static_parameters());
  add(problem.slacks());
  const auto nearest = nearest_name(name, names);
  throw InvalidValue(problem.name() + ": guess", "'" + name + "'",
                     nearest.empty() ? std::string("a variable's name, 't', 't0' or 'tf'")
                                     : "perhaps '" + nearest + "'");
}

Trajectory from_dictionary(const ocp::Problem& problem, const Trajectory& ends,
                           const nb::dict& given) {
  const bool at_times = given.contains("t");
  const std::size_t points = at_times ? times_of(given).size() : kPoints;
  if (points < 2)
    throw InvalidValue("guess", std::to_string(points) + " times 't'", "at least two");
  Trajectory guess = straight(ends, points);
  for (const auto& each : problem.static_parameters())
    guess.static_parameters.push_back(each.guess);
  for (const auto& each : problem.slacks()) guess.slacks.push_back(each.guess);
  set_times(given, guess);
  for (const auto& [key, value] : given) {
    const auto name = as<std::string>(key, "guess", "names of variables");
    if (name == "t" || name == "t0" || name == "tf") continue;
    if (!set(problem, name, value, at_times, guess)) unknown(problem, name);
  }
  return guess;
}

}  // namespace

Trajectory guess_of(const ocp::Problem& problem, nb::handle given) {
  if (given.is_none()) return {};
  if (nb::isinstance<Solved>(given)) {
    const auto& earlier = nb::cast<const Solved&>(given);
    return ocp::Guess(problem).from(*earlier.problem, earlier.answer);
  }
  if (nb::isinstance<Simulated>(given)) {
    const auto& earlier = nb::cast<const Simulated&>(given);
    return ocp::Guess(problem).from(*earlier.problem, earlier.answer.trajectory);
  }
  return from_dictionary(problem, ocp::straight_guess(problem),
                         as<nb::dict>(given, "guess", "a Solution, a Simulation or a dict"));
}

}  // namespace slalom::python
