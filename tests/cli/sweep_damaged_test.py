"""Stores that were damaged: one message that names the file, and the trial where it is one's; never a crash."""

import contextlib
import random
import shutil
import sqlite3
import unittest

from program import run
from sweeps import SweepTest

# What is done to a store, and what the message says.
DAMAGES = (
    ("UPDATE trials SET axes = '[\"1\",\"2\"]' WHERE trial = 3", ["trial 3", "2 values", "expected 3"]),
    ("UPDATE trials SET axes = '[\"1\",\"2\",\"3\",\"4\"]' WHERE trial = 3", ["trial 3", "4 values"]),
    ("UPDATE trials SET axes = 'x' WHERE trial = 3", ["trial 3", "axes", "'x'"]),
    ("UPDATE trials SET axes = '[1,2,3]' WHERE trial = 3", ["trial 3", "a list of texts"]),
    ("UPDATE trials SET axes = NULL WHERE trial = 3", ["trial 3", "axes"]),
    ("UPDATE trials SET axes = '{}' WHERE trial = 3", ["trial 3", "axes"]),
    ("UPDATE trials SET trial = 1000000000 WHERE trial = 3", ["trial 1000000000", "from 1 to 12"]),
    ("UPDATE trials SET trial = -7 WHERE trial = 3", ["trial -7"]),
    ("UPDATE trials SET planner = 'P_Z' WHERE trial = 3", ["trial 3", "'P_Z'"]),
    ("UPDATE trials SET scenario = x'ff00' WHERE trial = 3", ["trial 3", "scenario"]),
    ("UPDATE trials SET outcome = 'fine' WHERE trial = 3", ["trial 3", "'fine'"]),
    ("UPDATE trials SET cycles = -1 WHERE trial = 3", ["trial 3", "cycles"]),
    ("UPDATE trials SET cycles = 'many' WHERE trial = 3", ["trial 3", "cycles"]),
    ("UPDATE trials SET rests = 1e300 WHERE trial = 3", ["trial 3", "rests"]),
    ("UPDATE trials SET time_s = 'soon' WHERE trial = 3", ["trial 3", "time_s"]),
    ("UPDATE trials SET marks = x'00' WHERE trial = 3", ["trial 3", "marks"]),
    ("UPDATE trials SET repeat = 9 WHERE trial = 3", ["trial 3", "repeat"]),
    ("UPDATE study SET columns = '[]'", ["trial 1", "3 values, expected 0"]),
    ("UPDATE study SET columns = '[[[['", ["columns"]),
    ("UPDATE study SET planners = '[]'", ["planners"]),
    ("UPDATE study SET scenarios = NULL", ["scenarios"]),
    ("UPDATE study SET size = 0", ["size"]),
    ("UPDATE study SET size = 4611686018427387904", ["size"]),
    ("UPDATE study SET repeats = 0", ["repeats"]),
    ("UPDATE study SET kernels = 'sse'", ["'sse'", "an instruction set"]),
    ("UPDATE study SET stated = '{}'", ["stated"]),
    ("DELETE FROM study", ["no study stated"]),
    ("DROP TABLE trials", ["no such table: trials"]),
    ("ALTER TABLE trials DROP COLUMN hit", ["no such column: hit"]),
)
# What only a drive needs.
OF_DRIVES = (
    ("DELETE FROM bases", ["trial 3", "0 scenarios of 12 trials"]),
    ("DELETE FROM bases WHERE number = 0", ["number"]),
    ("UPDATE bases SET resolved = '' WHERE number = 0", ["trials.sqlite"]),
    ("UPDATE bases SET resolved = 7.5 WHERE number = 0", ["trials.sqlite"]),
    ("INSERT INTO bases VALUES (7, '')", ["number"]),
    ("UPDATE trials SET axes = '[\"1\",\"x\",\"3\"]' WHERE trial = 3", ["trial 3"]),
    ("UPDATE study SET columns = '[\"a.b\",\"c\",\"d\"]'", ["trial 3"]),
)


class Damaged(SweepTest):
    def setUp(self):
        super().setUp()
        self.sweep("whole", "--limit", "6")
        self.whole, self.out = self.folder / "whole", self.folder / "out"

    def damage(self, sql):
        shutil.rmtree(self.out, ignore_errors=True)
        shutil.copytree(self.whole, self.out)
        with contextlib.closing(sqlite3.connect(self.out / "trials.sqlite")) as store:
            store.execute(sql)
            store.commit()

    def assert_told(self, parts, *arguments):
        result = run(*arguments)
        self.assertIn(result.code, (2, 3), f"{arguments} {result.code} {result.err}")
        self.assert_refused(result, result.code, str(self.out), *parts)

    def test_one_message_names_file_and_trial(self):
        for sql, parts in DAMAGES:
            with self.subTest(sql):
                self.damage(sql)
                for arguments in (["study-report", self.out], ["merge", self.out, "--out", self.folder / "m"]):
                    self.assert_told(parts, *arguments)
                shutil.rmtree(self.folder / "m", ignore_errors=True)
                result = run("sweep", self.study, "--out", self.out, "--limit", "1", "--quiet")
                self.assertIn(result.code, (2, 3), f"{result.code} {result.err}")
                self.assertIn(str(self.out), result.err)
                again = run("sweep", self.study, "--out", self.out, "--limit", "1", "--quiet", "--force")
                self.assertEqual((again.code, again.err), (0, ""))

    def test_a_drive_of_a_damaged_store(self):
        for sql, parts in OF_DRIVES:
            with self.subTest(sql):
                self.damage(sql)
                self.assert_told(parts, "study-report", self.out, "--trial", "3")

    def test_stores_that_contradict_each_other(self):
        self.damage("UPDATE study SET columns = '[\"a\", \"b\", \"c\"]'")
        shutil.copy(self.whole / "trials.sqlite", self.out / "trials-1-of-2.sqlite")
        self.assert_told(["damaged"], "study-report", self.out)
        self.assert_told(["damaged"], "sweep", self.study, "--out", self.out)

    def test_bytes_at_random(self):
        """A store of which some bytes are others is read, or refused with a message."""
        dice = random.Random(11)
        good = (self.whole / "trials.sqlite").read_bytes()
        shutil.copytree(self.whole, self.out)
        for _ in range(60):
            bytes_ = bytearray(good)
            for _ in range(dice.choice([1, 10, 300])):
                bytes_[dice.randrange(100, len(bytes_))] = dice.randrange(256)
            (self.out / "trials.sqlite").write_bytes(bytes_)
            for arguments in (["study-report", self.out], ["study-report", self.out, "--trial", "3"]):
                result = run(*arguments)
                self.assertIn(result.code, (0, 2, 3), result.err)


if __name__ == "__main__":
    unittest.main()
