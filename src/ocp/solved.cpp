#include "solved.hpp"

#include "between_points.hpp"
#include "conflicts.hpp"
#include "slalom/ocp/guess.hpp"
#include "slalom/ocp/interpolant.hpp"
#include "slalom/ocp/kinks.hpp"
#include "slalom/ocp/moments.hpp"

namespace slalom::ocp {

std::vector<std::pair<std::string, double>> all_scales(const Problem& problem) {
  std::vector<std::pair<std::string, double>> scales;
  const auto note = [&](const auto& list) {
    for (const auto& each : list) scales.emplace_back(each.name, each.unit());
  };
  note(problem.states());
  note(problem.controls());
  note(problem.static_parameters());
  note(problem.slacks());
  note(problem.integrals());
  note(std::vector{problem.t0(), problem.tf()});
  note(problem.constraints());
  return scales;
}

void describe(const Problem& problem, const PhasedTranscription::Grid& grid, const Tables& tables,
              Transcription& transcription, const nlp::Start& point, Solution& solution) {
  solution.mesh = grid.mesh;
  for (const auto& state : problem.states()) solution.state_units.push_back(state.unit());
  solution.scales = all_scales(problem);
  solution.scheme = grid.schemes;
  solution.cost_terms = transcription.cost_terms(point.x);
  solution.trajectory = transcription.trajectory(point.x);
  solution.costates = transcription.costates(point.x, point.y);
  solution.collocated_costates = transcription.collocated_costates(point.y);
  solution.multipliers = transcription.multipliers(point);
  solution.excesses = transcription.excesses(point.x);
  solution.state_names = names_of(problem.states());
  solution.control_names = names_of(problem.controls());
  solution.static_parameter_names = names_of(problem.static_parameters());
  solution.slack_names = names_of(problem.slacks());
  if (solution.status != nlp::Status::solved) {
    solution.high_index = high_index(problem);
    solution.kinks = costs_with_kinks(problem);
  }
  solution.beyond_tables = tables.beyond(problem, solution);
  if (knows_conflicts(solution)) solution.conflicts = conflicts(problem, solution.multipliers);
}

void describe(const PhasedProblem& problem, const std::vector<PhasedTranscription::Grid>& grids,
              PhasedTranscription& transcription, const nlp::Start& point,
              PhasedSolution& solution) {
  const auto& row_scale = transcription.structure().row_scale;
  for (std::size_t p = 0; p < problem.phases().size(); ++p) {
    Solution& part = solution.phases.emplace_back();
    const Problem& phase = problem.phases()[p];
    part.status = solution.status;  // what there is to describe depends on it
    part.fault = solution.fault;
    describe(phase, grids[p], Tables(phase), transcription.phase(p),
             transcription.part_of(p, point), part);
    part.residuals = solution.residuals;
    part.options = solution.options;
    part.backend = solution.backend;
    part.iterations = solution.iterations;
    part.wall_s = solution.wall_s;
    for (const auto& term : part.cost_terms) part.objective += term.second;
  }
  for (std::size_t l = 0; l < problem.links().size(); ++l) {
    const std::size_t row = transcription.first_link() + l;
    solution.link_multipliers.emplace_back(problem.links()[l].name, point.y[row] * row_scale[row]);
  }
  const auto costs = transcription.cost_terms(point.x);
  for (std::size_t c = 0; c < costs.size(); ++c)
    solution.cost_terms.emplace_back(problem.costs()[c].name, costs[c]);
}

Solution not_begun(const Problem& problem, const PhasedTranscription::Grid& given,
                   const Trajectory& given_guess, const Solution* previous) {
  const auto grid = with_moments(problem, given);
  const Trajectory guess =
      previous != nullptr ? previous->trajectory : begin(problem, grid, given_guess, nullptr).guess;
  Solution solution;
  solution.mesh = grid.mesh;
  solution.scheme = grid.schemes;
  solution.scales = all_scales(problem);
  for (const auto& state : problem.states()) solution.state_units.push_back(state.unit());
  solution.state_names = names_of(problem.states());
  solution.control_names = names_of(problem.controls());
  solution.static_parameter_names = names_of(problem.static_parameters());
  solution.slack_names = names_of(problem.slacks());
  Trajectory& at = solution.trajectory = guess;
  at.tau = {0};
  for (std::size_t k = 0; k < grid.mesh.intervals(); ++k) {
    const double from = grid.mesh.breakpoints()[k], to = grid.mesh.breakpoints()[k + 1];
    const auto& points = grid.schemes.of(k).points;
    for (std::size_t j = 1; j < points.size(); ++j)
      at.tau.push_back(from + points[j] * (to - from));
  }
  const auto sample = [&](const std::vector<std::vector<double>>& rows) {
    std::vector<std::vector<double>> list(at.tau.size());
    for (std::size_t k = 0; k < list.size(); ++k)
      for (std::size_t i = 0; i < rows.front().size(); ++i)
        list[k].push_back(between_points(guess.tau, rows, i, at.tau[k]));
    return list;
  };
  at.states = sample(guess.states);
  at.controls = sample(guess.controls);
  for (std::size_t i = at.static_parameters.size(); i < problem.static_parameters().size(); ++i)
    at.static_parameters.push_back(problem.static_parameters()[i].guess);
  for (std::size_t i = at.slacks.size(); i < problem.slacks().size(); ++i)
    at.slacks.push_back(problem.slacks()[i].guess);
  at.integrals.resize(problem.integrals().size());
  return solution;
}

nlp::Answer interrupted_at(const nlp::Start& start, const nlp::Structure& shape) {
  nlp::Answer answer;
  answer.status = nlp::Status::interrupted;
  answer.point = start;
  answer.point.y.resize(shape.rows);
  answer.point.zl.resize(shape.variables);
  answer.point.zu.resize(shape.variables);
  return answer;
}

nlp::Start to_user(nlp::Start point, const nlp::Structure& shape) {
  for (std::size_t i = 0; i < point.x.size(); ++i) point.x[i] *= shape.variable_scale[i];
  for (auto* z : {&point.zl, &point.zu})
    for (std::size_t i = 0; i < z->size(); ++i) (*z)[i] /= shape.variable_scale[i];
  for (std::size_t r = 0; r < point.y.size(); ++r) point.y[r] *= shape.row_scale[r];
  return point;
}
nlp::Start from_user(nlp::Start point, const nlp::Structure& shape) {
  nlp::check_sizes(point, shape, true);
  for (std::size_t i = 0; i < point.x.size(); ++i) point.x[i] /= shape.variable_scale[i];
  for (auto* z : {&point.zl, &point.zu})
    for (std::size_t i = 0; i < z->size(); ++i) (*z)[i] *= shape.variable_scale[i];
  for (std::size_t r = 0; r < point.y.size(); ++r) point.y[r] /= shape.row_scale[r];
  return point;
}

Trajectory resampled(const Problem& problem, const Solution& solution,
                     const PhasedTranscription::Grid& grid) {
  const Interpolant polynomials(problem, solution.trajectory, solution.mesh, solution.scheme);
  return polynomials.resampled(grid.mesh, grid.schemes);
}

Beginning begin(const Problem& problem, const PhasedTranscription::Grid& grid,
                const Trajectory& guess, const Solution* previous) {
  if (previous != nullptr && previous->collocated_costates.tau.empty())  // its solve did not begin
    return {resampled(problem, *previous, grid), {}};
  if (previous != nullptr)
    return {resampled(problem, *previous, grid),
            Duals{previous->trajectory.tau, previous->collocated_costates, previous->multipliers}};
  if (guess.tau.empty()) return {straight_guess(problem), {}};
  check_guess(guess, problem);
  return {guess, {}};
}

nlp::Start start_of(Transcription& transcription, const Beginning& beginning) {
  if (beginning.duals) return transcription.carried(beginning.guess, *beginning.duals);
  return {transcription.point(beginning.guess), {}, {}, {}};
}

}  // namespace slalom::ocp
