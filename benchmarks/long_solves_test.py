#!/usr/bin/env python3
"""What long_solves.py measures with, on the program at $SLALOM and on answers made up for it."""

import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import types
import unittest
from unittest import mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import long_solves  # noqa: E402


def answer(cost, cpu, solved=True, iterations=10):
    return {"solved": solved, "status": "Solve_Succeeded" if solved else "Maximum_WallTime_Exceeded",
            "cost": cost, "cpu_s": [cpu], "iterations": iterations, "setup_s": 0.1}


class Fields(unittest.TestCase):
    def test_a_seed_gives_17_moving_circles_clear_of_the_start(self):
        for seed in long_solves.SEEDS:
            field = long_solves.field(seed)
            self.assertEqual(field, long_solves.field(seed))
            self.assertEqual(len(field), 17)
            self.assertTrue(all(math.hypot(x - 200, y) > r + long_solves.SM_END for x, y, r, *_ in field))
            self.assertTrue(any(math.hypot(vx, vy) > 1 for *_, vx, vy in field))
        self.assertNotEqual(long_solves.field(1), long_solves.field(2))


STAND_IN = """#!{python}
import json, os, sys
answer = {{"solved": True, "iterations": len(open("{log}").read()), "threads": os.environ["OMP_NUM_THREADS"]}}
open("{log}", "a").write("x")
json.dump(answer, open(sys.argv[3], "w"))
"""


class Kept(unittest.TestCase):
    """By a stand-in for the interpreter that has CasADi, which counts what it is asked to solve."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        folder = pathlib.Path(scratch.name)
        (folder / "log").touch()
        python = folder / "python"
        python.write_text(STAND_IN.format(python=sys.executable, log=folder / "log"))
        python.chmod(0o755)
        self.log = folder / "log"
        self.args = types.SimpleNamespace(work=folder, python=python, limit=600, casadi="3.8.2")

    def solves(self, case, mode="vm", rule="adaptive"):
        before = len(self.log.read_text())
        self.answer = long_solves.casadi(self.args, "name", case, mode, rule)
        return len(self.log.read_text()) - before

    def test_a_case_that_changed_is_solved_anew_by_every_way(self):
        ways = [("vm", "adaptive"), ("vm", "monotone"), ("c", "monotone")]
        for case in ({"N": 60}, {"N": 61}):
            self.assertEqual([self.solves(case, *way) for way in ways], [1, 1, 1])
            self.assertEqual([self.solves(case, *way) for way in ways], [0, 0, 0])
        self.assertEqual((self.answer["iterations"], self.answer["threads"]), (5, "1"))

    def test_another_casadi_limit_or_script_solves_anew(self):
        self.solves({})
        self.args.casadi = "3.9.0"
        self.assertEqual(self.solves({}), 1)
        self.args.limit = 300
        self.assertEqual(self.solves({}), 1)
        scripts = self.args.work / "scripts"
        scripts.mkdir()
        for name in long_solves.SCRIPTS:
            (scripts / name).write_text("# changed\n")
        with mock.patch.object(long_solves, "HERE", scripts):
            self.assertEqual((self.solves({}), self.solves({})), (1, 0))

    def test_an_answer_that_does_not_say_to_what_is_not_taken(self):
        self.solves({})
        out = self.args.work / "name_vm_adaptive.json"
        out.write_text(json.dumps({"solved": True}))
        self.assertEqual(self.solves({}), 1)

    def test_a_solve_that_fails_leaves_no_answer_of_another_case(self):
        self.solves({})
        self.args.python = "false"
        self.assertFalse(long_solves.casadi(self.args, "name", {"N": 3}, "vm", "adaptive")["solved"])
        self.assertFalse((self.args.work / "name_vm_adaptive.json").exists())


class Judgement(unittest.TestCase):
    def test_the_fastest_way_to_our_optimum_counts(self):
        ways = {("vm", "adaptive"): answer(900.0, 0.1), ("vm", "monotone"): answer(500.0001, 0.4),
                ("c", "monotone"): answer(500.0001, 0.2)}
        self.assertEqual(long_solves.best(answer(500.0, 0.01), ways)[0], ("c", "monotone"))
        self.assertEqual(long_solves.best(answer(700.0, 0.01), ways)[0], ("c", "monotone"))
        self.assertEqual(long_solves.best(answer(900.0, 0.01), ways)[0], ("vm", "adaptive"))
        unsolved = {("vm", "adaptive"): answer(500.0, 600, solved=False), ("c", "adaptive"): answer(900.0, 3)}
        self.assertEqual(long_solves.best(answer(500.0, 0.01), unsolved)[0], ("c", "adaptive"))

    def test_tables(self):
        row = {"N": 60, "constraint": "hard", "count": 3, "label": "3 (E_B)", "ours": answer(500.0, 0.01),
               "casadi": {("vm", "adaptive"): answer(500.0001, 0.25)}}  # fmt: skip
        text = long_solves.details([row], 600)
        self.assertIn("| 0.01 s, 10 | 0.25 s, 10 | virtual machine, adaptive | × 25.0 |", text)
        self.assertIn("2.0e-07", text)
        self.assertEqual(long_solves.slower_line([row]),
                         "CasADi is the faster in 0 of 1, and finds a lower optimum in 0.")
        row["ours"] = answer(600.0, 0.5)
        self.assertEqual(long_solves.slower_line([row]),
                         "CasADi is the faster in 1 of 1 (N = 60, hard, 3 (E_B)), and finds a lower optimum in 1 "
                         "(N = 60, hard, 3 (E_B)).")
        row["ours"] = answer(500.0, 0.01)
        row["casadi"]["vm", "adaptive"] = answer(math.nan, 600, solved=False)
        text = long_solves.details([row], 600)
        self.assertIn("no: Maximum WallTime Exceeded after 600 s", text)
        self.assertIn("| hard | 3 | 44.4 s | 0.01 s | none (0 of 1 solved) |",
                      long_solves.summary([row]))


@unittest.skipUnless(os.environ.get("SLALOM"), "needs the program")
class Ours(unittest.TestCase):
    def test_the_three_are_e_bs(self):
        text = subprocess.run([os.environ["SLALOM"], "check", "E_B"], check=True, capture_output=True,
                              text=True).stdout  # fmt: skip
        self.assertEqual(len(long_solves.THREE), text.count("- {name:"))
        for x, y, r, vx, vy in long_solves.THREE:
            self.assertIn(f"x: {x}, y: {y}, a: {r}, b: {r}, vx: {vx}, vy: {vy}}}", text)

    def test_both_kinds_of_rows_are_solved_and_soft_ones_cost_no_more(self):
        with tempfile.TemporaryDirectory() as folder:
            scenario = pathlib.Path(folder) / "scenario.yaml"
            scenario.write_text(long_solves.scenario_text(long_solves.THREE))
            hard, soft = (long_solves.ours(os.environ["SLALOM"], scenario, 30, c) for c in ("hard", "soft"))
        self.assertTrue(hard["solved"] and soft["solved"])
        self.assertLessEqual(soft["cost"], hard["cost"] + 1e-3)
        self.assertEqual(len(hard["cpu_s"]), long_solves.RUNS)
        self.assertGreater(hard["setup_s"], 0)


if __name__ == "__main__":
    unittest.main()
