#include "slalom/ocp/transcription.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "between_points.hpp"
#include "builder.hpp"
#include "carry.hpp"
#include "checks.hpp"
#include "constant_rows.hpp"
#include "duals.hpp"
#include "point_functions.hpp"
#include "set_up_watch.hpp"
#include "slalom/base/error.hpp"
#include "slalom/ocp/guess.hpp"
#include "stored_trajectory.hpp"
#include "symbols.hpp"

namespace slalom::ocp {
namespace {

/// Throws unless `now` is `before` with other numbers.
void check_same(const Problem& before, const Problem& now) {
  const auto sizes = [](const Problem& p) {
    return std::array{p.states().size(), p.controls().size(),   p.static_parameters().size(),
                      p.slacks().size(), p.integrals().size(),  p.parameters().size(),
                      p.costs().size(),  p.constraints().size()};
  };
  if (now.name() != before.name() || sizes(now) != sizes(before))
    throw InvalidValue(before.name() + ": update", "another problem " + now.name(),
                       "the problem that was transcribed");
  const auto check_switch = [&](const auto& old_list, const auto& new_list) {
    for (std::size_t i = 0; i < old_list.size(); ++i)
      if (old_list[i].enabled != new_list[i].enabled)
        throw InvalidValue(before.name(), new_list[i].name + " switched",
                           "the constraints and cost terms that were transcribed; another choice "
                           "needs a new transcription");
  };
  if (is_fixed(before.t0()) != is_fixed(now.t0()) || is_fixed(before.tf()) != is_fixed(now.tf()))
    throw InvalidValue(before.name(), "t0 or tf fixed or freed",
                       "the same as when it was transcribed; else a new transcription");
  const auto same_soft = [](const std::optional<Soft>& a, const std::optional<Soft>& b) {
    return a.has_value() == b.has_value() &&
           (!a || (a->norm == b->norm && a->tolerance == b->tolerance));
  };
  for (std::size_t i = 0; i < now.constraints().size(); ++i)
    if (!same_soft(before.constraints()[i].soft, now.constraints()[i].soft))
      throw InvalidValue(before.name(), now.constraints()[i].name + " softened otherwise",
                         "the norm and tolerance that were transcribed; else a new transcription");
  for (std::size_t i = 0; i < now.constraints().size(); ++i) {
    const Bounds was = before.constraints()[i].bounds;
    const Bounds is = now.constraints()[i].bounds;
    if (was.lower != is.lower || was.upper != is.upper)
      throw InvalidValue(before.name(), "other bounds of " + now.constraints()[i].name,
                         "those that were transcribed; else a new transcription");
  }
  if (now.moments() != before.moments())
    throw InvalidValue(before.name(), "another moment of a row or a cost term",
                       "those that were transcribed; else a new transcription");
  check_switch(before.constraints(), now.constraints());
  check_switch(before.costs(), now.costs());
}

/// The states at compressed midpoints: Hermite's interpolant of the ends.
void fill_midpoints(const Problem& problem, const Layout& layout, Trajectory& trajectory) {
  const PointFunctions functions(problem, trajectory);
  const std::size_t nx = problem.states().size();
  std::vector<double> at_begin(nx), at_end(nx);
  for (std::size_t point = 0; point < layout.points(); ++point) {
    if (layout.has_state(point)) continue;
    const std::size_t begin = point - 1, end = point + 1;
    const auto controls_at_end = end_controls(problem, trajectory, begin, end);
    functions.rates(trajectory.time(begin), trajectory.states[begin], trajectory.controls[begin],
                    at_begin);
    functions.rates(trajectory.time(end), trajectory.states[end], controls_at_end, at_end);
    const double h = trajectory.time(end) - trajectory.time(begin);
    for (std::size_t i = 0; i < nx; ++i)
      trajectory.states[point][i] = (trajectory.states[begin][i] + trajectory.states[end][i]) / 2 +
                                    h / 8 * (at_begin[i] - at_end[i]);
  }
}

}  // namespace

class Transcription::Impl {
 public:
  Impl(const ocp::Problem& p, const Mesh& mesh, const Schemes& s)
      : problem(p), schemes(s), symbols(problem), data(transcribe(p, mesh, schemes)) {
    check_times(problem);
    SetUpWatch::ask_now();
    check_rows(problem, data);
    terms.resize(data.terms.size());
    constant_rows.emplace(data.structure);
  }

  void sum_values(std::span<const double> x, nlp::Evaluation& out) {
    out.rows.resize(data.structure.rows);
    std::fill(terms.begin(), terms.end(), 0.0);
    for (const auto& batch : data.batches) {
      batch.to_rows.scatter(batch.evaluator->values(), out.rows);
      batch.to_terms.scatter(batch.evaluator->values(), terms);
    }
    data.linear.scatter(x, out.rows);
    out.objective = 0;
    for (double term : terms) out.objective += term;
  }
  void sum_derivatives(nlp::Evaluation& out) const {
    out.gradient.assign(data.structure.variables, 0.0);
    out.jacobian.resize(data.structure.jacobian_row.size());
    for (const auto& batch : data.batches) {
      batch.to_jacobian.scatter(batch.evaluator->jacobian(), out.jacobian);
      batch.to_gradient.scatter(batch.evaluator->jacobian(), out.gradient);
    }
    const double one = 1;
    data.linear_jacobian.scatter({&one, 1}, out.jacobian);
  }
  void sum_hessian(nlp::Evaluation& out) const {
    out.hessian.resize(data.structure.hessian_row.size());
    for (const auto& batch : data.batches)
      batch.to_hessian.scatter(batch.evaluator->hessian(), out.hessian);
  }

  static bool finite(nlp::Parts parts, const nlp::Evaluation& out) {
    const auto all = [](const std::vector<double>& list) {
      return lane_kernels().all_finite(list.data(), list.size());
    };
    return (!parts.values || (std::isfinite(out.objective) && all(out.rows))) &&
           (!parts.derivatives || (all(out.gradient) && all(out.jacobian))) &&
           (!parts.hessian || all(out.hessian));
  }
  nlp::Fault find_fault(nlp::Parts parts) const {
    for (const auto& batch : data.batches)
      if (const auto bad = batch.find_bad_number(parts); bad.found) return fault_of(batch, bad);
    return {"a sum of finite terms", "the whole problem", ""};
  }

  nlp::Fault fault_of(const Batch& batch, const Batch::BadNumber& bad) const {
    std::string function = batch.outputs[bad.output];
    const std::size_t family =
        data.batch_data[static_cast<std::size_t>(&batch - data.batches.data())].family;
    if (family != kNone) {
      const auto& members = problem.constraints()[family].members;
      function += "[" + members[batch.lane_member[bad.lane]] + "]";
    }
    return {function, data.layout.point_name(batch.lane_point[bad.lane]), bad.variable};
  }

  ocp::Problem problem;
  Schemes schemes;
  Symbols symbols;  ///< of `problem`
  Transcribed data;
  std::vector<double> terms;
  std::optional<ConstantRows> constant_rows;
  nlp::Limits whole;  ///< before rows were relaxed, which other numbers may not leave constant
};

Transcription::Transcription(const ocp::Problem& problem, const Mesh& mesh, const Schemes& schemes)
    : impl_(std::make_unique<Impl>(problem, mesh, schemes)) {
  SetUpWatch::ask_now();
  impl_->whole = impl_->data.limits;
  relax_constant_rows();
}
Transcription::~Transcription() = default;

void Transcription::relax_constant_rows() {
  const auto rows = [this](const std::vector<double>& x) {
    nlp::Evaluation at;
    (void)evaluate(x, 1, {}, {.values = true}, at);  // others may be undefined there
    return at.rows;
  };
  impl_->constant_rows->relax(rows, impl_->data.limits);
}

void Transcription::update(const ocp::Problem& problem) {
  check_same(impl_->problem, problem);
  check_times(problem);
  if (impl_->problem.runs_forward() && !problem.runs_forward())
    throw InvalidValue(
        problem.name(), "t0 that may be later than the least tf",
        "t0 at most the least tf, as when it was transcribed; else a new transcription");
  for (const auto& data : impl_->data.batch_data) {
    if (data.family == kNone) continue;
    const auto& now = problem.constraints().at(data.family).members;
    if (now.size() != impl_->problem.constraints()[data.family].members.size())
      throw InvalidValue(problem.name() + ": family " + problem.constraints()[data.family].name,
                         std::to_string(now.size()) + " members",
                         "as many as were transcribed; another number needs a new transcription");
  }
  fill_data(problem, impl_->data, &impl_->problem);
  impl_->problem = problem;
  impl_->data.limits = impl_->whole;
  fill_limits(problem, impl_->data);
  relax_constant_rows();
}

std::vector<double> Transcription::point(const Trajectory& guess) const {
  const Layout& layout = impl_->data.layout;
  const auto& problem = impl_->problem;
  check_guess(guess, problem);
  const auto& scale = impl_->data.structure.variable_scale;
  std::vector<double> x(layout.variables, 0.0);
  for (std::size_t point = 0; point < layout.points(); ++point) {
    SetUpWatch::poll();
    for (std::size_t i = 0; i < layout.nx && layout.has_state(point); ++i)
      x[layout.state(point, i)] = between_points(guess.tau, guess.states, i, layout.tau[point]);
    for (std::size_t i = 0; i < layout.nu; ++i)
      x[layout.control(point, i)] = between_points(guess.tau, guess.controls, i, layout.tau[point]);
  }
  for (std::size_t i = 0; i < layout.slack.size(); ++i)
    x[layout.slack[i]] = i < guess.slacks.size() ? guess.slacks[i] : problem.slacks()[i].guess;
  x[layout.t0] = guess.t0;
  x[layout.tf] = guess.tf;
  for (std::size_t i = 0; i < problem.static_parameters().size(); ++i)
    x[layout.static_parameters + i] = i < guess.static_parameters.size()
                                          ? guess.static_parameters[i]
                                          : problem.static_parameters()[i].guess;
  for (std::size_t i = 0; i < guess.integrals.size() && i < problem.integrals().size(); ++i)
    x[layout.integrals + i] = guess.integrals[i];
  for (std::size_t i = 0; i < layout.nx; ++i) {
    if (layout.lifted_initial[i] != kNone) x[layout.lifted_initial[i]] = x[layout.state(0, i)];
    if (layout.lifted_final[i] != kNone)
      x[layout.lifted_final[i]] = x[layout.state(layout.points() - 1, i)];
  }
  for (std::size_t i = 0; i < x.size(); ++i) x[i] /= scale[i];
  return x;
}

Trajectory Transcription::straight_guess() const {
  return ocp::straight_guess(impl_->problem);
}

Trajectory Transcription::trajectory(std::span<const double> x) const {
  const Layout& layout = impl_->data.layout;
  Trajectory result = stored_trajectory(impl_->problem, impl_->data, x);
  if (layout.state_points.size() < layout.points()) fill_midpoints(impl_->problem, layout, result);
  return result;
}

std::vector<std::pair<std::string, double>> Transcription::cost_terms(std::span<const double> x) {
  nlp::Evaluation at;
  evaluate(x, 1, {}, {.values = true}, at);
  return last_cost_terms();
}

std::vector<std::pair<std::string, double>> Transcription::last_cost_terms() const {
  std::vector<std::pair<std::string, double>> result;
  for (std::size_t i = 0; i < impl_->terms.size(); ++i)
    result.emplace_back(impl_->data.terms[i], impl_->terms[i]);
  return result;
}

std::vector<std::vector<double>> Transcription::costates(std::span<const double> x,
                                                         std::span<const double> y) {
  nlp::Evaluation at;
  evaluate(x, 1, {}, {.values = true, .derivatives = true}, at);
  return ocp::costates(impl_->data, y, at);
}

CollocatedCostates Transcription::collocated_costates(std::span<const double> y) const {
  return ocp::collocated_costates(impl_->data, impl_->schemes, y);
}

nlp::Start Transcription::carried(const Trajectory& guess, const Duals& duals) {
  const Transcribed& data = impl_->data;
  nlp::Start start;
  start.x = point(guess);
  nlp::Evaluation at;
  evaluate(start.x, 1, {}, {.values = true}, at);
  for (const Excess& excess : data.excesses) {
    const double value = at.rows[excess.row], unit = 1 / data.structure.row_scale[excess.row];
    const auto set = [&](std::size_t variable, double beyond) {
      if (variable != kNone)
        start.x[variable] = beyond * unit / data.structure.variable_scale[variable];
    };
    const double above = value - data.limits.gu[excess.row];
    const double below = data.limits.gl[excess.row] - value;
    const bool both_signs = excess.below == kNone && data.limits.xl[excess.above] < 0;
    set(excess.above, both_signs && below > 0 ? -below : std::max(above, 0.0));
    set(excess.below, std::max(below, 0.0));
  }
  carry_multipliers(impl_->problem, data, impl_->schemes, duals, start);
  evaluate(start.x, 1, {}, {.values = true, .derivatives = true}, at);
  settle_dependents(data, at, start);
  return start;
}

std::vector<Multipliers> Transcription::multipliers(const nlp::Start& point) const {
  return ocp::multipliers(impl_->problem, impl_->data, point);
}

std::vector<Excesses> Transcription::excesses(std::span<const double> x) const {
  return ocp::excesses(impl_->problem, impl_->data, x);
}

std::size_t Transcription::defect_row(std::size_t state, std::size_t interval) const {
  std::size_t row = kNone;
  for (std::size_t d = 0;
       d * impl_->data.layout.nx * impl_->data.layout.intervals() < impl_->data.defect_rows.size();
       ++d)
    if (const auto next = ocp::defect_row(impl_->data, d, state, interval); next != kNone)
      row = next;
  return row;
}

std::vector<char> Transcription::regular_variables() const {
  std::vector<char> regular(impl_->data.layout.variables, 1);
  for (const Excess& excess : impl_->data.excesses)
    for (const std::size_t variable : {excess.above, excess.below})
      if (variable != kNone) regular[variable] = 0;
  return regular;
}

std::optional<std::size_t> Transcription::end_variable(const Expr& symbol) const {
  const Layout& layout = impl_->data.layout;
  const Meaning* meaning = impl_->symbols.find(symbol);
  if (meaning == nullptr) return std::nullopt;
  using Kind = Meaning::Kind;
  switch (meaning->kind) {
    case Kind::initial:
      return layout.state(0, meaning->index);
    case Kind::final:
      return layout.state(layout.points() - 1, meaning->index);
    case Kind::t0:
      return layout.t0;
    case Kind::tf:
      return layout.tf;
    case Kind::static_parameter:
      return layout.static_parameters + meaning->index;
    case Kind::integral:
      return layout.integrals + meaning->index;
    default:
      return std::nullopt;
  }
}

const Transcribed& transcribed_by(const Transcription& transcription) {
  return transcription.impl_->data;
}

const nlp::Structure& Transcription::structure() const {
  return impl_->data.structure;
}
const nlp::Limits& Transcription::limits() const {
  return impl_->data.limits;
}

nlp::Fault Transcription::evaluate(std::span<const double> x, double sigma,
                                   std::span<const double> y, nlp::Parts parts,
                                   nlp::Evaluation& out) {
  for (auto& batch : impl_->data.batches) {
    batch.load(x);
    if (parts.hessian) batch.set_weights(sigma, y);
    batch.run(parts);
  }
  if (parts.values) impl_->sum_values(x, out);
  if (parts.derivatives) impl_->sum_derivatives(out);
  if (parts.hessian) impl_->sum_hessian(out);
  return Impl::finite(parts, out) ? nlp::Fault{} : impl_->find_fault(parts);
}

std::string Transcription::variable_name(std::size_t index) const {
  for (const Excess& excess : impl_->data.excesses)
    if (excess.above == index || excess.below == index) return "excess of " + row_name(excess.row);
  return ocp::variable_name(impl_->problem, impl_->data.layout, index);
}

std::string Transcription::row_name(std::size_t index) const {
  return impl_->data.row_names.at(index).in(impl_->problem);
}

std::optional<nlp::Formulas> Transcription::formulas() const {
  return ocp::formulas(impl_->data);
}

}  // namespace slalom::ocp
