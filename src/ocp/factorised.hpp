#pragma once

#include <string>
#include <utility>
#include <vector>

#include "dependence.hpp"
#include "numbers.hpp"
#include "slalom/base/error.hpp"
#include "slalom/nlp/check.hpp"
#include "slalom/nlp/sensitivity.hpp"
#include "slalom/ocp/sensitivity.hpp"
#include "solved.hpp"

namespace slalom::ocp {

/// The problem with these scales, as Solution::scales has them; others stay.
Problem scaled_by(const std::vector<std::pair<std::string, double>>& scales, Problem problem);
/// The problem with the scales that it was solved with.
Problem with_scales_of(const Solution& solution, Problem problem);

/// An answer's NLP, factorised there.
class Factorised {
 public:
  /// `name` is the problem's; `problem` outlives this. Throws as Sensitivities does.
  Factorised(std::string name, nlp::Problem& problem, const nlp::Start& users_point,
             const nlp::Options& options);

  const nlp::Start& point() const { return point_; }  ///< in the NLP's units
  /// In the NLP's units. Throws where the derivatives by `number` are not finite.
  nlp::Sensitivity solve(const std::string& number, const nlp::Dependence& dependence);
  /// The point and a change of it: fixed variables by the new limits exactly, and no multiplier of
  /// the wrong sign.
  nlp::Start moved(const nlp::Start& change, const nlp::Limits& limits) const;

 private:
  const std::string name_;
  const nlp::Start point_;
  nlp::Sensitivities system_;
};

/// One phase of an answer.
class AnsweredPhase {
 public:
  /// The first two outlive this; `point` is the phase's, in the NLP's units.
  AnsweredPhase(const Problem& problem, Transcription& transcription, const nlp::Start& point);

  const std::vector<Number>& numbers() const { return numbers_; }
  Direction direction(const Number& number) const;
  /// Nothing moves.
  Direction rest() const;
  nlp::Dependence dependence(const Direction& direction) const;
  /// What rates of the phase's part of the NLP's point say. Names the number `number`.
  Sensitivity describe(const std::string& number, const nlp::Start& rate,
                       const Direction& direction, const nlp::Dependence& dependence) const;

 private:
  const Transcribed& data() const { return transcribed_by(transcription_); }

  const Problem& problem_;
  Transcription& transcription_;
  DataSlopes slopes_;
  std::vector<Number> numbers_;
  std::vector<double> gradient_;  ///< of the phase's own objective
};

/// Throws InvalidValue for an answer, of one phase or several, that is not solved.
template <class Answer>
void check_solved(const std::string& name, const Answer& answer) {
  if (!answer.solved())
    throw InvalidValue(
        name + ": sensitivities",
        std::string("an answer that is not solved: ") +
            (answer.status == nlp::Status::solved ? "its residuals are beyond its tolerances"
                                                  : nlp::to_string(answer.status)),
        "one that is");
}

/// Fills what a predicted point of an NLP says of itself as an answer to it.
template <class Answer>
void judge_prediction(nlp::Problem& problem, const nlp::Start& point, const nlp::Options& options,
                      Answer& answer) {
  answer.options = options;
  answer.backend = "prediction";
  answer.residuals = nlp::check(problem, point, options);
  answer.status =
      answer.residuals.solved(options) ? nlp::Status::solved : nlp::Status::iteration_limit;
  answer.objective = answer.residuals.objective;
  answer.point = to_user(point, problem.structure());
}

}  // namespace slalom::ocp
