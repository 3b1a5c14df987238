"""Drives of P_A to P_D along roads: on a straight one, the paper's; around bends and hairpins, never off the road."""

import csv
import math
import unittest

from drives import SOURCE, STATES, scratch, simulate_all

# E_C with its region as a road, whose edges are the region's sides.
STRAIGHT = "road: {points: [[12, -50, 12, 12], [12, 800, 12, 12]]}\n"
UNTIMED = ("--set", "loop.deadline=off", "--set", "loop.latency=paper")


GAP = """\
name: gap
vehicle: {base: hmmwv, footprint: rectangle}
planner: {base: P_D, sm_start: 0.3, sm_end: 0.3, N: 20}
start: {x: 0, y: 0, psi_deg: 0, ux: 8}
goal: {s: 70}
road: {points: [[-20, 0, 8, 8], [40, 0, 8, 8], [110, 0, 8, 8]]}
obstacles:
  - {name: left, x: 35, y: 3.85, length: 14, width: 5}
  - {name: right, x: 35, y: -3.85, length: 14, width: 5}
loop: {tex: 0.5, sm_crash: 0}
"""


def line(points, width):
    """A road's points, all as wide."""
    return ", ".join(f"[{x:.3f}, {y:.3f}, {width}, {width}]" for x, y in points)


def arc(x, y, radius, begin, end, parts):
    """Places on a circle, at angles from `begin` to `end` in degrees."""
    for k in range(parts + 1):
        angle = math.radians(begin + (end - begin) * k / parts)
        yield x + radius * math.cos(angle), y + radius * math.sin(angle)


def scenario(points, goal, width=4, more=""):
    return f"""vehicle: {{base: hmmwv, footprint: rectangle}}
planner: P_D
start: {{x: 0, y: 0, psi_deg: 0, ux: 10}}
goal: {goal}
road:
  points: [{line(points, width)}]
loop: {{tex: 0.2, sm_crash: 0}}
{more}"""


# 100 m eastwards, half around to the left, and back 30 m beside the way out.
HAIRPIN = ([(x, 0) for x in range(-20, 101, 10)] + list(arc(100, 15, 15, -80, 80, 16)) +
           [(x, 30) for x in range(100, -41, -10)])
# To the left and to the right.
BENDS = ([(x, 0) for x in range(-20, 41, 10)] + list(arc(40, 50, 50, -80, -20, 6)) +
         list(arc(129.3, 17.5, 45, 150, 90, 6)) + [(129.3 + 10 * k, 62.5) for k in range(1, 12)])


class Road(unittest.TestCase):
    def drives(self, folder, jobs):
        """Drives of (text, options) by name."""
        named = {}
        for name, (text, *options) in jobs.items():
            file = f"{folder}/{name}.yaml"
            with open(file, "w", encoding="utf-8") as out:
                out.write(text)
            named[name] = (file, *UNTIMED, *options)
        return simulate_all(folder, named)

    def test_a_straight_road_gives_the_drive_without_it(self):
        with scratch() as folder:
            text = (SOURCE / "config/scenarios/E_C.yaml").read_text()
            region = next(row for row in text.splitlines() if row.startswith("region:"))
            jobs = {"plain": (text,), "instead": (text.replace(region, STRAIGHT),),
                    "beside": (text + STRAIGHT.replace("12, 12]", "20, 15]"),)}
            for planner in ("P_A", "P_B", "P_C"):
                for name in ("plain", "instead"):
                    jobs[f"{name} {planner}"] = (*jobs[name], "--planner", planner)
            drives = self.drives(folder, jobs)
            for name, drive in drives.items():
                kind, _, planner = name.partition(" ")
                if kind != "plain":
                    with self.subTest(name):
                        plain = drives["plain " + planner if planner else "plain"]
                        # From 19 s on P_A, for which time has no price, has two plans to choose from
                        # whose costs differ by .02 %.
                        if planner == "P_A":
                            self.assert_same(plain, drive, 18.5)
                        else:
                            self.assertEqual(plain.outcome, drive.outcome)
                            self.assertAlmostEqual(plain.time, drive.time, delta=1e-3)
                            self.assert_same(plain, drive, min(plain.time, drive.time))

    def assert_same(self, one, other, until):
        for k in range(int(until / 0.1)):
            far = math.hypot(*(one.at(0.1 * k, i) - other.at(0.1 * k, i) for i in STATES[:2]))
            self.assertLess(far, 0.01, f"at {0.1 * k} s")

    def test_it_keeps_to_roads_that_bend(self):
        with scratch() as folder:
            jobs = {"bends": (scenario(BENDS, "{s: 230}"),),
                    "hairpin": (scenario(HAIRPIN, "{s: 280}"),)}
            for name, drive in self.drives(folder, jobs).items():
                with self.subTest(name):
                    self.assertEqual(drive.outcome, "goal", drive.ended())
                    self.assertGreater(drive.summary["least_edge_distance_m"], 0)

    def test_a_body_passes_what_leaves_one_side_free(self):
        """By margins for a body; the paper's are about a point."""
        closer = ("--planner", "P_D", "--set", "planner.sm_start=0.3", "--set", "planner.sm_end=0.3", *UNTIMED)
        with scratch() as folder:
            jobs = {name: (name, *closer) for name in ("chicane", "door", "merge", "overtaking", "parked-row", "pedestrian",
                                                 "turning-car")}
            for name, drive in simulate_all(folder, jobs).items():
                with self.subTest(name):
                    self.assertEqual(drive.outcome, "goal", drive.ended())
                    self.assertGreater(drive.summary["least_clearance_m"], 0)
                    self.assertGreater(drive.summary["least_edge_distance_m"], 0)

    def test_a_verified_plan_may_end_in_a_bend(self):
        """In the chicane the goal comes while the vehicle turns so hard that it may not brake at once."""
        with scratch() as folder:
            drive = simulate_all(folder, {"chicane": ("chicane", *UNTIMED)})["chicane"]
            self.assertEqual(drive.outcome, "goal", drive.ended())
            self.assertEqual(drive.summary["cycles_unverified"], 0)
            with open(drive.folder / "cycles.csv", newline="") as file:
                first = next(csv.DictReader(file))
            self.assertEqual(first["goal_in_range"], "1", "the first plan only stops")

    def test_a_body_drives_through_a_gap_little_wider_than_its_margins(self):
        """Two lorries side by side: .35 m beside a body that keeps .3 m at the nodes of its plans."""
        with scratch() as folder:
            drive = self.drives(folder, {"gap": (GAP,)})["gap"]
            self.assertEqual(drive.outcome, "goal", drive.ended())
            self.assertGreater(drive.summary["least_clearance_m"], 0.3)


if __name__ == "__main__":
    unittest.main()
