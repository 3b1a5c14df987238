#!/usr/bin/env python3
"""Runs the study `latency` and writes its table, docs/measured/latency.md. Standard library only.

    tools/latency.py [--program build/slalom]
"""

import json

from measured import page_parser, stamp, write
from sweeps import head, row, swept

PAGE = """# When plans take effect

{stamp}
What the rules of `loop.latency` ([studies.md](../studies.md#latency-rules)) do to the pass rate: P_D in the
paper's E_C, O2 at {speeds} speeds from {first:g} to {last:g} m/s, by `slalom sweep latency`. Where a solve
yields no plan, the last one runs on. What a plan is charged:

- `instant`: nothing, and nothing is predicted: a plan takes effect at once.
- `paper`: tex, however long its solve takes.
- `measured`: its own solve time, on this machine {longest:.1f} ms or less, tex at least.
- `recorded`: {recorded:g} s, tex at least.
- `model`: a draw from a lognormal distribution of median {median:g} s and spread {spread:g}, tex at least.

At the goal, of {speeds} speeds:

{table}
{findings}"""


def arrive(trials):
    return sum(t["outcome"] == "goal" for t in trials)


def of(trials):
    return f"{arrive(trials)} of {len(trials)}"


def table(rules, texs, trials):
    text = head(["rule", *(f"tex {tex} s" for tex in texs), "all"])
    for rule in rules:
        own = [t for t in trials if t["loop.latency"] == rule]
        passed = [arrive(t for t in own if t["loop.tex"] == tex) for tex in texs]
        text += row([f"`{rule}`", *passed, of(own)])
    return text


def findings(trials, charged):
    """How each rule's drives end beside those of `paper`, and what a charge does to short horizons."""
    by_rule = {}
    for t in trials:
        by_rule.setdefault(t["loop.latency"], {})[t["loop.tex"], t["obstacles.O2.vy"]] = t
    lines = []
    for rule, own in by_rule.items():
        if rule != "paper":
            alike = sum(t["outcome"] == by_rule["paper"][key]["outcome"] for key, t in own.items())
            lines.append(f"- `{rule}`: {alike} of {len(own)} drives end as those of `paper` do.")
    for rule in ("paper", "recorded"):
        short = [t for t in by_rule[rule].values() if float(t["loop.tex"]) < charged]
        rest = [t for t in by_rule[rule].values() if float(t["loop.tex"]) >= charged]
        lines.append(f"- `{rule}` arrives in {of(short)} at horizons shorter than {charged:g} s, and in {of(rest)} "
                     "at the others.")
    return "\n".join(lines) + "\n"


def page(trials, stamped):
    (recorded,), = {tuple(json.loads(t["loop.solve_times"])) for t in trials}
    speeds = list(dict.fromkeys(float(t["obstacles.O2.vy"]) for t in trials))
    rules, texs = (list(dict.fromkeys(t[key] for t in trials)) for key in ("loop.latency", "loop.tex"))
    longest = max(float(t["max_solve_time_s"] or 0) for t in trials if t["loop.latency"] == "measured")
    return PAGE.format(
        stamp=stamped, speeds=len(speeds), first=speeds[0], last=speeds[-1], longest=1e3 * longest,
        recorded=recorded, median=float(trials[0]["loop.latency_median"]),
        spread=float(trials[0]["loop.latency_spread"]), table=table(rules, texs, trials),
        findings=findings(trials, recorded))


def main():
    options = page_parser("latency", __doc__).parse_args()
    trials = swept(options.program, "latency", options.work)
    write(options.out, page(trials, stamp("make latency", options.program)))


if __name__ == "__main__":
    main()
