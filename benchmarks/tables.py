"""The tables of run.py's summary as Markdown."""

QUANTITIES = {
    "all_first": "values, gradient, Jacobian",
    "all_second": "the same and the Hessian",
    "hessian": "the Hessian alone",
}
POINTS = {"guess": "the straight-on guess", "plan": "a solved plan"}
# Which of a round's solves each part of the table takes.
PARTS = {
    "first of a process": slice(0, 1),
    "cold": slice(1, 2),
    "first re-solve": slice(2, 3),
    "all re-solves": slice(2, None),
}


def number(value):
    return f"{value:.3g}" if value < 100 else f"{value:.0f}"


def cell(s):
    return f"{number(s['median'])} / {number(s['p95'])}"


def verdict(ours, peer):
    ratio = peer / ours
    return f"{number(ratio)}" + ("" if ratio >= 1 else " (CasADi faster)")


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def functions_markdown(times):
    parts = []
    for at, by_quantity in times.items():
        names = list(next(iter(by_quantity.values())))
        ours = names[0]
        rows = []
        for quantity, row in by_quantity.items():
            best = min(row[n]["median"] for n in names if n.startswith("CasADi"))
            rows.append([QUANTITIES[quantity], *(cell(row[n]) for n in names),
                         verdict(row[ours]["median"], best)])  # fmt: skip
        parts.append(f"At {POINTS[at]}, microseconds, median / p95:\n\n" +
                     table(["one evaluation of", *names, "best CasADi / ours"], rows))  # fmt: skip
    return "\n\n".join(parts)


def solves_markdown(times):
    rows = []
    peers = [n for n in times if n.startswith("CasADi") and "error" not in times[n]]
    for part in PARTS:
        best = min(times[n][part]["ms"]["median"] for n in peers)
        for name, entry in times.items():
            if "error" in entry:
                continue
            e = entry[part]
            ratio = "" if name in peers else verdict(e["ms"]["median"], best)
            rows.append([part, name, cell(e["ms"]), cell(e["iterations"]),
                         number(e["ms_per_iteration"]["median"]),
                         number(e["functions_ms"]["median"]), f"{e['solved']}/{e['of']}",
                         ratio])  # fmt: skip
    text = table(["solve", "by", "ms, median / p95", "iterations, median / p95", "ms an iteration",
                  "of it functions, ms a solve", "solved", "best CasADi / ours"], rows)  # fmt: skip
    failed = [f"- {n} did not run: {e['error']}" for n, e in times.items() if "error" in e]
    return text + ("\n\n" + "\n".join(failed) if failed else "")


def answers_markdown(answers):
    rows = [[name, f"{a['cycles']}", f"{a['phi']:.1e} ({a['phi_relative']:.1e})",
             f"{a['path_m']:.1e}", f"{a['tf_s']:.1e}", f"{a['start']:.1e}",
             f"{a['confirmed']}/{a['of']}" if name.startswith("slalom") else ""]
            for name, a in answers.items()]  # fmt: skip
    return table(["largest difference from CasADi C", "cycles both solved", "φ (relative to φ)",
                  "x, y at nodes [m]", "tf [s]", "starting points", "confirmed by our checker"],
                 rows)  # fmt: skip


def markdown(summary):
    p = summary["problem"]
    machine = table(["", ""], [[k, v] for k, v in summary["versions"].items()])
    return f"""# Benchmarks
Written by `make bench`; every sample is in `build/bench/benchmarks.json`. Our times include what a
caller meets: gathering, scattering into the NLP's arrays and the search for numbers that are not
finite. {summary['rounds']} rounds, contestants in turn, all on one core.

The problem is the planner P_D's in E_C (N = 15, 38 obstacles, goal out of range) at the barrier
floor 0.9: ours has {p['variables']} variables, {p['rows']} rows, {p['jacobian_entries']} entries in
the Jacobian and {p['hessian_entries']} in the Hessian's lower triangle. CasADi's is
`benchmarks/planner_casadi.py`, written from the formulation alone, with obstacles and predicted
state as parameters, as ours has them. From nothing to the first Hessian our problem takes
{1e3 * summary['setup_s']['median']:.1f} ms.

## One evaluation
{functions_markdown(summary['functions_us'])}

CasADi's C is called from C (`benchmarks/time_generated.c`), its virtual machine through its own
buffers, without conversion of data (about 0.1 µs of Python a call). *One function* gives all
results at once and shares their common subexpressions (CasADi's `cse`); *as Ipopt calls* is the sum
of `nlp_grad_f`, `nlp_jac_g` and `nlp_hess_l`, which is what its Ipopt interface evaluates. The ratio
is against the fastest CasADi column of the row; the peer's problem is one scalar graph, for the
form that maps one function over the nodes was about ten times slower. CasADi compiles
{summary['generated_mb']:.1f} MB of C for this one number of obstacles; ours compiles nothing. Called
over and over, straight-line code stays in the caches; how much functions cost within a solve, where
the linear solver has emptied them, is in the next table. At the guess all angles are zero, for which
scalar mathematics may return early.

## Solves
{solves_markdown(summary['solves'])}

Cold is the first cycle from the straight-on guess, the second time in its process; the first time
pays for code and memory too. A re-solve starts from the shifted last plan with its multipliers, as
far as the goal is out of range. The predicted states are those of a recorded drive (`benchmarks/cycles_E_C.json`),
the same for all. Times are wall clock, inside the solver's call; each cycle is solved once a round. Both
sides' Ipopt has the same options (those of the formulation's section 3) and MUMPS.

**Our Ipopt back end links Debian's Ipopt 3.11.9, which is known to be several times slower than the
3.14 of the CasADi wheel, and Debian's BLAS: it is a reference for answers, never the baseline of a
ratio.** Ratios above are against CasADi's own solves.

## Answers
{answers_markdown(summary['answers'])}

## Machine
{machine}
"""
