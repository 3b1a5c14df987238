#include "model_map.hpp"

#include <algorithm>

namespace slalom::planner {

using namespace vehicle;

ModelMap::ModelMap(const Parameters& vehicle, ModelKind kind)
    : model_(make_model(vehicle, kind)),
      values_({model_.state.begin(), model_.state.end()}, {},
              {model_.value.begin(), model_.value.end()}),
      same_(std::all_of(model_.role.begin(), model_.role.end(),
                        [](Role role) { return role == Role::state; })) {}

namespace {

template <std::size_t N, class Kept>
void keep(const std::array<Kept, N>& kept, Kept wanted, std::vector<double>& row) {
  std::size_t to = 0;
  for (std::size_t i = 0; i < row.size(); ++i)
    if (i >= N || kept[i] == wanted) row[to++] = row[i];
  row.resize(to);
}

/// The inverse, with zero for what was dropped.
template <std::size_t N, class Kept>
void spread(const std::array<Kept, N>& kept, Kept wanted, std::vector<double>& row) {
  for (std::size_t i = 0; i < N; ++i)
    if (kept[i] != wanted) row.insert(row.begin() + static_cast<std::ptrdiff_t>(i), 0.0);
}

}  // namespace

void ModelMap::to_planner(ocp::Trajectory& trajectory) const {
  if (same_) return;
  for (auto& state : trajectory.states) keep(model_.role, Role::state, state);
  for (auto& control : trajectory.controls) keep(model_.used, true, control);
  keep(model_.role, Role::state, trajectory.slacks);
}

void ModelMap::to_plant(const State& X0p, ocp::Trajectory& trajectory) const {
  if (same_) return;
  for (auto& state : trajectory.states) {
    spread(model_.role, Role::state, state);
    complete(X0p, state);
  }
  for (auto& control : trajectory.controls) spread(model_.used, true, control);
  spread(model_.role, Role::state, trajectory.slacks);
}

void ModelMap::complete(const State& X0p, std::vector<double>& state) const {
  for (std::size_t i = 0; i < kStates; ++i)
    if (model_.role[i] == Role::held) state[i] = X0p[i];
  State values;
  values_(state, {}, values);
  for (std::size_t i = 0; i < kStates; ++i)
    if (model_.role[i] == Role::derived) state[i] = values[i];
}

}  // namespace slalom::planner
