#include "iteration_log.hpp"

#include <cstdio>

namespace slalom::nlp::ipm {

IterationInfo iteration_info(const Descent& d, int iteration, bool restoration) {
  IterationInfo info;
  const auto& kernels = vector_kernels();
  info.iteration = iteration;
  info.restoration = restoration;
  info.objective = d.point().functions().objective / d.form().objective_scale();
  info.violation = kernels.largest_magnitude(d.form().rows(), d.point().residuals().data());
  info.dual = d.survey().dual;
  info.mu = d.barrier().mu();
  info.step = kernels.largest_magnitude(d.form().primal(), d.step().w.data());
  info.delta_w = d.newton().regularisation();
  info.delta_c = d.newton().row_regularisation();
  info.alpha_primal = d.last().alpha;
  info.alpha_dual = d.last().alpha_dual;
  info.trials = d.last().trials;
  return info;
}

void print(const IterationInfo& info) {
  if (info.iteration % 20 == 1)
    std::printf(
        "iter      objective  violation       dual  lg(mu)     |step|  delta_w  delta_c "
        "alpha_d  alpha_p  ls\n");
  std::printf("%4d%c %14.7e %10.2e %10.2e %10.2e %10.2e %8.1e %8.1e %8.2e %8.2e %3d\n",
              info.iteration, info.restoration ? 'r' : ' ', info.objective, info.violation,
              info.dual, info.mu, info.step, info.delta_w, info.delta_c, info.alpha_dual,
              info.alpha_primal, info.trials);
}

const char* reason(Status status) {
  switch (status) {
    case Status::solved:
      return "the tolerances are met";
    case Status::iteration_limit:
      return "max_iterations reached";
    case Status::time_limit:
      return "no step more fits into the time limit";
    case Status::infeasible:
      return "the violation is least here, and not zero";
    case Status::unbounded:
      return "variables beyond 1e20";
    case Status::invalid_number:
      return "a function gave a number that is not finite";
    case Status::too_few_freedoms:
      return "more equations than free variables";
    case Status::interrupted:
      return "the stop callback asked for it";
    case Status::numerical_failure:
      return "no direction or no step that makes progress";
  }
  return "";
}

}  // namespace slalom::nlp::ipm
