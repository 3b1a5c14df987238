"""fatrop through CasADi on recorded cycles, in its multiple-shooting form (shooting.py).

    python peer_fatrop.py prepare --environment E_C --dir DIR
    python peer_fatrop.py run --environment E_C --dir DIR --mode vm|c --cycles FILE --level 1e-6
           --start warm [--first I --count N]                   JSON on standard output
"""

import argparse
import json
import os
import sys
import time

import casadi as ca
import numpy as np

from compiled import compile_c
from cycles import LEVELS, CycleFile
from shooting import FlatNlp, Judge

FORMS = {"out_of_range": False, "in_range": True}


def make_solver(flat, level, more, source=None):
    options = {
        "structure_detection": "manual", "N": flat.N, "nx": flat.nx, "nu": flat.nu, "ng": flat.ng,
        "equality": flat.equality.tolist(), "print_time": False, "record_time": True,
        "calc_lam_p": False,
        "fatrop": {"print_level": 0, "tol": level.tol, "max_iter": 500} | more,
    }  # fmt: skip
    return ca.nlpsol("s", "fatrop", source or flat.nlp, options)


def library(args, form):
    return os.path.join(args.dir, f"fatrop_{args.environment}_{form}")


def prepare(args):
    os.makedirs(args.dir, exist_ok=True)
    os.chdir(args.dir)  # CasADi writes where it stands
    for form, in_range in FORMS.items():
        solver = make_solver(FlatNlp(args.environment, in_range), LEVELS["1e-6"], {})
        solver.generate_dependencies(os.path.basename(library(args, form)) + ".c")
        compile_c(library(args, form))


def run(args):
    file, level, warm = CycleFile(args.cycles), LEVELS[args.level], args.start == "warm"
    forms, setup = {}, []
    for form, in_range in FORMS.items():
        flat = FlatNlp(args.environment, in_range)
        began = time.perf_counter()
        source = library(args, form) + ".so" if args.mode == "c" else None
        solver = make_solver(flat, level, json.loads(args.options), source)
        setup.append(time.perf_counter() - began)
        forms[form] = flat, solver, Judge(flat)
    solves = []
    for cycle in file.cycles[args.first : args.first + args.count]:
        flat, solver, judge = forms[cycle.form]
        lbx, ubx = flat.bounds(cycle.X0p)
        states, controls = flat.model.start(cycle, file.forms[cycle.form],
                                            warm and cycle.meta["has_last"])  # fmt: skip
        answer = solver(x0=flat.flat(states, controls), p=flat.model.parameters(cycle), lbx=lbx,
                        ubx=ubx, lbg=flat.lbg, ubg=flat.ubg)  # fmt: skip
        stats = solver.stats()
        inner = stats.get("fatrop", {})
        solves.append(judge(np.array(answer["x"]).ravel(), cycle) | {
            "claimed": bool(stats["success"]), "status": str(stats["unified_return_status"]),
            "iterations": int(stats.get("iter_count", inner.get("iterations_count", -1))),
            "wall_s": stats["t_wall_total"], "cpu_s": stats["t_proc_total"]})  # fmt: skip
    json.dump({"setup_s": setup[0], "cycles": solves}, sys.stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("command", choices=["prepare", "run"])
    parser.add_argument("--environment", default="E_C")
    parser.add_argument("--mode", choices=["vm", "c"], default="vm")
    parser.add_argument("--dir", default=".", type=os.path.abspath)
    parser.add_argument("--cycles")
    parser.add_argument("--level", choices=["1e-2", "1e-6"], default="1e-6")
    parser.add_argument("--start", choices=["warm", "cold"], default="warm")
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--count", type=int, default=1 << 30)
    parser.add_argument("--options", default="{}", help="more of fatrop's, as JSON")
    args = parser.parse_args()
    {"prepare": prepare, "run": run}[args.command](args)


if __name__ == "__main__":
    main()
