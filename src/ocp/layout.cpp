#include "layout.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "slalom/base/error.hpp"

namespace slalom::ocp {

std::string Layout::point_name(std::size_t point) const {
  const auto above = std::upper_bound(node_point.begin(), node_point.end(), point);
  const auto node = static_cast<std::size_t>(above - node_point.begin()) - 1;
  const std::size_t offset = point - node_point[node];
  return offset == 0 ? fmt::format("node {}", node)
                     : fmt::format("point {} of interval {}", offset, node);
}

Layout make_layout(const Problem& problem, const Mesh& mesh, const Schemes& schemes,
                   const Lifts& lifts) {
  Layout layout;
  layout.nx = problem.states().size();
  layout.nu = problem.controls().size();
  const auto add_point = [&](double tau, std::size_t stage, bool has_state) {
    layout.state_slot.push_back(has_state ? layout.state_points.size() : kNone);
    if (has_state) layout.state_points.push_back(layout.tau.size());
    layout.tau.push_back(tau);
    layout.point_stage.push_back(stage);
  };
  const auto& breaks = mesh.breakpoints();
  for (std::size_t k = 0; k < breaks.size(); ++k) {
    layout.node_point.push_back(layout.tau.size());
    add_point(breaks[k], k, true);
    if (k + 1 == breaks.size()) break;
    const Scheme& scheme = schemes.of(k);
    for (std::size_t j = 1; j <= scheme.interior(); ++j)
      add_point(breaks[k] + scheme.points[j] * (breaks[k + 1] - breaks[k]), k, !scheme.compressed);
  }
  std::size_t next = 0;
  const auto place = [&](std::size_t stage) {
    layout.variable_stage.push_back(static_cast<std::uint32_t>(stage));
    return next++;
  };
  for (std::size_t i = 0; i < layout.nx; ++i)
    for (const std::size_t point : layout.state_points) place(layout.point_stage[point]);
  for (std::size_t i = 0; i < layout.nu; ++i)
    for (const std::size_t stage : layout.point_stage) place(stage);
  for (const auto& slack : problem.slacks())
    layout.slack.push_back(place(slack.end == End::initial ? 0 : breaks.size() - 1));
  layout.t0 = next++;
  layout.tf = next++;
  layout.static_parameters = next;
  next += problem.static_parameters().size();
  layout.integrals = next;
  next += problem.integrals().size();
  for (const auto& [used, where] : {std::pair{&lifts.initial, &layout.lifted_initial},
                                    std::pair{&lifts.final, &layout.lifted_final}}) {
    where->assign(layout.nx, kNone);
    for (std::size_t i = 0; i < layout.nx; ++i)
      if ((*used)[i]) (*where)[i] = next++;
  }
  layout.variables = next;
  layout.variable_stage.resize(next, static_cast<std::uint32_t>(breaks.size()));
  return layout;
}

std::vector<double> variable_scales(const Problem& problem, const Layout& layout) {
  std::vector<double> scale(layout.variables, 1.0);
  for (std::size_t i = 0; i < layout.nx; ++i)
    for (const std::size_t point : layout.state_points)
      scale[layout.state(point, i)] = problem.states()[i].unit();
  for (std::size_t i = 0; i < layout.nu; ++i)
    for (std::size_t point = 0; point < layout.points(); ++point)
      scale[layout.control(point, i)] = problem.controls()[i].unit();
  scale[layout.t0] = problem.t0().unit();
  scale[layout.tf] = problem.tf().unit();
  for (std::size_t i = 0; i < layout.slack.size(); ++i)
    scale[layout.slack[i]] = problem.slacks()[i].unit();
  for (std::size_t i = 0; i < problem.static_parameters().size(); ++i)
    scale[layout.static_parameters + i] = problem.static_parameters()[i].unit();
  for (std::size_t i = 0; i < problem.integrals().size(); ++i)
    scale[layout.integrals + i] = problem.integrals()[i].unit();
  for (std::size_t i = 0; i < layout.nx; ++i)
    for (const auto* lifted : {&layout.lifted_initial, &layout.lifted_final})
      if ((*lifted)[i] != kNone) scale[(*lifted)[i]] = problem.states()[i].unit();
  return scale;
}

void fill_variable_limits(const Problem& problem, const Layout& layout,
                          const std::vector<double>& scale, nlp::Limits& limits) {
  limits.xl.assign(layout.variables, -kInfinity);
  limits.xu.assign(layout.variables, kInfinity);
  const auto set = [&](std::size_t index, Bounds bounds, const std::string& name) {
    limits.xl[index] = std::max(limits.xl[index], bounds.lower / scale[index]);
    limits.xu[index] = std::min(limits.xu[index], bounds.upper / scale[index]);
    if (limits.xl[index] > limits.xu[index])
      throw InvalidValue(
          problem.name() + ": " + name,
          fmt::format("bounds {} to {} at an end and over the horizon",
                      limits.xl[index] * scale[index], limits.xu[index] * scale[index]),
          "bounds that meet");
  };
  const std::size_t last = layout.points() - 1;
  for (std::size_t i = 0; i < layout.nx; ++i) {
    const auto& state = problem.states()[i];
    for (const std::size_t point : layout.state_points)
      set(layout.state(point, i), state.bounds, state.name);
    set(layout.state(0, i), state.initial, "initial " + state.name);
    set(layout.state(last, i), state.final, "final " + state.name);
  }
  for (std::size_t i = 0; i < layout.nu; ++i)
    for (std::size_t point = 0; point <= last; ++point)
      set(layout.control(point, i), problem.controls()[i].bounds, problem.controls()[i].name);
  for (std::size_t i = 0; i < layout.slack.size(); ++i)
    set(layout.slack[i], problem.slacks()[i].bounds, problem.slacks()[i].name);
  set(layout.t0, problem.t0().bounds, "t0");
  set(layout.tf, problem.tf().bounds, "tf");
  for (std::size_t i = 0; i < problem.static_parameters().size(); ++i)
    set(layout.static_parameters + i, problem.static_parameters()[i].bounds,
        problem.static_parameters()[i].name);
  for (std::size_t i = 0; i < problem.integrals().size(); ++i)
    set(layout.integrals + i, problem.integrals()[i].bounds, problem.integrals()[i].name);
}

std::string variable_name(const Problem& problem, const Layout& layout, std::size_t index) {
  for (std::size_t i = 0; i < layout.slack.size(); ++i)
    if (layout.slack[i] == index) return problem.slacks()[i].name;
  if (index == layout.t0) return "t0";
  if (index == layout.tf) return "tf";
  for (std::size_t i = 0; i < problem.static_parameters().size(); ++i)
    if (layout.static_parameters + i == index) return problem.static_parameters()[i].name;
  for (std::size_t i = 0; i < problem.integrals().size(); ++i)
    if (layout.integrals + i == index) return problem.integrals()[i].name;
  for (std::size_t i = 0; i < layout.nx; ++i) {
    if (layout.lifted_initial[i] == index) return problem.states()[i].initial_symbol.name();
    if (layout.lifted_final[i] == index) return problem.states()[i].final_symbol.name();
  }
  const auto at = [&](const std::string& name, std::size_t point) {
    return name + " at " + layout.point_name(point);
  };
  const std::size_t slots = layout.state_points.size(), states = layout.nx * slots;
  if (index < states)
    return at(problem.states()[index / slots].name, layout.state_points[index % slots]);
  const std::size_t control = index - states;
  return at(problem.controls()[control / layout.points()].name, control % layout.points());
}

}  // namespace slalom::ocp
