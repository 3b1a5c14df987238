#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "objective_scale.hpp"
#include "slalom/nlp/check.hpp"
#include "slalom/ocp/solve.hpp"
#include "tables.hpp"

namespace slalom::ocp {

template <class List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  for (const auto& item : list) names.push_back(item.name);
  return names;
}

/// What Solution::scales has of a problem.
std::vector<std::pair<std::string, double>> all_scales(const Problem& problem);

/// Fills `solution` with what a point says of one phase, whose tables are `tables`.
void describe(const Problem& problem, const PhasedTranscription::Grid& grid, const Tables& tables,
              Transcription& transcription, const nlp::Start& point, Solution& solution);

/// The same of all phases, once all else of `solution` is filled.
void describe(const PhasedProblem& problem, const std::vector<PhasedTranscription::Grid>& grids,
              PhasedTranscription& transcription, const nlp::Start& point,
              PhasedSolution& solution);

/// The guess on the grid, of a solve whose set-up was ended.
Solution not_begun(const Problem& problem, const PhasedTranscription::Grid& given,
                   const Trajectory& given_guess, const Solution* previous);

/// A point of the NLP in the user's units, and back.
nlp::Start to_user(nlp::Start point, const nlp::Structure& shape);
nlp::Start from_user(nlp::Start point, const nlp::Structure& shape);

/// The answer of a solve that was not begun.
nlp::Answer interrupted_at(const nlp::Start& start, const nlp::Structure& shape);

/// Solves and checks from a start in the NLP's units, with multipliers or without; `solution` is of
/// one phase or of several. The NLP's answer, in its own units, is returned. Where `options.stop`
/// says so already, what the solver needs is not even set up.
template <class Result>
nlp::Start run(nlp::Problem& problem, nlp::Solver& solver, nlp::Options options,
               const nlp::Start& start, const std::vector<char>& regular, Result& solution) {
  options.warm_start = !start.y.empty();
  const bool stopped = options.stop != nullptr && options.stop(options.stop_data);
  nlp::Answer answer = stopped ? interrupted_at(start, problem.structure())
                               : solve_scaled(problem, solver, start, options, regular);
  solution.status = answer.status;
  solution.fault = answer.fault;
  solution.objective = answer.objective;
  solution.residuals = nlp::check(problem, answer.point, options);
  solution.options = options;
  solution.backend = answer.backend;
  solution.iterations = answer.iterations;
  solution.wall_s = answer.wall_s;
  solution.point = to_user(answer.point, problem.structure());
  return std::move(answer.point);
}

/// Whether an answer's multipliers are those of the least violation.
template <class Result>
bool knows_conflicts(const Result& answer) {
  return (answer.status == nlp::Status::infeasible ||
          answer.status == nlp::Status::too_few_freedoms) &&
         answer.backend.starts_with("interior_point");
}

/// What one phase starts from.
struct Beginning {
  Trajectory guess;
  std::optional<Duals> duals;
};

/// A solution's trajectory on another grid, by its own polynomials.
Trajectory resampled(const Problem& problem, const Solution& solution,
                     const PhasedTranscription::Grid& grid);
/// From `previous` if there is one, else from the guess, checked, or straight lines.
Beginning begin(const Problem& problem, const PhasedTranscription::Grid& grid,
                const Trajectory& guess, const Solution* previous);
nlp::Start start_of(Transcription& transcription, const Beginning& beginning);

}  // namespace slalom::ocp
