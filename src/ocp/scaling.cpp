#include "slalom/ocp/scaling.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "dynamics_at.hpp"
#include "set_up_watch.hpp"
#include "slalom/expr/function.hpp"

namespace slalom::ocp {
namespace {

double size_of(double value) {
  return std::isfinite(value) ? std::fabs(value) : 0;
}
double size_of(Bounds bounds) {
  return std::max(size_of(bounds.lower), size_of(bounds.upper));
}

double largest(const std::vector<std::vector<double>>& rows, std::size_t i) {
  double most = 0;
  for (const auto& row : rows) most = std::max(most, size_of(row[i]));
  return most;
}

/// Least size of a variable in the guess: this part of what fixed ends and the controls' bounds
/// make of it by the dynamics. Rounding left in a guess is no size. (Bounds of states are often
/// wide.)
constexpr double kLeastPart = 1e-2;
/// Ends and guesses below this part of what the rest makes of a variable are rounding, such as
/// sin(pi); below kDust they are so where the rest says nothing.
constexpr double kRoundingPart = 1e-10, kDust = 1e-12;

/// Sizes of the states and controls, 0 where not known yet.
class Sizes {
 public:
  Sizes(const Problem& problem, const Trajectory& guess)
      : problem_(problem), guess_(guess), nx_(problem.states().size()) {
    for (const auto& state : problem.states()) {
      scale_.push_back(state.scale);
      ends_.push_back(std::max(size_of(state.initial), size_of(state.final)));
      bounds_.push_back(size_of(state.bounds));
    }
    for (const auto& control : problem.controls()) {
      scale_.push_back(control.scale);
      ends_.push_back(0);
      bounds_.push_back(size_of(control.bounds));
    }
    for (std::size_t i = 0; i < scale_.size(); ++i)
      guessed_.push_back(i < nx_ ? largest(guess.states, i) : largest(guess.controls, i - nx_));
    known_ = told();
    if (std::all_of(scale_.begin(), scale_.end(), [](double scale) { return scale > 0; })) return;
    const std::size_t middle = guess.tau.size() / 2;
    const DynamicsAt at(problem, guess, middle,
                        [&](const auto& symbols) { return numbers(symbols, middle); });
    if (drop_rounding(at)) known_ = told();
    keep_off_rounding(at);
    if (!all_known()) infer(at);
  }

  double state(std::size_t i) const { return known_[i] > 0 ? known_[i] : 1; }
  double control(std::size_t i) const { return known_[nx_ + i] > 0 ? known_[nx_ + i] : 1; }

  /// The guess's, but no less than a part of that of the declaration's guess or bounds; without
  /// these, what moves a state by its size over the horizon.
  double static_parameter(std::size_t i) const {
    const auto& each = problem_.static_parameters()[i];
    const double declared = first_of({size_of(each.guess), size_of(each.bounds)});
    const double given = guessed(guess_.static_parameters, i, declared);
    return given > 0 ? given : first_of({by_effect(each.symbol), 1});
  }
  /// Its bounds', else the guess's, but no less than a part of what the integrand comes to.
  double integral(std::size_t i) const {
    const auto& each = problem_.integrals()[i];
    if (const double size = size_of(each.bounds); size > 0) return size;
    const std::vector<Expr> integrand{each.integrand};
    const auto symbols = expr::symbols_of(integrand);
    const expr::Function f({}, symbols, integrand);
    double most = 0;
    for (std::size_t point = 0; point < guess_.tau.size(); ++point) {
      SetUpWatch::poll();
      double value = 0;
      f({}, numbers(symbols, point), {&value, 1});
      most = std::max(most, size_of(value));
    }
    const double duration = std::max(guess_.tf - guess_.t0, 0.0);
    return guessed(guess_.integrals, i, first_of({duration * most, 1}));
  }

  /// Of a constraint: its bounds', else how much it changes when everything moves by half its size;
  /// where that is no more than rounding, its size in the guess, else the most that a single one
  /// changes it.
  double row(const Problem::Constraint& row) const {
    if (const double size = size_of(row.bounds); size > 0) return size;
    std::vector<Expr> values{row.value};
    if (!row.member_values.empty()) {
      const auto member = row.numbers_at(0);
      values = expr::substitute(values, row.symbols, {member.begin(), member.end()});
    }
    const auto symbols = expr::symbols_of(values);
    const expr::Function f({}, symbols, values);
    const std::size_t middle = guess_.tau.size() / 2;
    std::vector<double> at = numbers(symbols, middle);
    const std::vector<double> moved = numbers(symbols, middle, 0.5);
    double here = 0, beside = 0, alone = 0;
    f({}, at, {&here, 1});
    f({}, moved, {&beside, 1});
    const double change = size_of(beside - here);
    // What moves together may cancel out, as in a difference of two ends, up to rounding.
    for (std::size_t i = 0; i < at.size(); ++i) {
      const double value = std::exchange(at[i], moved[i]);
      f({}, at, {&beside, 1});
      alone = std::max(alone, size_of(beside - here));
      at[i] = value;
    }
    if (change > kRoundingPart * alone) return change;
    return size_of(here) >= kLeastPart * alone ? size_of(here) : alone;
  }

 private:
  /// The least that moves any state by that state's size over the horizon, at the steepest point of
  /// the guess for each; 0 for a symbol that moves none. What moves none from where the guess is,
  /// such as a rate times a state of 0, may do so from a state's size away.
  double by_effect(const Expr& symbol) const {
    std::vector<Expr> rates;
    for (const auto& state : problem_.states()) rates.push_back(state.rate);
    std::vector<Expr> data;
    for (const auto& each : expr::symbols_of(rates))
      if (!each.same(symbol)) data.push_back(each);
    const expr::Function f({symbol}, data, rates);
    const double here = by_effect(f, symbol, data, 0);
    return here > 0 ? here : by_effect(f, symbol, data, 1);
  }
  /// `f`: the rates by the symbol; states and controls moved by `shift` of their sizes.
  double by_effect(const expr::Function& f, const Expr& symbol, const std::vector<Expr>& data,
                   double shift) const {
    const double duration = std::max(guess_.tf - guess_.t0, 0.0);
    std::vector<double> slopes(f.jacobian_pattern().size()), steepest(nx_, 0.0), none;
    for (std::size_t point = 0; point < guess_.tau.size(); ++point) {
      SetUpWatch::poll();
      f.evaluate(1, std::vector{number(symbol, point, 0)}, numbers(data, point, shift), none,
                 {.values = false, .jacobian = true}, none, slopes, none);
      for (std::size_t e = 0; e < slopes.size(); ++e) {
        double& slope = steepest[f.jacobian_pattern()[e].row];
        slope = std::max(slope, size_of(slopes[e]));
      }
    }
    double least = 0;
    for (std::size_t i = 0; i < nx_; ++i) {
      const double size = size_of(state(i) / (steepest[i] * duration));
      if (size > 0) least = least > 0 ? std::min(least, size) : size;
    }
    return least;
  }
  static double first_of(std::initializer_list<double> candidates) {
    for (const double each : candidates)
      if (each > 0) return each;
    return 0;
  }
  /// Of what the guess has in a list, else `otherwise`.
  static double guessed(const std::vector<double>& list, std::size_t i, double otherwise) {
    const double size = i < list.size() ? size_of(list[i]) : 0;
    return size > 0 ? std::max(size, kLeastPart * otherwise) : otherwise;
  }
  bool all_known() const {
    return std::all_of(known_.begin(), known_.end(), [](double size) { return size > 0; });
  }

  /// By the dynamics' values and slopes in the middle of the guess.
  void infer(const DynamicsAt& at) {
    const double duration = std::max(guess_.tf - guess_.t0, 0.0);
    for (std::size_t pass = 0; pass < known_.size() && !all_known(); ++pass) {
      infer_from_rates(rates_of(at.f, at.values, at.slopes), duration);
      infer_from_effects(at.f, at.slopes, rates_of(at.f, at.values, at.slopes), duration);
    }
  }

  /// By row: the rate in the guess, and what the known sizes make of its slopes by other variables;
  /// and the slope by the state itself.
  struct Rates {
    std::vector<double> size, own;
  };
  /// As infer(), but one size at a time: the largest that the rates make, else of what moves a
  /// state the one with the largest slope. A slope that is rounding in the guess has no say before
  /// others.
  void infer_one_by_one(const DynamicsAt& at) {
    const double duration = std::max(guess_.tf - guess_.t0, 0.0);
    for (std::size_t pass = 0; pass < known_.size() && !all_known(); ++pass) {
      const Rates rates = rates_of(at.f, at.values, at.slopes);
      const std::vector<double> before = known_;
      infer_from_rates(rates, duration);
      std::size_t largest = nx_;
      for (std::size_t i = 0; i < nx_; ++i)
        if (known_[i] != before[i] && (largest == nx_ || known_[i] > known_[largest])) largest = i;
      const double size = largest < nx_ ? known_[largest] : 0;
      known_ = before;
      if (size > 0)
        known_[largest] = size;
      else if (!infer_from_steepest(at, rates, duration))
        return;
    }
  }
  /// False when nothing that is not known moves a state that is.
  bool infer_from_steepest(const DynamicsAt& at, Rates rates, double duration) {
    std::vector<double> one(at.slopes.size(), 0.0);
    std::size_t steepest = one.size();
    for (std::size_t e = 0; e < one.size(); ++e) {
      const auto [row, col] = at.f.jacobian_pattern()[e];
      if (known_[row] == 0 || known_[col] > 0 || !(size_of(at.slopes[e]) > 0)) continue;
      if (steepest == one.size() || size_of(at.slopes[e]) > size_of(at.slopes[steepest]))
        steepest = e;
    }
    if (steepest == one.size()) return false;
    one[steepest] = at.slopes[steepest];
    // Not to balance the rest of the rate: that would double from each of many controls to the
    // next.
    std::fill(rates.size.begin(), rates.size.end(), 0.0);
    infer_from_effects(at.f, one, rates, duration);
    return true;
  }

  /// What was given of each variable: its scale, else its guess and ends, else its bounds.
  std::vector<double> told() const {
    std::vector<double> list;
    for (std::size_t i = 0; i < scale_.size(); ++i)
      list.push_back(first_of({scale_[i], std::max(guessed_[i], ends_[i]), bounds_[i]}));
    return list;
  }

  /// Takes ends and guesses that are only rounding for 0, as if they had been given exactly; false
  /// where there are none.
  bool drop_rounding(const DynamicsAt& at) {
    double most = 0;
    for (std::size_t i = 0; i < scale_.size(); ++i)
      most = std::max({most, guessed_[i], ends_[i], control_bounds(i)});
    bool any = false;
    for (std::size_t i = 0; i < scale_.size(); ++i) {
      const double given = std::max(guessed_[i], ends_[i]);
      if (scale_[i] > 0 || given == 0 || given >= std::max(kDust, kRoundingPart * most)) continue;
      const double rest = size_by_others(i, at);
      if (given >= (rest > 0 ? kRoundingPart * rest : kDust)) continue;
      if (ends_[i] == 0 && rest > 0) continue;  // only the guess: keep_off_rounding() sees to it
      guessed_[i] = ends_[i] = 0;
      if (bounds_[i] == 0) bounds_[i] = rest;
      any = true;
    }
    return any;
  }
  /// What the other variables, as far as they are more than dust, make of this one; 0 for nothing.
  double size_by_others(std::size_t variable, const DynamicsAt& at) {
    return inferred(at, [&](std::size_t i) {
      const double given = std::max(guessed_[i], ends_[i]);
      return i == variable ? 0
                           : first_of({scale_[i], given >= kDust ? given : 0, control_bounds(i)});
    })[variable];
  }
  /// All sizes that follow from these by the dynamics' slopes alone: the guess's own rates may be
  /// rounding.
  template <class SizeOf>
  std::vector<double> inferred(DynamicsAt at, const SizeOf& size_of_variable) {
    std::fill(at.values.begin(), at.values.end(), 0.0);
    std::vector<double> sizes = std::exchange(known_, {});
    for (std::size_t i = 0; i < sizes.size(); ++i) known_.push_back(size_of_variable(i));
    infer_one_by_one(at);
    std::swap(sizes, known_);
    return sizes;
  }
  double control_bounds(std::size_t i) const { return i < nx_ ? 0 : bounds_[i]; }

  /// What the ends, and then the controls' bounds too, make of the sizes counts for a part.
  void keep_off_rounding(const DynamicsAt& at) {
    for (const bool with_controls : {false, true}) {
      const auto made = inferred(at, [&](std::size_t i) {
        return first_of({scale_[i], ends_[i], with_controls ? control_bounds(i) : 0});
      });
      for (std::size_t i = 0; i < made.size(); ++i)
        if (scale_[i] == 0 && known_[i] > 0) known_[i] = std::max(known_[i], kLeastPart * made[i]);
    }
  }

  Rates rates_of(const expr::Function& f, const std::vector<double>& values,
                 const std::vector<double>& slopes) const {
    Rates rates{std::vector<double>(nx_), std::vector<double>(nx_, 0.0)};
    for (std::size_t i = 0; i < nx_; ++i) rates.size[i] = size_of(values[i]);
    for (std::size_t e = 0; e < slopes.size(); ++e) {
      const auto [row, col] = f.jacobian_pattern()[e];
      if (row == col)
        rates.own[row] = size_of(slopes[e]);
      else
        rates.size[row] += size_of(slopes[e]) * known_[col];
    }
    return rates;
  }

  /// Of a state that its rate drives for the horizon, or for as long as it takes to settle.
  void infer_from_rates(const Rates& rates, double duration) {
    for (std::size_t i = 0; i < nx_; ++i)
      if (known_[i] == 0 && duration > 0)
        known_[i] = size_of(rates.size[i] / (rates.own[i] + 1 / duration));
  }

  /// Of what moves a state whose size is known: as much as moves it by that over the horizon, or as
  /// balances the rest of its rate.
  void infer_from_effects(const expr::Function& f, const std::vector<double>& slopes,
                          const Rates& rates, double duration) {
    const std::vector<double> before = known_;
    for (std::size_t e = 0; e < slopes.size(); ++e) {
      const auto [row, col] = f.jacobian_pattern()[e];
      if (before[col] > 0 || before[row] == 0 || slopes[e] == 0 || duration == 0) continue;
      const double rate =
          std::max(before[row] / duration, rates.size[row] + rates.own[row] * before[row]);
      const double size = size_of(rate / slopes[e]);
      known_[col] = known_[col] > 0 ? std::min(known_[col], size) : size;
    }
  }

  /// What symbols are in the guess, states and controls moved by `shift` of their sizes; 1 for what
  /// it does not tell.
  std::vector<double> numbers(const std::vector<Expr>& symbols, std::size_t point,
                              double shift = 0) const {
    std::vector<double> list;
    for (const auto& symbol : symbols) list.push_back(number(symbol, point, shift));
    return list;
  }
  double number(const Expr& symbol, std::size_t point, double shift) const {
    if (symbol.same(problem_.time())) return guess_.time(point);
    if (symbol.same(problem_.tau())) return guess_.tau[point];
    if (symbol.same(problem_.initial_time())) return guess_.t0;
    if (symbol.same(problem_.final_time())) return guess_.tf + shift * (guess_.tf - guess_.t0);
    for (std::size_t i = 0; i < nx_; ++i) {
      const auto& each = problem_.states()[i];
      const double more = shift * state(i);
      if (symbol.same(each.symbol)) return guess_.states[point][i] + more;
      if (symbol.same(each.initial_symbol)) return guess_.states.front()[i] + more;
      if (symbol.same(each.final_symbol)) return guess_.states.back()[i] + more;
    }
    for (std::size_t i = 0; i < problem_.controls().size(); ++i)
      if (symbol.same(problem_.controls()[i].symbol))
        return guess_.controls[point][i] + shift * control(i);
    for (const auto& each : problem_.parameters())
      if (symbol.same(each.symbol)) return each.value;
    for (std::size_t i = 0; i < problem_.static_parameters().size(); ++i)
      if (const auto& each = problem_.static_parameters()[i]; symbol.same(each.symbol))
        return i < guess_.static_parameters.size() ? guess_.static_parameters[i] : each.guess;
    return 1;
  }

  const Problem& problem_;
  const Trajectory& guess_;
  std::size_t nx_;
  /// Of states, then controls: the user's scales, sizes in the guess, of fixed ends and of bounds;
  /// 0 for none.
  std::vector<double> scale_, guessed_, ends_, bounds_;
  std::vector<double> known_;
};

}  // namespace

Problem with_scales(Problem problem, const Trajectory& guess) {
  const Problem unscaled = problem;
  const Sizes sizes(unscaled, guess);
  const auto set = [&](const Problem::Variable& variable, double size) {
    if (!variable.scaled()) problem.set_scale(variable.symbol, size > 0 ? size : 1);
  };
  for (std::size_t i = 0; i < problem.states().size(); ++i)
    set(problem.states()[i], sizes.state(i));
  for (std::size_t i = 0; i < problem.controls().size(); ++i)
    set(problem.controls()[i], sizes.control(i));
  for (std::size_t i = 0; i < problem.static_parameters().size(); ++i)
    set(problem.static_parameters()[i], sizes.static_parameter(i));
  for (std::size_t i = 0; i < problem.integrals().size(); ++i)
    set(problem.integrals()[i], sizes.integral(i));
  for (const auto& each : problem.slacks())
    set(each, each.guess != 0 ? size_of(each.guess) : size_of(each.bounds));
  for (std::size_t c = 0; c < problem.constraints().size(); ++c) {
    SetUpWatch::ask_now();
    if (problem.constraints()[c].scale == kAutomaticScale)
      if (const double size = sizes.row(problem.constraints()[c]); size > 0)
        problem.set_scale(ConstraintId{c}, size);
  }
  // Times by how long it lasts, however far from zero the clock stands.
  const double duration = guess.tf - guess.t0;
  const double horizon = duration > 0 ? duration : std::max(size_of(guess.t0), size_of(guess.tf));
  set(problem.t0(), horizon);
  set(problem.tf(), horizon);
  return problem;
}

}  // namespace slalom::ocp
