#include "midpoints.hpp"

#include <utility>

namespace slalom::ocp {

Midpoints::Midpoints(const Problem& problem, const Layout& layout)
    : problem_(problem), layout_(layout) {
  for (const auto& [side, word] :
       {std::pair{&begin_, " at the begin"}, std::pair{&end_, " at the end"}}) {
    for (const auto& state : problem.states())
      side->states.push_back(Expr::symbol(state.name + word));
    for (const auto& control : problem.controls())
      side->controls.push_back(Expr::symbol(control.name + word));
    side->tau = Expr::symbol(std::string("tau") + word);
  }
  // A held control has the begin's value at the end too.
  for (std::size_t i = 0; i < problem.controls().size(); ++i)
    if (problem.controls()[i].form == ControlForm::constant) end_.controls[i] = begin_.controls[i];

  const Expr duration = problem.final_time() - problem.initial_time();
  const Expr h = (end_.tau - begin_.tau) * duration;
  const auto at_begin = rates(begin_), at_end = rates(end_);
  for (std::size_t i = 0; i < problem.states().size(); ++i) {
    states_.push_back(problem.states()[i].symbol);
    midpoint_.push_back((begin_.states[i] + end_.states[i]) / 2 +
                        h / 8 * (at_begin[i] - at_end[i]));
  }
}

std::vector<Expr> Midpoints::rates(const Side& side) const {
  std::vector<Expr> rates, from, to;
  for (std::size_t i = 0; i < problem_.states().size(); ++i) {
    rates.push_back(problem_.states()[i].rate);
    from.push_back(problem_.states()[i].symbol);
    to.push_back(side.states[i]);
  }
  for (std::size_t i = 0; i < problem_.controls().size(); ++i) {
    from.push_back(problem_.controls()[i].symbol);
    to.push_back(side.controls[i]);
  }
  from.push_back(problem_.time());
  to.push_back(problem_.initial_time() +
               side.tau * (problem_.final_time() - problem_.initial_time()));
  from.push_back(problem_.tau());
  to.push_back(side.tau);
  return expr::substitute(rates, from, to);
}

std::vector<Output> Midpoints::outputs(const std::vector<Output>& at_point) const {
  std::vector<Expr> values;
  for (const auto& output : at_point) values.push_back(output.value);
  values = expr::substitute(values, states_, midpoint_);
  std::vector<Output> result = at_point;
  for (std::size_t i = 0; i < result.size(); ++i) result[i].value = values[i];
  return result;
}

Lanes Midpoints::lanes(std::vector<std::size_t> points, std::size_t family) const {
  Lanes lanes{std::move(points), family, nullptr, {}, {}, kNone, {}};
  const auto begin = [this](std::size_t point) {
    return layout_.node_point[layout_.point_stage[point]];
  };
  const auto end = [this](std::size_t point) {
    return layout_.node_point[layout_.point_stage[point] + 1];
  };
  const auto place = [&](const Side& side, auto end_point) {
    for (std::size_t i = 0; i < side.states.size(); ++i)
      lanes.placed.push_back({side.states[i], [this, i, end_point](const Batch& b, std::size_t l) {
                                return layout_.state(end_point(b.lane_point[l]), i);
                              }});
    for (std::size_t i = 0; i < side.controls.size(); ++i)
      lanes.placed.push_back(
          {side.controls[i], [this, i, end_point](const Batch& b, std::size_t l) {
             return layout_.control(end_point(b.lane_point[l]), i);
           }});
    lanes.taus.push_back({side.tau, end_point});
  };
  place(begin_, begin);
  place(end_, end);
  return lanes;
}

}  // namespace slalom::ocp
