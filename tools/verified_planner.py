#!/usr/bin/env python3
"""Drives P_E beside P_D through the paper's sweep and random scenarios, and writes counts, distances, times
to the goal and processor times to docs/measured/verified-planner.md. Standard library only.

    tools/verified_planner.py [--program build/slalom] [--most 125] [--points 20] [--jobs 2]
"""

import itertools
import re
import statistics
from typing import NamedTuple

from first_sight import saved
from measured import ROOT, command_of, page_parser, stamp, write
from random_scenarios import FAMILIES, TIMED_FAMILIES, arrivals, by_family, make_scenarios, sweep
from sweeps import (arrives, drive_folder, driven, head, interval, mcnemar, quantile, row, rows_of, setting, swept,
                    swept_thinly)

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

# Without a clock: the search, the ways and the looks for a better plan have so much more room that what is found is
# the best that this planner knows, driven by the true plant; the horizon is short, so that it may change its mind.
OFFLINE = {"loop.deadline": "off", "loop.latency": "paper", "loop.solve_time_limit": 600, "loop.tex": 0.1,
           "planner.search_places": 1_000_000, "planner.ways": 18, "planner.improvement_places": 300_000,
           "planner.improvement_time": 100, "planner.hysteresis": 0.001}
EVERY = 3  # of the sweep's speeds, one in so many is driven offline
RANGES = (90, 200)  # [m]; the paper's range in E_C is the first
RANGE_TEXES, RANGE_POINTS = (0.48,), 7

HEAD = """# The planner that verifies

{stamp}
[P_E](../verified-planner.md) beside P_D. P_E drives with `loop.deadline: tex` and `loop.latency: measured`; P_D as
the paper's planner does, by its defaults. Drives at a time: {jobs}.

"""

SWEEP = """title: the paper's sweep by {planner}
scenario: E_C
planners: [{planner}]
axes:
  - key: loop.tex
    range: {{from: 0.01, to: 1, count: {points}}}
  - key: obstacles.O2.vy
    range: {{from: 0, to: {fastest}, count: {points}}}
set: {settings}
keep: {keep}
"""
# Speeds of O2 up to which the grids go [m/s].
GRIDS = {-40: "O2 coming at up to 40 m/s", -20: "O2 coming at up to 20 m/s, as the paper's text says"}

BY_SPEED = """title: {title}
scenario: E_C
planners: [P_E]
axes:
  - key: obstacles.O2.vy
    values: {speeds}
set: {settings}
"""

BY_RANGE = """title: P_E that sees so far
scenario: E_C
planners: [P_E]
axes:
  - key: planner.L_range
    values: {ranges}
  - key: loop.tex
    values: {texes}
  - key: obstacles.O2.vy
    range: {{from: 0, to: -40, count: {points}}}
set: {settings}
"""


def number(value, digits):
    return f"{value:.{digits}f}"


def settings_of(planner):
    return REAL_TIME if planner == "P_E" else {}


def studied(options, name, text):
    """Runs or completes a study; its trials."""
    study = options.work / f"{name}.yaml"
    study.write_text(text)
    return swept(options.program, study, options.work / name, "--jobs", str(options.jobs))


def by_axes(trials):
    return {(t["loop.tex"], t["obstacles.O2.vy"]): t for t in trials}


def paper_sweep(options, name, planner, settings, fastest=min(GRIDS)):
    """Runs or completes the paper's sweep under a name; its trials by horizon and speed of O2."""
    text = SWEEP.format(planner=planner, points=options.points, fastest=fastest, settings=setting(settings),
                        keep="figures")
    return by_axes(studied(options, name, text))


def timed_sweep(options, name, fastest):
    """P_E's sweep; its trials, and the rows of each one's cycles.csv, by horizon and speed of O2."""
    study, out = options.work / f"{name}.yaml", options.work / name
    study.write_text(SWEEP.format(planner="P_E", points=options.points, fastest=fastest, settings=setting(REAL_TIME),
                                  keep="drives"))
    trials = swept_thinly(options.program, study, out, options.points**2, lambda trial: ("cycles.csv",),
                          "--jobs", str(options.jobs))
    cycles = {key: rows_of(drive_folder(out, trial) / "cycles.csv") if trial["outcome"] != "failed" else []
              for key, trial in by_axes(trials).items()}
    return by_axes(trials), cycles


def offline_times(options, speeds):
    """The time to the goal of the best drive found without a clock, by each speed of O2 at which it arrives, and that of
    an empty road."""
    text = BY_SPEED.format(title="the best drive found offline", speeds=speeds, settings=setting(OFFLINE))
    times = {float(t["obstacles.O2.vy"]): float(t["goal_time_s"])
             for t in studied(options, "offline", text) if arrives(t)}  # fmt: skip
    scenario = (ROOT / "config/scenarios/E_C.yaml").read_text()
    road = options.work / "empty-road.yaml"
    road.write_text(re.sub(r"(?m)^obstacles:\n(  .*\n)+", "", scenario).replace("name: E_C", "name: empty-road"))
    empty, _ = driven(options.program, road, "P_E", OFFLINE)
    return times, empty["goal_time_s"]


def random_sweep(options, name, files, planner, settings):
    """Runs or completes a sweep of scenarios; its trials by scenario."""
    trials = sweep(options.program, options.work, name, files, [planner], settings, "--jobs", str(options.jobs))
    return {scenario: trial for (scenario, _), trial in trials.items()}


def ladder(every):
    """How many cycles drove a new plan, the rest of the last and the least bad."""
    counts = [sum(int(t[rung]) for t in every) for rung in ("new_plans", "rests", "least_bads")]
    return ", ".join(map(str, counts)) if any(counts) else "–"


def totals(trials):
    """A row for each planner; `trials`: by key, for each planner."""
    text = head(["", "drives", "arrive", "95 %", "crash", "other ends", "cycles", "unverified or unsolved",
                 "of the ladder: new, rest, least bad", "least distance beyond the margin [m]", "least wheel load [N]"])
    for planner, of_key in trials.items():
        every = list(of_key.values())
        good = sum(map(arrives, every))
        crashes = sum(t["outcome"] == "crash" for t in every)
        there = [t for t in every if arrives(t)]
        text += row([planner, len(every), good, "{:.3f}–{:.3f}".format(*interval(good, len(every))), crashes,
                     len(every) - good - crashes, sum(int(t["cycles"]) for t in every),
                     sum(int(t["failed_cycles"]) for t in every), ladder(every),
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


def real_time(trials, cycles):
    """Processor time and time by the clock of P_E's cycles beside the horizon, by horizon: of all cycles of its drives."""
    text = head(["tex [s]", "drives", "arrive", "cycles", "median of a cycle [ms]", "99 % [ms]", "longest [ms]",
                 "longest over tex", "mean over tex", "by the clock: longest over tex", "by the clock: mean over tex"])
    for tex, group in itertools.groupby(trials, key=lambda key: key[0]):
        keys = list(group)
        own = [row for key in keys for row in cycles[key]]
        cpu, clock = ([float(row[column]) for row in own] for column in ("planning_cpu_s", "solve_time_s"))
        horizon = float(tex)
        text += row([f"{horizon:.4g}", len(keys), sum(arrives(trials[key]) for key in keys), len(own),
                     *(number(1e3 * quantile(cpu, share), digits) for share, digits in ((0.5, 2), (0.99, 1), (1, 1))),
                     *(number(value / horizon, digits) for times in (cpu, clock)
                       for value, digits in ((max(times), 2), (statistics.mean(times), 4)))])
    return text


def beside_offline(options, trials):
    """Times to the goal beside those of an offline search, for drives that P_D does and does not end at the goal."""
    speeds = sorted({float(key[1]) for key in trials["P_E"]})[::EVERY]
    best, empty = offline_times(options, speeds)
    text = ("### Beside an offline search\n\nThe same planner without a clock, with more places and more ways "
            f"(`{setting(OFFLINE)}`), drives the best way it finds on the true plant, at {len(speeds)} speeds of O2: an upper "
            "bound on the least time. The same without any obstacle bounds it from below, as far as its OCP finds the "
            f"optimum: {empty:.2f} s. Of the offline drives {len(speeds) - len(best)} do not arrive; drives at their speeds of "
            "O2 are left out.\n\n")
    text += head(["", "drives", "over the offline drive: least", "median", "greatest",
                  "over the empty road: median", "greatest"])
    for title, good in (("P_D arrives too", True), ("P_D does not", False)):
        own = [(float(t["goal_time_s"]), best[float(key[1])]) for key, t in trials["P_E"].items()
               if float(key[1]) in best and arrives(t) and arrives(trials["P_D"][key]) == good]
        if not own:
            continue
        beside = sorted(time / bound for time, bound in own)
        alone = sorted(time / empty for time, _ in own)
        text += row([title, len(own), number(beside[0], 3), number(statistics.median(beside), 3), number(beside[-1], 3),
                     number(statistics.median(alone), 3), number(alone[-1], 3)])
    return text


def by_range(options):
    """P_E told of what lies within a range alone."""
    settings = REAL_TIME | {"planner.known": "range"}
    text = ("\n## By range\n\nP_E in E_C by `known: range`: it learns of an obstacle when that is as near as `L_range`, and "
            "takes it that anything may stand beyond (`unseen: standing`) or nothing does (`nothing`). Each at "
            f"tex of {', '.join(map(str, RANGE_TEXES))} s and {RANGE_POINTS} speeds of O2.\n\n"
            + head(["unseen", "range [m]", "drives", "arrive", "crash", "other ends", "unverified cycles",
                    "median time to the goal [s]"]))
    lost = ""
    for unseen in ("standing", "nothing"):
        study = BY_RANGE.format(ranges=list(RANGES), texes=list(RANGE_TEXES), points=RANGE_POINTS,
                                settings=setting(settings | {"planner.unseen": unseen}))
        trials = studied(options, f"range-{unseen}", study)
        for far in RANGES:
            own = [t for t in trials if float(t["planner.L_range"]) == far]
            there = [t for t in own if arrives(t)]
            crashes = sum(t["outcome"] == "crash" for t in own)
            text += row([unseen, far, len(own), len(there), crashes, len(own) - len(there) - crashes,
                         sum(int(t["failed_cycles"]) for t in own),
                         number(statistics.median(float(t["goal_time_s"]) for t in there), 1) if there else "–"])
            for t in (t for t in own if not arrives(t)):
                lost += f"- {unseen}, {far} m, tex {t['loop.tex']}, vy {float(t['obstacles.O2.vy']):.4g}: {t['message']}"
                lost += first_sight(options, t, settings | {"planner.unseen": unseen})
    return text + (f"\nThese do not arrive. A crash is followed by what becomes of the vehicle's state where the "
                   "first plan begins that knows of what is hit, when all is known from there on and a way is searched for "
                   "without a clock, as offline above.\n\n" + lost if lost else "\nAll arrive.\n")


def first_sight(options, trial, settings):
    """What is said of a crash: whether a way was there once the obstacle was seen."""
    if trial["outcome"] != "crash":
        return "\n"
    keys = ("planner.L_range", "loop.tex", "obstacles.O2.vy")
    found = saved(options.program, ROOT / "config/scenarios/E_C.yaml", settings | {k: trial[k] for k in keys}, trial["hit"],
                  OFFLINE | {"planner.known": "all"})
    if found is None:
        return "; hit before such a plan begins\n"
    moment, outcome = found
    return f"; from {moment:.2f} s: {'a way to the goal' if outcome == 'goal' else f'no way found, {outcome}'}\n"


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
    parser.add_argument("--jobs", type=int, default=2, help="drives at a time")
    options = parser.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    command = command_of(parser, options, "verified-planner", "most", "points", "jobs")
    text = HEAD.format(stamp=stamp(command, options.program), jobs=options.jobs)
    text += "## The paper's sweep\n\nE_C, execution horizons of .01 to 1 s.\n"
    for fastest, title in GRIDS.items():
        trials = {"P_D": paper_sweep(options, f"sweep{fastest}-P_D", "P_D", {}, fastest)}
        trials["P_E"], cycles = timed_sweep(options, f"sweep{fastest}-P_E", fastest)
        text += (f"\n### {title[0].upper()}{title[1:]}\n\n" + totals(trials) + "\n" + compared(trials) + "\n"
                 + others(trials) + "\n" + real_time(trials["P_E"], cycles))
        if fastest == min(GRIDS):
            text += "\n" + beside_offline(options, trials)
    text += by_range(options)
    for families, count, seed, difficulty in SETS:
        folder = options.work / f"scenarios-{seed}"
        files = make_scenarios(options.program, folder, families, min(count, options.most), seed, difficulty)
        trials = {p: random_sweep(options, f"random-{seed}-{p}", files, p, settings_of(p)) for p in PLANNERS}
        families_table = by_family(sorted(trials["P_E"]), families, {p: arrivals(trials[p]) for p in PLANNERS})
        text += (f"\n## Random scenarios, seed {seed}, difficulty {difficulty:g}\n\n" + totals(trials) + "\n"
                 + compared(trials) + "\n" + families_table + "\n" + others(trials))
    write(options.out, text)


if __name__ == "__main__":
    main()
