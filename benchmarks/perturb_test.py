#!/usr/bin/env python3
"""What perturb.py solves anew and what it makes of it, by a stand-in for bench_perturb and bench_record."""

import pathlib
import sys
import tempfile
import unittest
from unittest import mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import perturb  # noqa: E402

STAND_IN = """#!{python}
import json, sys
option = dict(zip(sys.argv[1::2], sys.argv[2::2]))
open("{log}", "a").write(option["--first"] + " " + option["--count"] + "\\n")
for cycle in range(int(option["--first"]), int(option["--first"]) + int(option["--count"])):
    answer = {{"status": "solved", "confirmed": True, "iterations": cycle, "phi": 1.0}}
    limited = {{"status": "solved", "cpu_s": 0.001, "longest_step_s": 0.001}}
    print(json.dumps({{"cycle": cycle, "ours": answer, "ipopt": answer, "deadline": limited, "allocations": 0}}))
"""


class Kept(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.log, self.program = self.folder / "log", self.folder / "bench_perturb"
        self.log.touch()
        self.put_program()
        patch = mock.patch.multiple(perturb, program=lambda _: str(self.program), CHUNK=10,
                                    record_cycles=lambda _, out, *more: out.touch())  # fmt: skip
        self.addCleanup(patch.stop)
        patch.start()

    def put_program(self, more=""):
        self.program.write_text(STAND_IN.format(python=sys.executable, log=self.log) + more)
        self.program.chmod(0o755)

    def solved(self, count):
        """Cycles that there are lines of; what the program was asked for meanwhile."""
        before = len(self.log.read_text().splitlines())
        lines = perturb.solve_all(self.folder / "work", count, 1)
        return [line["cycle"] for line in lines], self.log.read_text().splitlines()[before:]

    def test_a_run_of_more_cycles_solves_what_a_run_of_fewer_left_out(self):
        self.assertEqual(self.solved(4), (list(range(4)), ["0 4"]))
        self.assertEqual(self.solved(25), (list(range(25)), ["0 10", "10 10", "20 5"]))
        self.assertEqual(self.solved(25), (list(range(25)), []))
        self.assertEqual(self.solved(13), (list(range(13)), []))

    def test_another_program_solves_all_anew(self):
        self.solved(4)
        self.put_program("# built anew\n")
        self.assertEqual(self.solved(4)[1], ["0 4"])

    def test_the_page_has_as_many_cycles_as_were_asked_for(self):
        self.solved(4)
        page = self.folder / "page.md"
        command = ["perturb.py", "--work", str(self.folder / "work"), "--out", str(page), "--count", "21", "--jobs", "1"]
        with mock.patch.object(sys, "argv", command), mock.patch.object(perturb, "build_ours"):
            perturb.main()
        text = page.read_text()
        self.assertIn("| cycles | 21 |\n", text)
        self.assertIn("| iterations of ours: median, p95, max | 10, 19, 20 |\n", text)
        self.assertIn("| | solved |\n|---|---|\n| solved | 21 |\n", text.replace("|  |", "| |"))
        self.assertIn("*Written by `benchmarks/perturb.py --count 21`;", text)


if __name__ == "__main__":
    unittest.main()
