#include <algorithm>
#include <deque>
#include <utility>

#include "factorised.hpp"
#include "slalom/ocp/sensitivity.hpp"
#include "solved.hpp"

namespace slalom::ocp {
namespace {

/// A number of a phased problem: of one phase, of several, or the bound of a link.
struct PhasedNumber {
  std::string name;
  double value = 0;
  std::vector<std::pair<std::size_t, Number>> of_phases;
  std::size_t link = kNone;
  Number::Side side = Number::Side::both;
};

void add_link(std::size_t index, const PhasedProblem::Link& link, std::vector<PhasedNumber>& list) {
  using Side = Number::Side;
  const auto [lower, upper] = link.bounds;
  if (lower == upper) {
    list.push_back({link.name, lower, {}, index, Side::both});
    return;
  }
  if (lower > -kInfinity) list.push_back({"lower " + link.name, lower, {}, index, Side::lower});
  if (upper < kInfinity) list.push_back({"upper " + link.name, upper, {}, index, Side::upper});
}

std::vector<PhasedNumber> phased_numbers(const PhasedProblem& problem) {
  std::vector<PhasedNumber> common, list;
  for (std::size_t p = 0; p < problem.phases().size(); ++p)
    for (auto& number : numbers(problem.phases()[p])) {
      if (number.kind == Number::Kind::parameter) {
        const auto same = std::find_if(common.begin(), common.end(),
                                       [&](const auto& each) { return each.name == number.name; });
        if (same == common.end())
          common.push_back({number.name, number.value, {{p, number}}});
        else
          same->of_phases.emplace_back(p, number);
      }
      list.push_back(
          {problem.phases()[p].name() + ": " + number.name, number.value, {{p, number}}});
    }
  for (std::size_t l = 0; l < problem.links().size(); ++l) add_link(l, problem.links()[l], list);
  common.insert(common.end(), list.begin(), list.end());
  return common;
}

PhasedProblem with_scales_of(const PhasedSolution& solution, PhasedProblem problem) {
  for (std::size_t p = 0; p < problem.phases().size(); ++p)
    problem.replace(p, with_scales_of(solution.phases[p], problem.phases()[p]));
  return problem;
}

std::vector<PhasedTranscription::Grid> grids_of(const PhasedSolution& solution) {
  std::vector<PhasedTranscription::Grid> grids;
  for (const auto& phase : solution.phases) grids.push_back({phase.mesh, phase.scheme});
  return grids;
}

void check_phases(const PhasedProblem& problem, const PhasedSolution& solution) {
  if (solution.phases.size() != problem.phases().size())
    throw InvalidValue(problem.name() + ": sensitivities",
                       std::to_string(solution.phases.size()) + " phases of an answer",
                       std::to_string(problem.phases().size()));
  check_solved(problem.name(), solution);
}

void append(const std::vector<double>& part, std::vector<double>& whole) {
  whole.insert(whole.end(), part.begin(), part.end());
}

}  // namespace

std::vector<std::pair<std::string, double>> sensitivity_numbers(const PhasedProblem& problem) {
  std::vector<std::pair<std::string, double>> list;
  for (const auto& number : phased_numbers(problem)) list.emplace_back(number.name, number.value);
  return list;
}

class PhasedSensitivities::Impl {
 public:
  Impl(const PhasedProblem& problem, const PhasedSolution& solution)
      : problem_((check_phases(problem, solution), with_scales_of(solution, problem))),
        grids_(grids_of(solution)),
        options_(solution.options),
        transcription_(problem_, grids_),
        factorised_(problem.name(), transcription_, solution.point, solution.options),
        numbers_(phased_numbers(problem_)) {
    for (std::size_t p = 0; p < problem_.phases().size(); ++p)
      phases_.emplace_back(problem_.phases()[p], transcription_.phase(p),
                           transcription_.part_of(p, factorised_.point()));
  }

  std::size_t phases() const { return phases_.size(); }
  std::size_t links() const { return problem_.links().size(); }

  PhasedSensitivity operator()(const std::string& name) {
    const auto& number =
        numbers_[number_named(problem_.name() + ": sensitivities", name, names_of(numbers_))];
    std::vector<Direction> directions;
    std::vector<nlp::Dependence> parts;
    for (std::size_t p = 0; p < phases_.size(); ++p) {
      const auto own = std::find_if(number.of_phases.begin(), number.of_phases.end(),
                                    [p](const auto& each) { return each.first == p; });
      directions.push_back(own == number.of_phases.end() ? phases_[p].rest()
                                                         : phases_[p].direction(own->second));
      parts.push_back(phases_[p].dependence(directions[p]));
    }
    const auto rate = factorised_.solve(name, joined(parts, number));
    PhasedSensitivity s;
    s.number = name;
    s.objective = rate.objective;
    for (std::size_t p = 0; p < phases_.size(); ++p)
      s.phases.push_back(phases_[p].describe(name, transcription_.part_of(p, rate.point),
                                             directions[p], parts[p]));
    const auto& row_scale = transcription_.structure().row_scale;
    for (std::size_t l = 0; l < problem_.links().size(); ++l) {
      const std::size_t row = transcription_.first_link() + l;
      s.link_multipliers.emplace_back(problem_.links()[l].name, rate.point.y[row] * row_scale[row]);
    }
    s.point = to_user(rate.point, transcription_.structure());
    return s;
  }

  PhasedSolution predict(const PhasedProblem& changed) {
    PhasedProblem now = changed;
    PhasedTranscription same(problem_, grids_);
    std::vector<nlp::Dependence> parts;
    for (std::size_t p = 0; p < phases_.size(); ++p) {
      now.replace(p, scaled_by(all_scales(problem_.phases()[p]), changed.phases().at(p)));
      same.phase(p).update(now.phases()[p]);
      const auto& before = transcribed_by(transcription_.phase(p));
      parts.push_back(
          phases_[p].dependence(direction_between(before, transcribed_by(same.phase(p)))));
    }
    PhasedTranscription moved(now, grids_);
    const auto change = factorised_.solve("other numbers", joined(parts, {})).point;
    const nlp::Start point = factorised_.moved(change, moved.limits());
    PhasedSolution s;
    judge_prediction(moved, point, options_, s);
    describe(now, grids_, moved, point, s);
    return s;
  }

 private:
  nlp::Dependence joined(const std::vector<nlp::Dependence>& parts,
                         const PhasedNumber& number) const {
    nlp::Dependence whole;
    for (const auto& part : parts) {
      whole.objective += part.objective;
      append(part.gradient, whole.gradient);
      append(part.rows, whole.rows);
      for (auto list : {&nlp::Limits::xl, &nlp::Limits::xu, &nlp::Limits::gl, &nlp::Limits::gu})
        append(part.limits.*list, whole.limits.*list);
    }
    const nlp::Structure& shape = transcription_.structure();
    for (auto* rows : {&whole.rows, &whole.limits.gl, &whole.limits.gu})
      rows->resize(shape.rows, 0.0);
    if (number.link == kNone) return whole;
    const std::size_t row = transcription_.first_link() + number.link;
    if (number.side != Number::Side::upper) whole.limits.gl[row] = shape.row_scale[row];
    if (number.side != Number::Side::lower) whole.limits.gu[row] = shape.row_scale[row];
    return whole;
  }

  const PhasedProblem problem_;
  const std::vector<PhasedTranscription::Grid> grids_;
  const nlp::Options options_;
  PhasedTranscription transcription_;
  Factorised factorised_;
  std::vector<PhasedNumber> numbers_;
  std::deque<AnsweredPhase> phases_;
};

PhasedSensitivities::PhasedSensitivities(const PhasedProblem& problem,
                                         const PhasedSolution& solution)
    : impl_(std::make_unique<Impl>(problem, solution)) {}
PhasedSensitivities::~PhasedSensitivities() = default;
PhasedSensitivities::PhasedSensitivities(PhasedSensitivities&&) noexcept = default;
PhasedSensitivities& PhasedSensitivities::operator=(PhasedSensitivities&&) noexcept = default;
PhasedSensitivity PhasedSensitivities::operator()(const std::string& number) const {
  return (*impl_)(number);
}
PhasedSolution PhasedSensitivities::predict(const PhasedProblem& changed) const {
  if (changed.phases().size() != impl_->phases() || changed.links().size() != impl_->links())
    throw InvalidValue(changed.name() + ": prediction", "other phases or links",
                       "the problem that was solved, with other numbers");
  return impl_->predict(changed);
}

PhasedProblem with_numbers(PhasedProblem problem,
                           const std::vector<std::pair<std::string, double>>& changes) {
  for (const auto& [name, value] : changes) {
    const auto all = phased_numbers(problem);
    const auto& number = all[number_named(problem.name() + ": numbers", name, names_of(all))];
    if (number.link != kNone)
      throw InvalidValue(problem.name() + ": " + name, "the bound of a link",
                         "a number of a phase");
    for (const auto& [phase, own] : number.of_phases) {
      Problem moved = problem.phases()[phase];
      set_number(own, value, moved);
      problem.replace(phase, std::move(moved));
    }
  }
  return problem;
}

}  // namespace slalom::ocp
