"""Sweeps: the same table on any number of workers, and whatever is killed."""

import contextlib
import fcntl
import json
import os
import random
import signal
import sqlite3
import subprocess
import threading
import time
import unittest
import xml.etree.ElementTree

from program import PROGRAM, interrupt, run, start, until
from sweeps import SMALL, SweepTest, events, next_event, table


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
        self.assertEqual(row["marks"].split(), [mark["kind"] for mark in drive["marks"]])

    def test_jobs_and_shards_and_pieces_give_the_same_bytes(self):
        one = self.sweep("one", "--jobs", "1")
        self.assertEqual(self.sweep("two", "--jobs", "2"), one)
        shards = [self.folder / f"shard{i}" for i in (1, 2, 3, 4)]
        for i, shard in enumerate(shards, 1):
            self.assertEqual(len(self.sweep(shard.name, "--shard", f"{i}/4")), 3)
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

    def test_a_merged_sweep_has_the_drives_that_were_kept(self):
        study = self.write("keep.yaml", SMALL + "keep: drives\n")
        for i in (1, 2):
            self.sweep(f"s{i}", "--shard", f"{i}/2", "--limit", "2", study=study)
        # As a shard at work has it.
        (self.folder / "s1/drives/000001/.plans.csv.00ff.aside").symlink_to("gone")
        (self.folder / "s2/drives/000002/report.html").unlink()
        self.assertEqual(run("merge", self.folder / "s1", self.folder / "s2", "--out", self.folder / "all",
                             "--quiet").code, 0)
        self.assertEqual([p.name for p in sorted((self.folder / "all/drives").iterdir())], ["000001", "000003", "000004"])
        for trial, shard in (("000001", "s1"), ("000003", "s1"), ("000004", "s2")):
            for file in (self.folder / shard / "drives" / trial).glob("*.*"):
                if not file.name.startswith("."):
                    self.assertEqual((self.folder / "all/drives" / trial / file.name).read_bytes(), file.read_bytes())

    def test_a_folder_without_a_sweep_is_refused(self):
        self.assert_refused(run("study-report", self.folder), 2, "no results of a sweep")
        self.assert_refused(run("study-report", self.folder / "none"), 2, "no such folder")

    def test_a_drive_that_is_not_as_recorded_says_so(self):
        self.sweep("out", "--limit", "1")
        first = run("study-report", self.folder / "out", "--trial", "1")
        self.assertIn("(driven again, as recorded)", first.out)
        self.assertIn("(kept, as recorded)", run("study-report", self.folder / "out", "--trial", "1").out)
        summary = self.folder / "out/drives/000001/summary.json"
        summary.write_text(summary.read_text().replace('"outcome": "timeout"', '"outcome": "crash"'))
        self.assertIn('(kept, NOT as recorded: outcome "crash", recorded "timeout")',
                      run("study-report", self.folder / "out", "--trial", "1").out)
        summary.unlink()
        self.assertIn("NOT as recorded: its summary.json cannot be read",
                      run("study-report", self.folder / "out", "--trial", "1").out)


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

        def is_gone():
            try:
                with open(f"/proc/{worker}/stat") as file:
                    return file.read().split(") ")[1][0] == "Z"
            except OSError:
                return True

        until(is_gone, 20)

    def test_whatever_is_killed_the_table_is_the_same(self):
        """Workers and supervisors by turns, of the whole study and of its shards, at any moment."""
        expected = self.sweep("calm", "--jobs", "1")
        dice = random.Random(7)
        kills = 0
        while kills < 20:
            shard = dice.choice([(), ("--shard", f"{dice.randint(1, 4)}/4")])
            process = start("sweep", self.study, "--out", self.folder / "out", "--json",
                            "--jobs", "2", *shard)
            victim = process.pid
            if kills % 2 == 0:
                try:
                    victim = next_event(process, "started")["process"]
                except AssertionError:  # it had nothing left to do
                    pass
            time.sleep(dice.uniform(0, 0.3))
            try:
                os.kill(victim, signal.SIGKILL)
                kills += 1
            except ProcessLookupError:
                pass
            time.sleep(dice.uniform(0, 0.1))
            process.kill()
            process.communicate(timeout=60)
            for file in (self.folder / "out").glob("trials*.sqlite"):
                if file.stat().st_size > 0:
                    with contextlib.closing(sqlite3.connect(file)) as store:
                        self.assertEqual(store.execute("PRAGMA integrity_check").fetchone()[0], "ok")
            if kills % 7 == 6:  # begin anew, so that kills hit all stages
                run("sweep", self.study, "--out", self.folder / "out", "--force", "--limit", "1")
        self.assertEqual(self.sweep("out"), expected)
        self.assertEqual(run("merge", self.folder / "out", "--out", self.folder / "merged",
                             "--quiet").code, 0)
        self.assertEqual(table(self.folder / "merged"), expected)

    def test_ctrl_c_ends_the_recording_of_what_contradicts_itself(self):
        study = self.write("many.yaml", "scenario: E_B\nset: {planner.tf_max: 8}\naxes:\n"
                           "  - {key: loop.tex, range: {from: 9, to: 9.5, count: 500000}}\n")
        process = start("sweep", study, "--out", self.folder / "out", "--json")
        next_event(process, "recorded")
        lines = []
        reader = threading.Thread(target=lambda: lines.extend(process.stdout))
        reader.start()
        process.send_signal(signal.SIGINT)
        try:
            self.assertEqual(process.wait(timeout=30), 130)
        finally:
            process.kill()
            reader.join()
            process.stdout.close()
            process.stderr.close()
        self.assertEqual(json.loads(lines[-1])["run"], len(table(self.folder / "out")))

    def test_ctrl_c_ends_soon_with_a_valid_table(self):
        slow = self.write("slow.yaml", "scenario: E_C\nset: {loop.tex: 0.01}\nrepeats: 4\n")
        out = self.folder / "out"
        process = subprocess.Popen([PROGRAM, "sweep", slow, "--out", out, "--jobs", "2"],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   start_new_session=True)
        until(lambda: any(out.glob("trials*.sqlite")))
        os.killpg(process.pid, signal.SIGINT)
        printed, errors = process.communicate(timeout=30)
        self.assertEqual((process.returncode, errors), (130, ""))
        self.assertIn("4 left", printed)
        self.assertEqual(table(out), [])
        process = start("sweep", self.study, "--out", self.folder / "fast", "--jobs", "2", "--json")
        next_event(process, "recorded")
        self.assertEqual(interrupt(process).code, 130)
        self.assertGreaterEqual(len(table(self.folder / "fast")), 1)
        self.assertEqual(self.sweep("fast"), self.sweep("calm"))


if __name__ == "__main__":
    unittest.main()
