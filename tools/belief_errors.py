#!/usr/bin/env python3
"""Drives P_E through random scenarios in which plant and sensors differ from what it believes in all that
sensitivity.py knows of at once, at three levels, and writes how the drives end to docs/measured/belief-errors.md,
with each crash in belief-errors.csv. Standard library only.

    tools/belief_errors.py [--program build/slalom] [--drives 10000]
"""

import csv
import io
import json
import math
import random
import re
import statistics
from typing import NamedTuple

from measured import command_of, page_parser, stamp, write
from random_scenarios import FAMILIES, TIMED_FAMILIES, arrivals, by_family, make_scenarios
from sensitivity import QUANTITIES
from sweeps import arrives, drive_folder, head, interval, row, setting, swept_thinly
from verified_planner import REAL_TIME, number

LEVELS = {"small": 0.1, "medium": 0.5, "large": 1.0}  # shares of the ranges
SEED, DIFFICULTY = 5, 0.6
ALL_FAMILIES = FAMILIES + TIMED_FAMILIES
MOST_LISTED = 20  # crashes of a level on the page
ROUNDING = 1e-6  # of what a certificate keeps [m]

HEAD = """# Errors of belief, all at once

{stamp}
P_E on random scenarios of {families} families (seed {seed}, difficulty {difficulty:g}), with `loop.deadline: tex`
and `loop.latency: measured`. In each drive, plant and sensors differ from what the planner believes in all of these
quantities at once ([formulation.md](../formulation.md), section 4). Each is drawn by itself, for each scenario anew,
evenly from its range. A level is a share of all ranges; but for it, the draws of a scenario are the same at every level.
Noise has a seed of its own in each scenario.

"""

VERIFIED = """
*Verified*: the plan that was driven at the crash had a certificate, which holds for a vehicle and obstacles that are as
believed ([verified-planner.md](../verified-planner.md)). It proves a distance (*kept*) beyond the edge of a crash. The
program measures at each such crash how far the vehicle was from where its plan has it (*off plan*) and the obstacle from
where it was believed (*off belief*), by the points that are farthest off. By the triangle's inequality a crash needs off
plan + off belief >= kept. Where the sum is less, the certificate was wrong.

"""


# --- the draws ----------------------------------------------------------------------------------


def reach(quantity):
    """How far below and above its neutral value a quantity may be at the full range: the middle of the values
    that sensitivity.py tries on a side."""
    return tuple(values[(len(values) - 1) // 2] - quantity.neutral if values else 0.0
                 for values in (quantity.below, quantity.above))


def drawn(scenario):
    """A share of its range for each quantity, from -1 to 1, and a seed for noise; of the scenario alone."""
    dice = random.Random(f"{SEED} {scenario}")
    shares = {q.key: dice.uniform(-1 if q.below else 0, 1) for q in QUANTITIES}
    return shares, dice.randrange(2**31)


def errors(shares, level):
    """The values of the quantities at a level."""
    found = {}
    for q in QUANTITIES:
        below, above = reach(q)
        share = shares[q.key] * LEVELS[level]
        found[q.key] = q.neutral + (share * above if share >= 0 else -share * below)
    return found


def with_errors(text, scenario, level):
    """The file of a scenario, which states every setting, with a plant and sensors that are not as believed."""
    shares, seed = drawn(scenario)
    for key, value in {**errors(shares, level), "sensing.noise_seed": seed}.items():
        section, name = key.split(".")
        text, found = re.subn(rf"(?m)(^{section}:\n(?:  .*\n)*?  {name}: ).*$", rf"\g<1>{value}", text)
        if found != 1:
            raise ValueError(f"{scenario}: found {key} {found} times, expected it once")
    return text


# --- the drives ---------------------------------------------------------------------------------


def write_files(options, level, plain):
    """The scenarios of a level, and the study that drives them by P_E."""
    folder = options.work / f"scenarios-{level}"
    folder.mkdir(parents=True, exist_ok=True)
    files = [folder / file.name for file in plain]
    for file, text in zip(files, (file.read_text() for file in plain)):
        file.write_text(with_errors(text, file.stem, level))
    study = options.work / f"{level}.yaml"
    lines = [f"title: errors of belief, {level}", "scenarios:", *(f"  - {file.resolve()}" for file in files),
             "planners: [P_E]", f"set: {setting(REAL_TIME)}", "keep: drives"]  # fmt: skip
    study.write_text("\n".join(lines) + "\n")
    return study


def drive_level(options, level, plain):
    """Runs or completes the drives of a level; its trials by scenario, and by scenario what is known of a crash."""
    study, out = write_files(options, level, plain), options.work / level
    trials = swept_thinly(options.program, study, out, len(plain),
                          lambda trial: ("summary.json",) if trial["outcome"] == "crash" else ())
    verified = {}
    for trial in trials:
        if trial["outcome"] == "crash":
            summary = json.loads((drive_folder(out, trial) / "summary.json").read_text())
            verified[trial["scenario"]] = crash_of(summary)
    return {t["scenario"]: t for t in trials}, verified


class Crash(NamedTuple):
    """What is known of a crash; without a verified plan, nothing else [m]."""

    verified: bool  # the plan that was driven
    kept: float = math.nan  # what its certificate keeps beyond the edge of a crash
    off_plan: float = math.nan  # how far the vehicle was from where that plan has it
    off_belief: float = math.nan  # and the obstacle from where it was believed; inf if it was not known

    def by_wrong_certificate(self):
        """All was so near to what was believed that nothing is hit."""
        return self.verified and self.off_plan + self.off_belief < self.kept - ROUNDING

    def by_vehicle(self):
        """The vehicle alone was farther off than what was kept."""
        return self.verified and self.off_plan >= self.kept


def crash_of(summary):
    """By a drive's summary.json."""
    found = summary.get("verified_crash")
    if not found:
        return Crash(False)
    belief = found["off_belief_m"]
    return Crash(True, found["kept_m"], found["off_plan_m"], math.inf if belief is None else belief)


# --- the page -----------------------------------------------------------------------------------


def ranges_table():
    text = head(["quantity", "unit", "neutral", *(f"{level}: {share:g} of the range" for level, share in LEVELS.items())])
    for q in QUANTITIES:
        below, above = reach(q)
        text += row([f"`{q.key}`", q.unit, f"{q.neutral:g}",
                     *(f"{q.neutral + share * below:g} to {q.neutral + share * above:g}" for share in LEVELS.values())])
    return text


def levels_table(trials, verified):
    text = head(["level", "drives", "arrive", "95 %", "crash", "of these verified", "of these by a wrong certificate",
                 "the vehicle alone off by more", "other ends",
                 "least distance beyond the 2 m of those that arrive [m]"])
    for level, of_scenario in trials.items():
        every = list(of_scenario.values())
        there = [t for t in every if arrives(t)]
        least = min((float(t["least_clearance_m"] or "inf") for t in there), default=None)
        text += row([level, len(every), len(there), "{:.4f}–{:.4f}".format(*interval(len(there), len(every))),
                     len(verified[level]), sum(c.verified for c in verified[level].values()),
                     sum(c.by_wrong_certificate() for c in verified[level].values()),
                     sum(c.by_vehicle() for c in verified[level].values()),
                     len(every) - len(there) - len(verified[level]), "–" if least is None else number(least, 3)])
    return text


def families_table(trials):
    def crashed(of_scenario):
        return lambda own: sum(of_scenario[s]["outcome"] == "crash" for s in own)
    columns = {f"{level}: arrive": arrivals(of_scenario) for level, of_scenario in trials.items()}
    columns |= {f"{level}: crash": crashed(of_scenario) for level, of_scenario in trials.items()}
    return by_family(list(trials["small"]), ALL_FAMILIES, columns)


def shares_table(trials):
    """Which errors go with crashes: the share of its range, without sign, in those that crash and the others."""
    text = head(["quantity", *(f"{level}: {kind}" for level in trials for kind in ("crash", "others"))])
    for q in QUANTITIES:
        cells = []
        for of_scenario in trials.values():
            for crash in (True, False):
                sizes = [abs(drawn(s)[0][q.key]) for s, t in of_scenario.items() if (t["outcome"] == "crash") == crash]
                cells.append(number(statistics.mean(sizes), 2) if sizes else "–")
        text += row([f"`{q.key}`", *cells])
    return text


def metres(crash):
    return [number(value, 2) if crash.verified else "–" for value in (crash.kept, crash.off_plan, crash.off_belief)]


def listed(trials, verified):
    """The crashes of each level, those of verified plans first; the whole list is the table of crashes()."""
    text = ""
    for level, of_scenario in verified.items():
        text += f"\n### {level.capitalize()}\n\n"
        if not of_scenario:
            text += "None.\n"
            continue
        first = sorted(of_scenario, key=lambda s: (not of_scenario[s].verified, s))
        text += head(["scenario", "verified", "kept [m]", "off plan [m]", "off belief [m]", "how it ended", "errors"])
        for scenario in first[:MOST_LISTED]:
            values = errors(drawn(scenario)[0], level)
            crash = of_scenario[scenario]
            text += row([scenario, "yes" if crash.verified else "no", *metres(crash), trials[level][scenario]["message"],
                         ", ".join(f"{key.split('.')[1]} {value:.3g}" for key, value in values.items())])
        if len(first) > MOST_LISTED:
            text += f"\nAnd {len(first) - MOST_LISTED} more.\n"
    return text


def crashes(trials, verified):
    """A row for each crash: level, scenario, whether its plan was verified, how it ended, and the errors."""
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(["level", "scenario", "verified", "kept_m", "off_plan_m", "off_belief_m", "message", *(q.key for q in QUANTITIES)])
    for level, of_scenario in verified.items():
        for scenario, crash in of_scenario.items():
            numbers = [f"{value:.3f}" if crash.verified else "" for value in crash[1:]]
            writer.writerow([level, scenario, int(crash.verified), *numbers, trials[level][scenario]["message"],
                             *errors(drawn(scenario)[0], level).values()])
    return file.getvalue()


def page(trials, verified, stamped):
    return (HEAD.format(stamp=stamped, families=len(ALL_FAMILIES), seed=SEED, difficulty=DIFFICULTY)
            + ranges_table() + "\n" + levels_table(trials, verified) + VERIFIED
            + "## By family\n\n" + families_table(trials)
            + "\n## The errors of drives that crash\n\nHow large an error is in drives that crash and in the others: the "
            "mean share of a level's range, without sign.\n\n" + shares_table(trials)
            + f"\n## The crashes\n\nAt most {MOST_LISTED} of each level, those with a verified plan first; each one is in "
            "[belief-errors.csv](belief-errors.csv).\n" + listed(trials, verified))


def main():
    parser = page_parser("belief-errors", __doc__)
    parser.add_argument("--drives", type=int, default=10000, help="at least so many, of all families and levels")
    options = parser.parse_args()
    folder = options.work / "scenarios"
    count = math.ceil(options.drives / (len(ALL_FAMILIES) * len(LEVELS)))
    plain = make_scenarios(options.program, folder, ALL_FAMILIES, count, SEED, DIFFICULTY)
    trials, verified = {}, {}
    for level in LEVELS:
        trials[level], verified[level] = drive_level(options, level, plain)
    stamped = stamp(command_of(parser, options, "belief-errors", "drives"), options.program)
    write(options.out.with_suffix(".csv"), crashes(trials, verified))
    write(options.out, page(trials, verified, stamped))


if __name__ == "__main__":
    main()
