#!/usr/bin/env python3
"""Drives P_E beside P_D through the paper's sweep and random scenarios, and writes counts, distances, times
to the goal and processor times to docs/measured/verified-planner.md. Standard library only.

    tools/verified_planner.py [--program build/slalom] [--most 125] [--points 20]
"""

import itertools
import statistics
from typing import NamedTuple

from measured import command_of, page_parser, stamp, write
from random_scenarios import FAMILIES, TIMED_FAMILIES, make_scenarios, of_family, sweep
from sweeps import head, interval, mcnemar, row, setting, swept

PLANNERS = ("P_D", "P_E")
# As it would be on a vehicle: a cycle ends within its horizon, and what planning takes is charged.
REAL_TIME = {"loop.deadline": "tex", "loop.latency": "measured"}


class Set(NamedTuple):
    """Random scenarios."""

    families: tuple
    count: int  # of each family
    seed: int
    difficulty: float


# No other tool, test or study names the third one's seed.
SETS = (Set(FAMILIES, 125, 1, 0.5), Set(FAMILIES, 125, 2, 0.8), Set(FAMILIES, 40, 2718, 0.65),
        Set(TIMED_FAMILIES, 100, 3, 0.6))

HEAD = """# The planner that verifies

{stamp}
[P_E](../verified-planner.md) beside P_D. P_E drives with `loop.deadline: tex` and `loop.latency: measured`; P_D as
the paper's planner does, by its defaults. Two drives at a time.

"""

SWEEP = """title: the paper's sweep by {planner}
scenario: E_C
planners: [{planner}]
axes:
  - key: loop.tex
    range: {{from: 0.01, to: 1, count: {points}}}
  - key: obstacles.O2.vy
    range: {{from: 0, to: -40, count: {points}}}
set: {settings}
"""


def number(value, digits):
    return f"{value:.{digits}f}"


def settings_of(planner):
    return REAL_TIME if planner == "P_E" else {}


def paper_sweep(options, name, planner, settings):
    """Runs or completes the paper's sweep; its trials by horizon and speed of O2."""
    study = options.work / f"{name}.yaml"
    study.write_text(SWEEP.format(planner=planner, points=options.points, settings=setting(settings)))
    return {(t["loop.tex"], t["obstacles.O2.vy"]): t
            for t in swept(options.program, study, options.work / name)}


def random_sweep(options, name, folder, planner, settings):
    """Runs or completes a sweep of the scenarios in `folder`; its trials by scenario."""
    trials = sweep(options.program, options.work, name, folder, [planner], settings)
    return {scenario: trial for (scenario, _), trial in trials.items()}


def arrives(trial):
    return trial["outcome"] == "goal"


def totals(trials):
    """A row a planner; `trials`: by key, for each planner."""
    text = head(["", "drives", "arrive", "95 %", "crash", "other ends", "cycles", "unverified or unsolved",
                 "least distance beyond the margin [m]", "least wheel load [N]"])
    for planner, of_key in trials.items():
        every = list(of_key.values())
        good = sum(map(arrives, every))
        crashes = sum(t["outcome"] == "crash" for t in every)
        there = [t for t in every if arrives(t)]
        text += row([planner, len(every), good, "{:.3f}–{:.3f}".format(*interval(good, len(every))), crashes,
                     len(every) - good - crashes, sum(int(t["cycles"]) for t in every),
                     sum(int(t["failed_cycles"]) for t in every),
                     number(min(float(t["least_clearance_m"] or "inf") for t in there), 3) if there else "–",
                     number(min(float(t["least_wheel_load_N"]) for t in there), 0) if there else "–"])
    return text


def compared(trials):
    """Times to the goal where both arrive, and pairs of drives."""
    both = [key for key in trials["P_D"] if all(arrives(trials[p][key]) for p in PLANNERS)]
    only = [sum(arrives(trials[p][k]) and not arrives(trials[q][k]) for k in trials[p])
            for p, q in (PLANNERS, PLANNERS[::-1])]
    ratio = sorted(float(trials["P_E"][k]["goal_time_s"]) / float(trials["P_D"][k]["goal_time_s"]) for k in both)
    text = (f"Both arrive in {len(both)}, P_D alone in {only[0]}, P_E alone in {only[1]} (McNemar's exact test: "
            f"p = {mcnemar(*only):.2g}).")
    if ratio:
        text += (f" Where both do, P_E's time to the goal over P_D's: least {ratio[0]:.3f}, "
                 f"median {statistics.median(ratio):.3f}, greatest {ratio[-1]:.3f}.")
    return text + "\n"


def real_time(trials):
    """Processor time of P_E's cycles beside the horizon, by horizon."""
    text = head(["tex [s]", "drives", "arrive", "median of a cycle [ms]", "longest [ms]", "longest over tex"])
    for tex, group in itertools.groupby(trials.items(), key=lambda item: item[0][0]):
        own = [t for _, t in group]
        longest = max(float(t["max_cpu_time_s"]) for t in own)
        text += row([f"{float(tex):.4g}", len(own), sum(map(arrives, own)),
                     number(1e3 * statistics.median(float(t["median_cpu_time_s"]) for t in own), 2),
                     number(1e3 * longest, 1), number(longest / float(tex), 2)])
    return text


def by_family(trials, families):
    text = head(["family", *PLANNERS])
    scenarios = sorted(trials["P_E"])
    for family in families:
        own = of_family(family, scenarios)
        text += row([family, *(f"{sum(arrives(trials[p][s]) for s in own)}/{len(own)}" for p in PLANNERS)])
    return text


def others(trials):
    """Each drive of P_E that does not arrive, by name and message."""
    lost = [(s, t) for s, t in trials["P_E"].items() if not arrives(t)]
    if not lost:
        return "P_E arrives in every one.\n"
    return "P_E does not arrive in:\n\n" + "".join(
        f"- {s if isinstance(s, str) else 'tex {}, vy {}'.format(*s)}: {t['message']}\n" for s, t in lost)


def main():
    parser = page_parser("verified-planner", __doc__)
    parser.add_argument("--most", type=int, default=max(s.count for s in SETS), help="scenarios of a family and set")
    parser.add_argument("--points", type=int, default=20, help="on each axis of the sweep")
    options = parser.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    trials = {p: paper_sweep(options, f"sweep-{p}", p, settings_of(p)) for p in PLANNERS}
    text = HEAD.format(stamp=stamp(command_of(parser, options, "verified-planner", "most", "points"), options.program))
    text += ("## The paper's sweep\n\nE_C, execution horizons of .01 to 1 s, O2 coming at up to 40 m/s.\n\n"
             + totals(trials) + "\n" + compared(trials) + "\n" + others(trials) + "\n" + real_time(trials["P_E"]))
    for families, count, seed, difficulty in SETS:
        folder = options.work / f"scenarios-{seed}"
        make_scenarios(options.program, folder, families, min(count, options.most), seed, difficulty)
        trials = {p: random_sweep(options, f"random-{seed}-{p}", folder, p, settings_of(p)) for p in PLANNERS}
        text += (f"\n## Random scenarios, seed {seed}, difficulty {difficulty:g}\n\n" + totals(trials) + "\n"
                 + compared(trials) + "\n" + by_family(trials, families) + "\n" + others(trials))
    write(options.out, text)


if __name__ == "__main__":
    main()
