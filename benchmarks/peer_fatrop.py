"""fatrop through CasADi on recorded cycles, in its multiple-shooting form (shooting.py).

    python peer_fatrop.py prepare --environment E_C --dir DIR
    python peer_fatrop.py run --environment E_C --dir DIR --mode vm|c --cycles FILE --level 1e-6
           --start warm --out FILE [--first I --count N]                   JSON into FILE
"""

import os
import time

import casadi as ca
import numpy as np

from compiled import compile_c
from cycles import FORMS, CycleFile, peer_arguments, write_results
from levels import LEVELS
from shooting import FlatNlp, Judge


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
        solver = make_solver(flat, level, args.options, source)
        setup.append(time.perf_counter() - began)
        forms[form] = flat, solver, Judge(flat, level)
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
    write_results(args, setup[0], solves)


def main():
    parser = peer_arguments(__doc__, ["prepare", "run"], ("1e-2", "1e-6"))
    args = parser.parse_args()
    {"prepare": prepare, "run": run}[args.command](args)


if __name__ == "__main__":
    main()
