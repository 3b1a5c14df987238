#!/usr/bin/env python3
"""What laps.py makes of a track's file and of what was measured; with $SLALOM, on a small track driven here."""

import json
import math
import os
import pathlib
import sys
import tempfile
import types
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import laps  # noqa: E402


def measured(**changes):
    peer = {"ours": {"solved": True, "status": "solved", "iterations": 40, "cpu_s": 0.5, "time_s": 60.0},
            "casadi": {"solved": True, "status": "Solve_Succeeded", "iterations": 50, "cpu_s": 3.0,
                       "time_s": 60.003, "ours_here": {"violation": 2e-7}, "casadi": "3.8.2"}}  # fmt: skip
    mesh = {"intervals": 100, "iterations": 40, "objective": 60.1, "solve_s": 0.4}
    return {"track": "ring", "peer": peer,
            "lap": {"length_m": 2000.0, "status": "converged", "time_s": 60.0, "meshes": [mesh, mesh]},
            "drive": {"outcome": "goal", "lap_ends_s": [63.0, 124.5], "least_edge_distance_m": 0.25}} | changes  # fmt: skip


class Page(unittest.TestCase):
    def page(self, *rows):
        return laps.page(list(rows), "A stamp.\n", 600, "3.8.2")

    def test_a_track_has_its_figures(self):
        text = self.page(measured())
        self.assertIn("| ring | 2000 | 60.000 | converged | 100, 100 | 40, 40 | 0.8 |", text)
        self.assertIn("| ring | 100 | 0.50 s, 40 | 3.00 s, 50 | × 6.0 | 60.0000, 60.0030 | 5.0e-05 | 2.0e-07 |", text)
        self.assertIn("| ring | 60.00 | 61.50 | 2.5% | goal | 0.250 |", text)
        self.assertIn("same lap time to 0.0001: 1; ours at least 5 times faster: 1 (from × 6.0 to × 6.0)", text)
        self.assertIn("1 of 1 flying laps within 3%", text)

    def test_it_says_how_busy_the_machine_was_and_what_was_left_out(self):
        self.assertIn("Load of the machine meanwhile: 0.5 to 7.2 on", self.page(measured(loads=[7.2, 0.5])))
        parser = laps.parser_of()
        parser.prog = "laps.py"
        for options in ("", "--peers ring circuit", "--vehicle hmmwv --peers --no-drives --limit 300.0"):
            args = parser.parse_args(["tracks", *options.split()])
            self.assertEqual(laps.made_by(parser, args),
                             f"benchmarks/laps.py FOLDER {options}" if options else "make laps TRACKS=folder")  # fmt: skip

    def test_it_says_what_falls_short(self):
        row = measured()
        row["peer"]["casadi"] |= {"cpu_s": 1.0, "time_s": 61.0}
        row["drive"] |= {"lap_ends_s": [63.0, 126.0], "least_edge_distance_m": -0.01}
        text = self.page(row)
        self.assertIn("same lap time to 0.0001: 0; ours at least 5 times faster: 0", text)
        self.assertIn("0 of 1 flying laps within 3% of the optimum; 0 of the drives on the road", text)

    def test_what_was_not_solved_or_driven_is_left_open(self):
        late = {"solved": False, "status": "Maximum_CpuTime_Exceeded", "iterations": 7, "cpu_s": 600.0,
                "time_s": 70.0, "ours_here": {"violation": 2e-7}}  # fmt: skip
        text = self.page(measured(peer={"ours": measured()["peer"]["ours"], "casadi": late}),
                         {"track": "lost", "lap": {"failure": "no road"}, "drive": {"failure": "no road"}})  # fmt: skip
        self.assertIn("| 600.00 s, 7, Maximum CpuTime Exceeded | – |", text)
        self.assertIn("CasADi solved 0 of 1; same lap time to 0.0001: 0; ours at least 5 times faster: 0.", text)
        self.assertIn("| lost | – | – | no road |", text)
        self.assertIn("| lost | – | – | – | no road | – |", text)

    def test_a_casadi_that_breaks_down_is_counted_and_its_reason_said(self):
        crashed = measured(peer={"ours": measured()["peer"]["ours"], "casadi": {"failure": "Killed | at 3"}})
        text = self.page(measured(), crashed, measured(peer={"failure": "bench_lap: no memory"}))
        self.assertIn("CasADi solved 1 of 2; same lap time", text)
        self.assertIn("| 0.50 s, 40 | failed: Killed / at 3 | – | 60.0000, – | – | – |", text)
        self.assertIn("\nring was not compared with CasADi: bench_lap: no memory.\n", text)

    def test_without_peers_and_drives_there_are_no_such_tables(self):
        row = measured()
        del row["peer"], row["drive"]
        self.assertNotIn("CasADi with Ipopt\n\nCasADi", self.page(row))
        self.assertNotIn("closed loop\n\n|", self.page(row))


STAND_IN = """#!{python}
import json, os, pathlib, sys
kind = "casadi" if "lap_casadi.py" in sys.argv[1] else "bench" if "--intervals" in sys.argv else sys.argv[1]
open("{folder}/log", "a").write(kind + "\\n")
if kind in open("{folder}/broken").read().split():
    sys.exit("it broke down")
answer = {{"solved": True, "status": "solved", "iterations": 9, "cpu_s": 2.0, "time_s": 60.0, "points": [],
           "casadi": "3.8.2", "threads": os.environ.get("OMP_NUM_THREADS")}}
if kind in ("casadi", "bench"):
    out = sys.argv[3] if kind == "casadi" else sys.argv[2]
    pathlib.Path(out).write_text(json.dumps({{"ours": answer}} if kind == "bench" else answer))
else:
    print(json.dumps({{"message": "as it should be", "outcome": "goal", "meshes": [{{"intervals": 9}}]}}))
"""


class Kept(unittest.TestCase):
    """By a stand-in for the program, bench_lap and the interpreter that has CasADi."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        program = self.folder / "program"
        program.write_text(STAND_IN.format(python=sys.executable, folder=self.folder))
        program.chmod(0o755)
        self.args = types.SimpleNamespace(work=self.folder, vehicle="bmw_320i", program=program, bench=program, python=program,
                                          peers=None, no_drives=False, limit=600)  # fmt: skip

    def measured(self, broken=""):
        """The row, and what was called for it."""
        (self.folder / "broken").write_text(broken)
        (self.folder / "log").write_text("")
        row = laps.measured_row(self.args, laps.BUILT_IN)
        return row, (self.folder / "log").read_text().split()

    def test_what_broke_down_is_tried_again_and_the_rest_is_kept(self):
        row, called = self.measured("casadi simulate")
        self.assertEqual(called, ["lap", "bench", "casadi", "simulate"])
        self.assertEqual((row["peer"]["casadi"], row["drive"]), ({"failure": "it broke down"},) * 2)
        self.assertEqual(self.measured("bench")[1], ["bench", "simulate"])
        row, called = self.measured()
        self.assertEqual((called, row["peer"]["casadi"]["threads"]), (["bench", "casadi"], "1"))
        self.assertEqual(self.measured()[1], [])

    def test_another_limit_or_vehicle_is_measured_anew(self):
        self.measured()
        self.args.limit = 300
        self.assertEqual(self.measured()[1], ["bench", "casadi"])
        self.args.vehicle = "hmmwv"
        self.assertEqual(self.measured()[1], ["lap", "bench", "casadi", "simulate"])


@unittest.skipUnless(os.environ.get("SLALOM"), "needs the program")
class Measured(unittest.TestCase):
    def test_a_small_track_is_solved_and_kept(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            track = folder / "ring.csv"
            points = [(60 * math.cos(2 * math.pi * k / 40), 40 * math.sin(2 * math.pi * k / 40)) for k in range(40)]
            track.write_text("# x_m,y_m,w_tr_right_m,w_tr_left_m\n" + "".join(f"{x},{y},4,4\n" for x, y in points))
            x, y, psi = laps.start_of(track)
            self.assertAlmostEqual(psi, math.pi / 2)
            args = types.SimpleNamespace(work=folder, vehicle="bmw_320i", program=os.environ["SLALOM"], peers=[],
                                         no_drives=True, limit=600)  # fmt: skip
            row = laps.measured_row(args, track)
            self.assertEqual(json.loads((folder / "ring.json").read_text()), row)
            self.assertIn("| ring | 3", laps.page([row], "A stamp.\n", 600, ""))
            self.assertIn("Laps solved: 1 of 1", laps.page([row], "A stamp.\n", 600, ""))
            args.program = "false"  # what is known is not measured again
            self.assertEqual(laps.measured_row(args, track), row)


if __name__ == "__main__":
    unittest.main()
