#include "objective_scale.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace slalom::ocp {
namespace {

constexpr double kStep = 0.5;
/// Times the largest slope at the start: an answer with a smaller one is solved again.
constexpr double kLeastSlope = 1e-2;
/// Slopes beside the objective itself, by variables in units of their scales, that are rounding.
constexpr double kRounding = 1e-14;

/// A problem with `factor` times its objective.
class Multiplied final : public nlp::Problem {
 public:
  Multiplied(nlp::Problem& problem, double factor) : problem_(problem), factor_(factor) {}

  /// The problem's own, so that a solver keeps its workspace from solve to solve.
  const nlp::Structure& structure() const override { return problem_.structure(); }
  const nlp::Limits& limits() const override { return problem_.limits(); }
  nlp::Fault evaluate(std::span<const double> x, double sigma, std::span<const double> y,
                      nlp::Parts parts, nlp::Evaluation& out) override {
    auto fault = problem_.evaluate(x, factor_ * sigma, y, parts, out);
    if (parts.values) out.objective *= factor_;
    if (parts.derivatives)
      for (double& slope : out.gradient) slope *= factor_;
    return fault;
  }
  std::string variable_name(std::size_t index) const override {
    return problem_.variable_name(index);
  }
  std::string row_name(std::size_t index) const override { return problem_.row_name(index); }
  std::optional<nlp::Formulas> formulas() const override {
    auto formulas = problem_.formulas();
    if (formulas) formulas->objective = factor_ * formulas->objective;
    return formulas;
  }

 private:
  nlp::Problem& problem_;
  double factor_;
};

/// A point of a problem as one of that with `factor` times its objective.
nlp::Start scaled(nlp::Start point, double factor) {
  for (auto* duals : {&point.y, &point.zl, &point.zu})
    for (double& dual : *duals) dual *= factor;
  return point;
}

/// Largest slope at x by one of the variables that `measured` counts; 0 where there is none, where
/// it is no more than rounding of the objective (of one that is constant, such as v² cos² + v²
/// sin²), or where a function is not finite.
double slope_at(nlp::Problem& problem, const std::vector<double>& x,
                const std::vector<char>& measured) {
  nlp::Evaluation at;
  if (problem.evaluate(x, 1, {}, {.values = true, .derivatives = true}, at)) return 0;
  double most = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (measured[i]) most = std::max(most, std::fabs(at.gradient[i]));
  // 1 / most is to be a factor: neither infinite nor 0.
  return std::isfinite(most) && std::isfinite(1 / most) &&
                 most > kRounding * std::fabs(at.objective)
             ? most
             : 0;
}

/// x with every variable moved up by half its scale, or down where its bound is nearer: where a
/// square of something that is 0 in the guess has a slope.
std::vector<double> beside(const nlp::Problem& problem, std::vector<double> x) {
  const auto& [xl, xu, gl, gu] = problem.limits();
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = x[i] + kStep <= xu[i] ? x[i] + kStep : std::max(x[i] - kStep, std::min(xl[i], x[i]));
  return x;
}

nlp::Answer solve_times(nlp::Problem& problem, double factor, nlp::Solver& solver,
                        const nlp::Start& start, const nlp::Options& options) {
  if (factor == 1) return solver.solve(problem, start, options);
  Multiplied multiplied(problem, factor);
  nlp::Answer answer = solver.solve(multiplied, scaled(start, factor), options);
  answer.objective /= factor;
  // An infeasible problem's multipliers are of its violation.
  if (answer.status != nlp::Status::infeasible && answer.status != nlp::Status::too_few_freedoms)
    answer.point = scaled(std::move(answer.point), 1 / factor);
  return answer;
}

}  // namespace

nlp::Answer solve_scaled(nlp::Problem& problem, nlp::Solver& solver, const nlp::Start& start,
                         const nlp::Options& options, const std::vector<char>& measured) {
  if (options.floor > 0) return solver.solve(problem, start, options);
  const double slope = std::max(slope_at(problem, start.x, measured),
                                slope_at(problem, beside(problem, start.x), measured));
  nlp::Answer answer = solve_times(problem, slope > 0 ? 1 / slope : 1, solver, start, options);
  if (answer.status != nlp::Status::solved) return answer;
  const double at_answer = slope_at(problem, answer.point.x, measured);
  if (at_answer == 0 || at_answer >= kLeastSlope * slope) return answer;
  // Both solves together have what the options allow.
  nlp::Options warm = options;
  warm.warm_start = true;
  warm.max_iterations -= answer.iterations;
  warm.time_limit = std::max(0.0, options.time_limit - (answer.cpu_s - answer.callback_s));
  if (warm.max_iterations <= 0 || warm.time_limit <= 0) return answer;
  nlp::Answer again = solve_times(problem, 1 / at_answer, solver, answer.point, warm);
  nlp::Answer& better = again.status == nlp::Status::solved ? again : answer;
  better.iterations = answer.iterations + again.iterations;
  better.cpu_s = answer.cpu_s + again.cpu_s;
  better.wall_s = answer.wall_s + again.wall_s;
  better.callback_s = answer.callback_s + again.callback_s;
  return std::move(better);
}

}  // namespace slalom::ocp
