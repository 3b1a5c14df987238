#include "slalom/ocp/sensitivity.hpp"

#include <utility>

#include "factorised.hpp"
#include "lookup.hpp"
#include "solved.hpp"
#include "tables.hpp"

namespace slalom::ocp {

std::vector<double> Sensitivity::state(const std::string& name) const {
  return column(trajectory.states, index_of(name, state_names, "state"));
}
std::vector<double> Sensitivity::control(const std::string& name) const {
  return column(trajectory.controls, index_of(name, control_names, "control"));
}
double Sensitivity::static_parameter(const std::string& name) const {
  return trajectory.static_parameters[index_of(name, static_parameter_names, "static parameter")];
}
double Sensitivity::slack(const std::string& name) const {
  return trajectory.slacks[index_of(name, slack_names, "slack")];
}
double Sensitivity::integral(const std::string& name) const {
  return trajectory.integrals[index_of(name, integral_names, "integral")];
}
const Multipliers& Sensitivity::multiplier(const std::string& name) const {
  return multipliers[index_of(name, names_of(multipliers), "multiplier")];
}

std::vector<std::pair<std::string, double>> sensitivity_numbers(const Problem& problem) {
  std::vector<std::pair<std::string, double>> list;
  for (const Number& number : numbers(problem)) list.emplace_back(number.name, number.value);
  return list;
}

namespace {

Problem answered(const Problem& problem, const Solution& solution) {
  check_solved(problem.name(), solution);
  if (solution.point.x.empty())
    throw InvalidValue(problem.name() + ": sensitivities", "one phase of an answer in several",
                       "the whole answer");
  return with_scales_of(solution, problem);
}

}  // namespace

class Sensitivities::Impl {
 public:
  Impl(const Problem& problem, const Solution& solution)
      : known_(solution),
        problem_(answered(problem, solution)),
        transcription_(problem_, solution.mesh, solution.scheme),
        factorised_(problem.name(), transcription_, solution.point, solution.options),
        phase_(problem_, transcription_, factorised_.point()) {}

  Sensitivity operator()(const std::string& name) {
    const auto& numbers = phase_.numbers();
    const Number& number =
        numbers[number_named(problem_.name() + ": sensitivities", name, names_of(numbers))];
    const Direction direction = phase_.direction(number);
    const auto dependence = phase_.dependence(direction);
    return phase_.describe(name, factorised_.solve(name, dependence).point, direction, dependence);
  }

  Solution predict(const Problem& changed) {
    const Problem now = scaled_by(all_scales(problem_), changed);
    if (!moved_) moved_ = std::make_unique<Transcription>(problem_, known_.mesh, known_.scheme);
    moved_->update(now);
    const Direction direction =
        direction_between(transcribed_by(transcription_), transcribed_by(*moved_));
    const auto change = factorised_.solve("other numbers", phase_.dependence(direction)).point;
    const nlp::Start point = factorised_.moved(change, moved_->limits());
    Solution s;
    judge_prediction(*moved_, point, known_.options, s);
    describe(now, {known_.mesh, known_.scheme}, Tables(now), *moved_, point, s);
    return s;
  }

 private:
  const Solution known_;
  const Problem problem_;
  Transcription transcription_;
  Factorised factorised_;
  AnsweredPhase phase_;
  std::unique_ptr<Transcription> moved_;  ///< with the numbers of the last prediction
};

Sensitivities::Sensitivities(const Problem& problem, const Solution& solution)
    : impl_(std::make_unique<Impl>(problem, solution)) {}
Sensitivities::~Sensitivities() = default;
Sensitivities::Sensitivities(Sensitivities&&) noexcept = default;
Sensitivities& Sensitivities::operator=(Sensitivities&&) noexcept = default;
Sensitivity Sensitivities::operator()(const std::string& number) const {
  return (*impl_)(number);
}
Solution Sensitivities::predict(const Problem& changed) const {
  return impl_->predict(changed);
}

Problem with_numbers(Problem problem, const std::vector<std::pair<std::string, double>>& changes) {
  for (const auto& [name, value] : changes) {
    const auto all = numbers(problem);
    set_number(all[number_named(problem.name() + ": numbers", name, names_of(all))], value,
               problem);
  }
  return problem;
}

}  // namespace slalom::ocp
