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


if __name__ == "__main__":
    unittest.main()
