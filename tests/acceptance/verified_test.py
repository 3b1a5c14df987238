"""Whole drives of the planner that verifies: the same plans come at the same moments however fast the machine is."""

import unittest

from drives import scratch, simulate_all

# By the clock alone nothing may change: no cycle has an end in time, and none is late.
UNTIMED = ("--planner", "P_E", "--set", "loop.deadline=off", "--set", "loop.latency=paper")


class Verified(unittest.TestCase):
    def test_a_drive_repeats_to_the_bit(self):
        job = ("E_C", *UNTIMED, "--set", "obstacles.O2.vy=-25")
        with scratch() as folder:
            one, other = simulate_all(folder, {"one": job, "other": job}).values()
            self.assertEqual(one.outcome, "goal", one.ended())
            self.assertEqual((one.folder / "plant.csv").read_bytes(),
                             (other.folder / "plant.csv").read_bytes())
            self.assertEqual(one.summary["rungs"], other.summary["rungs"])

    def test_it_drives_the_scenarios_on_roads(self):
        names = ("pedestrian", "door", "merge", "chicane")
        with scratch() as folder:
            for name, drive in simulate_all(folder, {n: (n, *UNTIMED[2:]) for n in names}).items():
                with self.subTest(name):
                    self.assert_clear(drive)

    def test_resolved_files_give_the_same_drives_on_roads(self):
        names = ("parked-row", "double-lane-change", "overtaking", "turning-car")
        untimed = UNTIMED[2:]
        with scratch() as folder:
            for name, drive in simulate_all(folder, {n: (n, *untimed) for n in names}).items():
                with self.subTest(name):
                    self.assert_clear(drive)
                    resolved = drive.folder / "resolved.yaml"
                    again = simulate_all(folder, {name + "-again": (resolved,)})[name + "-again"]
                    self.assertEqual((drive.folder / "plant.csv").read_bytes(),
                                     (again.folder / "plant.csv").read_bytes())

    def assert_clear(self, drive):
        self.assertEqual(drive.outcome, "goal", drive.ended())
        self.assertGreater(drive.summary["least_clearance_m"], 0)
        self.assertGreater(drive.summary["least_edge_distance_m"], 0)


if __name__ == "__main__":
    unittest.main()
