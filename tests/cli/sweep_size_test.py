"""The size of a study: a million trials of many drawn keys take little memory, and more is refused at once."""

import os
import subprocess
import unittest

from program import PROGRAM, run
from sweeps import SweepTest

KEYS = ("start.x", "start.y", "start.v", "start.r", "start.psi", "start.sa", "start.ux", "start.ax", "goal.x", "goal.y",
        "goal.psi", "goal.sigma", "obstacles.O1.x", "obstacles.O1.y", "obstacles.O2.x", "obstacles.O2.y")


def draw(count, method, keys=KEYS):
    of = ", ".join(f"{{key: {key}, uniform: [1, 1.1]}}" for key in keys)
    return f"scenario: E_A\naxes:\n  - draw: {{count: {count}, method: {method}, of: [{of}]}}\n"


class Size(SweepTest):
    def test_a_hundred_thousand_points_of_many_keys_take_little_memory(self):
        for method in ("sobol", "random", "latin_hypercube"):
            study = self.write("large.yaml", draw(100_000, method))
            arguments = [PROGRAM, "sweep", str(study), "--out", str(self.folder / method), "--limit", "0", "--quiet"]
            process = subprocess.Popen(arguments)
            _, status, used = os.wait4(process.pid, 0)
            process.returncode = status
            self.assertEqual(status, 0)
            self.assertLess(used.ru_maxrss / 1024, 90, method)  # [MB]; 12.8 of them are the values

    def test_more_values_than_memory_should_hold_are_refused(self):
        keys = [f"obstacles.O{i}.x" for i in range(3)] * 7
        result = run("sweep", self.write("s.yaml", draw(1_000_000, "random", keys)), "--out", self.folder / "out")
        self.assert_refused(result, 2, "s.yaml:3:", "1000000 points of 21 keys", "at most 20000000 values")


if __name__ == "__main__":
    unittest.main()
