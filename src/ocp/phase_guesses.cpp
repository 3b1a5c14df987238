#include "phase_guesses.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "bounds.hpp"
#include "slalom/expr/function.hpp"
#include "slalom/ocp/guess.hpp"

namespace slalom::ocp {
namespace {

/// One state at one end of one phase.
struct StateEnd {
  std::size_t phase = 0, state = 0;
  bool final = false;
};

std::optional<StateEnd> end_of(const PhasedProblem& problem, const Expr& symbol) {
  for (std::size_t p = 0; p < problem.phases().size(); ++p) {
    const auto& states = problem.phases()[p].states();
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (symbol.same(states[i].initial_symbol)) return StateEnd{p, i, false};
      if (symbol.same(states[i].final_symbol)) return StateEnd{p, i, true};
    }
  }
  return std::nullopt;
}

/// to = from + jump, from the end of one phase to the start of another.
struct Passage {
  StateEnd from, to;
  double jump = 0;
};

/// Of a link that says that and nothing more.
std::optional<Passage> passage_of(const PhasedProblem& problem, const PhasedProblem::Link& link) {
  const auto symbols = expr::symbols_of({link.value});
  if (symbols.size() != 2 || link.bounds.lower != link.bounds.upper) return std::nullopt;
  auto from = end_of(problem, symbols[0]), to = end_of(problem, symbols[1]);
  if (!from || !to || from->phase == to->phase || from->final == to->final) return std::nullopt;
  const bool swapped = to->final;
  if (swapped) std::swap(from, to);
  const expr::Function f(symbols, {}, {link.value});
  const auto at = [&](double of_from, double of_to) {
    const std::array<double, 2> x =
        swapped ? std::array{of_to, of_from} : std::array{of_from, of_to};
    double value = 0;
    f(x, {}, {&value, 1});
    return value - link.bounds.lower;
  };
  const double rest = at(0, 0), slope = at(0, 1) - rest;
  const bool same = slope != 0 && at(1, 0) - rest == -slope && at(2, 1) - rest == -slope;
  if (!same || !std::isfinite(rest / slope)) return std::nullopt;
  return Passage{*from, *to, -rest / slope};
}

/// What is known of a state at an end, and how far away along the phases.
struct Known {
  double value = 0, distance = 0;
};
using Ends = std::array<std::vector<std::optional<Known>>, 2>;  ///< initial, final: [state]

class Chain {
 public:
  Chain(const PhasedProblem& problem, const std::vector<Trajectory>& given)
      : problem_(problem), told_(problem.phases().size()) {
    for (const auto& link : problem.links())
      if (const auto passage = passage_of(problem, link)) passages_.push_back(*passage);
    for (std::size_t p = 0; p < told_.size(); ++p) {
      const auto& states = problem.phases()[p].states();
      for (const bool final : {false, true})
        for (std::size_t i = 0; i < states.size(); ++i) {
          auto& end = told_[p][final].emplace_back();
          const Bounds bounds = end_bounds(states[i], final);
          if (!given[p].tau.empty())
            end = {(final ? given[p].states.back() : given[p].states.front())[i], 0};
          else if (tells_a_value(bounds))
            end = {(bounds.lower + bounds.upper) / 2, 0};
        }
    }
  }

  /// Into a guess of a phase that had none.
  void tell(std::size_t phase, Trajectory& guess) const {
    const auto& states = problem_.phases()[phase].states();
    for (const bool final : {false, true})
      for (std::size_t i = 0; i < states.size(); ++i) {
        const StateEnd end{phase, i, final};
        if (told_[phase][final][i]) continue;
        const auto before = nearest(end, false), after = nearest(end, true);
        if (!before && !after) continue;
        const Known& a = before ? *before : *after;
        const Known& b = after ? *after : *before;
        const double way = a.distance + b.distance;
        const double share = before && after && way > 0 ? a.distance / way : 0;
        const Bounds bounds = end_bounds(states[i], final);
        auto& row = final ? guess.states.back() : guess.states.front();
        row[i] = std::clamp(a.value + share * (b.value - a.value), bounds.lower, bounds.upper);
      }
  }

 private:
  /// The nearest end that is told, later or earlier than `end`; itself, if it is.
  std::optional<Known> nearest(StateEnd end, bool later) const {
    double distance = 0, jumps = 0;
    for (std::size_t step = 0; step <= 2 * told_.size(); ++step) {  // phases may form a ring
      if (const auto& known = told_[end.phase][end.final][end.state])
        return Known{known->value - jumps, distance};
      if (end.final != later) {  // through its phase
        const Problem& phase = problem_.phases()[end.phase];
        const double duration = phase.tf().guess - phase.t0().guess;
        distance += duration > 0 ? duration : 1;
        end.final = later;
        continue;
      }
      const auto next = std::find_if(passages_.begin(), passages_.end(), [&](const Passage& each) {
        const StateEnd& here = later ? each.from : each.to;
        return here.phase == end.phase && here.state == end.state;
      });
      if (next == passages_.end()) return std::nullopt;
      jumps += later ? next->jump : -next->jump;
      end = later ? next->to : next->from;
    }
    return std::nullopt;
  }

  const PhasedProblem& problem_;
  std::vector<Passage> passages_;
  std::vector<Ends> told_;  ///< by phase
};

}  // namespace

std::vector<Trajectory> linked_guesses(const PhasedProblem& problem,
                                       std::vector<Trajectory> given) {
  given.resize(problem.phases().size());
  const Chain chain(problem, given);
  for (std::size_t p = 0; p < given.size(); ++p) {
    if (!given[p].tau.empty()) continue;
    given[p] = held_guess(problem.phases()[p]);
    chain.tell(p, given[p]);
  }
  return given;
}

}  // namespace slalom::ocp
