#!/usr/bin/env python3
"""From where, and with what, first_sight.py drives once more."""

import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import first_sight  # noqa: E402

SCENARIO = """name: E
start: {x: 6, y: 0, psi_deg: 90, ux: 17}
obstacles:
  - {name: O1, x: 6, y: 281, r: 6}
  - {name: O2, x: 18, y: 650, r: 6, vy: -10}
"""


def rows():
    """Along y at 10 m/s, ten rows a second."""
    return [{"t": f"{k / 10:g}", "x": "0", "y": f"{k:g}", "v": "0.1", "r": "0", "psi": "1.57", "sa": "0", "ux": "10",
             "ax": "-1"} for k in range(100)]  # fmt: skip


class FirstSight(unittest.TestCase):
    def test_the_plan_that_knows_begins_a_horizon_after_it_is_made(self):
        # 100 m apart, closing at 20 m/s: within 50 m from 2.5 s on, seen when it plans at 3 s.
        row = first_sight.first_knowing(rows(), lambda t: (0, 100 - 10 * t), 50, 1.0)
        self.assertEqual(row["t"], "4")

    def test_what_is_never_near_or_only_at_the_end_gives_nothing(self):
        self.assertIsNone(first_sight.first_knowing(rows(), lambda t: (1000, 0), 50, 1.0))
        self.assertIsNone(first_sight.first_knowing(rows()[:35], lambda t: (0, 100 - 10 * t), 50, 1.0))

    def test_the_scenario_begins_there_and_the_obstacle_has_moved(self):
        text = first_sight.from_there(SCENARIO, rows()[40], {"O2": (18, 610.0)})
        self.assertIn("start: {x: 0, y: 40, v: 0.1, r: 0, psi: 1.57, sa: 0, ux: 10, ax: -1}", text)
        self.assertIn("{name: O2, x: 18, y: 610.0, r: 6, vy: -10}", text)
        self.assertIn("{name: O1, x: 6, y: 281, r: 6}", text)


if __name__ == "__main__":
    unittest.main()
