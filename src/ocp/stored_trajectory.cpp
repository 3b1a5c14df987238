#include "stored_trajectory.hpp"

namespace slalom::ocp {

Trajectory stored_trajectory(const Problem& problem, const Transcribed& transcribed,
                             std::span<const double> x) {
  const Layout& layout = transcribed.layout;
  const auto& scale = transcribed.structure.variable_scale;
  const auto value = [&](std::size_t index) { return x[index] * scale[index]; };
  Trajectory result;
  result.t0 = value(layout.t0);
  result.tf = value(layout.tf);
  result.tau = layout.tau;
  for (std::size_t point = 0; point < layout.points(); ++point) {
    auto& states = result.states.emplace_back();
    for (std::size_t i = 0; i < layout.nx; ++i)
      states.push_back(layout.has_state(point) ? value(layout.state(point, i)) : 0);
    auto& controls = result.controls.emplace_back();
    for (std::size_t i = 0; i < layout.nu; ++i) controls.push_back(value(layout.control(point, i)));
  }
  for (std::size_t i = 0; i < problem.static_parameters().size(); ++i)
    result.static_parameters.push_back(value(layout.static_parameters + i));
  for (std::size_t i = 0; i < problem.integrals().size(); ++i)
    result.integrals.push_back(value(layout.integrals + i));
  for (const std::size_t index : layout.slack) result.slacks.push_back(value(index));
  return result;
}

}  // namespace slalom::ocp
