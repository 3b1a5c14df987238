#!/usr/bin/env python3
"""How the page on robustness judges and draws drives, on trials made up for it."""

import csv
import io
import json
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import robustness  # noqa: E402
from robustness import FLOORS, PAPER, Drive, band, figure, others, page, table  # noqa: E402


def drives(change):
    """All drives; change(key, floor, tex, shift) gives the end of those that are not as the paper's."""
    found = []
    for environment in robustness.X:
        axes = json.loads(robustness.study(environment))["axes"]
        for planner in (p for e, p in PAPER if e == environment):
            for floor in axes[0]["values"]:
                for tex in axes[1]["values"]:
                    for x in axes[2]["values"]:
                        shift = round(x - robustness.X[environment], 9)
                        end = change((environment, planner), floor, tex, shift) or PAPER[environment, planner]
                        outcome, _, hit = end.partition(" ")
                        found.append(Drive({
                            "scenario": environment, "planner": planner, "planner.floor": str(floor),
                            "loop.tex": str(tex), "start.x": str(x), "outcome": outcome, "hit": hit,
                            "time_s": "6.5", "least_clearance_m": "0.25"}))  # fmt: skip
    return found


def low(key, floor, tex, shift):
    """P_D in E_C hits a cone at low floors and the short horizon, and another one from one start."""
    if key == ("E_C", "P_D") and tex == 0.25 and floor < 0.7:
        return "crash cone12" if shift else "crash cone11"
    return "not_optimal" if key == ("E_C", "P_C") and floor == 2 and shift == 0 else None


class Robustness(unittest.TestCase):
    def test_the_obstacle_counts_as_well_as_the_outcome(self):
        own = drives(lambda key, *_: "crash O2" if key == ("E_B", "P_C") else None)
        self.assertEqual({d.key for d in own if not d.as_paper}, {("E_B", "P_C")})
        self.assertIn("P_C in E_B: crash O2, 102", others(own))

    def test_the_band_of_floors_ends_where_one_drive_differs(self):
        own = drives(low)
        self.assertEqual(band(own, 0.25), "at tex 0.25 s from 0.7 to 1.5")
        self.assertEqual(band(own, 0.5), "at tex 0.5 s from 0.1 to 1.5")
        self.assertIn("not even at 0.9", band(drives(lambda key, floor, *_: "timeout" if floor == 0.9 else None), 0.5))

    def test_a_row_and_a_cell_for_each_drive(self):
        own = drives(low)
        self.assertEqual(len(own), len(PAPER) * len(FLOORS) * 6)
        rows = list(csv.DictReader(io.StringIO(table(own))))
        self.assertEqual(len(rows), len(own))
        self.assertEqual(sum(row["as_paper"] == "0" for row in rows), 14)
        text = figure(own)
        cells = {line.split('"')[1]: line.count("M") for line in text.splitlines() if line.startswith("<path")}
        expected = {"as the paper's": 1006, "crashes": 12, "has no plan": 2}
        self.assertEqual(cells, {robustness.KINDS[name]: count for name, count in expected.items()})
        self.assertIn(">has no plan<", text)
        self.assertNotIn(">arrives<", text)

    def test_the_page_counts(self):
        text = page(drives(low), "A stamp.\n").replace("\n", " ")
        self.assertIn("1006 of 1020 drives end as the paper's, 60 of 60 at the default floor", text)
        self.assertIn("P_D in E_C: crash into a cone, 12; P_C in E_C: not optimal, 2.", text)


if __name__ == "__main__":
    unittest.main()
