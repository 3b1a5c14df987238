#!/usr/bin/env python3
"""What run.py does before it measures, and what becomes of its results."""

import pathlib
import sys
import unittest
from unittest import mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import run  # noqa: E402
from summary import summarise  # noqa: E402
from tables import markdown  # noqa: E402

ABOUT = {"run": "a", "commit": "0123456", "recorded": 300, "perturbed": 20, "seed": 1, "machine": {}}


def result(contestant, first=0, count=250, cpu_s=0.01, **changes):
    """Of a chunk at the floor, warm, in E_B: every cycle solved."""
    cycles = [{"cycle": cycle, "claimed": True, "violation": 0, "stationarity": 0, "complementarity": 0, "cpu_s": cpu_s,
               "wall_s": cpu_s, "iterations": 5, "phi": 1.0, "path": [0.0]} for cycle in range(first, first + count)]  # fmt: skip
    return {"contestant": contestant, "environment": "E_B", "level": "floor", "start": "warm", "first": first,
            "setup_s": 0.001, "version": "0123456", "load": 0.1, "cycles": cycles} | changes  # fmt: skip


def failed(contestant, first=0):
    """What write_result keeps of a chunk that failed."""
    kept = result(contestant, first, 0, error="no answer within 1200 s")
    return {name: value for name, value in kept.items() if name not in ("setup_s", "cycles")}


def summary_of(*results):
    return summarise(ABOUT, {str(k): each for k, each in enumerate(results)})


def times(summary):
    return summary["environments"]["E_B"]["groups"][0]["times"]


class Failures(unittest.TestCase):
    def test_cycles_of_a_chunk_that_failed_count_as_unsolved(self):
        summary = summary_of(result("slalom"), result("slalom", 250, 70), result("casadi-c"), failed("casadi-c", 250))
        found = times(summary)["casadi-c"]
        self.assertEqual((found["of"], found["solved"], found["all"]), (320, 250, 320))
        self.assertEqual(found["cpu_ms"], {"median": 10.0, "p95": 500.0, "p99": 500.0, "max": 500.0})
        self.assertEqual(found["iterations"]["max"], 5)

    def test_the_page_says_what_failed(self):
        summary = summary_of(result("slalom"), result("slalom", 250, 70), result("casadi-c"), failed("casadi-c", 250),
                             failed("casadi-vm"))  # fmt: skip
        self.assertNotIn("casadi-vm", times(summary))
        text = markdown(summary, "nowhere")
        self.assertIn("- CasADi C + Ipopt failed in 1 of its chunks of 250 cycles in E_B, which count as not solved: no answer "
                      "within 1200 s\n", text)  # fmt: skip
        self.assertIn("- CasADi VM + Ipopt did not run in E_B: no answer within 1200 s\n", text)
        self.assertIn("250/320 (78.1 %)", text)


class Steps(unittest.TestCase):
    def steps(self, *arguments):
        done = []
        stand_ins = {name: lambda args, name=name: done.append(name) for name in run.STEPS}
        stand_ins["build_ours"] = lambda *names: done.append("build")
        with (mock.patch.dict(run.__dict__, stand_ins), mock.patch.object(sys, "argv", ["run.py", *arguments]),
              mock.patch.object(run.os, "sched_setaffinity")):  # fmt: skip
            run.main()
        return done

    def test_what_is_measured_is_built_before(self):
        self.assertEqual(self.steps("measure", "report", "--again", "--contestants", "slalom"), ["build", "measure", "report"])
        self.assertEqual(self.steps(), ["build", *run.STEPS])

    def test_a_report_builds_nothing(self):
        self.assertEqual(self.steps("report"), ["report"])


if __name__ == "__main__":
    unittest.main()
