// The KNITRO back end, by its callable library (Artelys Knitro User's Manual, "Callable library API
// reference", 12 and later).

#include <knitro.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "backends.hpp"
#include "slalom/base/error.hpp"
#include "slalom/base/timer.hpp"

namespace slalom::nlp {
namespace {

/// Throws unless a call of the library during set-up succeeded.
void require(int code, const char* what) {
  if (code != 0)
    throw Error(std::string("KNITRO: ") + what + " failed with code " + std::to_string(code));
}

struct Free {
  void operator()(KN_context* context) const { KN_free(&context); }
};
using Context = std::unique_ptr<KN_context, Free>;

Context make_context() {
  KN_context* context = nullptr;
  const int code = KN_new(&context);
  if (code != 0 || context == nullptr)
    throw Error("KNITRO: no solver context (code " + std::to_string(code) +
                "); it needs a licence, see its manual");
  return Context(context);
}

/// A Problem as the library's callbacks see it.
struct Evaluated {
  Problem& problem;
  const Options& options;
  Timer timer = {};
  Evaluation at = {};
  Fault fault = {};
  Status stopped = Status::interrupted;

  /// False, with the fault noted, where a function is not finite.
  bool evaluate(const double* x, double sigma, const double* y, Parts parts) {
    const Structure& shape = problem.structure();
    const std::span<const double> duals =
        y == nullptr ? std::span<const double>() : std::span<const double>(y, shape.rows);
    fault = problem.evaluate({x, shape.variables}, sigma, duals, parts, at);
    return !fault;
  }
};

int functions(KN_context*, CB_context*, KN_eval_request* request, KN_eval_result* result,
              void* user) {
  auto& of = *static_cast<Evaluated*>(user);
  if (!of.evaluate(request->x, 1, nullptr, {.values = true})) return KN_RC_EVAL_ERR;
  *result->obj = of.at.objective;
  std::copy(of.at.rows.begin(), of.at.rows.end(), result->c);
  return 0;
}

int derivatives(KN_context*, CB_context*, KN_eval_request* request, KN_eval_result* result,
                void* user) {
  auto& of = *static_cast<Evaluated*>(user);
  if (!of.evaluate(request->x, 1, nullptr, {.values = true, .derivatives = true}))
    return KN_RC_EVAL_ERR;
  std::copy(of.at.gradient.begin(), of.at.gradient.end(), result->objGrad);
  std::copy(of.at.jacobian.begin(), of.at.jacobian.end(), result->jac);
  return 0;
}

int hessian(KN_context*, CB_context*, KN_eval_request* request, KN_eval_result* result,
            void* user) {
  auto& of = *static_cast<Evaluated*>(user);
  const double sigma = request->type == KN_RC_EVALH_NO_F ? 0 : *request->sigma;
  if (!of.evaluate(request->x, sigma, request->lambda, {.hessian = true})) return KN_RC_EVAL_ERR;
  std::copy(of.at.hessian.begin(), of.at.hessian.end(), result->hess);
  return 0;
}

int each_iteration(KN_context*, const double*, const double*, void* user) {
  auto& of = *static_cast<Evaluated*>(user);
  of.fault = {};  // one at a trial point that was stepped back from is forgiven
  if (of.timer.cpu() > of.options.time_limit)
    of.stopped = Status::time_limit;
  else if (of.options.stop != nullptr && of.options.stop(of.options.stop_data))
    of.stopped = Status::interrupted;
  else
    return 0;
  return KN_RC_USER_TERMINATION;
}

std::vector<int> as_int(const std::vector<std::uint32_t>& list) {
  return {list.begin(), list.end()};
}

/// The library's infinity for ours.
std::vector<double> limits_of(std::vector<double> list) {
  for (double& value : list) value = std::clamp(value, -KN_INFINITY, KN_INFINITY);
  return list;
}

void state_problem(KN_context* context, Evaluated& of) {
  const Structure& shape = of.problem.structure();
  const Limits& limits = of.problem.limits();
  require(KN_add_vars(context, static_cast<int>(shape.variables), nullptr), "KN_add_vars");
  require(KN_set_var_lobnds_all(context, limits_of(limits.xl).data()), "KN_set_var_lobnds_all");
  require(KN_set_var_upbnds_all(context, limits_of(limits.xu).data()), "KN_set_var_upbnds_all");
  if (shape.rows > 0) {
    require(KN_add_cons(context, static_cast<int>(shape.rows), nullptr), "KN_add_cons");
    require(KN_set_con_lobnds_all(context, limits_of(limits.gl).data()), "KN_set_con_lobnds_all");
    require(KN_set_con_upbnds_all(context, limits_of(limits.gu).data()), "KN_set_con_upbnds_all");
  }
  CB_context* callback = nullptr;
  require(KN_add_eval_callback_all(context, functions, &callback), "KN_add_eval_callback_all");
  const auto rows = as_int(shape.jacobian_row), cols = as_int(shape.jacobian_col);
  require(KN_set_cb_grad(context, callback, KN_DENSE, nullptr, static_cast<long long>(rows.size()),
                         rows.data(), cols.data(), derivatives),
          "KN_set_cb_grad");
  // The upper triangle is wanted: the lower one's columns are its rows.
  const auto first = as_int(shape.hessian_col), second = as_int(shape.hessian_row);
  require(KN_set_cb_hess(context, callback, static_cast<long long>(first.size()), first.data(),
                         second.data(), hessian),
          "KN_set_cb_hess");
  require(KN_set_cb_user_params(context, callback, &of), "KN_set_cb_user_params");
  require(KN_set_newpt_callback(context, each_iteration, &of), "KN_set_newpt_callback");
}

void state_start(KN_context* context, const Start& start, const Options& options) {
  require(KN_set_var_primal_init_values_all(context, start.x.data()),
          "KN_set_var_primal_init_values_all");
  if (!options.warm_start) return;
  if (!start.y.empty())
    require(KN_set_con_dual_init_values_all(context, start.y.data()),
            "KN_set_con_dual_init_values_all");
  std::vector<double> bounds(start.x.size());
  for (std::size_t i = 0; i < bounds.size(); ++i) bounds[i] = start.zu[i] - start.zl[i];
  require(KN_set_var_dual_init_values_all(context, bounds.data()),
          "KN_set_var_dual_init_values_all");
}

void state_options(KN_context* context, const Options& options) {
  for (const auto& [name, value] : knitro_options(options)) {
    if (const auto* count = std::get_if<int>(&value))
      require(KN_set_int_param_by_name(context, name.c_str(), *count), name.c_str());
    else if (const auto* number = std::get_if<double>(&value))
      require(KN_set_double_param_by_name(context, name.c_str(), *number), name.c_str());
  }
}

/// "Return codes" of the manual.
Status status_of(int code, const Evaluated& of) {
  if (code == KN_RC_USER_TERMINATION) return of.stopped;
  if (code == KN_RC_EVAL_ERR) return Status::invalid_number;
  if (code == 0) return Status::solved;
  if (code <= -200 && code > -300) return Status::infeasible;
  if (code <= -300 && code > -400) return Status::unbounded;
  if (code == KN_RC_TIME_LIMIT_FEAS || code == KN_RC_TIME_LIMIT_INFEAS) return Status::time_limit;
  if (code <= -400 && code > -500) return Status::iteration_limit;
  return Status::numerical_failure;
}

class KnitroSolver final : public Solver {
 public:
  void solve(Problem& problem, const Start& start, const Options& options,
             Answer& answer) override {
    check_sizes(start, problem.structure(), options.warm_start);
    check(options, "solver options");
    if (options.floor > 0)
      throw InvalidValue("solver options: floor", std::to_string(options.floor),
                         "0: KNITRO does not stop at a floor");
    Evaluated of{problem, options};
    const Context context = make_context();
    state_problem(context.get(), of);
    state_start(context.get(), start, options);
    state_options(context.get(), options);
    const int code = KN_solve(context.get());
    answer = {};
    read(context.get(), problem, answer);
    answer.status = status_of(code, of);
    if (answer.status == Status::invalid_number) answer.fault = of.fault;
    answer.backend = "knitro";
    answer.message = "KNITRO return code " + std::to_string(code);
    answer.cpu_s = of.timer.cpu();
    answer.wall_s = of.timer.wall();
    note_violation(problem, answer);
  }

 private:
  /// Multipliers of rows first, then of bounds: > 0 at upper ones, < 0 at lower ones.
  static void read(KN_context* context, const Problem& problem, Answer& answer) {
    const Structure& shape = problem.structure();
    std::vector<double> x(shape.variables), lambda(shape.rows + shape.variables);
    int status = 0;
    require(KN_get_solution(context, &status, &answer.objective, x.data(), lambda.data()),
            "KN_get_solution");
    require(KN_get_number_iters(context, &answer.iterations), "KN_get_number_iters");
    answer.point.x = std::move(x);
    const auto bounds = lambda.begin() + static_cast<std::ptrdiff_t>(shape.rows);
    answer.point.y.assign(lambda.begin(), bounds);
    for (auto z = bounds; z != lambda.end(); ++z) {
      answer.point.zl.push_back(std::max(-*z, 0.0));
      answer.point.zu.push_back(std::max(*z, 0.0));
    }
  }
};

}  // namespace

std::unique_ptr<Solver> make_knitro() {
  return std::make_unique<KnitroSolver>();
}

}  // namespace slalom::nlp
