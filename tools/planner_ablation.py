#!/usr/bin/env python3
"""Drives P_E whole and with one part of it left out through the paper's sweep and random scenarios, and writes
what each part does to docs/measured/ablation.md. Standard library only.

    tools/planner_ablation.py [--program build/slalom] [--points 10] [--count 20] [--jobs 2]
"""

import statistics

from measured import command_of, page_parser, stamp, write
from random_scenarios import FAMILIES, TIMED_FAMILIES, arrivals, by_family, make_scenarios
from sweeps import arrives, head, interval, mcnemar, row
from verified_planner import REAL_TIME, number, paper_sweep, random_sweep

WHOLE = "whole"
# What is left out, under the name that it has in the tables, by the settings of the planner.
VARIANTS = {
    WHOLE: {},
    "no guidance": {"planner.guidance": "false"},
    "no rows between points": {"planner.rows_between": "false"},
    "no verification": {"planner.verification": "false"},
    "no fallback": {"planner.fallback": "false"},
    "one guided way": {"planner.ways": 1},
}
SEED, DIFFICULTY = 4, 0.6

HEAD = """# What each part of P_E does

{stamp}
[P_E](../verified-planner.md) whole, and with one part left out at a time by a setting of the planner
([scenario-reference.md](../scenario-reference.md)). All drive with `loop.deadline: tex` and
`loop.latency: measured`. Drives at a time: {jobs}.

"""


def of(trials):
    """Arrivals, crashes and other ends."""
    good, crashes = sum(map(arrives, trials)), sum(t["outcome"] == "crash" for t in trials)
    return good, crashes, len(trials) - good - crashes


def time_over(trials, whole):
    """The median of times to the goal over the whole planner's, where both arrive."""
    ratios = [float(trials[k]["goal_time_s"]) / float(whole[k]["goal_time_s"])
              for k in whole if arrives(trials[k]) and arrives(whole[k])]
    return number(statistics.median(ratios), 3) if ratios else "–"


def table(variants):
    """A row a variant; `variants`: trials by key, for each name."""
    whole = variants[WHOLE]
    text = head(["", "left out by", "drives", "arrive", "95 %", "crash", "other ends", "cycles", "unverified",
                 "time to the goal over the whole's, median", "the whole alone arrives", "this alone",
                 "p (McNemar)"])
    for name, trials in variants.items():
        every = list(trials.values())
        good, crashes, others = of(every)
        cells = [name, ", ".join(f"`{k}: {v}`" for k, v in VARIANTS[name].items()) or "–", len(every), good,
                 "{:.3f}–{:.3f}".format(*interval(good, len(every))), crashes, others,
                 sum(int(t["cycles"] or 0) for t in every), sum(int(t["failed_cycles"] or 0) for t in every)]
        if name == WHOLE:
            text += row([*cells, *"––––"])
            continue
        lost = sum(arrives(whole[k]) and not arrives(trials[k]) for k in whole)
        gained = sum(arrives(trials[k]) and not arrives(whole[k]) for k in whole)
        text += row([*cells, time_over(trials, whole), lost, gained, f"{mcnemar(lost, gained):.2g}"])
    return text


def page(swept, drawn, options, stamped):
    return (HEAD.format(stamp=stamped, jobs=options.jobs)
            + "## The paper's sweep\n\n"
            f"E_C, {options.points} execution horizons of .01 to 1 s, O2 coming at {options.points} speeds of up to "
            "40 m/s.\n\n" + table(swept)
            + f"\n## Random scenarios\n\nSeed {SEED}, difficulty {DIFFICULTY:g}, "
            f"{options.count} of each family.\n\n" + table(drawn)
            + "\nDrives that arrive:\n\n"
            + by_family(sorted(drawn[WHOLE]), FAMILIES + TIMED_FAMILIES, {name: arrivals(t) for name, t in drawn.items()}))


def main():
    parser = page_parser("ablation", __doc__)
    parser.add_argument("--points", type=int, default=10, help="on each axis of the sweep")
    parser.add_argument("--count", type=int, default=20, help="scenarios of each family")
    parser.add_argument("--jobs", type=int, default=2, help="drives at a time")
    options = parser.parse_args()
    folder = options.work / "scenarios"
    files = make_scenarios(options.program, folder, FAMILIES + TIMED_FAMILIES, options.count, SEED, DIFFICULTY)
    swept, drawn = {}, {}
    for number_of, (name, settings) in enumerate(VARIANTS.items()):
        settings = {**REAL_TIME, **settings}
        swept[name] = paper_sweep(options, f"sweep-{number_of}", "P_E", settings)
        drawn[name] = random_sweep(options, f"random-{number_of}", files, "P_E", settings)
    stamped = stamp(command_of(parser, options, "ablation", "points", "count", "jobs"), options.program)
    write(options.out, page(swept, drawn, options, stamped))


if __name__ == "__main__":
    main()
