#!/usr/bin/env python3
"""How the page on the parts of P_E counts, on drives made up for it."""

import argparse
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from planner_ablation import VARIANTS, WHOLE, page, table  # noqa: E402


def trial(outcome, time="10", failed="0"):
    return {"outcome": outcome, "goal_time_s": time if outcome == "goal" else "", "cycles": "20",
            "failed_cycles": failed}


def trials(*outcomes):
    return {f"gates-{k:04}": trial(outcome) for k, outcome in enumerate(outcomes)}


class Ablation(unittest.TestCase):
    def setUp(self):
        self.variants = {name: trials("goal", "goal", "goal", "crash") for name in VARIANTS}

    def row_of(self, name, text):
        return next(line for line in text.splitlines() if line.startswith(f"| {name} |"))

    def test_each_is_held_against_the_whole(self):
        other = trials("crash", "timeout", "goal", "goal")
        other["gates-0002"] = trial("goal", time="12", failed="3")
        self.variants["no guidance"] = other
        text = table(self.variants)
        self.assertEqual(self.row_of("no guidance", text),
                         "| no guidance | `planner.guidance: false` | 4 | 2 | 0.068–0.932 | 1 | 1 | 80 | 3 | 1.200 "
                         "| 2 | 1 | 1 |")  # fmt: skip
        self.assertIn("| – | – | – | – |", self.row_of(WHOLE, text))

    def test_a_part_without_which_nothing_arrives_has_no_time(self):
        self.variants["no fallback"] = trials(*["not_optimal"] * 4)
        self.assertIn("| 4 | 80 | 0 | – | 3 | 0 | 0.25 |", self.row_of("no fallback", table(self.variants)))

    def test_the_page_counts_by_family(self):
        text = page(self.variants, self.variants, argparse.Namespace(points=2, count=4), "A stamp.\n")
        self.assertIn("| gates |" + " 3/4 |" * len(VARIANTS), text)
        self.assertIn("A stamp.", text)


if __name__ == "__main__":
    unittest.main()
