#include "planner_cycle.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "slalom/io/scenario_file.hpp"

namespace slalom::bench {

using namespace vehicle;

Form::Form(const sim::Scenario& scenario, bool goal_in_range)
    : problem(scenario.planner, scenario.vehicle, scenario.goal, scenario.region,
              scenario.obstacles, goal_in_range),
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

PlannerCycle::PlannerCycle(sim::Scenario scenario) : scenario_(std::move(scenario)) {}

bool PlannerCycle::goal_in_range(const State& X0p) const {
  return std::hypot(X0p[X] - scenario_.goal.x, X0p[Y] - scenario_.goal.y) <
         scenario_.planner.L_range;
}

Form& PlannerCycle::form(bool in_range) {
  auto& form = forms_[in_range ? 1 : 0];
  if (!form) form = std::make_unique<Form>(scenario_, in_range);
  return *form;
}

nlp::Start PlannerCycle::start(const Form& form, bool in_range, const planner::Request& request,
                               const Last* last) const {
  ocp::Trajectory guess = last != nullptr ? shifted(request, *last) : straight_on(request);
  place_slacks(request, in_range, last, guess);
  nlp::Start start;
  if (last != nullptr && last->in_range == in_range) start = last->multipliers;
  start.x = form.transcription.point(guess);
  return start;
}

ocp::Trajectory PlannerCycle::straight_on(const planner::Request& request) const {
  const auto& s = scenario_.planner;
  const State& X0p = request.X0p;
  const double distance = std::hypot(X0p[X] - scenario_.goal.x, X0p[Y] - scenario_.goal.y);
  const double tf = std::clamp(std::min(s.L_range, distance) / std::max(X0p[UX], 5.0),
                               1.01 * s.tf_min, 0.99 * s.tf_max);
  std::vector<double> end(kStates, 0.0);
  end[X] = X0p[X] + tf * X0p[UX] * std::cos(X0p[PSI]);
  end[Y] = X0p[Y] + tf * X0p[UX] * std::sin(X0p[PSI]);
  end[PSI] = X0p[PSI];
  end[UX] = X0p[UX];
  return {0, tf, {0, 1}, {{X0p.begin(), X0p.end()}, end}, {{0, 0}, {0, 0}}, {}, {}};
}

/// The last plan from the new start on, its last point held, its end time kept.
ocp::Trajectory PlannerCycle::shifted(const planner::Request& request, const Last& last) const {
  const auto& s = scenario_.planner;
  const ocp::Trajectory& plan = last.plan;
  const double shift = request.t0 + request.tex - last.t_start;
  ocp::Trajectory guess;
  guess.tf = std::clamp(std::max(plan.tf - shift, 0.2), 1.01 * s.tf_min, 0.99 * s.tf_max);
  for (const double tau : plan.tau) {
    const double at = std::clamp((shift + tau * guess.tf) / plan.tf, 0.0, 1.0);
    const auto above = std::upper_bound(plan.tau.begin(), plan.tau.end(), at) - plan.tau.begin();
    const auto k = std::min(static_cast<std::size_t>(above), plan.tau.size() - 1);
    const double share = (at - plan.tau[k - 1]) / (plan.tau[k] - plan.tau[k - 1]);
    const auto mix = [&](const auto& rows) {
      std::vector<double> row(rows[k]);
      for (std::size_t i = 0; i < row.size(); ++i)
        row[i] = rows[k - 1][i] + share * (rows[k][i] - rows[k - 1][i]);
      return row;
    };
    guess.tau.push_back(tau);
    guess.states.push_back(mix(plan.states));
    guess.controls.push_back(mix(plan.controls));
  }
  return guess;
}

/// After a solved plan X(0) keeps its offset from X0p and the slacks their values: their rows start
/// where the barrier left them.
void PlannerCycle::place_slacks(const planner::Request& request, bool in_range, const Last* last,
                                ocp::Trajectory& guess) const {
  const auto& s = scenario_.planner;
  guess.slacks.clear();
  for (std::size_t i = 0; i < kStates; ++i) {
    const double offset = last != nullptr ? last->plan.states.front()[i] - last->X0p[i] : 0;
    guess.states.front()[i] = request.X0p[i] + offset;
    guess.slacks.push_back(last != nullptr ? last->plan.slacks[i]
                                           : inside(s.X0_tol[i], s.w_ic * s.w_s0[i]));
  }
  if (!in_range) return;
  const auto& end = guess.states.back();
  const auto& goal = scenario_.goal;
  for (const double gap : {std::fabs(end[X] - goal.x), std::fabs(end[Y] - goal.y)})
    guess.slacks.push_back(gap < s.XF_tol ? gap + inside(s.XF_tol - gap, s.w_xf) : s.XF_tol * 0.99);
}

/// Where the barrier alone would hold a slack of this weight, and at most half of its room.
double PlannerCycle::inside(double room, double weight) const {
  return std::min(2 * scenario_.planner.floor / weight, room / 2);
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

}  // namespace slalom::bench
