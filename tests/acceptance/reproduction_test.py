#!/usr/bin/env python3
"""All ten drives of the paper's figures, by the default settings, as the formulation's section 5
says they come out."""

import json
import math
import pathlib
import sys
import unittest

import drives

sys.path.append(str(drives.SOURCE / "tools"))
import robustness  # noqa: E402


def setUpModule():
    global SCRATCH, DRIVES, EVALUATION
    SCRATCH = drives.scratch()
    folder = pathlib.Path(SCRATCH.name) / "paper"
    drives.run("reproduce", "--out", folder, "--quiet")
    DRIVES = {(p.parts[-3], p.parts[-2]): drives.Drive(p.parent)
              for p in folder.glob("*/*/summary.json")}
    DRIVES["page"] = folder / "index.html"
    EVALUATION = json.loads((folder / "evaluation.json").read_text())


def tearDownModule():
    SCRATCH.cleanup()


def effort(drive, weights):
    """Weighted integrals of sa^2, sr^2 and jx^2 along the drive; all three are (nearly) linear
    between samples, for which this is exact."""
    total = 0
    for a, b in zip(drive.plant, drive.plant[1:]):
        for column, weight in weights.items():
            p, q = a[column], b[column]
            total += weight * (b["t"] - a["t"]) * (p * p + p * q + q * q) / 3
    return total


class Reproduction(unittest.TestCase):
    def arrives(self, environment, planner, earliest=0, latest=math.inf):
        drive = DRIVES[environment, planner]
        self.assertEqual(drive.outcome, "goal", drive.ended())
        self.assertGreaterEqual(drive.time, earliest, drive.ended())
        self.assertLessEqual(drive.time, latest, drive.ended())
        self.assertGreater(drive.summary["least_clearance_m"], 0)
        return drive

    def crashes(self, environment, planner, into, earliest=0, latest=math.inf):
        drive = DRIVES[environment, planner]
        self.assertEqual((drive.outcome, drive.summary["hit"]), ("crash", into), drive.ended())
        self.assertGreaterEqual(drive.time, earliest, drive.ended())
        self.assertLessEqual(drive.time, latest, drive.ended())
        self.assertAlmostEqual(drive.end["clearance"], 0, delta=1e-6)
        return drive

    def test_there_are_ten_four_variants_six_cases_and_a_page(self):
        self.assertEqual(len(DRIVES), 10 + 4 + 6 + 1)
        self.assertTrue(DRIVES["page"].is_file())

    def test_a_arrives_late_and_slows(self):
        for environment in ("E_A", "E_A-figure"):
            a = self.arrives(environment, "P_A")
            self.assertLess(a.end["ux"], a.plant[0]["ux"])

    def test_b_and_c_arrive_early_and_gain_speed(self):
        for environment in ("E_A", "E_A-figure"):
            a = DRIVES[environment, "P_A"]
            for planner in ("P_B", "P_C"):
                drive = self.arrives(environment, planner)
                self.assertLessEqual(drive.time, a.time - 1.5)
                self.assertLessEqual(drive.summary["goal_time_s"], a.summary["goal_time_s"] - 1.5)
                self.assertGreater(drive.end["ux"], drive.plant[0]["ux"])

    def test_c_spends_no_more_effort_than_b(self):
        # By the paper's table, and by the cost's own weights.
        for weights in ({"sa": 0.1, "sr": 0.1, "jx": 0.1}, {"sa": 0.1, "sr": 1, "jx": 0.01}):
            for environment in ("E_A", "E_A-figure"):
                b, c = (effort(DRIVES[environment, p], weights) for p in ("P_B", "P_C"))
                self.assertLessEqual(c, b, f"{environment} {weights}")

    def test_e_b(self):
        c = self.crashes("E_B", "P_C", "O1")
        o1 = drives.obstacles(c.resolved)[0]
        self.assertLess(c.end["x"], o1["x"] + o1["vx"] * c.time)  # left of O1
        d = self.arrives("E_B", "P_D")
        passing = next(row for row in d.plant if row["y"] >= o1["y"])
        self.assertGreater(passing["x"], o1["x"] + o1["vx"] * passing["t"])  # right of O1

    def test_e_c(self):
        c = self.crashes("E_C", "P_C", "O2")
        self.assertGreaterEqual(c.end["ux"], 25.5)
        self.assertLessEqual(c.end["ux"], 27.5)
        self.arrives("E_C", "P_D")

    def test_seen_50_m_ahead_both_crash_into_o2(self):
        self.crashes("E_C-range-50", "P_C", "O2", 19.5, 21.5)
        self.crashes("E_C-range-50", "P_D", "O2", 19.5, 21.5)

    def test_without_cones_the_lane_is_changed_earlier(self):
        for planner in ("P_C", "P_D"):
            y, y_cones = (next(row["y"] for row in DRIVES[environment, planner].plant
                               if row["x"] >= 12) for environment in ("E_C-no-cones", "E_C"))
            self.assertLess(y, y_cones / 2)

    def test_the_cases_come_out_as_the_papers_text_says(self):
        self.crashes("cases", "A", "O1", 2, 5)
        slow, held, both = (DRIVES["cases", c] for c in "BCD")
        self.assertEqual([d.outcome for d in (slow, held, both)], ["goal"] * 3)
        times = [d.summary["goal_time_s"] for d in (slow, held, both)]
        self.assertEqual(times, sorted(times, reverse=True))
        self.assertGreater(times[0] - times[1], 2)
        self.assertGreater(times[1] - times[2], 0.5)
        self.crashes("cases", "E", "O1", 2, 5)
        self.arrives("cases", "F", 6, 9)

    def test_all_end_as_the_papers(self):
        printed = [one for one in EVALUATION["drives"] if one["printed"]]
        self.assertEqual(len(printed), 10)
        for one in printed:
            self.assertTrue(one["printed"]["as_paper"], one["folder"])
            ours = DRIVES[one["scenario"], one["planner"]]
            self.assertEqual((one["outcome"], one["time_s"]), (ours.outcome, ours.time))
        ends = {(one["scenario"], one["planner"]): " ".join(filter(None, (
            one["printed"]["outcome"], one["printed"]["hit"]))) for one in printed}
        self.assertEqual(ends, robustness.PAPER, "tools/robustness.py counts by other ends")

    def test_snapshots(self):
        compared = 0
        for one in EVALUATION["drives"]:
            ours = DRIVES[one["scenario"], one["planner"]]
            for shot in one["printed"]["snapshots"] if one["printed"] else ():
                if not shot["comparable"] or shot["ours"] is None:
                    continue
                t = min(shot["t_s"], ours.time)
                away = math.hypot(ours.at(t, "x") - shot["x_m"], ours.at(t, "y") - shot["y_m"])
                self.assertAlmostEqual(away, shot["ours"]["distance_m"], delta=1e-6)
                self.assertTrue(shot["ours"]["within"], f"{one['folder']} at {t:.4f} s: {away:.2f} m")
                compared += 1
        self.assertEqual(compared, 12)

    def test_claims_that_do_not_ask_for_solve_times_hold(self):
        verdicts = {one["claim"]: one["verdict"] for one in EVALUATION["claims"]}
        for claim in ("minimum_time_arrives", "minimum_time_speeds", "less_area", "effort_no_more",
                      "moving_is_safer", "sides", "crash_speed", "range_50_crash", "lane_change", "cases"):
            self.assertEqual(verdicts[claim], "holds", claim)


class Files(unittest.TestCase):
    def test_summary_says_how_it_ended(self):
        for key, drive in DRIVES.items():
            if key == "page":
                continue
            s = drive.summary
            if key[0] != "cases":
                self.assertEqual((s["scenario"], s["planner"]), key)
            self.assertEqual(s["time_s"], drive.t[-1])
            least = min(row["clearance"] for row in drive.plant)
            self.assertLessEqual(s["least_clearance_m"], least + 1e-9)
            self.assertAlmostEqual(s["least_clearance_m"], least, delta=0.01)

    def test_samples_are_close(self):
        for key, drive in DRIVES.items():
            if key != "page":
                gaps = [b - a for a, b in zip(drive.t, drive.t[1:])]
                self.assertGreater(min(gaps), 0)
                self.assertLessEqual(max(gaps), 0.02 + 1e-12)

    def test_clearance_is_to_the_grown_circles(self):
        for key in (("E_B", "P_C"), ("E_B", "P_D"), ("E_C", "P_D")):
            drive = DRIVES[key]
            field = drives.obstacles(drive.resolved)
            for row in drive.plant[::50]:
                own = min(math.hypot(row["x"] - o["x"] - o["vx"] * row["t"],
                                     row["y"] - o["y"] - o["vy"] * row["t"]) - o["a"] - 2
                          for o in field)
                self.assertAlmostEqual(row["clearance"], own, delta=1e-9)


if __name__ == "__main__":
    unittest.main()
