// Options in the words of Ipopt and KNITRO, for their libraries and executables alike.

#include <algorithm>

#include "backends.hpp"

namespace slalom::nlp {

NativeOptions ipopt_options(const Options& options) {
  NativeOptions list{{"print_level", options.print_level},
                     {"max_iter", options.max_iterations},
                     {"bound_relax_factor", 0.0},
                     {"acceptable_iter", 0}};  // no early stop
  const auto add = [&](const char* name, auto value) { list.emplace_back(name, value); };
  if (options.floor > 0) {
    // Section 3 of docs/formulation.md: stop at the central point of the floor.
    add("nlp_scaling_method", "none");
    add("mu_target", options.floor);
    add("mu_init", options.floor);
    add("kappa_d", 0.0);
    add("tol", 1e-6);
    add("dual_inf_tol", options.dual_tol);
    add("constr_viol_tol", options.constraint_tol);
    add("compl_inf_tol", options.floor_tol * options.floor);
  } else {
    add("tol", options.tol);
    if (options.warm_start) add("mu_init", std::max(options.tol, 1e-4));
  }
  if (options.warm_start) {
    add("warm_start_init_point", "yes");
    for (const char* name :
         {"warm_start_bound_push", "warm_start_bound_frac", "warm_start_slack_bound_push",
          "warm_start_slack_bound_frac", "warm_start_mult_bound_push"})
      add(name, 1e-6);
  }
  return list;
}

/// Knitro User's Manual, "User options".
NativeOptions knitro_options(const Options& options) {
  NativeOptions list{{"outlev", options.print_level},
                     {"maxit", options.max_iterations},
                     {"opttol", options.tol},
                     {"feastol", options.constraint_tol}};
  if (options.warm_start) list.emplace_back("strat_warm_start", 1);
  return list;
}

}  // namespace slalom::nlp
