#!/usr/bin/env python3
"""From where, and with what, first_sight.py drives once more."""

import pathlib
import sys
import tempfile
import unittest
import unittest.mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import first_sight  # noqa: E402

SCENARIO = """name: E
start: {x: 6, y: 0, psi_deg: 90, ux: 17}
obstacles:
  - {name: O1, x: 6, y: 281, r: 6}
  - {name: O2, x: 18, y: 650, r: 6, vy: -10}
loop: {tex: 0.5}
"""
RESOLVED = """obstacles:
  - {name: "O1", x: 6, y: 281, a: 6, b: 6, vx: 0, vy: 0}
  - {name: "O2", x: 18, y: 650, a: 6, b: 6, vx: 0.5, vy: -10}
  - {name: "O3", x: 1, y: 2, a: 6, b: 6, vx: -1, vy: 0}
loop:
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

    def test_the_scenario_begins_there_and_every_obstacle_has_moved(self):
        text = first_sight.from_there(SCENARIO, rows()[40], first_sight.obstacles_of(RESOLVED))
        self.assertIn("start: {x: 0, y: 40, v: 0.1, r: 0, psi: 1.57, sa: 0, ux: 10, ax: -1}", text)
        self.assertIn('{name: "O2", x: 20.0, y: 610.0, a: 6.0, b: 6.0, vx: 0.5, vy: -10.0}', text)
        self.assertIn('{name: "O1", x: 6.0, y: 281.0,', text)
        self.assertIn('{name: "O3", x: -3.0, y: 2.0,', text)
        self.assertEqual(text.count("name: "), 4)
        self.assertTrue(text.endswith("loop: {tex: 0.5}\n"))

    def test_it_drives_from_where_the_obstacle_that_is_hit_is_seen(self):
        """By stand-ins for the drives."""
        def drive(program, scenario, planner, settings, out):
            out.mkdir()
            (out / "resolved.yaml").write_text(RESOLVED)
            (out / "plant.csv").write_text("\n".join([",".join(rows()[0]), *(",".join(r.values()) for r in rows())]))

        def driven(program, scenario, planner, settings):
            self.assertEqual(settings, {"planner.known": "all"})
            again.append(scenario.read_text())
            return {"outcome": "goal"}, []
        again = []
        with tempfile.TemporaryDirectory() as folder, unittest.mock.patch.multiple(first_sight, drive=drive, driven=driven):
            file = pathlib.Path(folder) / "E.yaml"
            file.write_text(SCENARIO)
            settings = {"planner.L_range": "220", "loop.tex": "1", "obstacles.O2.vy": "-10"}
            # The edge of O1, which stands at 281 m, is 220 m away at 5.5 s: seen when it plans at 6 s.
            self.assertEqual(first_sight.saved("slalom", file, settings, "O1", {"planner.known": "all"}), (7.0, "goal"))
        self.assertIn("y: 580.0,", again[0])  # O2, which is not the one that is hit



if __name__ == "__main__":
    unittest.main()
