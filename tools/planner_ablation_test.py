#!/usr/bin/env python3
"""How the page on the parts of P_E counts, on drives made up for it, and what it drives, by a stand-in for the program."""

import argparse
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import stand_in  # noqa: E402
from planner_ablation import VARIANTS, WHOLE, main, page, table  # noqa: E402


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
        text = page(self.variants, self.variants, argparse.Namespace(points=2, count=4, jobs=2), "A stamp.\n")
        self.assertIn("| gates |" + " 3/4 |" * len(VARIANTS), text)
        self.assertIn("A stamp.", text)

    def test_every_variant_drives_both_sets(self):
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch)
            text = stand_in.page_of(main, folder, "--points", "2", "--count", "1", STAND_IN_CRASHES="gates-0001")
            studies = {file.stem: file.read_text() for file in (folder / "work").glob("*.yaml")}
        for name in VARIANTS:
            self.assertEqual(sum(line.startswith(f"| {name} |") for line in text.splitlines()), 2, name)
        self.assertIn("| gates |" + " 0/1 |" * len(VARIANTS), text)
        self.assertIn("| crossing |" + " 1/1 |" * len(VARIANTS), text)
        self.assertEqual(len(studies), 2 * len(VARIANTS))
        for number, changed in enumerate(VARIANTS.values()):
            for kind in ("sweep", "random"):
                for key, value in {"loop.deadline": "tex", **changed}.items():
                    self.assertIn(f"{key}: {value}", studies[f"{kind}-{number}"])


if __name__ == "__main__":
    unittest.main()
