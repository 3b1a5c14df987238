"""The planner's OCP with the goal in range, by backward Euler, in CasADi with its Ipopt.

    python long_casadi.py CASE.json OUT.json --mode vm|c --rule adaptive|monotone [--limit S] [--runs R]

Sections 1 to 3 of docs/formulation.md on N intervals: a defect X_k+1 - X_k - h f(X_k+1, u_k+1) = 0, the
cost's integrals by the same rule, controls held. Soft obstacle rows have an excess s >= 0 each and cost
w h s. Exact Hessian, MUMPS; the functions are evaluated node by node through one mapped function, by
CasADi's virtual machine or as compiled C. long_solves.py writes the case and reads the result.
"""

import argparse
import json
import math
import os
import time

import casadi as ca
import numpy as np

from compiled import compile_c
from planner_casadi import (
    AX, FZ_MIN, INF, NX, NZ, PSI, SA, TF_MAX, TF_MIN, UX, W_FZ, W_HAF, W_IC, W_JX, W_S0, W_SA, W_SR,
    W_XF, X, X0_TOL, XF_TOL, Y, vehicle)  # fmt: skip

W_T, W_CE = 100, 1


def node_functions(case):
    """At node 0 its limits; at a later one rate, integrand, limits, LiDAR row and obstacle rows."""
    z, start, tau, tf = (ca.SX.sym(s, k) for s, k in
                         (("z", NZ), ("start", 2), ("tau", 1), ("tf", 1)))  # fmt: skip
    rate, loads, ax_min, ax_max = vehicle(z)
    limits = [z[AX] - ax_min, ax_max - z[AX], loads - FZ_MIN]
    integrand = W_HAF * (z[X] - case["goal"][0]) ** 2  # psi_g = 90 degrees
    integrand += W_FZ * sum(ca.tanh(-(loads[i] - 1300) / 100) for i in (0, 1))
    integrand += W_CE * (W_SA * z[SA] ** 2 + W_SR * z[8] ** 2 + W_JX * z[9] ** 2)
    margin, t = 2.5 + 1.5 * tau, case["t_start"] + tau * tf
    outside = [((z[X] - x - vx * t) / (a + margin)) ** 2 + ((z[Y] - y - vy * t) / (b + margin)) ** 2 - 1
               for x, y, a, b, vx, vy in case["obstacles"]]  # fmt: skip
    lidar = case["reach"] ** 2 - (z[X] - start[0]) ** 2 - (z[Y] - start[1]) ** 2
    first = ca.Function("first", [z], [ca.vertcat(*limits)])
    later = ca.Function("later", [z, start, tau, tf],
                        [rate, integrand, ca.vertcat(*limits, lidar), ca.vertcat(*outside)])  # fmt: skip
    return first, later


def statement(case):
    """The NLP, its bounds and its start; variables x0s, X_0, (X, u) at 1..N, excesses, xfs, tf."""
    N, members, soft = case["N"], len(case["obstacles"]), case["soft"]
    excess_count = N * members if soft else 0
    n = 8 + NX + NZ * N + excess_count + 2 + 1
    w = ca.MX.sym("w", n)
    x0s, X0, Z, s, xfs, tf = ca.vertsplit(
        w, np.cumsum([0, 8, NX, NZ * N, excess_count, 2, 1]).tolist())  # fmt: skip
    Z = ca.reshape(Z, NZ, N)
    first, later = node_functions(case)
    h = tf / N
    taus = ca.DM([k / N for k in range(1, N + 1)]).T
    rate, integrand, limits, outside = later.map("nodes", "serial", N, [1, 3], [])(
        Z, X0[:2], taus, tf)  # fmt: skip
    states = ca.horzcat(X0, Z[:NX, :])
    gap, over = X0 - ca.DM(case["X0p"]), Z[:2, N - 1] - ca.DM(case["goal"])
    if soft:
        outside += ca.reshape(s, members, N)
    f = W_T * tf + h * ca.sum2(integrand) + W_IC * ca.dot(ca.DM(W_S0), x0s) + W_XF * ca.sum1(xfs)
    if soft:
        f += case["w_obstacle"] * h * ca.sum1(s)
    defects = ca.vec(states[:, 1:] - states[:, :-1] - h * rate)
    rows = [gap + x0s, x0s - gap, first(ca.vertcat(X0, 0, 0)), ca.vec(limits), ca.vec(outside),
            over + xfs, xfs - over]  # fmt: skip
    g = ca.vertcat(defects, *rows)
    equations = NX * N
    lbg = np.zeros(g.numel())
    ubg = np.full(g.numel(), INF)
    ubg[:equations] = 0
    return {"x": w, "f": f, "g": g}, *bounds_and_start(case, excess_count), lbg, ubg


def bounds_and_start(case, excess_count):
    """Straight on at the start's heading and speed, as the planner's own guess."""
    N, deg, X0p = case["N"], math.pi / 180, np.array(case["X0p"])
    box = np.array([(-INF, INF)] * 4 + [(-2 * math.pi, 2 * math.pi), (-30 * deg, 30 * deg),
                    (0.01, 29), (-INF, INF), (-5 * deg, 5 * deg), (-5, 5)])  # fmt: skip
    low = [-INF] * 8 + [*box[:NX, 0]] + [*box[:, 0]] * N + [0.0] * excess_count + [-INF] * 2 + [TF_MIN]
    high = X0_TOL + [*box[:NX, 1]] + [*box[:, 1]] * N + [INF] * excess_count + [XF_TOL] * 2 + [TF_MAX]
    distance = math.hypot(X0p[X] - case["goal"][0], X0p[Y] - case["goal"][1])
    tf = min(distance / max(X0p[UX], 5), 0.99 * TF_MAX)
    heading = np.array([math.cos(X0p[PSI]), math.sin(X0p[PSI])])
    nodes = []
    for k in range(1, N + 1):
        z = np.zeros(NZ)
        z[:2] = X0p[:2] + k / N * tf * X0p[UX] * heading
        z[PSI], z[UX] = X0p[PSI], X0p[UX]
        nodes.append(z)
    half = [room / 2 for room in X0_TOL]
    guess = [*half, *X0p, *np.concatenate(nodes), *[0.1] * excess_count, 1.0, 1.0, tf]
    return np.array(low), np.array(high), np.array(guess)


def options(args):
    chosen = {
        "print_level": 0, "sb": "yes", "linear_solver": "mumps", "tol": 1e-8, "max_iter": 3000,
        "max_wall_time": args.limit, "mu_strategy": args.rule,
        # Bounds relaxed by 1e-8 would let a thousand excesses of weight 100 fall below zero.
        "bound_relax_factor": 0,
    }  # fmt: skip
    return {"print_time": False, "record_time": True, "calc_lam_p": False} | {
        "ipopt." + key: value for key, value in chosen.items()}


def solver_of(nlp, args):
    """The solver, and what making it took: derivatives, and C where it is asked for."""
    began = time.perf_counter()
    solver = ca.nlpsol("solver", "ipopt", nlp, options(args))
    if args.mode == "c":
        name = os.path.splitext(os.path.abspath(args.out))[0] + "_functions"
        here = os.getcwd()
        os.chdir(os.path.dirname(name))  # CasADi writes where it stands
        solver.generate_dependencies(os.path.basename(name) + ".c")
        os.chdir(here)
        compile_c(name)
        solver = ca.nlpsol("solver", "ipopt", name + ".so", options(args))
    return solver, time.perf_counter() - began


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("case")
    parser.add_argument("out")
    parser.add_argument("--mode", choices=["vm", "c"], default="vm")
    parser.add_argument("--rule", choices=["adaptive", "monotone"], default="adaptive")
    parser.add_argument("--limit", type=float, default=600, help="of one solve [s]")
    parser.add_argument("--runs", type=int, default=5, help="solves; one where it takes over 60 s")
    args = parser.parse_args()
    with open(args.case) as file:
        case = json.load(file)
    nlp, lbx, ubx, start, lbg, ubg = statement(case)
    solver, setup_s = solver_of(nlp, args)
    wall, cpu = [], []
    while len(wall) < args.runs and (not wall or wall[0] < 60):
        answer = solver(x0=start, lbx=lbx, ubx=ubx, lbg=lbg, ubg=ubg)
        stats = solver.stats()
        wall.append(stats["t_wall_total"])
        cpu.append(stats["t_proc_total"])
    result = {
        "solved": bool(stats["success"]), "status": stats["return_status"],
        "iterations": int(stats["iter_count"]), "cost": float(answer["f"]),
        "tf": float(answer["x"][-1]), "wall_s": wall, "cpu_s": cpu, "setup_s": setup_s,
        "variables": int(start.size), "rows": int(lbg.size), "casadi": ca.__version__,
    }  # fmt: skip
    with open(args.out, "w") as file:
        json.dump(result, file)


if __name__ == "__main__":
    main()
