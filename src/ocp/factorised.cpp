#include "factorised.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "slalom/base/options.hpp"
#include "slalom/ocp/scaling.hpp"

namespace slalom::ocp {

Problem scaled_by(const std::vector<std::pair<std::string, double>>& scales, Problem problem) {
  const auto scale = [&](const std::string& name) -> std::optional<double> {
    for (const auto& [known, value] : scales)
      if (known == name) return value;
    return std::nullopt;
  };
  const auto set = [&](const auto& list) {
    for (std::size_t i = 0; i < list.size(); ++i)
      if (const auto known = scale(list[i].name)) problem.set_scale(list[i].symbol, *known);
  };
  set(problem.states());
  set(problem.controls());
  set(problem.static_parameters());
  set(problem.slacks());
  set(problem.integrals());
  if (const auto known = scale("t0")) problem.set_scale(problem.initial_time(), *known);
  if (const auto known = scale("tf")) problem.set_scale(problem.final_time(), *known);
  for (std::size_t c = 0; c < problem.constraints().size(); ++c)
    if (const auto known = scale(problem.constraints()[c].name))
      problem.set_scale(ConstraintId{c}, *known);
  return problem;
}

Problem with_scales_of(const Solution& solution, Problem problem) {
  return with_scales(scaled_by(solution.scales, std::move(problem)), solution.trajectory);
}

Factorised::Factorised(std::string name, nlp::Problem& problem, const nlp::Start& users_point,
                       const nlp::Options& options)
    : name_(std::move(name)),
      point_(from_user(users_point, problem.structure())),
      system_(problem) {
  const std::string where = name_ + ": sensitivities";
  if (!nlp::check(problem, point_, options).solved(options))
    throw InvalidValue(where, "an answer to other numbers than the problem's",
                       "the problem as it was solved");
  switch (system_.factorize(point_, options)) {
    case nlp::Regularity::regular:
      return;
    case nlp::Regularity::invalid_number:
      throw InvalidValue(
          where, "NaN or infinity in " + system_.fault().function + " at " + system_.fault().where,
          "finite second derivatives");
    case nlp::Regularity::irregular:
      const std::string what = system_.undetermined();
      throw InvalidValue(
          where, "a singular KKT matrix" + (what.empty() ? "" : ", least determined at " + what),
          "a strict minimum: a cost that determines each variable, and rows that do not depend on "
          "each other");
  }
}

nlp::Sensitivity Factorised::solve(const std::string& number, const nlp::Dependence& dependence) {
  nlp::Sensitivity rate;
  if (!system_.solve(dependence, rate))
    throw InvalidValue(name_ + ": sensitivity to " + number,
                       "derivatives by it that are not finite, or a KKT matrix that is singular "
                       "but for rounding",
                       "a regular problem");
  return rate;
}

nlp::Start Factorised::moved(const nlp::Start& change, const nlp::Limits& limits) const {
  nlp::Start point = point_;
  for (std::size_t i = 0; i < point.x.size(); ++i) {
    point.x[i] = limits.xl[i] == limits.xu[i] ? limits.xl[i] : point.x[i] + change.x[i];
    point.zl[i] = std::max(point.zl[i] + change.zl[i], 0.0);
    point.zu[i] = std::max(point.zu[i] + change.zu[i], 0.0);
  }
  for (std::size_t r = 0; r < point.y.size(); ++r) point.y[r] += change.y[r];
  return point;
}

AnsweredPhase::AnsweredPhase(const Problem& problem, Transcription& transcription,
                             const nlp::Start& point)
    : problem_(problem),
      transcription_(transcription),
      slopes_(data(), point.x, point.y),
      numbers_(ocp::numbers(problem)) {
  nlp::Evaluation at;
  (void)transcription.evaluate(point.x, 1, {}, {.values = true, .derivatives = true}, at);
  gradient_ = std::move(at.gradient);
}

Direction AnsweredPhase::direction(const Number& number) const {
  return direction_of(problem_, data(), number);
}

Direction AnsweredPhase::rest() const {
  Direction none;
  for (const auto& batch : data().batches) none.data.emplace_back(batch.data().size(), 0.0);
  none.limits = nlp::no_dependence(data().structure).limits;
  return none;
}

nlp::Dependence AnsweredPhase::dependence(const Direction& direction) const {
  return slopes_.dependence(direction);
}

Sensitivity AnsweredPhase::describe(const std::string& number, const nlp::Start& rate,
                                    const Direction& direction,
                                    const nlp::Dependence& dependence) const {
  Sensitivity s;
  s.number = number;
  s.objective = dependence.objective;
  for (std::size_t i = 0; i < gradient_.size(); ++i) s.objective += gradient_[i] * rate.x[i];
  s.trajectory = trajectory_rate(problem_, data(), slopes_, rate.x, direction);
  s.multipliers = transcription_.multipliers(rate);
  s.point = to_user(rate, transcription_.structure());
  s.state_names = names_of(problem_.states());
  s.control_names = names_of(problem_.controls());
  s.static_parameter_names = names_of(problem_.static_parameters());
  s.slack_names = names_of(problem_.slacks());
  s.integral_names = names_of(problem_.integrals());
  return s;
}

}  // namespace slalom::ocp
