#!/usr/bin/env python3
"""What becomes of peers that break down, by stand-ins for them and their interpreter; what a statement finds wrong."""

import json
import math
import pathlib
import sys
import tempfile
import types
import unittest
from unittest import mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
sys.modules["judge"] = types.ModuleType("judge")  # which needs SciPy
import attempt  # noqa: E402
import peers  # noqa: E402
import statements  # noqa: E402

STAND_IN = """#!{python}
import json, os, sys, time
answers, what, problem = sys.argv[2:5]
print(what, problem, os.environ["OMP_NUM_THREADS"], file=open("{log}", "a"))
with open(answers, "a") as file:
    if what == "reference":
        if problem == "goddard":
            sys.exit("no package slalom")
        print(json.dumps({{"values": [4.0, 4.000001]}}), file=file)
    if what in ("slalom", "asset"):
        print(json.dumps({{"scheme": "s", "intervals": 10, "setup_s": 0.001, "solve_s": 0.002}}), file=file, flush=True)
    if what == "asset":
        print('{{"scheme":', end="", file=file, flush=True)
        os.kill(os.getpid(), 9)
    if what == "casadi":
        time.sleep(60)
    if what == "maptor":
        sys.exit("Traceback\\nNo module named 'maptor' | at all")
"""


class Broken(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.work = pathlib.Path(scratch.name)
        self.log, self.python = self.work / "log", self.work / "python"
        self.python.write_text(STAND_IN.format(python=sys.executable, log=self.log))
        self.python.chmod(0o755)
        patch = mock.patch.object(peers, "LIMIT", 3)
        self.addCleanup(patch.stop)
        patch.start()

    def measured(self, problems, contestants=peers.CONTESTANTS):
        self.log.write_text("")
        return peers.measure(str(self.python), self.work, problems, contestants, False)

    def test_what_was_found_before_is_kept_and_the_reason_is_said(self):
        found = self.measured(["rayleigh"])["rayleigh"]
        self.assertEqual({c: (len(r["found"]), r["failed"]) for c, r in found.items()}, {
            "slalom": (1, ""), "asset": (1, "killed by SIGKILL"), "casadi": (0, "no more within 3 s"),
            "maptor": (0, "No module named 'maptor' | at all")})  # fmt: skip
        self.assertIn("slalom rayleigh 1\n", self.log.read_text())

    def test_the_next_run_tries_again_what_failed_alone(self):
        self.measured(["rayleigh"], ["slalom", "asset", "maptor"])
        self.measured(["rayleigh"], ["slalom", "asset", "maptor"])
        self.assertEqual(self.log.read_text(), "asset rayleigh 1\nmaptor rayleigh 1\n")

    def test_the_page_goes_on_without_a_converged_objective(self):
        results = self.measured(["goddard", "rayleigh"], ["slalom", "asset", "maptor"])
        text = peers.page(results, {"rayleigh": "Rayleigh", "goddard": "rocket"}, "A stamp.\n")
        self.assertIn("| Rayleigh | 1.0 + 2.0 (s, 10) | 1.0 + 2.0 (s, 10) | not run | failed: No module named 'maptor' / at all |",
                      text)  # fmt: skip
        self.assertIn("Not all schemes were tried:\n\n- ASSET, Rayleigh: failed: killed by SIGKILL\n", text)
        self.assertIn("| rocket | failed: there is no converged objective to compare with |", text)
        self.assertIn("| rocket | failed: no package slalom | – |", text)
        self.assertIn("| Rayleigh | 4 | 4.000001 |", text)
        self.assertIn("| ASSET | 1 | 1.0 | 1.0 | 1.0 | none |", text)

    def test_a_dash_is_what_was_tried_to_the_end(self):
        self.assertEqual(peers.cell({"found": [], "failed": ""}), "–")


class Attempts(unittest.TestCase):
    def found(self, *schemes):
        """Of a tool whose schemes are the numbers of intervals that suffice, or the errors that they raise."""
        def solve(statement, scheme, intervals):
            if scheme in errors:
                raise errors[scheme]
            return intervals >= scheme, 0.001, 0.002

        errors = {number: each for number, each in enumerate(schemes) if isinstance(each, Exception)}
        schemes = [number if number in errors else each for number, each in enumerate(schemes)]
        tool = types.SimpleNamespace(SCHEMES=schemes, solve=solve)
        judge = types.SimpleNamespace(judge=lambda statement, answer, reference: (0.0, 0.0, answer))
        with mock.patch.object(attempt, "judge", judge):
            return [(f["scheme"], f["intervals"]) for f in attempt.measure(tool, None, 1.0)]

    def test_each_scheme_has_its_first_good_mesh(self):
        self.assertEqual(self.found(40, 1000, 10), [(40, 40), (10, 10)])

    def test_a_tool_that_raises_errors_alone_did_not_fail_in_accuracy(self):
        with self.assertRaises(SystemExit) as end:
            self.found(TypeError("no such\nargument"))
        self.assertRegex(str(end.exception), "^every attempt raised an error, the last: .*, 320: TypeError: no such argument$")
        self.assertEqual(self.found(TypeError("no"), 1000), [])


class Violation(unittest.TestCase):
    """Of the car past a disc: three nodes, 9 m aside of its middle as it passes."""

    def violation(self, tf=6.0, aside=9.0, end=0.0, speed=10.0):
        rows = [[x, y, math.pi / 2, ux, 0.0] for x, y, ux in ((0.0, 0.0, 10.0), (aside, 30.0, speed), (end, 60.0, 10.0))]
        return statements.bicycle().violation(math, [0.0, tf / 2, tf], rows, lambda k, t: [0.0, 0.0])

    def test_nodes_that_keep_to_all_violate_nothing(self):
        self.assertEqual(self.violation(), 0)

    def test_ends_bounds_times_and_paths_are_looked_at(self):
        self.assertAlmostEqual(self.violation(end=0.9), 0.9 / (2 * 9))  # beside the goal
        self.assertAlmostEqual(self.violation(speed=16.0), 1 / (2 * 16))  # of 15 m/s at the most
        self.assertAlmostEqual(self.violation(tf=40.0), 10 / 40)  # of 30 s at the most
        self.assertAlmostEqual(self.violation(aside=2.0), 35 / (2 * 865))  # 1 m from the middle of a disc of 6 m


if __name__ == "__main__":
    unittest.main()
