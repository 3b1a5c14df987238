"""Times CasADi's functions of planner_casadi.py in E_C, goal out of range. JSON on standard output.

    python time_casadi.py --cycles FILE --dir DIR --generated PROGRAM [--cycle 4] [--repeats 300]

DIR has the C that `peer_ipopt.py prepare` compiled; PROGRAM is bench_generated.
"""

import argparse
import json
import os
import subprocess
import sys
import time

import casadi as ca
import numpy as np

from compiled import compile_c
from cycles import CycleFile, Names
from planner_casadi import Ocp

QUANTITIES = ("all_first", "all_second", "hessian")
# What Ipopt calls for each; CasADi's grad_f gives f too, its jac_g gives g.
CALLS = {
    "all_first": ["nlp_grad_f", "nlp_jac_g"],
    "all_second": ["nlp_grad_f", "nlp_jac_g", "nlp_hess_l"],
    "hessian": ["nlp_hess_l"],
}


def combined(nlp):
    """Everything at once, sharing common subexpressions: CasADi's best for one evaluation."""
    x, p, f, g = nlp["x"], nlp["p"], nlp["f"], nlp["g"]
    lam_f, lam_g = type(x).sym("lam_f"), type(x).sym("lam_g", g.numel())
    first = [f, g, ca.gradient(f, x), ca.jacobian(g, x)]
    hessian = ca.triu(ca.hessian(lam_f * f + ca.dot(lam_g, g), x)[0])
    inputs = [x, p, lam_f, lam_g]
    return [ca.Function("all_first", inputs, ca.cse(first)),
            ca.Function("all_second", inputs, ca.cse(first + [hessian])),
            ca.Function("hessian", inputs, ca.cse([hessian]))]  # fmt: skip


def compiled(functions, folder):
    generator = ca.CodeGenerator("E_C_combined.c")
    for function in functions:
        generator.add(function)
    os.chdir(folder)  # CasADi writes where it stands
    generator.generate()
    name = os.path.join(folder, "E_C_combined")
    compile_c(name)
    return name + ".so"


def time_vm(functions, inputs, repeats):
    """Microseconds a call on CasADi's virtual machine, without Python's data."""
    samples = {}
    for function in functions:
        buffer, call = function.buffer()
        outputs = [np.zeros(function.nnz_out(i)) for i in range(function.n_out())]
        for i, v in enumerate(inputs):
            buffer.set_arg(i, memoryview(v))
        for i, v in enumerate(outputs):
            buffer.set_res(i, memoryview(v))
        times = []
        for _ in range(repeats):
            began = time.perf_counter_ns()
            call()
            times.append((time.perf_counter_ns() - began) / 1e3)
        samples[function.name()] = times
    return samples


def time_c(program, library, point, repeats, names):
    done = subprocess.run([program, library, point, str(repeats), *names], check=True,
                          capture_output=True, text=True)  # fmt: skip
    return json.loads(done.stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--cycles", required=True, type=os.path.abspath)
    parser.add_argument("--dir", required=True, type=os.path.abspath)
    parser.add_argument("--generated", required=True, type=os.path.abspath)
    parser.add_argument("--cycle", type=int, default=4)
    parser.add_argument("--repeats", type=int, default=300)
    args = parser.parse_args()
    file = CycleFile(args.cycles)
    cycle, ocp = file.cycles[args.cycle], Ocp("E_C", "P_D")
    names = Names(file.forms["out_of_range"]["variables"], ocp.variable_names())
    functions = combined(ocp.nlp)
    together = compiled(functions, args.dir)
    result = {}
    for place, x in (("guess", cycle.cold_x), ("plan", cycle.warm_x)):
        p = ocp.parameters(cycle.X0p, cycle.meta["t0"], cycle.meta["t_start"])
        inputs = [names.to_peer(x), p, np.ones(1), np.ones(len(ocp.lbg))]
        point = os.path.join(args.dir, f"point_{place}.txt")
        with open(point, "w") as out:
            for v in inputs:
                out.write(f"{len(v)}\n" + " ".join(repr(float(a)) for a in v) + "\n")
        separate = time_c(args.generated, os.path.join(args.dir, "E_C_out_of_range.so"), point,
                          args.repeats, CALLS["all_second"])  # fmt: skip
        result[place] = {
            "CasADi C, one function": time_c(args.generated, together, point, args.repeats,
                                             QUANTITIES),
            "CasADi C, as Ipopt calls": {
                q: [sum(t) for t in zip(*(separate[n] for n in CALLS[q]))] for q in QUANTITIES},
            "CasADi VM": time_vm(functions, inputs, args.repeats)}  # fmt: skip
    json.dump(result, sys.stdout)


if __name__ == "__main__":
    main()
