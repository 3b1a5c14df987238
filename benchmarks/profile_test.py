#!/usr/bin/env python3
"""What profile.py makes of samples, and what it says where perf takes none."""

import os
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import profile  # noqa: E402

SAMPLES = [(30.0, "slalom::kkt::Loops<4>::factor()"), (10.0, "slalom::nlp::check(slalom::nlp::Problem&)"),
           (10.0, "slalom::base::Timer::cpu()"), (50.0, "nlohmann::dump()")]  # fmt: skip


class Page(unittest.TestCase):
    def page(self, ratios):
        return profile.page({"E_B": (100.0, 5, profile.shares(SAMPLES))}, ratios, "A stamp.\n")

    def test_what_fits_no_part_is_shown_and_what_is_not_the_librarys_is_left_out(self):
        text = self.page({})
        self.assertIn("| factorisation | 60 | 60 % |", text)
        self.assertIn("| the independent check | 20 | 20 % |", text)
        self.assertIn("| other functions of the library | 20 | 20 % |", text)
        self.assertIn("| all | 100 | 5 iterations |", text)

    def test_fronts_together_are_told_of_where_they_were_timed(self):
        self.assertNotIn("together", self.page({}))
        text = self.page({18: 2.0, 28: 1.5, 38: 1.2})
        self.assertIn("| four interleaved, times as fast | 2.00 | 1.50 | 1.20 |", text)
        self.assertIn("in E_B, 60 % of it spent on fronts, 1.25 times as fast.", text)


class Refused(unittest.TestCase):
    def test_perfs_reason_is_said(self):
        with tempfile.TemporaryDirectory() as folder:
            perf = pathlib.Path(folder) / "perf"
            perf.write_text("#!/bin/sh\necho 'No permission to enable cycles event.' >&2\nexit 255\n")
            perf.chmod(0o755)
            with mock.patch.dict(os.environ, {"PATH": folder}), self.assertRaises(SystemExit) as end:
                list(profile.samples(["bench_solve"]))
        self.assertIn("No permission to enable cycles event.", str(end.exception))
        self.assertIn("perf_event_paranoid", str(end.exception))


if __name__ == "__main__":
    unittest.main()
