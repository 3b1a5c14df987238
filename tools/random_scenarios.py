#!/usr/bin/env python3
"""Drives random scenarios of every family with the planners P_A to P_D and writes the counts and
their paired comparison to docs/random-scenarios.md. Standard library only.

    tools/random_scenarios.py --program build/slalom [--count 125] [--seed 1] [--difficulty 0.5]
"""

import argparse
import collections
import concurrent.futures
import json
import math
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
PLANNERS = ("P_A", "P_B", "P_C", "P_D")
FAMILIES = ("static_field", "moving_field", "crossing", "oncoming", "slalom", "double_lane_change",
            "gates", "dead_ends")
PAIRS = (("P_A", "P_B"), ("P_B", "P_C"), ("P_C", "P_D"))

HEAD = """<!-- Written by tools/random_scenarios.py (`make random-scenarios`). -->
# Random scenarios

`slalom make-scenarios FAMILY --count N --seed S --difficulty D --out DIR` makes scenarios of a family
(`--help` lists them). The same numbers give the same files. Each has a way from start to goal: a
search over a grid of places and times (1 m, .5 s) finds a path for a point at 2 to 24 m/s that keeps
2.5 m from every obstacle where it is by then; draws without one are drawn again. A point turns and
brakes at once, so that a way need not be one that the vehicle can drive.

"""


def drive(program, path, planner):
    done = subprocess.run([program, "simulate", path, "--planner", planner, "--json"],
                          capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{path} {planner}: {done.stderr}")
    return json.loads(done.stdout)["outcome"]


def interval(k, n):
    """Exact 95 % interval of a share (Clopper and Pearson), by bisection on the binomial sum."""
    def tail(p, at_least):
        return sum(math.comb(n, i) * p**i * (1 - p)**(n - i)
                   for i in (range(k, n + 1) if at_least else range(k + 1)))

    def solve(at_least):
        lo, hi = 0.0, 1.0
        for _ in range(60):
            p = (lo + hi) / 2
            if (tail(p, at_least) < 0.025) == at_least:
                lo = p
            else:
                hi = p
        return lo
    return (solve(True) if k else 0.0), (solve(False) if k < n else 1.0)


def mcnemar(b, c):
    """Two-sided exact p of b and c discordant pairs."""
    n = b + c
    return min(1.0, 2 * sum(math.comb(n, i) for i in range(min(b, c) + 1)) / 2**n)


def tables(outcomes, files):
    text = "| family | " + " | ".join(PLANNERS) + " |\n|---" * 1 + "|---" * len(PLANNERS) + "|\n"
    text = "| family | " + " | ".join(PLANNERS) + " |\n" + "|---" * (1 + len(PLANNERS)) + "|\n"
    for family in FAMILIES:
        own = [f for f in files if f.name.startswith(family + "-")]
        passed = [sum(outcomes[f, p] == "goal" for f in own) for p in PLANNERS]
        text += f"| {family} | " + " | ".join(f"{k}/{len(own)}" for k in passed) + " |\n"
    passed = {p: sum(outcomes[f, p] == "goal" for f in files) for p in PLANNERS}
    text += "| all | " + " | ".join(f"{passed[p]}/{len(files)}" for p in PLANNERS) + " |\n"
    text += "| 95 % of the share | " + " | ".join(
        "{:.2f}–{:.2f}".format(*interval(passed[p], len(files))) for p in PLANNERS) + " |\n"
    text += "\nHow they ended:\n\n| planner | goal | crash | not_optimal | others |\n|---|---|---|---|---|\n"
    for p in PLANNERS:
        count = collections.Counter(outcomes[f, p] for f in files)
        named = [count.pop(name, 0) for name in ("goal", "crash", "not_optimal")]
        text += f"| {p} | " + " | ".join(map(str, named)) + f" | {sum(count.values())} |\n"
    text += ("\nPaired on the scenarios, by McNemar's exact test:\n\n"
             "| pair | the first alone arrives | the second alone | p |\n|---|---|---|---|\n")
    for one, two in PAIRS:
        b = sum(outcomes[f, one] == "goal" and outcomes[f, two] != "goal" for f in files)
        c = sum(outcomes[f, two] == "goal" and outcomes[f, one] != "goal" for f in files)
        text += f"| {one}, {two} | {b} | {c} | {mcnemar(b, c):.2g} |\n"
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default="build/slalom")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "docs/random-scenarios.md")
    parser.add_argument("--count", type=int, default=125, help="of each family")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--difficulty", type=float, default=0.5)
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        for family in FAMILIES:
            subprocess.run([options.program, "make-scenarios", family, "--quiet", "--out", folder,
                            "--count", str(options.count), "--seed", str(options.seed),
                            "--difficulty", str(options.difficulty)], check=True)
        files = sorted(pathlib.Path(folder).glob("*.yaml"))
        keys = [(f, p) for f in files for p in PLANNERS]
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            results = pool.map(lambda k: drive(options.program, str(k[0]), k[1]), keys)
            outcomes = dict(zip(keys, results))
        text = HEAD + (f"{options.count} of each family, seed {options.seed}, difficulty "
                       f"{options.difficulty:g}, execution horizon .5 s, floor .9. Drives that "
                       "arrive:\n\n") + tables(outcomes, files)
    options.out.write_text(text)


if __name__ == "__main__":
    main()
