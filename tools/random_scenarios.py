#!/usr/bin/env python3
"""Sweeps random scenarios of eight families with the planners P_A to P_D, at several execution horizons,
and writes the counts and their paired comparison to docs/measured/random-scenarios.md. Standard library
only.

    tools/random_scenarios.py [--program build/slalom] [--count 125] [--seed 1] [--difficulty 0.5]
"""

import collections
import itertools
import subprocess

from measured import command_of, page_parser, stamp, write
from sweeps import arrives, head, interval, mcnemar, row, setting, swept, table

PLANNERS = ("P_A", "P_B", "P_C", "P_D")
# Those that this page measures, and those that came later, in which the way is a matter of time.
FAMILIES = ("static_field", "moving_field", "crossing", "oncoming", "slalom", "double_lane_change",
            "gates", "dead_ends")
TIMED_FAMILIES = ("two_oncoming", "overtaking", "crossing_at_rest")
# What else is tried of P_D, and under which name it stands in the tables.
VARIANTS = {"P_D": {}, "tex .1 s": {"loop.tex": 0.1},
            "N 40": {"planner.N": 40}, "N 40, range 90 m": {"planner.N": 40, "planner.L_range": 90}}

HEAD = """# Random scenarios

{stamp}
`slalom make-scenarios FAMILY --count N --seed S --difficulty D --out DIR` makes scenarios of a family
(`--help` lists them). The same numbers give the same files. Each has a way from start to goal that a
vehicle could drive: a search (hybrid A*, Dolgov et al. 2010) over place, heading, speed, curvature and
time finds one at 3 to 25 m/s, with at most 4 m/s² to the side, 1.5 forward and 3.5 back, the steering
no faster than the vehicle's 5°/s, 2.5 m off every obstacle where it is by then. Draws without one
are drawn again. The search knows all obstacles from the start; a planner knows those in the range
of its LiDAR as far as its plan reaches them.

"""

def make_scenarios(program, folder, families, count, seed, difficulty):
    """The files of `count` scenarios of each family; what else is in the folder, of a larger count, is none of them."""
    for family in families:
        subprocess.run([program, "make-scenarios", family, "--quiet", "--force", "--out", folder, "--count",
                        str(count), "--seed", str(seed), "--difficulty", str(difficulty)], check=True)
    return [folder / f"{family}-{index:04}.yaml" for family in families for index in range(1, count + 1)]


def sweep(program, work, name, files, planners, settings, *arguments):
    """Runs or completes a sweep; its trials by scenario and planner."""
    study = work / f"{name}.yaml"
    listed = "".join(f"  - {file.resolve()}\n" for file in sorted(files))
    study.write_text(f"title: random scenarios, {name}\nscenarios:\n{listed}"
                     f"planners: [{', '.join(planners)}]\nset: {setting(settings)}\n")
    return {(t["scenario"], t["planner"]): t for t in swept(program, study, work / name, *arguments)}


def of_family(family, scenarios):
    return [s for s in scenarios if s.rsplit("-", 1)[0] == family]


def by_family(scenarios, families, columns):
    """A table with a row a family; `columns`: what is said of a list of scenarios, by name."""
    return table(["family", *columns],
                 ([family, *(say(of_family(family, scenarios)) for say in columns.values())] for family in families))


def arrivals(trials):
    """How many of a list of scenarios arrive; `trials`: by scenario."""
    return lambda own: f"{sum(arrives(trials[s]) for s in own)}/{len(own)}"


def shares(columns, scenarios):
    """A row a family of how many arrive, and rows of all; `columns`: trials by scenario, for each name."""
    def share(trials):
        return "{:.3f}–{:.3f}".format(*interval(sum(arrives(trials[s]) for s in scenarios), len(scenarios)))
    text = by_family(scenarios, FAMILIES, {name: arrivals(trials) for name, trials in columns.items()})
    text += row(["all", *(arrivals(trials)(scenarios) for trials in columns.values())])
    return text + row(["95 % of the share", *map(share, columns.values())])


def ends(columns):
    text = head(["", "goal", "crash", "not_optimal", "others"])
    for name, trials in columns.items():
        count = collections.Counter(trial["outcome"] for trial in trials.values())
        named = [count.pop(kind, 0) for kind in ("goal", "crash", "not_optimal")]
        text += row([name, *named, sum(count.values())])
    return text


def pairs(columns, wanted, scenarios):
    text = head(["pair", "both", "the first alone", "the second alone", "p (McNemar)"])
    for one, two in wanted:
        first = [arrives(columns[one][s]) for s in scenarios]
        second = [arrives(columns[two][s]) for s in scenarios]
        both = sum(a and b for a, b in zip(first, second))
        only1 = sum(a and not b for a, b in zip(first, second))
        only2 = sum(b and not a for a, b in zip(first, second))
        text += row([f"{one}, {two}", both, only1, only2, f"{mcnemar(only1, only2):.2g}"])
    return text


def never(columns, scenarios):
    """The families in which no drive of any column arrives."""
    families = [family for family in FAMILIES if not any(
        arrives(trials[s]) for trials in columns.values() for s in of_family(family, scenarios))]
    return f"Families in which none of these arrives: {', '.join(families) or 'none'}.\n"


def page(planners, variants, scenarios, options, stamped):
    return (HEAD.format(stamp=stamped) + f"{len(scenarios)} scenarios, {options.count} of each family in the table, seed {options.seed}, "
            f"difficulty {options.difficulty:g}, else by default settings. Drives that arrive:\n\n"
            + shares(planners, scenarios) + "\n" + never(planners, scenarios)
            + "\nHow they ended:\n\n" + ends(planners)
            + "\nPaired on the scenarios, by McNemar's exact test:\n\n"
            + pairs(planners, itertools.combinations(PLANNERS, 2), scenarios)
            + "\nP_D, with other settings:\n\n" + shares(variants, scenarios) + "\n"
            + pairs(variants, [("P_D", name) for name in variants if name != "P_D"], scenarios)
            + "\n" + never(variants, scenarios))


def main():
    parser = page_parser("random-scenarios", __doc__)
    parser.add_argument("--count", type=int, default=125, help="of each family")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--difficulty", type=float, default=0.5)
    options = parser.parse_args()
    folder = options.work / "scenarios"
    files = make_scenarios(options.program, folder, FAMILIES, options.count, options.seed, options.difficulty)
    scenarios = sorted(file.stem for file in files)
    trials = sweep(options.program, options.work, "planners", files, PLANNERS, {})
    planners = {p: {s: trials[s, p] for s in scenarios} for p in PLANNERS}
    variants = {"P_D": planners["P_D"]}
    for number, (name, settings) in enumerate(VARIANTS.items()):
        if settings:
            trials = sweep(options.program, options.work, f"variant-{number}", files, ["P_D"], settings)
            variants[name] = {s: trials[s, "P_D"] for s in scenarios}
    command = command_of(parser, options, "random-scenarios", "count", "seed", "difficulty")
    write(options.out, page(planners, variants, scenarios, options, stamp(command, options.program)))


if __name__ == "__main__":
    main()
