#!/usr/bin/env python3
"""One long cold solve each, by ours and by CasADi with Ipopt, into docs/measured/long-solves.md.

    long_solves.py [--program build/slalom] [--python PYTHON] [--work DIR]

The paper's table of long solve times: obstacle constraints hard or soft, 3 or 17 moving obstacles, the
goal in range, one plan from a cold start by backward Euler. The three obstacles are E_B's; the 17 are
drawn, one field a seed. --python takes an interpreter that has CasADi; else one is made from requirements.txt.
CasADi's answers stay in --work. Standard library only.
"""

import hashlib
import json
import math
import random
import re
import statistics
import subprocess
import sys
import time

from contestants import BUILD, HERE
from environments import environment, one_thread, requirements
from measured import command_of, output_of, page_parser, stamp, write
from sweeps import head, row

PAPER = {("hard", 3): 44.4, ("hard", 17): 193.0, ("soft", 3): 110.0, ("soft", 17): 2190.0}
INTERVALS = (60, 200)
SEEDS = (1, 2, 3)
RUNS = 9  # of ours; medians
THREE = [[205, 57, 5, -2, 0], [180, 75, 4, -1, 1], [200, 63, 2, -0.5, 6]]  # E_B's: x, y, r, vx, vy
REACH, SM_END = 200, 4.0
MODES = ("vm", "c")
RULES = ("adaptive", "monotone")
SCRIPTS = ("long_casadi.py", "planner_casadi.py", "compiled.py")  # what states and solves the problem in CasADi


def field(seed):
    """17 moving circles about the way from (200, 0) to (200, 125), clear of start and goal then."""
    rng = random.Random(seed)
    found = []
    while len(found) < 17:
        r, speed, towards = rng.uniform(1, 3), rng.uniform(0, 6), rng.uniform(-math.pi, math.pi)
        x, y = rng.uniform(165, 235), rng.uniform(30, 115)
        vx, vy = speed * math.cos(towards), speed * math.sin(towards)
        clear = all(math.hypot(x + vx * t - px, y + vy * t - py) > r + SM_END + 1
                    for px, py, times in ((200, 0, (0, 0.5)), (200, 125, (4, 5, 6, 7, 8)))
                    for t in times)  # fmt: skip
        if clear:
            found.append([round(v, 3) for v in (x, y, r, vx, vy)])
    return found


def scenario_text(obstacles):
    lines = ["name: long_solve", "planner: {base: P_D, L_range: %d}" % REACH,
             "start: {x: 200, y: 0, psi_deg: 90, ux: 17}",
             "goal: {x: 200, y: 125, psi_deg: 90, sigma: 15}", "obstacles:"]  # fmt: skip
    for x, y, r, vx, vy in obstacles:
        lines.append(f"  - {{x: {x}, y: {y}, r: {r}, vx: {vx}, vy: {vy}}}")
    return "\n".join(lines) + "\n"


def ours(program, scenario, N, constraint):
    """Median times of RUNS runs of the program, each a solve from cold; the whole run beside it."""
    command = [program, "plan", scenario, "--json", "--set", f"planner.N={N}",
               "--set", "planner.scheme=backward_euler", "--set", "planner.floor=0",
               "--set", "planner.tol=1e-8", "--set", "planner.max_iterations=3000",
               "--set", "loop.warm_up=false",
               "--set", f"planner.obstacle_constraint={constraint}"]  # fmt: skip
    answers, whole = [], []
    for _ in range(RUNS):
        began = time.perf_counter()
        done = subprocess.run(command, capture_output=True, text=True)
        whole.append(time.perf_counter() - began)
        if done.returncode != 0:
            sys.exit(f"{' '.join(map(str, command))}: {done.stderr}")
        answers.append(json.loads(done.stdout))
    answer = answers[-1]
    cpu = [a["cpu_time_s"] for a in answers]
    return {"solved": answer["solved"], "status": answer["status"],
            "iterations": answer["iterations"], "cost": answer["cost"], "tf": answer["tf_s"],
            "X0p": [answer["X0p"][k] for k in ("x", "y", "v", "r", "psi", "sa", "ux", "ax")],
            "t_start": answer["t_start_s"], "cpu_s": cpu,
            "setup_s": statistics.median(whole) - statistics.median(cpu)}  # fmt: skip


def digest_of(*parts):
    """Of what an answer of CasADi's belongs to, and of the scripts that find it."""
    text = json.dumps([*parts, *((HERE / name).read_text() for name in SCRIPTS)])
    return hashlib.sha256(text.encode()).hexdigest()


def casadi(args, name, case, mode, rule):
    """One way of CasADi's on a case, in a process of its own; kept, with what it is the answer to."""
    case_file, out = args.work / f"{name}.json", args.work / f"{name}_{mode}_{rule}.json"
    of = digest_of(case, mode, rule, args.limit, args.casadi)
    if out.is_file() and (kept := json.loads(out.read_text())).get("of") == of:
        return kept
    out.unlink(missing_ok=True)
    case_file.write_text(json.dumps(case))
    command = [args.python, HERE / "long_casadi.py", case_file, out, "--mode", mode, "--rule", rule,
               "--limit", str(args.limit)]  # fmt: skip
    try:
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True,
                              timeout=3 * args.limit + 900, env=one_thread())  # fmt: skip
        if done.returncode != 0:
            raise RuntimeError(done.stderr.strip().splitlines()[-1] if done.stderr else "no word")
    except (subprocess.TimeoutExpired, RuntimeError) as error:
        return {"solved": False, "status": str(error)[:60], "cpu_s": [], "setup_s": math.nan,
                "iterations": 0, "cost": math.nan}  # fmt: skip
    answer = json.loads(out.read_text()) | {"of": of}
    write(out, json.dumps(answer))
    return answer


def measure(args):
    """A row for each mesh, constraint and field: ours, and CasADi's ways."""
    fields = [("3 (E_B)", 3, THREE)] + [(f"17, seed {s}", 17, field(s)) for s in args.seeds]
    rows = []
    for N in args.intervals:
        for constraint in ("hard", "soft"):
            for label, count, obstacles in fields:
                name = f"N{N}_{constraint}_{re.sub('[^0-9a-zA-Z]+', '_', label).strip('_')}"
                scenario = args.work / f"{name}.yaml"
                scenario.write_text(scenario_text(obstacles))
                mine = ours(args.program, scenario, N, constraint)
                case = {"N": N, "soft": constraint == "soft", "w_obstacle": 1000,
                        "goal": [200, 125], "t_start": mine["t_start"], "reach": REACH + 5,
                        "X0p": mine["X0p"],
                        "obstacles": [[x, y, r, r, vx, vy] for x, y, r, vx, vy in obstacles]}  # fmt: skip
                theirs = {}
                for rule in RULES:
                    theirs["vm", rule] = casadi(args, name, case, "vm", rule)
                _, rule = best(mine, theirs)[0]
                theirs["c", rule] = casadi(args, name, case, "c", rule)
                rows.append({"N": N, "constraint": constraint, "label": label, "count": count,
                             "ours": mine, "casadi": theirs})  # fmt: skip
                print(name, "ours", brief(mine), "|",
                      " | ".join(f"{m} {r}: {brief(a)}" for (m, r), a in theirs.items()), flush=True)
    return rows


def seconds(answer):
    """CPU time of a solve that succeeded, infinite otherwise."""
    return statistics.median(answer["cpu_s"]) if answer["solved"] else math.inf


def brief(answer):
    time_text = f"{seconds(answer):.4g} s" if answer["solved"] else answer["status"]
    return f"{time_text} ({answer['iterations']} it, cost {answer['cost']:.6f})"


def same(mine, theirs):
    """Whether both ended in one optimum."""
    return mine["solved"] and theirs["solved"] and abs(theirs["cost"] / mine["cost"] - 1) < 1e-6


def best(mine, theirs):
    """CasADi's fastest way to our optimum or, if none ended there, to its lowest; name and answer."""
    lowest = min((a["cost"] for a in theirs.values() if a["solved"]), default=math.inf)
    ours = [k for k, a in theirs.items() if same(mine, a)]
    low = [k for k, a in theirs.items() if a["solved"] and a["cost"] <= lowest * (1 + 1e-6)]
    key = min(ours or low or theirs, key=lambda k: seconds(theirs[k]))
    return key, theirs[key]


def time_cell(answer, limit):
    if answer["solved"]:
        return f"{seconds(answer):.3g} s, {answer['iterations']}"
    return f"no: {answer['status'].replace('_', ' ')}" + (
        f" after {max(answer['cpu_s']):.0f} s" if answer["cpu_s"] else f" (limit {limit:g} s)")


def details(rows, limit):
    text = head(["N", "rows", "obstacles", "ours: time, iterations", "CasADi, best: time, iterations", "way",
                 "ours faster by", "costs: ours, CasADi's", "apart"])  # fmt: skip
    for each in rows:
        mine = each["ours"]
        (mode, rule), theirs = best(mine, each["casadi"])
        both = mine["solved"] and theirs["solved"]
        ratio = f"× {seconds(theirs) / seconds(mine):.1f}" if same(mine, theirs) else "–"
        apart = abs(theirs["cost"] / mine["cost"] - 1) if both else math.nan
        agree = "–" if not both else f"{apart:.1e}" if same(mine, theirs) else "another optimum"
        way = ("C" if mode == "c" else "virtual machine") + f", {rule}"
        text += row([each["N"], each["constraint"], each["label"], time_cell(mine, limit), time_cell(theirs, limit), way,
                     ratio, f"{mine['cost']:.5f}, {theirs['cost']:.5f}", agree])  # fmt: skip
    return text


def summary(rows):
    """The paper's table: medians over the fields of one size."""
    meshes = sorted({r["N"] for r in rows})
    text = head(["rows", "obstacles", "paper, MATLAB + IPOPT",
                 *(cell for N in meshes for cell in (f"ours, N = {N}", f"CasADi, N = {N}"))])  # fmt: skip
    for (constraint, count), printed in PAPER.items():
        cells = [constraint, count, f"{printed:g} s"]
        for N in meshes:
            own = [r for r in rows if (r["N"], r["constraint"], r["count"]) == (N, constraint, count)]
            for answers in ([r["ours"] for r in own], [best(r["ours"], r["casadi"])[1] for r in own]):
                solved = [seconds(a) for a in answers if a["solved"]]
                cells.append(f"{statistics.median(solved):.3g} s" if solved else "none")
                if len(solved) < len(answers):
                    cells[-1] += f" ({len(solved)} of {len(answers)} solved)"
        text += row(cells)
    return text


def slower_line(rows):
    """Where CasADi is faster, or finds the lower cost."""
    def place(row):
        return f"N = {row['N']}, {row['constraint']}, {row['label']}"

    pairs = [(row, row["ours"], best(row["ours"], row["casadi"])[1]) for row in rows]
    slower = [place(r) for r, mine, theirs in pairs if seconds(theirs) < seconds(mine)]
    worse = [place(r) for r, mine, _ in pairs if mine["solved"] and any(
        a["solved"] and not same(mine, a) and a["cost"] < mine["cost"] for a in r["casadi"].values())]
    return (f"CasADi is the faster in {len(slower)} of {len(rows)}" + (f" ({'; '.join(slower)})" if slower else "")
            + f", and finds a lower optimum in {len(worse)}" + (f" ({'; '.join(worse)})" if worse else "") + ".")


def setup_line(rows):
    """What comes before a first solve."""
    def span(values):
        values = [v for v in values if math.isfinite(v)]
        return f"{min(values):.2g} to {max(values):.2g} s" if values else "not measured"

    mine = span([r["ours"]["setup_s"] for r in rows])
    vm = span([a["setup_s"] for r in rows for (m, _), a in r["casadi"].items() if m == "vm"])
    c = span([a["setup_s"] for r in rows for (m, _), a in r["casadi"].items() if m == "c"])
    return (f"Before the first solve: ours {mine} (the whole run of the program less the solve: reading, "
            f"derivatives, transcription, printing); CasADi {vm}, with C {c}.")  # fmt: skip


def page(rows, args, stamped):
    version = next((a["casadi"] for r in rows for a in r["casadi"].values() if "casadi" in a), "?")
    return "\n".join([
        "# Long cold solves", "", stamped,
        "The paper's table of long solve times (MATLAB with IPOPT, of earlier work on a simpler problem) and",
        "ours: one plan from a cold start, the goal in range, backward Euler on N intervals, moving obstacles,",
        "obstacle rows hard or soft (l1). The paper states neither N nor its field of 17; ours are E_B's three",
        f"obstacles and {len(args.seeds)} drawn fields of 17. Solved to 1e-8 without barrier floor. Times are CPU",
        "time of the solve, medians.", "",
        summary(rows),
        "One thread. Where the table has 17 obstacles, the median is over the fields.",
        "The paper's is an Intel i7-4910MQ, and its problem and N are not ours: the ratio of the times is not one of",
        "solvers alone. CasADi's, here, is.", "",
        "## Beside CasADi with Ipopt", "",
        f"CasADi {version} (wheel): the same problem, stated anew from [formulation.md](../formulation.md)",
        "(`benchmarks/long_casadi.py`), exact Hessian, MUMPS, tol 1e-8, the same straight start. Of the",
        "ways tried (barrier rule adaptive or monotone by the virtual machine, and compiled C, -O3",
        "-march=native, with the better rule) the fastest stands here, of those that ended in our optimum or, where",
        f"none did, in their lowest. Limit: {args.limit:g} s a solve.", "",
        details(rows, args.limit),
        "Costs are the same problem's where both ended in the same optimum: passing obstacles on another side is",
        "another one. " + slower_line(rows) + " " + setup_line(rows), ""])  # fmt: skip


def casadi_python():
    """An interpreter that has CasADi, at the version of requirements.txt."""
    return environment(BUILD / "casadi", requirements(HERE / "requirements.txt", "casadi", "numpy"))


def main():
    parser = page_parser("long-solves", __doc__)
    parser.add_argument("--python", help="an interpreter that has CasADi")
    parser.add_argument("--limit", type=float, default=600, help="of one solve of CasADi's [s]")
    parser.add_argument("--intervals", type=int, nargs="+", default=list(INTERVALS))
    parser.add_argument("--seeds", type=int, nargs="+", default=list(SEEDS))
    args = parser.parse_args()
    args.work = args.work.resolve()
    args.work.mkdir(parents=True, exist_ok=True)
    args.python = args.python or casadi_python()
    args.casadi = output_of(args.python, "-c", "import casadi; print(casadi.__version__)")
    made_by = command_of(parser, args, "long-solves", "limit", "intervals", "seeds")
    write(args.out, page(measure(args), args, stamp(made_by, args.program)))


if __name__ == "__main__":
    main()
