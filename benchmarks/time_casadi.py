"""Checks, compiles and times planner_casadi.py.

    python time_casadi.py check                     the page's first OCPs (its section 6)
    python time_casadi.py prepare --dir DIR         generate C for the E_C problem and compile it
    python time_casadi.py run --mode vm|c --dir DIR time one round, JSON on standard output
    python time_casadi.py record                    drive E_C in closed loop, print its cycles
"""

import argparse
import hashlib
import json
import math
import os
import subprocess
import sys
import time

import casadi as ca
import numpy as np

from planner_casadi import ENVIRONMENTS, NX, NZ, X, Y, Ocp, Solver, vehicle


def check(_):
    """The first OCPs of section 6, in both forms."""
    expected = {("E_A", "P_B"): (271.6379, 2.515208, 196.49608, 53.46048, -157.7753),
                ("E_C", "P_D"): (909.7726, 4.179134, 7.68836, 88.55504, -1932.5254)}  # fmt: skip
    worst = 0
    for (environment, planner), want in expected.items():
        for form in ("sx", "map"):
            ocp = Ocp(environment, planner, form=form)
            X0p = ocp.env["start"].copy()
            X0p[Y] = 8.5
            got = Solver(ocp, 0.8).solve(ocp.straight_on(X0p, 0.8), ocp.parameters(X0p, 0))
            z, tf = ocp.plan(got["x"])
            have = (got["f"], tf, z[-1, X], z[-1, Y], got["phi"])
            # f is not stationary at the floor's point: it moves with the solver's tolerance.
            errors = [abs(a - b) / max(1, abs(b)) for a, b in zip(have, want)]
            worst = max(worst, *errors)
            print(f"{environment} {planner} {form}: {got['status']}, {got['iterations']} "
                  f"iterations, f {have[0]:.4f} tf {tf:.6f} end ({have[2]:.5f}, {have[3]:.5f}) "
                  f"phi {have[4]:.4f}; largest error {max(errors):.1e}")  # fmt: skip
    if worst > 1e-5:
        sys.exit("the page's values are not reproduced")


def combined(nlp):
    """Everything at once, sharing common subexpressions: CasADi's best for one evaluation."""
    x, p, f, g = nlp["x"], nlp["p"], nlp["f"], nlp["g"]
    lam_f, lam_g = type(x).sym("lam_f"), type(x).sym("lam_g", g.numel())
    first = [f, g, ca.gradient(f, x), ca.jacobian(g, x)]
    hessian = ca.triu(ca.hessian(lam_f * f + ca.dot(lam_g, g), x)[0])
    inputs = [x, p, lam_f, lam_g]
    share = lambda outputs: ca.cse(outputs)
    return [ca.Function("all_first", inputs, share(first)),
            ca.Function("all_second", inputs, share(first + [hessian])),
            ca.Function("hessian", inputs, share([hessian]))]  # fmt: skip


FORMS = ("sx", "map")
POINTS = ("guess", "plan")


def load(path):
    with open(path) as file:
        return json.load(file)


def prepare(args):
    """DIR/nlp_FORM.so (what Ipopt calls), DIR/all_FORM.so (combined functions), evaluation points."""
    form, recording = args.form, load(args.cycles)
    os.makedirs(args.dir, exist_ok=True)
    os.chdir(args.dir)
    ocp = Ocp("E_C", "P_D", form=form)
    for at in POINTS:
        write_point(ocp, args, recording, at)
    Solver(ocp, args.floor).solvers[0].generate_dependencies(f"nlp_{form}.c")
    generator = ca.CodeGenerator(f"all_{form}.c")
    for function in combined(ocp.nlp):
        generator.add(function)
    generator.generate()
    for name in (f"nlp_{form}", f"all_{form}"):
        compile_c(name, args.compiler)


def compile_c(name, compiler):
    """NAME.so from NAME.c, unless it is there from the same text, compiler and processor."""
    version = subprocess.run([compiler.split()[0], "--version"], capture_output=True).stdout
    with open(f"{name}.c", "rb") as source, open("/proc/cpuinfo") as info:
        flags = next((line for line in info if line.startswith("flags")), "")
        parts = [source.read(), compiler.encode(), version, flags.encode()]
    key, stamp = hashlib.sha256(b"\0".join(parts)).hexdigest(), f"{name}.stamp"
    if os.path.exists(stamp) and os.path.exists(f"{name}.so"):
        with open(stamp) as file:
            if file.read() == key:
                return
    began = time.time()
    subprocess.run([*compiler.split(), f"{name}.c", "-o", f"{name}.so", "-shared", "-fPIC",
                    "-lm"], check=True)  # fmt: skip
    print(f"{name}.so: {os.path.getsize(name + '.c') / 1e6:.1f} MB of C, "
          f"{time.time() - began:.1f} s to compile", file=sys.stderr)  # fmt: skip
    with open(stamp, "w") as file:
        file.write(key)


def evaluation_point(ocp, recording, floor, at):
    """The straight-on guess, or the recorded plan: at the guess all angles are zero, for which
    scalar maths libraries return early."""
    cycle = recording["cycles"][0]
    X0p = np.array(cycle["X0p"])
    if at == "guess":
        x = ocp.straight_on(X0p, floor)
    else:
        plan = recording["point"]
        x = ocp.with_slacks(np.array(plan["nodes"]), plan["tf"], X0p, floor)
    return x, ocp.parameters(X0p, cycle["t0"], cycle["tex"]), np.ones(1), np.ones(len(ocp.lbg))


def time_vm(ocp, args, recording, at):
    """Microseconds a call of each function on CasADi's virtual machine, without Python's data."""
    functions = combined(ocp.nlp)
    inputs = evaluation_point(ocp, recording, args.floor, at)
    samples = {}
    for function in functions:
        buffer, call = function.buffer()
        keep = [np.ascontiguousarray(v) for v in inputs]
        outputs = [np.zeros(function.nnz_out(i)) for i in range(function.n_out())]
        for i, v in enumerate(keep):
            buffer.set_arg(i, memoryview(v))
        for i, v in enumerate(outputs):
            buffer.set_res(i, memoryview(v))
        times = []
        for _ in range(args.repeats):
            began = time.perf_counter_ns()
            call()
            times.append((time.perf_counter_ns() - began) / 1e3)
        samples[function.name()] = times
    return samples


def write_point(ocp, args, recording, at):
    """The evaluation's inputs as text, for the program that calls the generated C."""
    with open(f"point_{at}.txt", "w") as file:
        for v in evaluation_point(ocp, recording, args.floor, at):
            file.write(f"{len(v)}\n" + " ".join(repr(float(a)) for a in v) + "\n")


def describe(ocp, got):
    z, tf = ocp.plan(got["x"])
    keep = {k: v for k, v in got.items() if k not in ("x", "duals")}
    return keep | {"tf": float(tf), "nodes": z.tolist()}


def run(args):
    """One round: functions (VM), then the first cycle as the process's very first solve, then each
    cycle from the last solved plan, the first one from straight on again."""
    recording = load(args.cycles)
    form = args.form
    ocp = Ocp("E_C", "P_D", form=form)
    result = {"casadi": ca.__version__, "mode": args.mode, "form": form}
    if args.mode == "vm":
        result["functions_us"] = {at: time_vm(ocp, args, recording, at) for at in POINTS}
        solver = Solver(ocp, args.floor)
    else:
        solver = Solver(ocp, args.floor, os.path.join(os.path.abspath(args.dir), f"nlp_{form}.so"))
    result["solves"] = []
    last = None
    for i, cycle in enumerate([recording["cycles"][0], *recording["cycles"]]):
        X0p = np.array(cycle["X0p"])
        p = ocp.parameters(X0p, cycle["t0"], cycle["tex"])
        if last is None:
            x, duals = ocp.straight_on(X0p, args.floor), None
        else:
            shift = cycle["t0"] - last[0]
            x, duals = ocp.shifted(ocp.plan(last[1]["x"]), shift, X0p, args.floor), last[1]["duals"]
        got = solver.solve(x, p, duals)
        result["solves"].append(describe(ocp, got) | {"start": x.tolist()})
        if i > 0 and got["solved"]:
            last = (cycle["t0"], got)
    json.dump(result, sys.stdout)


def record(args):
    """Closed loop of section 4 in E_C by P_D: predicted states and times, cycle by cycle."""
    env = ENVIRONMENTS["E_C"]
    z = ca.SX.sym("z", NZ)
    rate = ca.Function("rate", [z], [vehicle(z)[0]])
    solvers = {}

    def integrate(state, control, t, duration, steps=200):
        h = duration / steps
        f = lambda s, at: np.array(rate(np.concatenate([s, control(at)]))).ravel()
        for k in range(steps):
            at = t + k * h
            k1 = f(state, at)
            k2 = f(state + h / 2 * k1, at + h / 2)
            k3 = f(state + h / 2 * k2, at + h / 2)
            k4 = f(state + h * k3, at + h)
            state = state + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        return state

    state, t0, tex, cycles, last, point = env["start"].copy(), 0.0, 0.5, [], None, None
    control = lambda t: np.zeros(2)
    while t0 < 60:
        X0p = integrate(state, control, t0, tex)
        distance = math.hypot(X0p[X] - env["goal"][0], X0p[Y] - env["goal"][1])
        in_range = distance < env["L_range"]
        cycles.append({"t0": t0, "tex": tex, "X0p": X0p.tolist(), "in_range": in_range})
        if in_range not in solvers:
            solvers[in_range] = Solver(Ocp("E_C", "P_D", in_range), args.floor)
        solver = solvers[in_range]
        ocp = solver.ocp
        x = (ocp.straight_on(X0p, args.floor) if last is None
             else ocp.shifted(last[0], tex, X0p, args.floor))  # fmt: skip
        duals = last[1] if last is not None and last[2] == in_range else None
        got = solver.solve(x, ocp.parameters(X0p, t0, tex), duals)
        if not got["solved"]:
            sys.exit(f"cycle {len(cycles)} is not solved: {got['status']}")
        plan = ocp.plan(got["x"])
        point = point or {"tf": float(plan[1]), "nodes": plan[0].tolist()}
        last = (plan, got["duals"], in_range)
        state, t0 = X0p, t0 + tex
        if max(abs(state[0] - env["goal"][0]), abs(state[1] - env["goal"][1])) <= env["sigma"]:
            break
        nodes, tf, begin = plan[0], plan[1], t0
        grid = np.linspace(0, tf, len(nodes))
        control = lambda t, g=grid, n=nodes, b=begin: np.array(
            [np.interp(t - b, g, n[:, NX]), np.interp(t - b, g, n[:, NX + 1])])
    out = [c for c in cycles if not c.pop("in_range")]
    print(f"arrived at {t0} s after {len(cycles)} cycles", file=sys.stderr)
    print('{"environment": "E_C", "planner": "P_D", "cycles": [')
    print(",\n".join(json.dumps(c) for c in out) + "\n],")
    print(f'"point": {json.dumps(point)}}}')


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("command", choices=["check", "prepare", "run", "record"])
    parser.add_argument("--mode", choices=["vm", "c"], default="vm")
    parser.add_argument("--form", choices=FORMS, default="sx")
    parser.add_argument("--dir", default=".")
    parser.add_argument("--floor", type=float, default=0.9)
    parser.add_argument("--repeats", type=int, default=200, help="calls of each function")
    parser.add_argument("--cycles", default=os.path.join(here, "cycles_E_C.json"))
    parser.add_argument("--compiler", default="gcc -O3 -march=native")
    args = parser.parse_args()
    {"check": check, "prepare": prepare, "run": run, "record": record}[args.command](args)


if __name__ == "__main__":
    main()
