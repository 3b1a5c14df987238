#!/usr/bin/env python3
"""What any_scenario.py makes of a scenario, and how it finds what is at fault."""

import math
import pathlib
import re
import sys
import tempfile
import types
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from any_scenario import (  # noqa: E402
    NO_CAUSE, NO_DRIVE, UNREPORTED, Drive, depth, moved, page, unexplained, unreported, without_a_drive)  # fmt: skip

TEXT = """name: "made"
start: {x: 0, y: 10, v: 0, r: 0, psi: 1.5, sa: 0, ux: 17, ax: 0}
goal: {x: 5, y: 200, psi: 1.5, sigma: 15}
region: {x_min: -12, x_max: 24}
obstacles:
  - {name: "O 1", x: 3, y: 100, a: 2, b: 1, vx: 4, vy: -1e-3}
loop:
  tex: 0.5
"""


def numbers(text, section):
    line = next(line for line in text.splitlines() if line.strip().startswith(section))
    return {k: float(v) for k, v in re.findall(r"(\w+): ([-+.\d][-+.\deE]*)", line)}


class Moved(unittest.TestCase):
    def test_a_quarter_turn_and_a_move(self):
        text = moved(TEXT, 1, 2, 1000, -50)
        start, goal, region, obstacle = (numbers(text, s) for s in ("start", "goal", "region", "- {"))
        self.assertEqual((start["x"], start["y"]), (990, -50))
        self.assertAlmostEqual(start["psi"], 1.5 + math.pi / 2 + 4 * math.pi)
        self.assertEqual((goal["x"], goal["y"]), (800, -45))
        self.assertEqual(region, {"y_min": -62, "y_max": -26})
        self.assertEqual((obstacle["x"], obstacle["y"]), (900, -47))
        self.assertEqual((obstacle["a"], obstacle["b"], obstacle["vx"], obstacle["vy"]), (1, 2, 1e-3, 4))
        self.assertIn('name: "O 1"', text)
        self.assertIn("  tex: 0.5\n", text)

    def test_four_quarters_are_none(self):
        self.assertEqual(numbers(moved(TEXT, 4, 0, 0, 0), "region"), numbers(TEXT, "region"))
        self.assertEqual(numbers(moved(TEXT, 2, 0, 0, 0), "region"), {"x_min": -24, "x_max": 12})


class Faults(unittest.TestCase):
    def test_a_plan_between_its_nodes(self):
        def node(t, x):
            return {"t": t, "x": x, "y": 0.0, "psi": 0.0, "v": 0.0, "r": 0.0, "ux": 20.0}
        o = {"x": 40.0, "y": 3.0, "a": 2.0, "b": 1.0, "vx": -20.0, "vy": 0.0}
        nodes = [node(0.0, 0.0), node(2.0, 40.0)]  # they meet at 1 s
        self.assertAlmostEqual(depth(nodes, o, None, 1.5), 2.0)
        self.assertAlmostEqual(depth(nodes, o, 0.0, 1.5), 2.0)  # held: passed at 2 s
        self.assertAlmostEqual(depth(nodes[:1], o, None, 1.5), math.inf)

    def test_a_drive_without_a_plan_says_why(self):
        def ended(message, outcome="not_optimal"):
            return unexplained({"outcome": outcome, "message": message})
        self.assertEqual(ended("the NLP of cycle 2 was not solved: infeasible; O1 in the way: node 3"), {NO_CAUSE: ""})
        self.assertIn("names no cause", ended("the NLP of cycle 2 was not solved: infeasible")[NO_CAUSE])
        self.assertEqual(ended("reached the goal", "goal"), {})

    def test_a_refusal_is_counted_and_no_fault_while_other_errors_are(self):
        def ended(code, message):
            return without_a_drive(types.SimpleNamespace(returncode=code, stderr=message))
        self.assertEqual(ended(2, "x.yaml:2:1: start.ux: found -1, expected at least 0\n"), ("refused", {}))
        self.assertEqual(ended(2, "terminate called\n"), ("exit code 2", {NO_DRIVE: "terminate called"}))
        self.assertEqual(ended(-11, ""), ("exit code -11", {NO_DRIVE: "no message"}))

    def test_each_kind_of_fault_is_counted_of_those_that_it_is_judged_of(self):
        text = page([Drive("0-gates-0001", "P_A", {}, "goal", {NO_DRIVE: "", UNREPORTED: ""}),
                     Drive("0-gates-0002", "P_A", {"loop.tex": 1}, "hangs", {NO_DRIVE: "late"}),
                     Drive("0-gates-0003", "P_A", {}, "refused", {}),
                     Drive("0-gates-0004", "P_E", {}, "not_optimal", {NO_DRIVE: "", NO_CAUSE: ""})], "A stamp.\n")  # fmt: skip
        self.assertIn("Of 4, 1 are refused", text)
        self.assertIn("| planner | drives | goal | hangs | not_optimal | refused | at fault |", text)
        self.assertIn("| P_A | 3 | 1 | 1 | 0 | 1 | 1 |", text)
        counts = {kind: re.search(rf"(?m)^\| {kind} \|.*\| (\d+ \| \d+) \| [^|]+\|$", text)[1]
                  for kind in (NO_DRIVE, NO_CAUSE, UNREPORTED)}
        self.assertEqual(counts, {NO_DRIVE: "1 | 3", NO_CAUSE: "0 | 1", UNREPORTED: "0 | 1"})
        self.assertIn("- 0-gates-0002, P_A, hangs: late (loop.tex=1)", text)
        self.assertNotIn("check` takes them", text)

    def test_plans_of_p_e_are_not_looked_at(self):
        self.assertEqual(unreported(pathlib.Path("/nowhere"), "P_E"), {})

    def test_a_solved_plan_through_an_obstacle_is_a_fault_by_any_settings(self):
        resolved = (TEXT + "planner:\n  sm_start: 2.5\n  sm_end: 4\n  passage_depth: 0.5\n  moving_avoidance: true\n"
                    "  obstacle_constraint: soft\n  model: kinematic\nvehicle:\n  la: 1.5\n")
        nodes = [(0, 0), (1, 20), (2, 40)]  # eastwards below O 1, whose shorter axis is 1 m
        for y, status, fault in ((98.9, "solved", True), (96, "solved", False), (98.9, "passes_through: 1.6 m", False)):
            with self.subTest(y=y, status=status), tempfile.TemporaryDirectory() as folder:
                out = pathlib.Path(folder)
                (out / "resolved.yaml").write_text(resolved)
                (out / "cycles.csv").write_text(f"cycle,t0,status\n1,0,{status}\n")
                (out / "plans.csv").write_text("cycle,t,x,y,psi,v,r,ux\n" + "".join(
                    f"1,{t},{x - 20},{y},0,0,0,20\n" for t, x in nodes))
                found = unreported(out, "P_D")
                if status != "solved":
                    self.assertEqual(found, {})
                else:
                    self.assertEqual(bool(found[UNREPORTED]), fault, found)


if __name__ == "__main__":
    unittest.main()
