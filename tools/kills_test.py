#!/usr/bin/env python3
"""What kills.py calls clean; with $SLALOM, one kill of each kind."""

import collections
import contextlib
import os
import pathlib
import random
import sqlite3
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import kills  # noqa: E402


def bench(folder, rows):
    """A bench whose undisturbed table has these rows."""
    made = kills.Bench.__new__(kills.Bench)
    made.folder, made.tables = folder, {"study": rows}
    return made


def write(folder, rows, times):
    folder.mkdir(exist_ok=True)
    text = "trial,outcome,median_cpu_time_s\n" + "".join(f"{k},{outcome},{time}\n" for (k, outcome), time in zip(rows, times))
    (folder / "trials.csv").write_text(text)
    (folder / "trials.sqlite").unlink(missing_ok=True)
    with contextlib.closing(sqlite3.connect(folder / "trials.sqlite")) as database:
        database.execute("CREATE TABLE trials (trial INTEGER PRIMARY KEY, outcome TEXT, time REAL)")
        database.executemany("INSERT INTO trials VALUES (?, ?, ?)",
                             [(k, outcome, time) for (k, outcome), time in zip(rows, times)])  # fmt: skip
        database.commit()


class Judge(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.bench = bench(self.folder, [{"trial": "1", "outcome": "goal"}, {"trial": "2", "outcome": "goal"}])

    def test_other_times_are_the_same_table(self):
        write(self.folder / "out", [(1, "goal"), (2, "goal")], [0.1, 0.2])
        self.bench.judge("out", kills.recorded(self.folder / "out"))

    def test_a_failed_and_a_lost_trial_are_faults(self):
        write(self.folder / "out", [(1, "goal"), (2, "failed")], [0.1, 0.2])
        with self.assertRaisesRegex(kills.Fault, "2 of 40 trials, 1 failed"):
            self.bench.judge("out")
        write(self.folder / "out", [(1, "goal")], [0.1])
        with self.assertRaises(kills.Fault):
            self.bench.judge("out")

    def test_a_trial_run_again_is_a_fault(self):
        write(self.folder / "out", [(1, "goal"), (2, "goal")], [0.1, 0.2])
        kept = kills.recorded(self.folder / "out")
        write(self.folder / "out", [(1, "goal"), (2, "goal")], [0.1, 0.3])
        with self.assertRaisesRegex(kills.Fault, "1 recorded trials were run again"):
            self.bench.judge("out", kept)


class Strikes(unittest.TestCase):
    """On processes that sleep, in the place of sweeps."""

    def setUp(self):
        self.bench = bench(pathlib.Path("/"), [])
        self.bench.kind, self.bench.takes_s, self.bench.struck = "kind", {}, collections.Counter()
        self.draw = random.Random(1)

    def strike(self, *seconds, strike=kills.kill):
        processes = [subprocess.Popen(["sleep", str(s)], stderr=subprocess.PIPE) for s in seconds]
        return kills.struck(self.draw, self.bench, processes, strike), processes

    def test_the_first_run_of_a_kind_is_undisturbed_and_gives_its_time(self):
        self.assertIsNone(self.strike(0.05, 0.2)[0])
        self.assertGreater(self.bench.takes_s["kind"], 0.1)
        self.assertEqual(self.bench.struck["kind"], 0)

    def test_a_strike_counts_where_something_is_struck(self):
        self.bench.takes_s = {"kind": 0.3}
        one, processes = self.strike(60)
        self.assertEqual((one, self.bench.struck["kind"]), (processes[0], 1))
        self.draw.random = lambda: 10  # long after it is over
        self.assertIsNone(self.strike(0)[0])
        self.assertEqual(self.bench.struck["kind"], 1)
        self.draw.random = lambda: 0.5
        self.strike(1, strike=lambda process: kills.kill_workers(self.draw, process))  # has none
        self.assertEqual(self.bench.struck["kind"], 1)

    def test_of_several_one_that_runs_is_struck(self):
        self.bench.takes_s = {"kind": 0.5}
        self.draw.random = lambda: 1
        one, processes = self.strike(0, 60)
        self.assertIs(one, processes[1])

    def test_the_page_says_how_many_runs_were_struck(self):
        def strike(draw, made, out):
            kills.struck(draw, made, [subprocess.Popen(["sleep", "0"], stderr=subprocess.PIPE)], kills.kill)
        self.draw.random = lambda: 100  # long after all is over
        made = bench(pathlib.Path("/"), [])
        made.takes_s, made.struck = {}, collections.Counter()
        made.finish = lambda *_: None
        with (unittest.mock.patch.object(kills, "Bench", lambda *_: made), unittest.mock.patch("random.Random", lambda _: self.draw),
              unittest.mock.patch.object(kills, "KINDS", {"what is over": strike})):
            found = kills.run_all("program", 3, pathlib.Path("/nowhere"))
            self.assertRegex(kills.page(3, *found, "A stamp.\n"), r"\| what is over \| 0\.\d\d \| 3 \| 0 \| 3 \|")


@unittest.skipUnless(os.environ.get("SLALOM"), "needs $SLALOM")
class Program(unittest.TestCase):
    def test_each_kind_is_clean_once(self):
        with tempfile.TemporaryDirectory() as folder:
            made, clean, faults = kills.run_all(os.environ["SLALOM"], 1, pathlib.Path(folder))
        self.assertEqual(faults, [])
        self.assertEqual(clean, {name: 1 for name in kills.KINDS})
        self.assertEqual(set(made.takes_s), set(kills.KINDS))


if __name__ == "__main__":
    unittest.main()
