#!/usr/bin/env python3
"""Times the planner in closed loop against its execution horizon and writes docs/measured/realtime.md
from one run. Standard library only.

    tools/realtime.py [--program build/slalom]

Thread times are of the one run, the first, not the best of several.
"""

import json
import pathlib
import statistics
import subprocess
import tempfile

from measured import page_parser, stamp, write
from robustness import PAPER as DRIVES
from sweeps import ended, head, quantile, row, rows_of

# Drives of E_C by P_D: name, tex [s], deadline, what an unsolved cycle drives on.
STUDIES = (("off", 0.01, "off", "last_plan"), ("10 ms", 0.01, "tex", "best_iterate"),
           ("1 ms", 0.001, "tex", "best_iterate"))
MOST_LISTED = 20


class Drive:
    def __init__(self, folder):
        self.summary = json.loads((folder / "summary.json").read_text())
        self.cycles = rows_of(folder / "cycles.csv")
        # A plan that goes through an obstacle between its nodes is solved, too: its rows hold.
        solved = [c["status"].startswith(("solved", "passes_through")) for c in self.cycles]
        self.unsolved = [c for c, good in zip(self.cycles, solved) if not good]
        self.solved = [c for c, good in zip(self.cycles, solved) if good]

    def times(self, column, cycles=None):
        """In ms, rising."""
        return sorted(1e3 * float(c[column]) for c in (self.cycles if cycles is None else cycles))

    def end(self):
        return f"{ended(self.summary)} {self.summary['time_s']:.2f} s"


def ms(value):
    return f"{value:.3f}"


def simulate_arguments(tex, deadline, on_failure):
    return ["simulate", "E_C", "--planner", "P_D", "--tex", f"{tex:g}", "--set",
            f"loop.deadline={deadline}", "--set", f"loop.on_failure={on_failure}"]


def reproduced_table(drives):
    text = head(["drive", "outcome", "cycles", "first solve, cold [ms]", "its iterations", "median solve [ms]",
                 "longest solved [ms]", "its iterations", "cycle", "not solved"])
    for key in DRIVES:
        drive = drives[key]
        warm_up = drive.summary["warm_up"]
        longest = max(drive.solved, key=lambda c: float(c["cpu_time_s"]))
        text += row([f"{key[0]}, {key[1]}", drive.end(), len(drive.cycles), ms(1e3 * warm_up["cpu_time_s"]),
                     warm_up["iterations"], ms(statistics.median(drive.times("cpu_time_s"))),
                     ms(1e3 * float(longest["cpu_time_s"])), longest["iterations"], longest["cycle"],
                     len(drive.unsolved)])
    return text


def study_table(studies):
    text = head(["deadline", "tex [s]", "outcome", "cycles", "solved", "best iterate driven", "last plan driven on",
                 "solve: median, p99, longest [ms]", "whole cycle: median, p99, longest [ms]"])
    for (name, tex, _, _), drive in studies.items():
        share = 100 * len(drive.solved) / len(drive.cycles)
        best = drive.summary["cycles_best_iterate"]
        both = [", ".join(ms(quantile(drive.times(column), q)) for q in (0.5, 0.99, 1))
                for column in ("cpu_time_s", "planning_cpu_s")]
        text += row([name, f"{tex:g}", drive.end(), len(drive.cycles), f"{share:.3f} %", best,
                     len(drive.unsolved) - best, *both])
    return text


def overshoot_table(studies):
    """Of the thread time of a whole cycle beyond the deadline; negative: within it."""
    text = head(["deadline", "cycles it ended", "of these: least, median, p99, most beyond it [ms]", "cycles beyond it",
                 "most beyond it [ms]"])
    for (name, tex, deadline, _), drive in studies.items():
        if deadline == "off":
            continue
        cut = [c for c in drive.cycles if c["status"] == "time_limit"]
        beyond = [t - 1e3 * tex for t in drive.times("planning_cpu_s", cut)]
        everyone = [t - 1e3 * tex for t in drive.times("planning_cpu_s")]
        spread = ", ".join(ms(quantile(beyond, q)) for q in (0, 0.5, 0.99, 1)) if beyond else "–"
        text += row([name, len(cut), spread, sum(t > 0 for t in everyone), ms(everyone[-1])])
    return text


def unsolved_list(named_drives):
    lines = []
    for name, drive in named_drives:
        for c in drive.unsolved[:MOST_LISTED]:
            lines.append(row([name, c["cycle"], f"{float(c['t0']):g}", c["status"], c["iterations"], c["worst_constraint"],
                              f"{float(c['worst_violation']):.2g}",
                              "best iterate" if c["used"] == "1" else "last plan"]))
        if len(drive.unsolved) > MOST_LISTED:
            lines.append(f"| {name} | and {len(drive.unsolved) - MOST_LISTED} more |||||||\n")
    if not lines:
        return "None.\n"
    return head(["drive", "cycle", "t0 [s]", "status", "iterations", "worst constraint", "violation", "driven"]) + "".join(lines)


def page(drives, studies, stamped):
    commands = [f"    slalom {' '.join(simulate_arguments(*study[1:]))} --out DIR"
                for study in studies]
    longest = max(float(c["cpu_time_s"]) for d in drives.values() for c in d.solved)
    cold = max(d.summary["warm_up"]["cpu_time_s"] for d in drives.values())
    off = studies[STUDIES[0]]
    share = 100 * len(off.solved) / len(off.cycles)
    named = [(f"{k[0]}, {k[1]}", d) for k, d in drives.items()]
    named += [(f"E_C, P_D, tex {study[1]:g} s, deadline {study[0]}", d)
              for study, d in studies.items()]
    backend = off.cycles[0]["backend"]
    return "\n".join([
        "# Real time", "", stamped,
        f"How long planning takes beside the execution horizon, from one run, solver `{backend}`.",
        "Times are of the planning thread; the operating system's share is in the wall times of each",
        "drive's `cycles.csv`. *Solved* is the independent check's word.", "",
        "| what | wanted | found |", "|---|---|---|",
        "| the ten drives: longest solve of a cycle that was solved | at most 3 ms | "
        f"{ms(1e3 * longest)} ms |",
        f"| the ten drives: longest first solve, from the cold guess | at most 3 ms | {ms(1e3 * cold)} ms |",
        f"| E_C, P_D, tex 0.01 s, deadline off: cycles solved | at least 99.9 % | {share:.3f} % |",
        "| the same: longest cycle, with update, guess and check | at most 10 ms | "
        f"{ms(off.times('planning_cpu_s')[-1])} ms |", "",
        "## The ten drives of the paper's figures", "", reproduced_table(drives),
        "By default settings, `slalom reproduce --out DIR`. The first solve is the warm-up from the",
        "straight-on guess. Cycles that were not solved do not count among the longest.", "",
        "## E_C at short execution horizons", "", study_table(studies),
        "A deadline is the execution horizon: planning has tex of the thread's time for update, guess,",
        "solve and check together.", "", *commands, "",
        "## Beyond the deadline", "", overshoot_table(studies),
        "A solve takes no step that its longest one so far would carry past the deadline, and leaves room",
        "for the longest check so far.", "",
        "## Cycles that were not solved", "", unsolved_list(named)])


def main():
    args = page_parser("realtime", __doc__, keeps=False).parse_args()

    def run(*arguments):
        subprocess.run([args.program, *map(str, arguments), "--quiet"], check=True)

    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        run("reproduce", "--out", folder / "paper")
        drives = {key: Drive(folder / "paper" / key[0] / key[1]) for key in DRIVES}
        studies = {}
        for study in STUDIES:
            run(*simulate_arguments(*study[1:]), "--out", folder / study[0])
            studies[study] = Drive(folder / study[0])
    write(args.out, page(drives, studies, stamp("make realtime", args.program)))


if __name__ == "__main__":
    main()
