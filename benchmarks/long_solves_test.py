#!/usr/bin/env python3
"""What long_solves.py measures with, on the program at $SLALOM and on answers made up for it."""

import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

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
        text = "\n".join(long_solves.details([row], 600))
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
        text = "\n".join(long_solves.details([row], 600))
        self.assertIn("no: Maximum WallTime Exceeded after 600 s", text)
        self.assertIn("| hard | 3 | 44.4 s | 0.01 s | none (0 of 1 solved) |",
                      "\n".join(long_solves.summary([row])))


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
