"""Sweeps that cannot be: one message for a bad study, for a folder of something else, and for a disk that is
full or may not be written to; nothing is lost."""

import contextlib
import os
import resource
import shutil
import sqlite3
import subprocess
import unittest

from program import run, start
from sweeps import SMALL, SweepTest, next_event, table


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
                (head + "planners: P_C\n", ["s.yaml:2:11", "found 'P_C'", "a list of planners"]),
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
                 ["s.yaml:5:5", "1000000000 trials (1000 x 1000 x 1000)", "at most 1000000"]),
                (head + "axes:\n" + "".join(
                    f"  - {{key: {key}, range: {{from: 1, to: 2, count: 100000}}}}\n"
                    for key in ("loop.tex", "start.ux")),
                 ["1e+10 trials (100000 x 100000)", "at most 1000000"]),
                (head + "axes:\n  - {key: tex, values: [1]}\n",
                 ["s.yaml:3:11", "'tex' without its section", "expected loop.tex"]),
                (head + "axes:\n  - {key: loop.tex, values: }\n", ["s.yaml:3:29", "a list of values"]),
                (head + "axes:\n  - {key: start.x, values: [.nan]}\n", ["s.yaml:3:29", "x = nan"]),
                (head + "axes:\n  - {key: start.x, values: [null]}\n", ["s.yaml:3:29", "found nothing"]),
                (head + "axes:\n", ["s.yaml:3:1", "a list of axes"]),
                (head + "axes: {loop.tex: [1]}\n", ["s.yaml:2:7", "a list of axes"]),
                (head + "set: {loop.tex: 1}\naxes:\n  - {key: loop.tex, values: [1]}\n",
                 ["s.yaml:2:7", "'loop.tex', which an axis varies"]),
                ("scenario: [E_A, E_B]\n", ["s.yaml:1:11", "'scenarios' for several"]),
                (head + "repeats: 1000000000\n", ["s.yaml:2:10", "repeats = 1000000000"]),
                (head + "repeats: -1\n", ["s.yaml:2:10", "repeats = -1"]),
                (head + "axes:\n  - {key: loop.tex, values: [1]}\n  - {key: loop.tex, values: [2]}\n",
                 ["s.yaml:4:11", "'loop.tex' a second time"]),
                (head + "axes:\n  - {key: start.psi, values: [1]}\n  - {key: start.psi_deg, values: [90]}\n",
                 ["s.yaml:4:11", "both start.psi and start.psi_deg"]),
                (head + "axes:\n  - {key: loop.tex}\n", ["s.yaml:3:5", "none of the known forms"]),
                (head + "axes:\n  - {keys: [start.x, start.y], values: [[1, 2], [3]]}\n",
                 ["s.yaml:3:", "1 values", "2 values"]),
                (head + "axes:\n  - draw: {count: 3, of: [{key: start.x, uniform: [2, 1]}]}\n",
                 ["s.yaml:3:", "low < high"]),
                (head + "axes:\n  - draw: {count: 3, method: sobl, of: [{key: start.x, normal: [2, 1]}]}\n",
                 ["s.yaml:3:30", "did you mean 'sobol'?"]),
                (head + "axes:\n  - draw: {count: 99, of: [{key: loop.tex, uniform: [-0.1, 1]}]}\n",
                 ["s.yaml:3:", "found tex = -0.0", "a number >= 0.001"]),
                (head + "axes:\n  - draw: {count: 99, of: [{key: planner.N, uniform: [10, 12]}]}\n",
                 ["s.yaml:3:", "found a number 1", "an integer for N"]),
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
                                 (["sweep", "E_B", "--out", "o"], ["study 'E_B'", "paper"]),
                                 (["sweep", ".", "--out", "o"], ["a folder", "a study"]),
                                 (["sweep", "paper", "--out", "o", "--set", "loop.tx=1"], ["'tex'"]),
                                 (["sweep", "paper", "--out", "o", "--set", "planner.w_t=nan"],
                                  ["--set planner.w_t", "nan"]),
                                 (["sweep", "paper", "--out", "o", "--set", "loop.tex=1"],
                                  ["--set loop.tex", "which an axis varies"]),
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
        drive = self.folder / "drive"
        self.assertEqual(run("simulate", "E_B", "--set", "loop.timeout=0.5", "--out", drive,
                             "--quiet").code, 0)
        before = self.entries(drive)
        self.assert_refused(run("sweep", self.study, "--out", drive), 3, "something else")
        self.assertEqual(self.entries(drive), before)
        self.assert_refused(run("sweep", self.study, "--out", self.study), 3, "is a file")
        self.assert_refused(run("merge", out, notes, "--out", self.folder / "m"), 2,
                            "another study")
        self.assert_refused(run("merge", self.folder, "--out", self.folder / "m"), 2, "no results")
        self.assert_refused(run("merge", self.folder / "nosuch", "--out", self.folder / "m"), 2, "no such folder")

    def test_force_takes_nothing_that_is_no_sweeps(self):
        self.sweep("out", "--limit", "1")
        for name in ("index.html", "trials.csv", "figures/a.svg", "drives/000001/report.html"):
            with self.subTest(name):
                site = self.folder / "site"
                file = site / name
                file.parent.mkdir(parents=True)
                file.write_text("mine")
                for command in (["sweep", self.study], ["merge", self.folder / "out"]):
                    for force in ([], ["--force"]):
                        self.assert_refused(run(*command, "--out", site, *force), 3, "something else",
                                            f"'{name.split('/')[0]}'")
                self.assertEqual(file.read_text(), "mine")
                shutil.rmtree(site)

    def test_an_instruction_set_that_is_not_there_fails_no_trial(self):
        with open("/proc/cpuinfo") as file:
            if "avx512f" in file.read():
                self.skipTest("this processor has every instruction set")
        study = self.write("wide.yaml", SMALL + "kernels: avx512\n")
        self.assert_refused(run("sweep", study, "--out", self.folder / "wide"), 2, "kernels: found avx512")
        self.assertFalse((self.folder / "wide").exists())

    def test_a_store_of_another_version_is_replaced_by_force_alone(self):
        self.sweep("out", "--limit", "1")
        store = self.folder / "out/trials.sqlite"
        with sqlite3.connect(store) as database:
            database.execute("UPDATE study SET format = 1")
        database.close()
        self.assert_refused(run("sweep", self.study, "--out", self.folder / "out"), 3,
                            "another version of Slalom", "--force")
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


def keep_files_small():
    """In the child: no file may grow beyond 64 KiB."""
    resource.setrlimit(resource.RLIMIT_FSIZE, (65536, -1))


class NoRoom(SweepTest):
    """Disks that are full or may not be written to."""

    def mount(self, size):
        """A disk of `size` at DISK; only root may have one."""
        disk = self.folder / "disk"
        disk.mkdir()
        done = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", disk],
                              stderr=subprocess.DEVNULL)
        if done.returncode != 0:
            self.skipTest("disks cannot be mounted here")
        self.addCleanup(subprocess.run, ["umount", disk], check=True)
        return disk

    def remount(self, disk, options):
        subprocess.run(["mount", "-o", f"remount,{options}", disk], check=True)

    def many_trials(self):
        """Some hundred trials that contradict themselves: rows without drives."""
        study = self.write("many.yaml", "scenario: E_B\naxes:\n"
                           "  - {key: loop.tex, range: {from: 9, to: 9.5, count: 700}}\n"
                           "set: {planner.tf_max: 8}\n")
        rows = self.sweep("calm", study=study)
        self.assertEqual({row["outcome"] for row in rows}, {"invalid"})
        return study, rows

    def test_a_full_disk_is_said_and_the_sweep_goes_on_afterwards(self):
        expected = self.sweep("calm")
        study = self.write("keep.yaml", SMALL + "keep: drives\n")
        out = self.folder / "out"
        result = run("sweep", study, "--out", out, "--jobs", "1", preexec_fn=keep_files_small)
        self.assert_refused(result, 3, "cannot be written")
        self.assertEqual(self.sweep("out", study=study), expected)

    def test_a_store_that_cannot_grow_is_said_and_the_sweep_goes_on(self):
        study, expected = self.many_trials()
        out = self.folder / "out"
        result = run("sweep", study, "--out", out, preexec_fn=keep_files_small)
        self.assert_refused(result, 3, "out/trials.sqlite: ")
        self.assertEqual(self.sweep("out", "--resume", study=study), expected)

    def test_a_small_disk_costs_nothing_that_is_recorded(self):
        study, expected = self.many_trials()
        disk = self.mount("256k")
        out = disk / "out"
        self.assert_refused(run("sweep", study, "--out", out), 3, "disk is full")
        self.assert_refused(run("sweep", study, "--out", out, "--resume"), 3, "disk/out")
        self.remount(disk, "size=8m")
        with contextlib.closing(sqlite3.connect(out / "trials.sqlite")) as store:
            kept = store.execute("SELECT count(*) FROM trials").fetchone()[0]
        self.assertGreater(kept, 20)
        result = run("sweep", study, "--out", out, "--resume")
        self.assertIn(f"{len(expected) - kept} run now, {kept} found done", result.out)
        self.assertEqual(table(out), expected)

    def test_merge_and_the_page_on_a_small_disk(self):
        _, expected = self.many_trials()
        disk = self.mount("128k")
        self.assert_refused(run("merge", self.folder / "calm", "--out", disk / "m"), 3,
                            "disk/m/trials.sqlite: database or disk is full")
        self.remount(disk, "size=8m")
        self.assertEqual(run("merge", self.folder / "calm", "--out", disk / "m", "--quiet").code, 0)
        used = os.statvfs(disk)
        self.remount(disk, f"size={(used.f_blocks - used.f_bfree) * used.f_frsize // 1024}k")
        self.assert_refused(run("study-report", disk / "m"), 3, "cannot be written (No space left")
        self.assertFalse((disk / "m/index.html").exists())
        self.remount(disk, "size=8m")
        self.assertEqual(run("study-report", disk / "m").code, 0)
        self.assertEqual(table(disk / "m"), expected)

    def test_a_folder_that_may_only_be_read_is_said_and_can_be_read(self):
        expected = self.sweep("calm")
        disk = self.mount("8m")
        self.sweep("disk/out", "--limit", "5")
        self.remount(disk, "ro")
        before = (disk / "out/trials.csv").read_bytes()
        for command in (["sweep", self.study, "--out", disk / "out"],
                        ["sweep", self.study, "--out", disk / "out", "--resume"],
                        ["sweep", self.study, "--out", disk / "out", "--force"],
                        ["sweep", self.study, "--out", disk / "new"],
                        ["merge", disk / "out", "--out", disk / "new"],
                        ["study-report", disk / "out"]):
            with self.subTest(command[0]):
                self.assert_refused(run(*command), 3, "disk/", "cannot be written (Read-only file system)")
        self.assertEqual((disk / "out/trials.csv").read_bytes(), before)
        self.assertEqual(run("merge", disk / "out", "--out", self.folder / "read", "--quiet").code, 0)
        self.assertEqual(table(self.folder / "read"), expected[:5])
        self.remount(disk, "rw")
        self.assertEqual(self.sweep("disk/out", "--resume"), expected)

    def test_a_folder_of_someone_else_is_said(self):
        if os.getuid() != 0:
            self.skipTest("only root can be someone else")
        self.sweep("out", "--limit", "1")
        self.folder.chmod(0o755)  # to be reached at all
        result = run("study-report", self.folder / "out", "--trial", "1", user="nobody")
        self.assert_refused(result, 3, "/out")
        for out in ("out", "new"):
            result = run("sweep", self.study, "--out", self.folder / out, user="nobody")
            self.assert_refused(result, 3, f"/{out}", "cannot be written (Permission denied)")
        self.assertEqual(len(self.sweep("out", "--limit", "1", "--resume")), 2)


if __name__ == "__main__":
    unittest.main()
