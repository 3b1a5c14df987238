"""Sweeps: the same table on any number of workers, whatever is killed; one message for bad studies."""

import csv
import fcntl
import json
import os
import random
import signal
import sqlite3
import subprocess
import time
import unittest
import urllib.error
import urllib.request
import xml.etree.ElementTree

from program import PROGRAM, ProgramTest, interrupt, run, start

# Twelve trials of about a tenth of a second each.
SMALL = """
title: small
scenario: E_B
planners: [P_C, P_D]
set: {loop.timeout: 1.5}
axes:
  - key: loop.tex
    values: [0.25, 0.5]
  - keys: [obstacles.O1.vx, obstacles.O1.vy]
    values: [[-2, 0], [-1, 0.5], [0, 1]]
"""
MEASURED = {"max_solve_time_s", "median_solve_time_s", "max_cpu_time_s", "median_cpu_time_s"}


def table(folder):
    """The rows of trials.csv without what is measured."""
    with open(folder / "trials.csv", newline="") as file:
        return [{k: v for k, v in row.items() if k not in MEASURED} for row in csv.DictReader(file)]


def events(text):
    return [json.loads(line) for line in text.splitlines()]


def next_event(process, kind):
    """Reads the process's events up to one of a kind."""
    for line in process.stdout:
        event = json.loads(line)
        if event["event"] == kind:
            return event
    raise AssertionError(f"no event '{kind}' before the end")


class SweepTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.study = self.write("small.yaml", SMALL)

    def sweep(self, out, *arguments, study=None):
        result = run("sweep", study or self.study, "--out", self.folder / out, "--quiet", *arguments)
        self.assertEqual((result.code, result.err), (0, ""))
        return table(self.folder / out)


class Sweep(SweepTest):
    def test_the_table_has_a_row_a_trial_in_order(self):
        rows = self.sweep("out")
        self.assertEqual(list(rows[0])[:8], ["trial", "scenario", "planner", "loop.tex",
                                             "obstacles.O1.vx", "obstacles.O1.vy", "outcome",
                                             "time_s"])
        self.assertEqual([int(row["trial"]) for row in rows], list(range(1, 13)))
        self.assertEqual([row["planner"] for row in rows], ["P_C"] * 6 + ["P_D"] * 6)
        self.assertEqual([row["loop.tex"] for row in rows[:6]], ["0.25"] * 3 + ["0.5"] * 3)
        self.assertEqual([row["obstacles.O1.vy"] for row in rows[:3]], ["0", "0.5", "1"])
        self.assertEqual(len({row["identity"] for row in rows}), 12)

    def test_a_trial_is_the_drive_that_simulate_makes(self):
        row = self.sweep("out", "--limit", "1")[0]
        drive = json.loads(run("simulate", "E_B", "--planner", "P_C", "--set", "loop.timeout=1.5",
                               "--tex", "0.25", "--set", "obstacles.O1.vx=-2",
                               "--set", "obstacles.O1.vy=0", "--json").out)
        self.assertEqual((row["outcome"], float(row["time_s"]), float(row["least_clearance_m"])),
                         (drive["outcome"], drive["time_s"], drive["least_clearance_m"]))

    def test_jobs_and_shards_and_pieces_give_the_same_bytes(self):
        one = self.sweep("one", "--jobs", "1")
        self.assertEqual(self.sweep("two", "--jobs", "2"), one)
        shards = [self.folder / f"shard{i}" for i in (1, 2, 3)]
        for i, shard in enumerate(shards, 1):
            self.assertEqual(len(self.sweep(shard.name, "--shard", f"{i}/3")), 4)
        self.assertEqual(run("merge", *shards, "--out", self.folder / "merged", "--quiet").code, 0)
        self.assertEqual(table(self.folder / "merged"), one)
        for i in (1, 2):  # shards in one folder need no merging
            together = self.sweep("together", "--shard", f"{i}/2")
        self.assertEqual(together, one)
        for limit in (1, 4, 100):
            pieces = self.sweep("pieces", "--limit", str(limit))
        self.assertEqual(pieces, one)

    def test_shards_that_end_together_wait_for_each_others_table(self):
        self.sweep("out", "--shard", "1/2", "--limit", "0")
        with open(self.folder / "out/.export.lock", "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            process = start("sweep", self.study, "--out", self.folder / "out", "--shard", "2/2",
                            "--limit", "1", "--json")
            next_event(process, "recorded")
            with self.assertRaises(subprocess.TimeoutExpired):
                process.wait(timeout=0.5)
            self.assertEqual(table(self.folder / "out"), [])
        process.communicate(timeout=60)
        self.assertEqual(len(table(self.folder / "out")), 1)

    def test_a_finished_trial_is_not_run_again(self):
        self.sweep("out", "--limit", "5")
        result = run("sweep", self.study, "--out", self.folder / "out", "--json")
        kinds = [event["event"] for event in events(result.out)]
        self.assertEqual(kinds.count("started"), 7)
        before = (self.folder / "out/trials.csv").read_bytes()
        self.sweep("out")
        self.assertEqual((self.folder / "out/trials.csv").read_bytes(), before)

    def test_drives_are_kept_when_asked_for(self):
        study = self.write("keep.yaml", SMALL + "keep: drives\n")
        self.sweep("out", "--limit", "2", study=study)
        drive = self.folder / "out/drives/000002"
        self.assertTrue((drive / "report.html").exists())
        again = json.loads(run("simulate", drive / "resolved.yaml", "--json").out)
        kept = json.loads((drive / "summary.json").read_text())
        self.assertEqual(again["least_clearance_m"], kept["least_clearance_m"])

    def test_values_that_contradict_each_other_cost_their_trial_only(self):
        study = self.write("odd.yaml", "scenario: E_B\nset: {loop.timeout: 0.5}\naxes:\n"
                           "  - {key: start.y, values: [0, 57, 1]}\n"
                           "  - {key: start.x, values: [205, 200]}\n")
        rows = self.sweep("out", study=study)
        self.assertEqual([row["outcome"] for row in rows][2], "invalid")
        self.assertIn("inside obstacle", rows[2]["message"])
        self.assertEqual({row["outcome"] for row in (rows[0], rows[4], rows[5])}, {"timeout"})


    def test_scenarios_are_crossed_with_planners_and_axes(self):
        self.assertEqual(run("make-scenarios", "gates", "--count", "2", "--out", self.folder / "set",
                             "--quiet").code, 0)
        text = SMALL.replace("scenario: E_B", "scenarios: [E_B, 'set/*.yaml']").replace("1.5}", "0.5}")
        rows = self.sweep("all", study=self.write("all.yaml", text))
        self.assertEqual([row["scenario"] for row in rows],
                         ["E_B"] * 12 + ["gates-0001"] * 12 + ["gates-0002"] * 12)
        self.assertEqual([row["planner"] for row in rows], (["P_C"] * 6 + ["P_D"] * 6) * 3)
        # One of them is what a study of it alone is, but for its numbers.
        alone = self.sweep("alone", study=self.write("alone.yaml", SMALL.replace("1.5}", "0.5}").replace(
            "scenario: E_B", "scenarios: [set/gates-0002.yaml]")))
        self.assertEqual([dict(row, trial=None) for row in rows[24:]],
                         [dict(row, trial=None) for row in alone])
        self.assertEqual(run("study-report", self.folder / "all").code, 0)
        page = (self.folder / "all/index.html").read_text()
        self.assertIn("Scenarios E_B, gates-0001, gates-0002", page)
        self.assertIn("At the goal, by scenario", page)


class Report(SweepTest):
    def test_the_page_and_its_figures_stand_beside_the_table(self):
        self.sweep("out")
        before = self.entries(self.folder / "out")
        result = run("study-report", self.folder / "out")
        self.assertEqual((result.code, result.err), (0, ""))
        self.assertEqual(sorted(set(self.entries(self.folder / "out")) - set(before)),
                         ["figures", "figures/map_P_C.svg", "figures/map_P_D.svg",
                          "figures/real_time.svg", "index.html"])
        for figure in (self.folder / "out/figures").iterdir():
            xml.etree.ElementTree.parse(figure)
        page = (self.folder / "out/index.html").read_text()
        self.assertIn("12 <small>of 12</small>", page)
        self.assertNotIn("paper: RTF", page)  # of another scenario
        self.sweep("out")  # goes on beside its page

    def test_the_papers_figures_stand_beside_its_sweep(self):
        rows = self.sweep("paper", "--limit", "1", "--set", "loop.timeout=1", study="paper")
        self.assertEqual(len(rows), 1)
        self.assertEqual(run("study-report", self.folder / "paper").code, 0)
        page = (self.folder / "paper/index.html").read_text()
        self.assertIn("1 <small>of 800</small>", page)
        self.assertIn("paper: RTF", page)

    def test_a_trial_is_driven_again_to_the_same_bits(self):
        rows = self.sweep("out", "--limit", "3")
        result = run("study-report", self.folder / "out", "--trial", "2,3")
        self.assertEqual((result.code, result.err), (0, ""))
        self.assertEqual(result.out.count("driven again, as recorded"), 2)
        folder = self.folder / "out/drives/000003"
        self.assertIn("<html", (folder / "report.html").read_text())
        self.assertEqual(f"{json.loads((folder / 'summary.json').read_text())['time_s']}", rows[2]["time_s"])
        self.assertIn("kept", run("study-report", self.folder / "out", "--trial", "3").out)
        self.assert_refused(run("study-report", self.folder / "out", "--trial", "13"), 2,
                            "found trial 13, expected a trial from 1 to 12")
        self.assert_refused(run("study-report", self.folder / "out", "--trial", "4"), 2,
                            "which has not run yet")

    def test_a_merged_sweep_drives_its_trials_again(self):
        self.sweep("one", "--shard", "1/2", "--limit", "2")
        self.sweep("two", "--shard", "2/2", "--limit", "2")
        self.assertEqual(run("merge", self.folder / "one", self.folder / "two", "--out",
                             self.folder / "all").code, 0)
        self.assertIn("as recorded", run("study-report", self.folder / "all", "--trial", "4").out)

    def test_a_served_page_drives_what_is_asked_for(self):
        self.sweep("out", "--limit", "1")
        process = start("study-report", self.folder / "out", "--serve", "0")
        try:
            address = ""
            while not address.startswith("http"):
                address = process.stdout.readline().split(" ")[0]
            base = address.rsplit("/", 1)[0]
            self.assertIn(b"Click on a trial", urllib.request.urlopen(address, timeout=20).read())
            self.assertFalse((self.folder / "out/drives").exists())
            drive = urllib.request.urlopen(f"{base}/drives/000001/report.html", timeout=60).read()
            self.assertEqual(drive, (self.folder / "out/drives/000001/report.html").read_bytes())
            for number, said in (("000002", b"has not run yet"), ("000099", b"from 1 to 12")):
                with self.assertRaises(urllib.error.HTTPError) as refused:
                    urllib.request.urlopen(f"{base}/drives/{number}/report.html", timeout=20)
                self.assertEqual(refused.exception.code, 404)
                self.assertIn(said, refused.exception.read())
                refused.exception.close()
            taken = run("study-report", self.folder / "out", "--serve", base.rsplit(":", 1)[1])
            self.assertEqual(taken.code, 3)
            self.assertIn("is taken", taken.err)
        finally:
            interrupt(process)
        self.assertEqual(process.wait(20), 0)

    def test_a_folder_without_a_sweep_is_refused(self):
        self.assert_refused(run("study-report", self.folder), 3, "holds no results of a sweep")
        self.assert_refused(run("study-report", self.folder / "none"), 3, "holds no results")


class Killed(SweepTest):
    def test_a_worker_that_crashes_costs_an_attempt(self):
        expected = self.sweep("calm")
        process = start("sweep", self.study, "--out", self.folder / "out", "--json", "--jobs", "2")
        trial = next_event(process, "started")
        os.kill(trial["process"], signal.SIGSEGV)
        lost = next_event(process, "lost")
        self.assertEqual(lost["trial"], trial["trial"])
        self.assertIn("signal 11", lost["reason"])
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 0)
        self.assertEqual(table(self.folder / "out"), expected)

    def run_with_a_victim(self, study, number):
        """Strikes every attempt at trial 2 with a signal; returns the table."""
        process = start("sweep", study, "--out", self.folder / "out", "--json", "--jobs", "2")
        attempts = 0
        for line in process.stdout:
            event = json.loads(line)
            if event["event"] == "started" and event["trial"] == 2:
                attempts += 1
                os.kill(event["process"], number)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 0)
        self.assertEqual(attempts, 3)
        return table(self.folder / "out")

    def test_a_trial_that_always_crashes_or_hangs_is_recorded_as_failed(self):
        calm = self.sweep("calm")
        hasty = self.write("hasty.yaml", SMALL + "time_limit: 3\n")
        for study, number, reason in ((self.study, signal.SIGABRT, "signal 6"),
                                      (hasty, signal.SIGSTOP, "no answer within 3 s")):
            with self.subTest(number.name):
                rows = self.run_with_a_victim(study, number)
                self.assertEqual(rows[1]["outcome"], "failed")
                self.assertIn(reason, rows[1]["message"])
                self.assertEqual(rows[:1] + rows[2:], calm[:1] + calm[2:])
                run("sweep", self.study, "--out", self.folder / "out", "--force", "--limit", "0")

    def test_workers_end_with_the_supervisor(self):
        # A trial of minutes: the worker would find out at its end alone.
        slow = self.write("slow.yaml", "scenario: E_C\nset: {loop.tex: 0.01, planner.N: 60}\n")
        process = start("sweep", slow, "--out", self.folder / "out", "--json", "--jobs", "1")
        worker = next_event(process, "started")["process"]
        time.sleep(0.5)
        process.kill()
        process.communicate()
        for _ in range(20):
            try:
                with open(f"/proc/{worker}/stat") as file:
                    state = file.read().split(") ")[1][0]
            except OSError:
                return
            if state == "Z":
                return
            time.sleep(0.05)
        self.fail("the worker outlived its supervisor")

    def test_whatever_is_killed_the_table_is_the_same(self):
        expected = self.sweep("calm")
        dice = random.Random(7)
        kills = 0
        while kills < 20:
            process = start("sweep", self.study, "--out", self.folder / "out", "--json",
                            "--jobs", "2")
            worker = None
            if dice.random() < 0.5:
                try:
                    worker = next_event(process, "started")["process"]
                except AssertionError:
                    worker = None
            time.sleep(dice.uniform(0, 0.35))
            try:
                os.kill(worker or process.pid, signal.SIGKILL)
                kills += 1
            except ProcessLookupError:
                pass
            time.sleep(dice.uniform(0, 0.1))
            process.kill()
            process.communicate(timeout=60)
            stores = list((self.folder / "out").glob("trials*.sqlite"))
            if stores and stores[0].stat().st_size > 0:
                with sqlite3.connect(stores[0]) as store:
                    self.assertEqual(store.execute("PRAGMA integrity_check").fetchone()[0], "ok")
                store.close()
            if kills % 7 == 6:  # begin anew, so that kills hit all stages
                run("sweep", self.study, "--out", self.folder / "out", "--force", "--limit", "1")
        self.assertEqual(self.sweep("out"), expected)

    def test_ctrl_c_ends_soon_with_a_valid_table(self):
        slow = self.write("slow.yaml", "scenario: E_C\nset: {loop.tex: 0.01}\nrepeats: 4\n")
        out = self.folder / "out"
        process = subprocess.Popen([PROGRAM, "sweep", slow, "--out", out, "--jobs", "2"],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   start_new_session=True)
        time.sleep(1)
        begin = time.monotonic()
        os.killpg(process.pid, signal.SIGINT)
        printed, errors = process.communicate(timeout=60)
        self.assertLess(time.monotonic() - begin, 2)
        self.assertEqual((process.returncode, errors), (130, ""))
        self.assertIn("4 left", printed)
        self.assertEqual(table(out), [])
        process = start("sweep", self.study, "--out", self.folder / "fast", "--jobs", "2", "--json")
        next_event(process, "recorded")
        self.assertEqual(interrupt(process).code, 130)
        self.assertGreaterEqual(len(table(self.folder / "fast")), 1)
        self.assertEqual(self.sweep("fast"), self.sweep("calm"))


class Refused(SweepTest):
    def test_studies(self):
        head = "scenario: E_B\n"
        for text, parts in (
                ("planners: [P_C]\n", ["s.yaml:1:1", "a study without 'scenario'"]),
                (head + "scenarios: [E_A]\n", ["s.yaml:2:12", "'scenarios' beside 'scenario'"]),
                ("scenarios: []\n", ["s.yaml:1:12", "an empty list"]),
                ("scenarios: [E_B, E_X]\n", ["s.yaml:1:18", "scenario 'E_X'"]),
                ("scenarios: [E_B, 'none/*.yaml']\n", ["s.yaml:1:18", "pattern 'none/*.yaml'"]),
                ("scenarios: [E_B, E_A, E_B]\n", ["s.yaml:1:23", "a second scenario named 'E_B'"]),
                ("scenarios: [E_A, E_C]\naxes:\n  - {key: obstacles.O3.x, values: [1, 2]}\n",
                 ["s.yaml:3:11", "'O3'", "for scenario 'E_C'"]),
                ("scenarios: [E_A, E_C]\nset: {obstacles.O3.x: 1}\n",
                 ["s.yaml:2:7", "'O3'", "for scenario 'E_C'"]),
                (head + "axis: []\n", ["s.yaml:2:1", "unknown key 'axis'", "'axes'"]),
                (head + "planners: [P_C, P_X]\n", ["s.yaml:2:17", "planner 'P_X'"]),
                (head + "planners: [P_C, P_C]\n", ["s.yaml:2:17", "a second planner named 'P_C'"]),
                (head + "planners: []\n", ["s.yaml:2:11", "no planner"]),
                (head + "axes:\n  - {key: loop.tx, values: [1]}\n",
                 ["s.yaml:3:11", "unknown key 'tx'", "did you mean 'tex'?"]),
                (head + "axes:\n  - {key: lop.tex, values: [1]}\n", ["s.yaml:3:11", "'loop'"]),
                (head + "axes:\n  - {key: obstacles.O9.x, values: [1]}\n", ["s.yaml:3:11", "'O9'"]),
                (head + "axes:\n  - {key: loop.tex, values: []}\n",
                 ["s.yaml:3:29", "an empty list"]),
                (head + "axes:\n  - {key: loop.tex, values: [0.5, .nan]}\n",
                 ["s.yaml:3:35", "tex = nan"]),
                (head + "axes:\n  - {key: loop.tex, values: [0.5, -1]}\n",
                 ["s.yaml:3:35", "tex = -1"]),
                (head + "axes:\n  - {key: loop.tex, values: [soon]}\n", ["s.yaml:3:30", "soon"]),
                (head + "axes:\n  - {key: loop.tex, range: {from: 0.1, to: .inf, count: 3}}\n",
                 ["s.yaml:3:", "a finite number"]),
                (head + "axes:\n  - {key: loop.tex, range: {from: 0.1, to: 1, count: 0}}\n",
                 ["s.yaml:3:", "an integer from 1"]),
                (head + "axes:\n  - {key: loop.tex, range: {from: 0.1, to: 1, count: 1000000000}}\n",
                 ["s.yaml:3:", "an integer from 1 to 1000000"]),
                (head + "axes:\n" + "".join(
                    f"  - {{key: {key}, range: {{from: 1, to: 2, count: 1000}}}}\n"
                    for key in ("loop.tex", "start.ux", "planner.w_g")),
                 ["1e+09 trials", "at most 1000000"]),
                (head + "repeats: -1\n", ["s.yaml:2:10", "repeats = -1"]),
                (head + "axes:\n  - {key: loop.tex, values: [1]}\n  - {key: loop.tex, values: [2]}\n",
                 ["s.yaml:4:11", "'loop.tex' a second time"]),
                (head + "axes:\n  - {key: loop.tex}\n", ["s.yaml:3:5", "none of the known forms"]),
                (head + "axes:\n  - {keys: [start.x, start.y], values: [[1, 2], [3]]}\n",
                 ["s.yaml:3:", "1 values", "2 values"]),
                (head + "axes:\n  - draw: {count: 3, of: [{key: start.x, uniform: [2, 1]}]}\n",
                 ["s.yaml:3:", "low < high"]),
                (head + "axes:\n  - draw: {count: 3, method: sobl, of: [{key: start.x, normal: [2, 1]}]}\n",
                 ["s.yaml:3:30", "did you mean 'sobol'?"]),
                (head + "axes:\n  - draw: {count: 3, of: [{key: start.x, gauss: [2, 1]}]}\n",
                 ["s.yaml:3:42", "unknown key 'gauss'"]),
        ):
            with self.subTest(text):
                study = self.write("s.yaml", text)
                result = run("sweep", study, "--out", self.folder / "out")
                self.assert_refused(result, 2, *parts)
                self.assertFalse((self.folder / "out").exists())

    def test_arguments(self):
        for arguments, parts in ((["sweep", "papre", "--out", "o"], ["did you mean 'paper'"]),
                                 (["sweep", "paper"], ["--out"]),
                                 (["sweep", "paper", "--out", "o", "--shard", "0/4"], ["--shard"]),
                                 (["sweep", "paper", "--out", "o", "--shard", "2"], ["--shard"]),
                                 (["sweep", "paper", "--out", "o", "--jobs", "0"], ["--jobs"]),
                                 (["sweep", "paper", "--out", "o", "--limit", "-1"], ["--limit"])):
            with self.subTest(arguments):
                self.assert_refused(run(*arguments, cwd=self.folder), 2, *parts)
                self.assertEqual(self.entries(), ["small.yaml"])

    def test_folders_of_something_else(self):
        out = self.folder / "out"
        sweep = ["sweep", self.study, "--out", out]
        self.assert_refused(run(*sweep, "--resume"), 3, "no sweep", "nothing to resume")
        self.sweep("out", "--limit", "1")
        before = (out / "trials.csv").read_bytes()
        self.assertEqual(run(*sweep, "--resume", "--limit", "0", "--quiet").code, 0)
        other = self.write("other.yaml", SMALL)
        changed = self.write("small.yaml", SMALL.replace("1.5}", "1.25}"))
        self.assert_refused(run("sweep", changed, "--out", out), 3, "before it changed", "--force")
        self.assert_refused(run("sweep", changed, "--out", out, "--resume"), 3, "another study")
        self.assert_refused(run("sweep", self.write("third.yaml", SMALL + "repeats: 2\n"), "--out",
                                out), 3, "another study, 'small'")
        self.assertEqual((out / "trials.csv").read_bytes(), before)
        self.assertEqual(run("sweep", other, "--out", out, "--limit", "0", "--quiet").code, 0)
        notes = self.folder / "notes"
        notes.mkdir()
        (notes / "diary.txt").write_text("dear diary")
        self.assert_refused(run("sweep", self.study, "--out", notes), 3, "'diary.txt'")
        self.assertEqual(run("sweep", self.study, "--out", notes, "--force", "--limit", "1",
                             "--quiet").code, 0)
        self.assertEqual((notes / "diary.txt").read_text(), "dear diary")
        self.assert_refused(run("sweep", self.study, "--out", self.study), 3, "is a file")
        self.assert_refused(run("merge", out, notes, "--out", self.folder / "m"), 3,
                            "another study")
        self.assert_refused(run("merge", self.folder, "--out", self.folder / "m"), 3, "no results")

    def test_a_store_of_another_version_is_replaced_by_force_alone(self):
        self.sweep("out", "--limit", "1")
        store = self.folder / "out/trials.sqlite"
        with sqlite3.connect(store) as database:
            database.execute("UPDATE study SET format = 1")
        database.close()
        self.assert_refused(run("sweep", self.study, "--out", self.folder / "out"), 3,
                            "another version of Slalom")
        self.assertEqual(len(self.sweep("out", "--limit", "2", "--force")), 2)
        store.write_bytes(b"dear diary, " * 100)
        self.assert_refused(run("sweep", self.study, "--out", self.folder / "out"), 3,
                            "trials.sqlite: ", "not a database")
        self.assertEqual(len(self.sweep("out", "--limit", "1", "--force")), 1)

    def test_two_sweeps_do_not_share_a_store(self):
        process = start("sweep", self.study, "--out", self.folder / "out", "--json", "--jobs", "1")
        next_event(process, "started")
        result = run("sweep", self.study, "--out", self.folder / "out")
        self.assert_refused(result, 3, "another sweep is at work")
        process.communicate(timeout=60)
        self.assertEqual(len(table(self.folder / "out")), 12)

    def test_a_full_disk_is_said_and_the_sweep_goes_on_afterwards(self):
        expected = self.sweep("calm")
        study = self.write("keep.yaml", SMALL + "keep: drives\n")
        out = self.folder / "out"
        # A file may not grow beyond 64 KiB: drives, and at last the store, cannot be written.
        result = run("sweep", study, "--out", out, "--jobs", "1",
                     preexec_fn=lambda: __import__("resource").setrlimit(
                         __import__("resource").RLIMIT_FSIZE, (65536, -1)))
        self.assert_refused(result, 3, "cannot be written")
        self.assertEqual(self.sweep("out", study=study), expected)


if __name__ == "__main__":
    unittest.main()
