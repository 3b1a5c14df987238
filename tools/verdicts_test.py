#!/usr/bin/env python3
"""The verdicts' statistics and rules, on figures made up for them."""

import csv
import math
import pathlib
import sys
import tempfile
import types
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import verdict_drives  # noqa: E402
import verdict_sweep  # noqa: E402
from sweeps import fisher  # noqa: E402
from verdict_data import (  # noqa: E402
    Sweep, median_interval, paired, paper_counts, paper_points, ratio_interval)


def drive(outcome="goal", time=6.0, hit=None, solves=(0.001,) * 12, ux=20.0):
    rows = [{"t": 0.5 * k, "x": 0.0, "y": 20.0 * k, "ux": ux, "ax": 0.0, "sa": 0.0, "sr": 0.0, "jx": 0.1}
            for k in range(int(2 * time) + 1)]
    made = types.SimpleNamespace(
        outcome=outcome, arrived=outcome == "goal", time=time, rows=rows, solves=list(solves),
        later=list(solves)[1:], iterations=[5] * len(solves), t0=[0.5 * k for k in range(len(solves))],
        summary={"hit": hit, "outcome": outcome, "time_s": time, "goal_time_s": time})
    made.ended = lambda: f"{outcome} at {time}"
    made.at = lambda t, column: rows[0][column]
    made.effort = lambda: 1.0
    return made


class Statistics(unittest.TestCase):
    def test_fisher_is_the_published_value(self):
        # Fisher's tea (1935): 3 of 4 and 1 of 4; two-sided .4857.
        self.assertAlmostEqual(fisher(3, 1, 1, 3), 34 / 70, delta=1e-12)
        # The paper's counts; the formulation has the exact p.
        self.assertAlmostEqual(fisher(22, 378, 148, 252) / 1.3e-29, 1, delta=0.05)

    def test_intervals_hold_their_median(self):
        median, low, high = median_interval(range(1, 26))
        self.assertEqual((median, low, high), (13, 8, 18))  # binomial(25, 1/2): 8th and 18th
        ratio, low, high = ratio_interval([1, 2, 3] * 10, [2, 4, 6] * 10)
        self.assertEqual(ratio, 2)
        self.assertTrue(low <= 2 <= high)
        self.assertEqual(paired([1, 2, 4], [2, 4, 8, 100])[0], 2)
        self.assertTrue(math.isnan(median_interval([])[0]))

    def test_the_papers_figures_are_read(self):
        self.assertEqual(paper_counts(), {"P_C": (22, 400), "P_D": (148, 400)})
        self.assertEqual(len(paper_points()), 4)


class Rules(unittest.TestCase):
    def test_drives(self):
        good = {f"{e}/{p}": drive(*(("crash", 3.0, "O1") if p == "P_C" and e in ("E_B", "E_C") else ()))
                for e in ("E_A", "E_A-figure", "E_B", "E_C") for p in ("P_A", "P_B", "P_C", "P_D")}
        self.assertEqual(verdict_drives.moving_is_safer(good)[3], "holds")
        self.assertEqual(verdict_drives.moving_is_safer(good | {"E_B/P_D": drive("crash")})[3], "holds in part")
        slow = {f"{e}/P_A": drive(time=9.0, solves=[0.004] * 16) for e in ("E_A", "E_A-figure")}
        self.assertEqual(verdict_drives.minimum_time_arrives(good)[3], "does not hold")
        self.assertEqual(verdict_drives.minimum_time_arrives(good | slow)[3], "holds")
        self.assertEqual(verdict_drives.minimum_time_solves(good)[3], "does not hold")
        self.assertEqual(verdict_drives.minimum_time_solves(good | slow)[3], "holds")
        self.assertEqual(verdict_drives.effort_free(good)[3], "holds")
        dear = {f"{e}/P_C": drive(solves=[0.002] * 12) for e in ("E_A", "E_A-figure")}
        self.assertEqual(verdict_drives.effort_free(good | dear)[3], "does not hold")
        self.assertEqual(verdict_drives.real_time(good)[3], "holds")
        self.assertEqual(verdict_drives.real_time(good | {"E_B/P_D": drive(solves=[0.6] * 3)})[3],
                         "does not hold")

    def test_area_is_between_path_and_line(self):
        drives = {f"E_A-figure/{p}": drive(time=2) for p in ("P_A", "P_B", "P_C")}
        for p, x in (("P_A", 199.0), ("P_B", 197.0), ("P_C", 203.0)):
            for row in drives[f"E_A-figure/{p}"].rows:
                row["x"] = x
        claim = verdict_drives.less_area(drives)
        self.assertIn("P_A 80 m², P_B 240 m², P_C 240 m²", claim[2])  # 80 m along y
        self.assertEqual(claim[3], "holds")

    def test_cases(self):
        found = {f"cases/{c}": drive(o, t) for c, o, t in (
            ("A", "crash", 3), ("B", "goal", 13), ("C", "goal", 9), ("D", "goal", 8), ("E", "crash", 3),
            ("F", "goal", 8))}
        self.assertEqual(verdict_drives.cases(found)[3], "holds")
        self.assertEqual(verdict_drives.cases(found | {"cases/D": drive("goal", 10)})[3], "holds in part")


def sweep(passes):
    """A sweep whose trials pass where passes(planner, tex, speed) says so."""
    folder = tempfile.TemporaryDirectory()
    with open(pathlib.Path(folder.name) / "trials.csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["planner", "loop.tex", "obstacles.O2.vy", "outcome", "hit", "max_cpu_time_s",
                         "median_cpu_time_s", "max_solve_time_s"])
        for planner in ("P_C", "P_D"):
            for tex in (0.1, 0.3, 0.687, 0.9):
                for speed in (0, 2.1, 10, 20, 30):
                    passed = passes(planner, tex, speed)
                    writer.writerow([planner, tex, -speed, "goal" if passed else "crash",
                                     "" if passed else "O2", 0.001 if passed else 0.003, 0.001, 0.004])
    with folder:
        return Sweep(folder.name)


class SweepRules(unittest.TestCase):
    def setUp(self):
        self.like = sweep(lambda p, tex, v: v < 21 and (tex < 0.5 or v < 5) if p == "P_D"
                          else v < 3 and tex < 0.375)
        self.unlike = sweep(lambda p, tex, v: v > 21 and tex > 0.5 if p == "P_D" else v > 3)

    def test_safer(self):
        self.assertIn("P_C 4 of 20, P_D 12 of 20: × 3.00", verdict_sweep.safer(self.like)[2])
        self.assertEqual(verdict_sweep.safer(self.like)[3], "holds")
        self.assertEqual(verdict_sweep.safer(self.unlike)[3], "does not hold")

    def test_where_moving_avoidance_is_not_needed(self):
        self.assertEqual(verdict_sweep.not_needed(self.like)[3], "holds")
        self.assertIn("P_C arrives in 4 of 4; at larger tex in 0 of 4, with a faster O2 in 0 of 6",
                      verdict_sweep.not_needed(self.like)[2])
        self.assertEqual(verdict_sweep.not_needed(self.unlike)[3], "does not hold")

    def test_a_small_tex_instead(self):
        crashes = {0.5: "crash", 0.1: "crash"}
        self.assertEqual(verdict_drives.small_tex_instead(crashes, self.like)[3], "holds in part")
        self.assertEqual(verdict_drives.small_tex_instead(crashes | {0.1: "goal"}, self.like)[3], "holds")
        self.assertEqual(verdict_drives.small_tex_instead(crashes, self.unlike)[3], "does not hold")

    def test_speed_and_tex(self):
        self.assertEqual(verdict_sweep.too_fast(self.like)[3], "holds")
        self.assertEqual(verdict_sweep.too_fast(self.unlike)[3], "does not hold")
        self.assertEqual(verdict_sweep.small_tex(self.like)[3], "holds")
        self.assertEqual(verdict_sweep.small_tex(self.unlike)[3], "does not hold")

    def test_real_time_factor_is_the_papers(self):
        # Mean over the speeds of the longest solve, over tex: (4 * .001 + .003) / 5 / .1.
        factor, pos = self.like.rtf("P_D", 0.1)
        self.assertAlmostEqual(factor, 0.014, delta=1e-12)
        self.assertAlmostEqual(pos, 0.8, delta=1e-12)
        self.assertEqual(self.like.rtf("P_D", 0.1, 20)[1], 1)
        self.assertEqual(verdict_sweep.danger(self.like)[3], "holds")
        self.assertIn("P_C at most 0.40; P_D 0.80 up to .5 s, 0.40 above",
                      verdict_sweep.safety_by_tex(self.like)[2])


if __name__ == "__main__":
    unittest.main()
