"""Ctrl-C and SIGTERM: the drive ends within two seconds, its files are valid, its outcome is
`interrupted`."""

import csv
import json
import signal
import time
import unittest

from program import ProgramTest, interrupt, run, start

FILES = ["cycles.csv", "figures", "plans.csv", "plant.csv", "report.html", "resolved.yaml",
         "summary.json"]

# So many short cycles that no machine is through with them before it is interrupted.
LONG = ["simulate", "E_C", "--set", "loop.tex=0.001"]


class Interrupt(ProgramTest):
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
                out = self.folder / number.name
                process = start(*LONG, "--out", out)
                time.sleep(0.5)
                self.assertIsNone(process.poll(), "the drive ended by itself")
                result = interrupt(process, number)
                self.assertLess(result.seconds, 2)
                self.assertEqual(result.code, 130, result.err)
                self.assertEqual(result.err, "")
                self.check_files(out, 0)

    def test_a_doubled_signal_changes_nothing(self):
        out = self.folder / "out"
        process = start(*LONG, "--out", out)
        time.sleep(1)
        process.send_signal(signal.SIGINT)
        result = interrupt(process, signal.SIGTERM)
        self.assertEqual(result.code, 130)
        self.check_files(out, -1)

    def test_a_long_solve_is_left_in_time(self):
        out = self.folder / "out"
        process = start("simulate", "E_C", "--set", "planner.N=120", "--out", out)
        time.sleep(0.5)
        result = interrupt(process)
        self.assertLess(result.seconds, 2)
        self.assertEqual(result.code, 130, result.err)
        self.check_files(out, -1)

    def test_an_expected_interruption_is_success(self):
        process = start(*LONG, "--expect", "interrupted,goal", "--json")
        time.sleep(1)
        result = interrupt(process)
        self.assertEqual(result.code, 0, result.err)
        self.assertEqual(json.loads(result.out)["outcome"], "interrupted")

    def test_commands_that_write_nothing_end_at_once(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number.name):
                process = start("problems", "--all")
                process.stdout.readline()  # the table's head: it is at work
                result = interrupt(process, number)
                self.assertLess(result.seconds, 2)
                self.assertEqual((result.code, result.err), (130, ""))

    def test_reproduce_stops_where_it_is(self):
        out = self.folder / "out"
        process = start("reproduce", "--tex", "0.02", "--out", out)
        time.sleep(0.5)
        self.assertIsNone(process.poll(), "all drives ended by themselves")
        result = interrupt(process)
        self.assertLess(result.seconds, 2)
        self.assertEqual(result.code, 130, result.err)
        self.assertFalse((out / "index.html").exists())
        written = [p for p in out.glob("*/*") if (p / "summary.json").exists()]
        last = max(written, key=lambda p: (p / "summary.json").stat().st_mtime_ns)
        self.check_files(last, -1)


if __name__ == "__main__":
    unittest.main()
