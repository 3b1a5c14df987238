#!/usr/bin/env python3
"""Drives E_B and E_C with each choice of obstacles and writes the table of docs/obstacle-choice.md.
Standard library only.

    tools/obstacle_choice.py --program build/slalom [--out docs/obstacle-choice.md]
"""

import argparse
import csv
import json
import pathlib
import statistics
import subprocess
import tempfile

CHOICES = [("all", {})]
CHOICES += [("in_reach", {"obstacle_choice": "in_reach"})]
CHOICES += [(f"nearest {n}", {"obstacle_choice": "nearest", "obstacle_count": n})
            for n in (1, 2, 5, 10, 20)]
CHOICES += [("all, groups", {"obstacle_group_gap": 4.5}),
            ("in_reach, groups", {"obstacle_choice": "in_reach", "obstacle_group_gap": 4.5})]

HEAD = """<!-- Written by tools/obstacle_choice.py (`make obstacle-choice`). -->
# Which obstacles a plan knows of

`planner.obstacle_choice` is `all` (the default, and the paper's), `in_reach` or `nearest` with
`planner.obstacle_count`. `planner.obstacle_group_gap` beside it puts one ellipse in the place of
obstacles of one velocity that stand closer than this.

- `in_reach` leaves out what no plan can touch: a plan stays within L_range + kappa of its start, and
  lasts tf_max at most. At a barrier floor a far row pushes all the same, a little, so that drives
  differ by centimetres.
- `nearest` may leave out what the plan drives into: it is safe as far as its count is large enough.
- A group's ellipse has the middle and the ratio of axes of its members' common box, and is scaled to
  cover them all (at most √2 times the half box, the least ellipse about a box). It closes gaps
  between its members, and reaches beyond the ends of a row.
- A choice that changes from one cycle to the next begins that solve without the last multipliers, and
  another number of obstacles needs a transcription of its own when it first occurs. For few
  obstacles that costs more time than the rows saved.

Planner P_D, execution horizon .5 s; groups with a gap of 4.5 m, which joins E_C's cones. Planning
time is thread time of a cycle, transcription included; iterations are of the whole drive.

| environment | choice | ends | least clearance [m] | iterations | median [ms] | greatest [ms] |
|---|---|---|---|---|---|---|
"""


def row(program, environment, name, settings):
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "simulate", environment, "--planner", "P_D", "--out", folder, "--force",
                   "--quiet"]
        for key, value in settings.items():
            command += ["--set", f"planner.{key}={value}"]
        subprocess.run(command, check=True)
        out = pathlib.Path(folder)
        drive = json.loads((out / "summary.json").read_text())
        with open(out / "cycles.csv", newline="") as file:
            cycles = list(csv.DictReader(file))
    times = [1e3 * float(c["planning_cpu_s"]) for c in cycles[1:]]  # the first is the warm-up
    end = drive["outcome"] + (f" {drive['hit']}" if drive["hit"] else "")
    return (f"| {environment} | {name} | {end}, {drive['time_s']:.2f} s | "
            f"{drive['least_clearance_m']:.2f} | {sum(int(c['iterations']) for c in cycles)} | "
            f"{statistics.median(times):.2f} | {max(times):.2f} |\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default="build/slalom")
    parser.add_argument("--out", default="docs/obstacle-choice.md")
    options = parser.parse_args()
    text = HEAD
    for environment in ("E_B", "E_C"):
        for name, settings in CHOICES:
            text += row(options.program, environment, name, settings)
    pathlib.Path(options.out).write_text(text)


if __name__ == "__main__":
    main()
