#!/usr/bin/env python3
"""What kills.py calls clean; with $SLALOM, one kill of each kind."""

import contextlib
import os
import pathlib
import sqlite3
import sys
import tempfile
import unittest

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


@unittest.skipUnless(os.environ.get("SLALOM"), "needs $SLALOM")
class Program(unittest.TestCase):
    def test_each_kind_is_clean_once(self):
        with tempfile.TemporaryDirectory() as folder:
            done, faults = kills.run_all(os.environ["SLALOM"], 1, pathlib.Path(folder))
        self.assertEqual(faults, [])
        self.assertEqual(done, {name: 1 for name in kills.KINDS})


if __name__ == "__main__":
    unittest.main()
