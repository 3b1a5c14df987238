"""CasADi with its Ipopt on recorded cycles, from the same starts as ours.

    python peer_ipopt.py check                 the page's first OCPs (docs/formulation.md, section 6)
    python peer_ipopt.py prepare --environment E_C --dir DIR     generate and compile both forms
    python peer_ipopt.py run --environment E_C --dir DIR --mode vm|c --cycles FILE --level floor
           --start warm --out FILE --answers FILE [--first I --count N]     JSON into FILE
"""

import os
import sys
import time

import casadi as ca
import numpy as np

from compiled import compile_c
from cycles import (
    FORMS, CycleFile, Names, peer_arguments, split_multipliers, within,
    write_answer, write_results)  # fmt: skip
from levels import LEVELS, Level
from planner_casadi import Ocp, X, Y


def ipopt_options(level, warm):
    """At a floor as section 3 gives them; warm-start pushes small, so that the start is kept."""
    options = {
        "print_level": 0, "sb": "yes", "max_iter": 500, "linear_solver": "mumps",
        "bound_relax_factor": 0, "tol": level.tol, "acceptable_tol": level.tol,
        "dual_inf_tol": level.dual_tol, "constr_viol_tol": level.violation,
        "compl_inf_tol": level.complementarity,
    }  # fmt: skip
    if level.floor > 0:
        options |= {"nlp_scaling_method": "none", "kappa_d": 0, "mu_target": level.floor,
                    "mu_init": level.floor, "compl_inf_tol": level.complementarity * level.floor}  # fmt: skip
    else:
        options["mu_strategy"] = "adaptive"  # the fastest of the strategies and mu_init tried
    if warm:
        options["warm_start_init_point"] = "yes"
        for push in ("bound_push", "bound_frac", "slack_bound_push", "slack_bound_frac",
                     "mult_bound_push"):  # fmt: skip
            options["warm_start_" + push] = 1e-6
    return options


class Solver:
    """Cold and warm solves of one form; `source` is the NLP, or the path of its compiled C."""

    def __init__(self, ocp, level, source=None, more=None):
        self.ocp = ocp
        plain = {"print_time": False, "record_time": True, "calc_lam_p": False}
        began = time.perf_counter()
        self.solvers = []
        for warm in (False, True):
            options = ipopt_options(level, warm) | (more or {})
            options = plain | {"ipopt." + key: value for key, value in options.items()}
            self.solvers.append(ca.nlpsol("s", "ipopt", source or ocp.nlp, options))
        self.setup_s = (time.perf_counter() - began) / 2

    def solve(self, x, p, duals=None):
        """Answer and statistics; duals are lam_x, lam_g as CasADi has them."""
        ocp, solver = self.ocp, self.solvers[duals is not None]
        start = {} if duals is None else {"lam_x0": duals[0], "lam_g0": duals[1]}
        answer = solver(x0=x, p=p, lbx=ocp.lbx, ubx=ocp.ubx, lbg=ocp.lbg, ubg=ocp.ubg, **start)
        return {k: np.array(v).ravel() for k, v in answer.items()}, solver.stats()


def describe(stats):
    return {
        "claimed": bool(stats["success"]), "status": stats["return_status"],
        "iterations": int(stats["iter_count"]), "wall_s": stats["t_wall_total"],
        "cpu_s": stats["t_proc_total"],
        "functions_s": sum(v for k, v in stats.items() if k.startswith("t_wall_nlp_")),
    }  # fmt: skip


def check(_):
    """The first OCPs of section 6, in both ways of writing them."""
    expected = {("E_A", "P_B"): (271.6379, 2.515208, 196.49608, 53.46048),
                ("E_C", "P_D"): (909.7726, 4.179134, 7.68836, 88.55504)}  # fmt: skip
    floor = LEVELS["floor"]
    level = Level(0.8, floor.tol, floor.violation, floor.stationarity, floor.complementarity)
    worst = 0
    for (environment, planner), want in expected.items():
        for form in ("sx", "map"):
            ocp = Ocp(environment, planner, form=form)
            X0p = ocp.env["start"].copy()
            X0p[Y] = 8.5
            got, stats = Solver(ocp, level).solve(ocp.straight_on(X0p, 0.8), ocp.parameters(X0p, 0, 0.5))
            z, tf = ocp.plan(got["x"])
            # f is not stationary at the floor's point: it moves with the solver's tolerance.
            errors = [abs(a - b) / max(1, abs(b)) for a, b in
                      zip((float(got["f"][0]), tf, z[-1, X], z[-1, Y]), want)]  # fmt: skip
            worst = max(worst, *errors)
            print(f"{environment} {planner} {form}: {stats['return_status']}, "
                  f"{stats['iter_count']} iterations; largest error {max(errors):.1e}")  # fmt: skip
    if worst > 1e-5:
        sys.exit("the page's values are not reproduced")


def library(args, form):
    return os.path.join(args.dir, f"{args.environment}_{form}")


def prepare(args):
    """DIR/ENVIRONMENT_FORM.so: the functions Ipopt calls."""
    os.makedirs(args.dir, exist_ok=True)
    os.chdir(args.dir)  # CasADi writes where it stands
    for form, in_range in FORMS.items():
        solver = Solver(Ocp(args.environment, "P_D", in_range), LEVELS["floor"])
        solver.solvers[0].generate_dependencies(f"{args.environment}_{form}.c")
        compile_c(library(args, form))


def run(args):
    file, level = CycleFile(args.cycles), LEVELS[args.level]
    forms, setup = {}, []
    for form, in_range in FORMS.items():
        began = time.perf_counter()
        ocp = Ocp(args.environment, "P_D", in_range)
        built_s = time.perf_counter() - began
        source = library(args, form) + ".so" if args.mode == "c" else None
        names = file.forms[form]
        obstacles = [n[9 : n.index("]")] for n in names["rows"] if n.startswith("obstacle[")
                     and n.endswith("at node 1")]  # fmt: skip
        forms[form] = (Solver(ocp, level, source, args.options),
                       Names(names["variables"], ocp.variable_names()),
                       Names(names["rows"], ocp.row_names(obstacles)))  # fmt: skip
        setup.append(built_s * (source is None) + forms[form][0].setup_s)
    solves = []
    with open(args.answers, "wb") as answers:
        for cycle in file.cycles[args.first : args.first + args.count]:
            solves.append(solve_cycle(cycle, level, args.start, *forms[cycle.form], answers))
    write_results(args, setup[0], solves)


def solve_cycle(cycle, level, start, solver, variables, rows, answers):
    ocp, duals = solver.ocp, None
    warm = start == "warm" and cycle.meta["has_last"]
    x = variables.to_peer(cycle.warm_x if warm else cycle.cold_x)
    if warm and cycle.has_duals:
        duals = variables.to_peer(cycle.zu - cycle.zl), rows.to_peer(cycle.y)
    p = ocp.parameters(cycle.X0p, cycle.meta["t0"], cycle.meta["t_start"])
    got, stats = solver.solve(x, p, duals)
    zl, zu = split_multipliers(got["x"], ocp.lbx, ocp.ubx, got["lam_x"], level.floor)
    y = got["lam_g"]
    if level.floor == 0:
        most = level.complementarity
        zl, zu = within(zl, got["x"] - ocp.lbx, most), within(zu, ocp.ubx - got["x"], most)
        y = np.where(ocp.is_equation, y, -within(-y, got["g"], most))
    write_answer(answers, cycle.index, variables.to_ours(got["x"]), rows.to_ours(y),
                 variables.to_ours(zl), variables.to_ours(zu))  # fmt: skip
    return describe(stats) | {"cycle": cycle.index}


def main():
    parser = peer_arguments(__doc__, ["check", "prepare", "run"])
    parser.add_argument("--answers", default=os.devnull, help="file for bench_judge")
    args = parser.parse_args()
    {"check": check, "prepare": prepare, "run": run}[args.command](args)


if __name__ == "__main__":
    main()
