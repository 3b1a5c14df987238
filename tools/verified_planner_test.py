#!/usr/bin/env python3
"""What the pages on P_E and on random scenarios drive and count, by a stand-in for the program."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import random_scenarios  # noqa: E402
import stand_in  # noqa: E402
import verified_planner  # noqa: E402


class Page(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def verified_planner(self, crashes, failures="none"):
        """The page, and the commands that made it."""
        text = stand_in.page_of(verified_planner.main, self.folder, "--most", "1", "--points", "2", "--jobs", "3",
                                STAND_IN_LOG=str(self.folder / "log"), STAND_IN_CRASHES=crashes,
                                STAND_IN_FAILURES=failures)  # fmt: skip
        return text, (self.folder / "log").read_text().splitlines()

    def test_as_many_drives_at_a_time_as_it_says(self):
        text, commands = self.verified_planner("none")
        sweeps = [command for command in commands if command.startswith("sweep")]
        self.assertGreater(len(sweeps), 10)
        self.assertEqual([command for command in sweeps if "--jobs 3" not in command], [])
        self.assertIn("Drives at a time: 3.", text)
        self.assertIn("tools/verified_planner.py --most 1 --points 2 --jobs 3", text)
        self.assertIn("Of the offline drives 0 do not arrive", text)
        self.assertIn("| P_D arrives too | 2 | 1.000 | 1.000 | 1.000 |", text)

    def test_times_are_those_of_all_cycles_of_a_horizon(self):
        text, _ = self.verified_planner("none")
        self.assertIn("| 1 | 2 | 2 | 4 | 2.00 | 3.0 | 3.0 | 0.00 | 0.0020 | 0.00 | 0.0030 |", text)
        kept = {file.name for file in (self.folder / "work/sweep-40-P_E/drives/000001").iterdir()}
        self.assertEqual(kept, {"cycles.csv"})

    def test_an_offline_drive_that_does_not_arrive_bounds_nothing(self):
        text, _ = self.verified_planner("^E_C P_E -40(.0)?$")  # the study without an axis of horizons
        self.assertIn("Of the offline drives 1 do not arrive", text)
        self.assertNotIn("| P_D arrives too |", text)

    def test_a_trial_that_fails_is_counted_and_takes_nothing_with_it(self):
        text, _ = self.verified_planner("none", "P_E 1 -40(.0)?$")
        self.assertIn("| 1 | 2 | 1 | 2 |", text)

    def test_scenarios_of_a_larger_count_before_are_not_driven(self):
        scenarios = self.folder / "work/scenarios"
        scenarios.mkdir(parents=True)
        (scenarios / "gates-0002.yaml").write_text("name: of another count\n")
        text = stand_in.page_of(random_scenarios.main, self.folder, "--count", "1", STAND_IN_CRASHES="gates-0002")
        self.assertIn("8 scenarios, 1 of each family", text)
        self.assertIn("| gates |" + " 1/1 |" * 4, text)
        self.assertIn("tools/random_scenarios.py --count 1", text)


if __name__ == "__main__":
    unittest.main()
