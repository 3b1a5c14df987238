"""The summary of a run as Markdown."""

from contestants import CONTESTANTS
from levels import LEVELS
from measured import stamp
from sweeps import head, row

QUANTITIES = {
    "all_first": "values, gradient, Jacobian",
    "all_second": "the same and the Hessian",
    "hessian": "the Hessian alone",
}
PLACES = {"guess": "from straight on", "plan": "at a shifted plan"}
AT = {name: f"at the floor {level.floor:g}" if level.floor else f"at {name} without floor"
      for name, level in LEVELS.items()}  # fmt: skip
SHOWN = 12  # other local optima listed a table


def number(value):
    if value is None:
        return "–"
    return f"{value:.3g}" if abs(value) < 1000 else f"{value:.0f}"


def table(header, rows):
    return (head(header) + "".join(map(row, rows))).rstrip("\n")


def title(name):
    return CONTESTANTS[name].title + ("" if CONTESTANTS[name].same_problem else " ¹")


def ratio(peer, ours):
    value = peer / ours
    return number(value) + ("" if value >= 1 else " (**the peer wins**)")


def times_markdown(group):
    rows, ours = [], group["times"].get("slalom")
    for name, t in group["times"].items():
        iterations, each = t.get("iterations"), t.get("us_per_iteration")
        row = [title(name), *(number(t["cpu_ms"][q]) for q in ("median", "p95", "p99", "max")),
               number(t["wall_ms"]["median"]), number(t.get("max_solved_ms")),
               f"{number(iterations['median'])} / {number(iterations['p95'])}" if iterations else "–",
               number(each), f"{t['solved']}/{t['of']} ({100 * t['solved'] / t['of']:.1f} %)",
               number(t["setup_ms"])]  # fmt: skip
        same = name.startswith("slalom") or ours is None
        row += ["", ""] if same else [ratio(t["cpu_ms"][q], ours["cpu_ms"][q])
                                      for q in ("median", "p99")]  # fmt: skip
        rows.append(row)
    return table(["", "median [ms]", "p95", "p99", "max", "wall, median", "longest solved",
                  "iterations, median / p95", "µs an iteration", "solved of feasible",
                  "set-up [ms]", "× ours, median", "× ours, p99"], rows)  # fmt: skip


def denied_markdown(group):
    denied = [f"{title(name)} {t['denied']}" for name, t in group["times"].items() if t["denied"]]
    return "\nClaimed solved, denied by the checker: " + ", ".join(denied) + "." if denied else ""


def answers_markdown(group):
    a = group["answers"]
    if not a or not a["both"]:
        return ""
    merit = "φ" if group["level"] == "floor" else "f"
    text = (f"\nOf {a['both']} cycles that we and CasADi C + Ipopt both solved, {a['same']} have the "
            f"same answer ({merit} within {a['phi']:.1e} relative, paths within "
            f"{1e3 * a['path_m']:.1g} mm), {len(a['others'])} another local optimum")  # fmt: skip
    if not a["others"]:
        return text + "."
    ours = sum(o["ours"] < o["theirs"] for o in a["others"])
    listed = "; ".join(f"cycle {o['cycle']}: {o['ours']:.4f} against {o['theirs']:.4f}, "
                       f"{o['path_m']:.2f} m" for o in a["others"][:SHOWN])  # fmt: skip
    more = f"; and {len(a['others']) - SHOWN} more" if len(a["others"]) > SHOWN else ""
    return text + f" (ours the lower {merit} in {ours}). {merit} ours, theirs, paths: {listed}{more}."


def environment_markdown(name, part):
    f = part["feasible"]
    parts = [f"## {name}", f"{f['True']} cycles are feasible, for some contestant solved them at "
             f"some level ({f['False']} in the multiple-shooting form)."]  # fmt: skip
    for group in part["groups"]:
        parts.append(f"### {name}, {group['start']}, {AT[group['level']]}")
        parts.append(times_markdown(group) + "\n" + denied_markdown(group) +
                     "\n" + answers_markdown(group))  # fmt: skip
    return "\n\n".join(parts)


def functions_markdown(functions):
    parts = []
    for place, by_quantity in functions.items():
        names = list(next(iter(by_quantity.values())))
        rows = []
        for quantity, row in by_quantity.items():
            ours = min(row[n]["median"] for n in names if n.startswith("slalom"))
            best = min(row[n]["median"] for n in names if not n.startswith("slalom"))
            rows.append([QUANTITIES[quantity], *(f"{number(row[n]['median'])} / "
                                                 f"{number(row[n]['p95'])}" for n in names),
                         ratio(best, ours)])  # fmt: skip
        parts.append(f"{PLACES[place].capitalize()}, microseconds, median / p95:\n\n" +
                     table(["one evaluation of", *names, "best CasADi / ours"], rows))  # fmt: skip
    return "\n\n".join(parts) or "Not measured in this run."


def levels_markdown():
    return table(["level", "floor", "tolerance asked", "violation", "stationarity",
                  "complementarity"],
                 [[AT[k], number(v.floor), f"{v.tol:.0e}" if not v.floor else "–",
                   f"{v.violation:.0e}", f"{v.stationarity:.0e}", f"{v.complementarity:.0e}"]
                  for k, v in LEVELS.items()])  # fmt: skip


def markdown(summary, program):
    about = summary["about"]
    machine = about["machine"] | {
        "slalom": ", ".join(summary["versions"]), "our kernel set": summary["kernels"],
        "highest load while measuring": f"{summary['load']:.2f}"}  # fmt: skip
    warnings = list(summary["errors"])
    if len(summary["versions"]) > 1:
        warnings.append("**Several versions of slalom were measured in this run.**")
    environments = "\n\n".join(environment_markdown(n, p)
                               for n, p in summary["environments"].items())  # fmt: skip
    stamped = stamp("make bench", program, about["commit"])
    return PAGE.format(about=about, stamp=stamped, warnings="\n".join(f"- {w}" for w in warnings),
                       limit=number(summary["limit_ms"]), levels=levels_markdown(),
                       environments=environments, functions=functions_markdown(summary["functions"]),
                       machine=table(["", ""], [[k, v] for k, v in machine.items()]))  # fmt: skip


PAGE = """# Benchmarks

{stamp}
Every figure comes from one run, {about[run]}, on one core.
How contestants are set up and what makes the comparison fair: `benchmarks/README.md`.
{warnings}

The work, in each environment: {about[recorded]} planning cycles of planner P_D, recorded from
closed-loop drives by Ipopt and by our solver at tex 0.5 and 0.1 s from seeded starts, failures kept,
and {about[perturbed]} of them with a perturbed predicted state (seed {about[seed]}). Warm: from the
last solved plan, shifted, with its slacks and its multipliers as they were. Cold: from straight on.
Each cycle is solved once. Times are the thread's processor time: ours of the whole cycle (update of
problem and obstacles, shift, solve, check), a peer's inside its solver alone; an iteration's is the solver's alone for all. The tables are
over the feasible cycles, and **what is not solved counts as {limit} ms** (or its time, if longer). An answer is solved when its
solver says so and the independent checker, in unscaled units, finds it within

{levels}

(complementarity is |s z / μ - 1| at the floor, |s z| without). Ratios are by environment, never
pooled; where a peer is faster, the cell says so.

¹ fatrop and acados solve a multiple-shooting form: another problem, with x(0) fixed, controls constant
in an interval and no floor. They get the same nodes to start from, but no multipliers, which belong to
our problem. Their answers are judged against their own problem, with the multipliers that suit them best.

{environments}

## One evaluation of the functions
In E_C. CasADi's C is called from C, its virtual machine through its own buffers. *One function* gives
all results at once and shares their common subexpressions; *as Ipopt calls* is the sum of what its
Ipopt interface evaluates. Ours includes gathering, scattering and the search for numbers that are not
finite.

{functions}

## Machine
{machine}
"""
