"""A small study for the tests of sweeps, and what they read of a sweep."""

import csv
import json

from program import ProgramTest, run

# Twelve trials of about a tenth of a second each.
SMALL = """
title: small
scenario: E_B
planners: [P_C, P_D]
set: {loop.timeout: 1.5}
axes:
  - key: loop.tex
    values: [0.25, 0.5]
  - keys: [obstacles.O1.vx, obstacles.O1.vy]
    values: [[-2, 0], [-1, 0.5], [0, 1]]
"""
MEASURED = {"max_solve_time_s", "median_solve_time_s", "max_cpu_time_s", "p99_cpu_time_s",
            "median_cpu_time_s"}


def table(folder):
    """The rows of trials.csv without what is measured."""
    with open(folder / "trials.csv", newline="") as file:
        return [{k: v for k, v in row.items() if k not in MEASURED} for row in csv.DictReader(file)]


def events(text):
    return [json.loads(line) for line in text.splitlines()]


def next_event(process, kind):
    """Reads the process's events up to one of a kind."""
    for line in process.stdout:
        event = json.loads(line)
        if event["event"] == kind:
            return event
    raise AssertionError(f"no event '{kind}' before the end")


class SweepTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.study = self.write("small.yaml", SMALL)

    def sweep(self, out, *arguments, study=None):
        result = run("sweep", study or self.study, "--out", self.folder / out, "--quiet", *arguments)
        self.assertEqual((result.code, result.err), (0, ""))
        return table(self.folder / out)
