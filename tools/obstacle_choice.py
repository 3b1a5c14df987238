#!/usr/bin/env python3
"""Drives E_B and E_C with each choice of obstacles and writes the table of docs/measured/obstacle-choice.md.
Standard library only.

    tools/obstacle_choice.py [--program build/slalom]
"""

import statistics

from measured import page_parser, stamp, write
from sweeps import driven, ended, head, row

GAP = 4.5  # of groups [m]
ENVIRONMENTS = ("E_B", "E_C")
COUNTS = (1, 2, 5, 10, 20)  # of nearest
CHOICES = [("all", {}), ("in_reach", {"obstacle_choice": "in_reach"})]
CHOICES += [(f"nearest {n}", {"obstacle_choice": "nearest", "obstacle_count": n}) for n in COUNTS]
CHOICES += [("all, groups", {"obstacle_group_gap": GAP}),
            ("in_reach, groups", {"obstacle_choice": "in_reach", "obstacle_group_gap": GAP})]

HEAD = """# Which obstacles a plan knows of

{stamp}
`planner.obstacle_choice` is `all` (the default, and the paper's), `in_reach` or `nearest` with
`planner.obstacle_count`. `planner.obstacle_group_gap` beside it puts one ellipse in the place of
obstacles of one velocity that stand closer than this.

- `in_reach` leaves out what no plan can touch: a plan stays within L_range + kappa of its start, and
  lasts tf_max at most. Answers may differ all the same, since at a barrier floor a far row pushes a little.
- `nearest` may leave out what the plan drives into.
- A group's ellipse has the middle and the ratio of axes of its members' common box, and is scaled to
  cover them all (at most √2 times the half box, the least ellipse about a box). It closes gaps
  between its members, and reaches beyond the ends of a row.
- A choice that changes from one cycle to the next begins that solve without the last multipliers, and
  another number of obstacles needs a transcription of its own when it first occurs.

Planner P_D, execution horizon .5 s; groups with a gap of {gap:g} m. Planning time is thread time of a
cycle, transcription included, of all cycles; iterations are of the whole drive, without its warm-up.

"""


class Drive:
    def __init__(self, program, environment, settings):
        self.summary, cycles = driven(program, environment, "P_D",
                                      {f"planner.{key}": value for key, value in settings.items()})  # fmt: skip
        self.end = ended(self.summary)
        self.iterations = sum(int(c["iterations"]) for c in cycles)
        self.times = [1e3 * float(c["planning_cpu_s"]) for c in cycles]


def table(drives):
    text = head(["environment", "choice", "ends", "least clearance [m]", "iterations", "median [ms]",
                 "greatest [ms]"])
    for (environment, name), d in drives.items():
        text += row([environment, name, f"{d.end}, {d.summary['time_s']:.2f} s",
                     f"{max(0, d.summary['least_clearance_m']):.2f}", d.iterations,
                     f"{statistics.median(d.times):.2f}", f"{max(d.times):.2f}"])
    return text


def findings(drives):
    """From which count on `nearest` ends as `all` does, in each environment."""
    text = ""
    for environment in ENVIRONMENTS:
        whole = drives[environment, "all"].end
        alike = [drives[environment, f"nearest {n}"].end == whole for n in COUNTS]
        least = next((n for k, n in enumerate(COUNTS) if all(alike[k:])), None)
        words = f"from {least} obstacles on" if least else f"not even with {COUNTS[-1]} obstacles"
        text += f"\nIn {environment}, of the counts tried, `nearest` ends as `all` does {words}.\n"
    return text


def main():
    options = page_parser("obstacle-choice", __doc__, keeps=False).parse_args()
    drives = {(environment, name): Drive(options.program, environment, settings)
              for environment in ENVIRONMENTS for name, settings in CHOICES}
    write(options.out, HEAD.format(stamp=stamp("make obstacle-choice", options.program), gap=GAP)
          + table(drives) + findings(drives))


if __name__ == "__main__":
    main()
