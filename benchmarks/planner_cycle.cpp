#include "planner_cycle.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "obstacle_view.hpp"
#include "slalom/io/scenario_file.hpp"

namespace slalom::bench {

using namespace vehicle;

Form::Form(const sim::Scenario& scenario, bool goal_in_range)
    : problem(scenario,
              planner::stand_ins(scenario.planner, world::Footprint(scenario.vehicle),
                                 scenario.obstacles),
              goal_in_range),
      transcription(
          [&]() -> const ocp::Problem& {
            problem.update({});
            return problem.problem();
          }(),
          ocp::Mesh::uniform(scenario.planner.N), ocp::trapezoidal()) {}

void Form::update(const planner::Request& request) {
  problem.update(request);
  transcription.update(problem.problem());
}

PlannerCycle::PlannerCycle(sim::Scenario scenario)
    : scenario_(std::move(scenario)), guess_(scenario_) {}

bool PlannerCycle::goal_in_range(const State& X0p) const {
  return std::hypot(X0p[X] - scenario_.goal.x, X0p[Y] - scenario_.goal.y) <
         scenario_.planner.L_range;
}

Form& PlannerCycle::form(bool in_range) {
  auto& form = forms_[in_range ? 1 : 0];
  if (!form) form = std::make_unique<Form>(scenario_, in_range);
  return *form;
}

void PlannerCycle::start(const planner::Request& request, const Last* last, nlp::Start& start) {
  const bool in_range = goal_in_range(request.X0p);
  planner::WayAhead way;  // there is no road
  way.in_range = in_range;
  start.x = form(in_range).transcription.point(
      guess_(request, way, last != nullptr ? &last->plan : nullptr));
  const bool same = last != nullptr && last->plan.in_range == in_range;
  for (auto part : {&nlp::Start::y, &nlp::Start::zl, &nlp::Start::zu})
    same ? (void)(start.*part = last->multipliers.*part) : (start.*part).clear();
}

sim::Scenario load(const std::string& environment, double tex, std::optional<int> N,
                   std::optional<std::size_t> obstacles) {
  sim::Scenario scenario = io::load_scenario({environment, "P_D", tex, {}});
  if (N) scenario.planner.N = *N;
  if (!obstacles) return scenario;
  for (std::size_t i = scenario.obstacles.size(); i < *obstacles; ++i) {
    const double aside = 60 + 40 * spread(1, 2 * i), along = 350 + 350 * spread(1, 2 * i + 1);
    const double x = i % 2 == 0 ? scenario.start[X] - aside : scenario.start[X] + 18 + aside;
    scenario.obstacles.push_back({"extra " + std::to_string(i), x, along, 2, 2, 0, 0});
  }
  scenario.obstacles.resize(*obstacles);
  return scenario;
}

double spread(std::uint64_t seed, std::uint64_t index) {
  std::uint64_t z = seed * 0xd1342543de82ef95ULL + (index + 1) * 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;  // splitmix64
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  z ^= z >> 31;
  return 2 * (static_cast<double>(z >> 11) * 0x1.0p-53) - 1;
}

State moved(State state, const State& width, std::uint64_t seed, std::uint64_t index) {
  for (std::size_t i = 0; i < state.size(); ++i)
    state[i] += width[i] * spread(seed, index * state.size() + i);
  return state;
}

}  // namespace slalom::bench
