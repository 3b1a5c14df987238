"""Ctrl-C and SIGTERM: the drive ends soon, its files are valid, its outcome is `interrupted`."""

import csv
import json
import signal
import unittest

from program import ProgramTest, interrupt, run, start, until

FILES = ["cycles.csv", "figures", "plans.csv", "plant.csv", "report.html", "resolved.yaml",
         "summary.json"]

# So many short cycles that no machine is through with them before it is interrupted.
LONG = ["simulate", "E_C", "--set", "loop.tex=0.001"]
SOON = 10
"""Two seconds are promised, which a busy machine may not keep [s]."""


class Interrupt(ProgramTest):
    def start_writing(self, out, *arguments):
        """A process that has begun what it writes to `out`: it holds the folder, and takes signals."""
        process = start(*arguments, "--out", out)
        until(lambda: (out / ".results.lock").exists() or process.poll() is not None)
        self.assertIsNone(process.poll(), "it ended by itself")
        return process

    def check_files(self, out, least_time):
        self.assertEqual(sorted(p.name for p in out.iterdir()), FILES)
        summary = json.loads((out / "summary.json").read_text())
        self.assertEqual(summary["outcome"], "interrupted")
        with open(out / "plant.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertTrue(all(None not in row.values() for row in rows), "a cut row")
        self.assertEqual(float(rows[-1]["t"]), summary["time_s"])
        self.assertGreater(summary["time_s"], least_time)
        self.assertEqual(run("check", out / "resolved.yaml", "--quiet").code, 0)

    def test_signals_end_a_drive_with_valid_files(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number.name):
                out, solves = self.folder / number.name, self.folder / f"solves of {number.name}"
                process = self.start_writing(out, *LONG, "--record-failures", solves, "--record-slow", 0)
                until(lambda: len(list(solves.glob("*.json"))) > 3)  # it drives
                result = interrupt(process, number)
                self.assertLess(result.seconds, SOON)
                self.assertEqual(result.code, 130, result.err)
                self.assertEqual(result.err, "")
                self.check_files(out, 0)

    def test_a_doubled_signal_changes_nothing(self):
        out = self.folder / "out"
        process = self.start_writing(out, *LONG)
        process.send_signal(signal.SIGINT)
        result = interrupt(process, signal.SIGTERM)
        self.assertEqual(result.code, 130)
        self.check_files(out, -1)

    def test_a_long_solve_is_left_in_time(self):
        out = self.folder / "out"
        process = self.start_writing(out, "simulate", "E_C", "--set", "planner.N=400")
        result = interrupt(process)
        self.assertLess(result.seconds, SOON)
        self.assertEqual(result.code, 130, result.err)
        self.check_files(out, -1)

    def test_an_expected_interruption_is_success(self):
        process = self.start_writing(self.folder / "out", *LONG, "--expect", "interrupted,goal", "--json")
        result = interrupt(process)
        self.assertEqual(result.code, 0, result.err)
        self.assertEqual(json.loads(result.out)["outcome"], "interrupted")

    def test_commands_that_write_nothing_end_at_once(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number.name):
                process = start("problems", "--all")
                process.stdout.readline()  # the table's head: it is at work
                result = interrupt(process, number)
                self.assertLess(result.seconds, SOON)
                self.assertEqual((result.code, result.err), (130, ""))

    def test_reproduce_stops_where_it_is(self):
        out = self.folder / "out"
        process = self.start_writing(out, "reproduce", "--tex", "0.02")
        result = interrupt(process)
        self.assertLess(result.seconds, SOON)
        self.assertEqual(result.code, 130, result.err)
        self.assertFalse((out / "index.html").exists())
        written = [p for p in out.glob("*/*") if (p / "summary.json").exists()]
        last = max(written, key=lambda p: (p / "summary.json").stat().st_mtime_ns)
        self.check_files(last, -1)


if __name__ == "__main__":
    unittest.main()
