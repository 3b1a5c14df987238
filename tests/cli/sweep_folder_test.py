"""Several processes at one folder of a sweep: what is at work there is left alone, and a kill is no failed trial."""

import contextlib
import os
import random
import shutil
import signal
import sqlite3
import subprocess
import time
import unittest

from program import PROGRAM, run, start
from sweeps import SMALL, SweepTest, events, next_event, table

# Sixty trials, of which two shards are at work for some seconds.
LONG = SMALL.replace("values: [0.25, 0.5]", "range: {from: 0.25, to: 0.5, count: 10}")
CALM = "scenario: E_A\nset: {loop.timeout: 3}\nretries: 0\naxes:\n" \
       "  - {key: start.x, range: {from: 195, to: 205, count: 100}}\n"


def stored(folder, what="trial", where="1"):
    """Of all stores of a folder, a column of the trials."""
    found = []
    for file in sorted(folder.glob("trials*.sqlite")):
        with contextlib.closing(sqlite3.connect(file)) as store:
            if store.execute("SELECT 1 FROM sqlite_master WHERE name = 'trials'").fetchone():
                found += [row[0] for row in store.execute(f"SELECT {what} FROM trials WHERE {where}")]
    return found


class Together(SweepTest):
    def setUp(self):
        super().setUp()
        self.long = self.write("long.yaml", LONG)
        self.out = self.folder / "out"

    def at_work(self, *arguments, study=None):
        process = start("sweep", study or self.long, "--out", self.out, "--jobs", "1", "--json", *arguments)
        next_event(process, "started")
        return process

    def test_nothing_takes_the_store_from_a_shard_at_work(self):
        self.sweep("other", "--limit", "1")
        shard = self.at_work("--shard", "1/2")
        other = self.write("other.yaml", LONG.replace("1.5}", "1.25}"))
        for arguments in (["sweep", other, "--out", self.out, "--shard", "2/2", "--force"],
                          ["sweep", self.long, "--out", self.out, "--shard", "1/2", "--force"],
                          ["sweep", self.study, "--out", self.out, "--force"],
                          ["sweep", self.long, "--out", self.out],
                          ["sweep", self.long, "--out", self.out, "--shard", "3/4"],
                          ["merge", self.folder / "other", "--out", self.out, "--force"],
                          ["merge", self.out, "--out", self.out]):
            with self.subTest(arguments[0] + " " + " ".join(map(str, arguments[4:]))):
                self.assert_refused(run(*arguments), 3, "trials-1-of-2.sqlite: another sweep is at work")
        beside = run("sweep", self.long, "--out", self.out, "--shard", "2/4", "--quiet")
        self.assertEqual((beside.code, beside.err), (0, ""))
        shard.communicate(timeout=120)
        self.assertEqual(shard.returncode, 0)
        self.assertEqual(sorted(stored(self.out)), sorted(set(range(1, 61, 2)) | set(range(2, 61, 4))))

    def test_force_leaves_alone_what_is_at_work(self):
        study = self.write("kept.yaml", LONG + "keep: drives\n")
        self.sweep("out", "--limit", "4", study=study)
        shard = self.at_work("--shard", "1/2", study=study)
        next_event(shard, "recorded")
        beside = run("sweep", study, "--out", self.out, "--shard", "2/2", "--force", "--jobs", "1", "--limit",
                     "20", "--quiet")
        self.assertEqual((beside.code, beside.err), (0, ""))
        shard.communicate(timeout=120)
        self.assertEqual(shard.returncode, 0)
        # What the shard at work had found done is there still.
        self.assertEqual(sorted(stored(self.out)), sorted(set(range(1, 61, 2)) | set(range(2, 41, 2))))
        self.assertEqual([int(row["trial"]) for row in table(self.out)], sorted(stored(self.out)))
        for trial in stored(self.out):
            self.assertTrue((self.out / f"drives/{trial:06}/report.html").exists(), trial)

    def test_of_two_studies_begun_together_one_has_the_folder(self):
        other = self.write("other.yaml", LONG.replace("1.5}", "1.25}"))
        for _ in range(5):
            shutil.rmtree(self.out, ignore_errors=True)
            both = [subprocess.Popen([PROGRAM, "sweep", study, "--out", self.out, "--jobs", "1", "--limit",
                                      "3", "--quiet", "--shard", f"{i}/2"], stderr=subprocess.PIPE, text=True)
                    for i, study in ((1, self.long), (2, other))]
            errors = [process.communicate(timeout=60)[1] for process in both]
            codes = [process.returncode for process in both]
            self.assertEqual(sorted(codes), [0, 3], errors)
            winner = codes.index(0)
            self.assertEqual(sorted(stored(self.out)), [winner + 1, winner + 3, winner + 5])
            self.assertRegex(errors[1 - winner], "holds results of|another sweep is at work")
            self.assertEqual(run("study-report", self.out).code, 0)

    def test_a_store_killed_as_it_was_made_costs_no_scenario(self):
        for i in (1, 2):
            self.sweep(f"s{i}", "--shard", f"{i}/2", "--limit", "1")
        for empty in (b"", None):
            with self.subTest(empty=empty):
                store = self.folder / "s1/trials-1-of-2.sqlite"
                store.unlink()
                if empty is not None:
                    store.write_bytes(empty)
                else:
                    with contextlib.closing(sqlite3.connect(store)) as database:
                        database.execute("PRAGMA journal_mode=WAL")
                for beside in (False, True):
                    if beside:
                        self.sweep("s1", "--shard", "3/4", "--limit", "1")
                    merged = run("merge", self.folder / "s1", self.folder / "s2", "--out", self.out, "--force")
                    self.assertEqual(merged.code, 0, merged.err)
                    drive = run("study-report", self.out, "--trial", "2")
                    self.assertEqual(drive.code, 0, drive.err)
                    self.assertIn("driven again, as recorded", drive.out)
                self.assert_refused(run("merge", self.folder / "s1", self.folder, "--out", self.out), 2,
                                    "no results of a sweep")

    def test_timed_kills_of_what_begins_leave_nothing_that_loses_scenarios(self):
        dice = random.Random(5)
        for i in range(20):
            process = start("sweep", self.study, "--out", self.folder / f"k{i}", "--shard", "1/2", "--jobs", "1")
            time.sleep(dice.uniform(0.005, 0.06))
            process.kill()
            process.communicate(timeout=60)
        self.sweep("whole", "--limit", "2")
        for i in range(20):
            folder = self.folder / f"k{i}"
            for file in folder.glob("trials*.sqlite"):
                with contextlib.closing(sqlite3.connect(file)) as store:
                    if store.execute("SELECT 1 FROM sqlite_master WHERE name = 'study'").fetchone():
                        self.assertEqual(store.execute("SELECT count(*) FROM bases").fetchone()[0], 2)
            if run("study-report", folder).code == 0:
                self.assertEqual(run("merge", folder, self.folder / "whole", "--out", self.out, "--force",
                                     "--quiet").code, 0)
                self.assertEqual(run("study-report", self.out, "--trial", "2").code, 0)


class Kills(SweepTest):
    def test_a_kill_of_the_group_records_nothing_as_failed(self):
        study = self.write("calm.yaml", CALM)
        dice = random.Random(3)
        for number in [signal.SIGTERM] * 8 + [signal.SIGHUP] * 2:
            out = self.folder / "out"
            shutil.rmtree(out, ignore_errors=True)
            process = subprocess.Popen([PROGRAM, "sweep", study, "--out", out, "--jobs", "2", "--quiet"],
                                       start_new_session=True)
            time.sleep(dice.uniform(0.2, 0.6))
            os.killpg(process.pid, number)
            self.assertEqual(process.wait(30), 130)
            self.assertEqual(stored(out, where="outcome = 'failed'"), [])

    def test_a_worker_that_others_kill_leaves_its_trial_to_the_next_run(self):
        study = self.write("once.yaml", SMALL + "retries: 0\n")
        for number in (signal.SIGKILL, signal.SIGQUIT):
            with self.subTest(number.name):
                out = self.folder / number.name
                process = start("sweep", study, "--out", out, "--jobs", "1", "--json")
                event = next_event(process, "started")
                os.kill(event["process"], number)
                printed, errors = process.communicate(timeout=60)
                self.assertEqual((process.returncode, errors), (130, ""))
                end = events(printed)[-1]
                self.assertEqual((end["run"], end["left"], end["killed"], end["failed"]), (11, 1, 1, 0))
                self.assertEqual(stored(out), list(range(2, 13)))
                self.assertEqual(len(self.sweep(number.name, study=study)), 12)

    def test_again_runs_what_failed_and_nothing_else(self):
        expected = self.sweep("calm")
        study = self.write("once.yaml", SMALL + "retries: 0\n")
        out = self.folder / "out"
        for shard in ("1/2", "2/2"):
            process = start("sweep", study, "--out", out, "--jobs", "1", "--json", "--shard", shard)
            os.kill(next_event(process, "started")["process"], signal.SIGABRT)
            process.communicate(timeout=60)
        self.assertEqual(stored(out, where="outcome = 'failed'"), [1, 2])
        result = run("sweep", study, "--out", out, "--again", "failed", "--json", "--shard", "2/2")
        self.assertEqual([e["trial"] for e in events(result.out) if e["event"] == "recorded"], [2])
        self.assertEqual(stored(out, where="outcome = 'failed'"), [1])
        result = run("sweep", study, "--out", out, "--again", "failed", "--json")
        self.assertEqual([e["trial"] for e in events(result.out) if e["event"] == "recorded"], [1])
        self.assertEqual(table(out), expected)
        self.assert_refused(run("sweep", study, "--out", out, "--again", "goal"), 2, "--again")
        self.assert_refused(run("sweep", study, "--out", out, "--again", "failed", "--force"), 2, "--again")


if __name__ == "__main__":
    unittest.main()
