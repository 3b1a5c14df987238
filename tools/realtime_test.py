#!/usr/bin/env python3
"""What realtime.py and obstacle_choice.py make of the cycles of drives that were not driven."""

import csv
import json
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import obstacle_choice  # noqa: E402
import realtime  # noqa: E402

SUMMARY = {"outcome": "goal", "hit": "", "time_s": 3.0, "warm_up": {"cpu_time_s": 0.002, "iterations": 9},
           "cycles_best_iterate": 1, "least_clearance_m": 0.5}  # fmt: skip


def cycle(number, milliseconds, status="solved"):
    return {"cycle": number, "status": status, "t0": 0.5 * number, "cpu_time_s": 1e-3 * milliseconds,
            "planning_cpu_s": 1e-3 * milliseconds, "iterations": 5, "worst_constraint": "obstacle", "worst_violation": 0.01,
            "used": 1, "backend": "interior_point"}  # fmt: skip


def driven(cycles):
    """A drive, read from the files that it writes."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "summary.json").write_text(json.dumps(SUMMARY))
        with open(folder / "cycles.csv", "w", newline="") as file:
            writer = csv.DictWriter(file, cycles[0])
            writer.writeheader()
            writer.writerows(cycles)
        return realtime.Drive(folder)


class Page(unittest.TestCase):
    def page(self):
        """Cycles of 1 to 101 ms, of which the one of 50 ms met its deadline."""
        drive = driven([cycle(k, k, "time_limit" if k == 50 else "solved") for k in range(1, 102)])
        return realtime.page(dict.fromkeys(realtime.DRIVES, drive), dict.fromkeys(realtime.STUDIES, drive), "A stamp.\n")

    def test_quantiles_lie_between_values_in_proportion(self):
        self.assertIn("| off | 0.01 | goal 3.00 s | 101 | 99.010 % | 1 | 0 | 51.000, 100.000, 101.000 | "
                      "51.000, 100.000, 101.000 |", self.page())  # fmt: skip

    def test_what_was_not_solved_is_listed_and_is_not_the_longest(self):
        text = self.page()
        self.assertIn("| E_B, P_D | goal 3.00 s | 101 | 2.000 | 9 | 51.000 | 101.000 | 5 | 101 | 1 |", text)
        self.assertIn("| E_B, P_D | 50 | 25 | time_limit | 5 | obstacle | 0.01 | best iterate |", text)
        self.assertIn("| 10 ms | 1 | 40.000, 40.000, 40.000, 40.000 | 91 | 91.000 |", text)


class Choice(unittest.TestCase):
    def test_every_cycle_counts_for_cycles_csv_has_no_warm_up(self):
        with mock.patch.object(obstacle_choice, "driven", lambda *_: (SUMMARY, [cycle(1, 9), cycle(2, 4), cycle(3, 5)])):
            drive = obstacle_choice.Drive("slalom", "E_B", {})
        self.assertIn("| E_B | all | goal, 3.00 s | 0.50 | 15 | 5.00 | 9.00 |", obstacle_choice.table({("E_B", "all"): drive}))


if __name__ == "__main__":
    unittest.main()
