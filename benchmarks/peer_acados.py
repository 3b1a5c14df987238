"""acados (SQP, HPIPM) on recorded cycles, in its multiple-shooting form (shooting.py).

    python peer_acados.py prepare --environment E_C --dir DIR --wheel FOLDER
    python peer_acados.py run --environment E_C --dir DIR --wheel FOLDER --cycles FILE --level 1e-6
           --start warm --out FILE [--first I --count N]                   JSON into FILE

FOLDER holds the unpacked wheel `comma-deps-acados`; CasADi comes from its own wheel.
"""

import contextlib
import ctypes
import os
import sys
import time

import numpy as np

from cycles import FORMS, CycleFile, peer_arguments, write_results
from levels import LEVELS
from shooting import NS, NU, NX, TF, U_MAX, W_T, W_XF, XF_TOL, FlatNlp, Judge, Model

BIG = 1e4  # stands for no bound: HPIPM has both sides of every row
SOFT = 1e3  # weight of a violated row: more than its multiplier, so that the answer keeps to it


def formulate(model, in_range, name, options):
    """The AcadosOcp of one form."""
    import casadi as ca
    from acados.acados_template import AcadosModel, AcadosOcp

    ocp, m = AcadosOcp(), AcadosModel()
    x, u = ca.SX.sym("x", NS), ca.SX.sym("u", NU)
    p = ca.SX.sym("p", model.np + 2)  # with tau of the node and its weight in the trapezoidal rule
    tau, weight = p[model.np], p[model.np + 1]
    m.name, m.x, m.u, m.p = name, x, u, p
    m.disc_dyn_expr = model.step(x, u)
    m.cost_expr_ext_cost = weight * model.state_cost(x) + model.control_cost(x, u)
    m.cost_expr_ext_cost_e = W_T * x[TF] + weight * model.state_cost(x)
    # Small numbers, for HPIPM does not scale rows, and distances, which linearise better.
    scale = ca.DM([1, 1, *[1e-3] * 4, *[1] * len(model.obstacles), 1e-3])
    m.con_h_expr = scale * model.rows(x, p, tau, root=True)
    count = m.con_h_expr.numel()
    if in_range:
        gap = x[:2] - ca.DM(model.env["goal"])
        m.con_h_expr_e = ca.vertcat(m.con_h_expr, gap, gap)
        lower, upper = [-XF_TOL] * 2 + [0] * 2, [XF_TOL] * 2 + [0] * 2
        soft_e = [*range(count), count + 2, count + 3]
    else:
        m.cost_expr_ext_cost_e += model.goal_cost(x, p)
        m.con_h_expr_e = ca.vertcat(m.con_h_expr, 1e-3 * model.edge(x, p))
        lower, upper = [0], [BIG]
        soft_e = list(range(count + 1))
    c = ocp.constraints
    c.lh, c.uh = np.zeros(count), np.full(count, BIG)
    c.lh_e, c.uh_e = np.append(c.lh, lower), np.append(c.uh, upper)
    c.idxsh, c.idxsh_e = np.arange(count), np.array(soft_e)
    cost = ocp.cost
    cost.zl = cost.zu = np.full(count, SOFT)
    cost.Zl = cost.Zu = np.zeros(count)
    cost.zl_e = cost.zu_e = np.full(len(soft_e), SOFT)
    if in_range:  # |x(tf) - xg| at the weight of xfs
        cost.zl_e[-2:] = cost.zu_e[-2:] = W_XF
    cost.Zl_e = cost.Zu_e = np.zeros(len(soft_e))
    bounded = np.isfinite(model.x_max)
    c.idxbx = c.idxbx_e = np.flatnonzero(bounded)
    c.lbx = c.lbx_e = model.x_min[bounded]
    c.ubx = c.ubx_e = model.x_max[bounded]
    c.idxbx_0 = np.arange(NS)  # x(0) as bounds: eliminating 8 of 9 with soft rows gives HPIPM NaN
    c.lbx_0 = np.append(model.env["start"], model.x_min[TF])
    c.ubx_0 = np.append(model.env["start"], model.x_max[TF])
    c.idxbu, c.lbu, c.ubu = np.arange(NU), -U_MAX, U_MAX
    ocp.model, ocp.dims.N, ocp.parameter_values = m, model.N, np.zeros(model.np + 2)
    ocp.cost.cost_type = ocp.cost.cost_type_e = "EXTERNAL"
    set_options(ocp.solver_options, model, options)
    return ocp


def set_options(o, model, options):
    o.tf, o.integrator_type, o.nlp_solver_type = 1.0, "DISCRETE", "SQP"
    o.time_steps = np.ones(model.N)  # the cost's own tf / N is in its expressions
    o.tf = float(model.N)
    o.qp_solver, o.hessian_approx = "PARTIAL_CONDENSING_HPIPM", "EXACT"
    o.regularize_method, o.globalization = "PROJECT", "MERIT_BACKTRACKING"
    o.hpipm_mode = "SPEED"  # of the modes the fastest, as reliable as BALANCE here
    o.qp_solver_iter_max, o.nlp_solver_max_iter, o.print_level = 100, 200, 0
    o.ext_fun_compile_flags = "-O3 -march=native"
    for key, value in options.items():
        setattr(o, key, value)


def make(args, form, build):
    """The solver of a form, compiled in DIR or taken from there."""
    from acados.acados_template import AcadosOcpSolver

    model = Model(args.environment)
    name = f"acados_{args.environment}_{form}"
    ocp = formulate(model, FORMS[form], name, args.options)
    ocp.code_export_directory = os.path.join(args.dir, name)
    file = os.path.join(args.dir, f"{name}.json")
    with contextlib.redirect_stdout(sys.stderr):  # acados says what it writes
        return model, AcadosOcpSolver(ocp, json_file=file, build=build, generate=build)


def set_cycle(solver, model, flat, cycle, names, warm):
    """Start, parameters and x(0); multipliers from zero, for they belong to another problem."""
    states, controls = model.start(cycle, names, warm)
    p = model.parameters(cycle)
    solver.reset()
    for k in range(model.N + 1):
        solver.set(k, "p", np.concatenate([p, [k / model.N, 0.5 if k in (0, model.N) else 1]]))
        solver.set(k, "x", states[k])
        if k < model.N:
            solver.set(k, "u", controls[k])
    solver.set(0, "lbx", np.append(cycle.X0p, model.x_min[TF]))
    solver.set(0, "ubx", np.append(cycle.X0p, model.x_max[TF]))
    solver.constraints_set(0, "lh", np.full(7 + len(model.obstacles), -BIG))


def answer_of(solver, flat):
    N = flat.N
    states = np.array([solver.get(k, "x") for k in range(N + 1)])
    controls = np.array([solver.get(k, "u") for k in range(N)])
    w = flat.flat(states, controls)
    if flat.in_range:  # the soft rows' slacks
        w[-2:] = np.abs(states[-1, :2] - flat.model.env["goal"])
    return w


def run(args):
    file, level, warm = CycleFile(args.cycles), LEVELS[args.level], args.start == "warm"
    forms, setup = {}, []
    for form, in_range in FORMS.items():
        began = time.perf_counter()
        model, solver = make(args, form, build=False)
        setup.append(time.perf_counter() - began)
        for which, tol in (("stat", level.dual_tol), ("eq", level.violation),
                           ("ineq", level.violation), ("comp", level.complementarity)):  # fmt: skip
            solver.options_set(f"tol_{which}", tol)
        flat = FlatNlp(args.environment, in_range)
        forms[form] = model, solver, flat, Judge(flat, level)
    solves = []
    for cycle in file.cycles[args.first : args.first + args.count]:
        model, solver, flat, judge = forms[cycle.form]
        set_cycle(solver, model, flat, cycle, file.forms[cycle.form],
                  warm and cycle.meta["has_last"])  # fmt: skip
        began = time.process_time()
        status = solver.solve()
        cpu_s, wall_s = time.process_time() - began, float(np.sum(solver.get_stats("time_tot")))
        solves.append(judge(answer_of(solver, flat), cycle) | {
            "claimed": status == 0, "status": f"acados status {status}",
            "iterations": int(np.sum(solver.get_stats("sqp_iter"))), "wall_s": wall_s,
            "cpu_s": min(cpu_s, wall_s)})  # fmt: skip
    write_results(args, setup[0], solves)


def prepare(args):
    os.makedirs(args.dir, exist_ok=True)
    for form in FORMS:
        make(args, form, build=True)


def main():
    parser = peer_arguments(__doc__, ["prepare", "run"], ("1e-2", "1e-6"))
    parser.add_argument("--wheel", required=True, type=os.path.abspath)
    args = parser.parse_args()
    sys.path.append(args.wheel)  # after CasADi's own wheel: the slim one in here is not wanted
    install = os.path.join(args.wheel, "acados", "install")
    os.environ |= {
        "ACADOS_SOURCE_DIR": install, "TERA_PATH": os.path.join(install, "bin", "t_renderer"),
        "ACADOS_PYTHON_INTERFACE_PATH": os.path.join(args.wheel, "acados", "acados_template"),
    }  # fmt: skip
    for library in ("libblasfeo.so", "libhpipm.so", "libqpOASES_e.so.3.1"):
        ctypes.CDLL(os.path.join(install, "lib", library), mode=ctypes.RTLD_GLOBAL)
    {"prepare": prepare, "run": run}[args.command](args)


if __name__ == "__main__":
    main()
