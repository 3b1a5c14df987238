"""Output that cannot be written: exit 3 before any solving where that can be known, and whatever
happens later, no half file and nothing in place of what was there."""

import ctypes
import os
import resource
import subprocess
import unittest

from program import ProgramTest, run

DRIVE = ["simulate", "E_B", "--set", "loop.timeout=1"]

PR_CAPBSET_DROP, CAP_DAC_OVERRIDE = 24, 1


def obey_permissions():
    """Before the program starts: root may write anywhere, unless it gives that up."""
    if os.geteuid() == 0 and ctypes.CDLL(None).prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE, 0, 0, 0):
        raise OSError("the right to write anywhere cannot be given up")


class Output(ProgramTest):
    def test_results_are_not_replaced_unless_forced(self):
        out = self.folder / "out"
        self.assertEqual(run(*DRIVE, "--out", out, "--quiet").code, 0)
        before = {name: (out / name).stat().st_mtime_ns for name in self.entries(out)}
        self.assert_refused(run(*DRIVE, "--out", out), 3, "holds results already", "--force")
        self.assertEqual({n: (out / n).stat().st_mtime_ns for n in self.entries(out)}, before)
        self.assertEqual(run(*DRIVE, "--out", out, "--force", "--quiet").code, 0)
        self.assertEqual(self.entries(out), sorted(before))

    def test_folders_that_cannot_be(self):
        file = self.write("file", "mine")
        for out, part in ((file, "is a file"), (file / "below", "cannot be written"),
                          ("/proc/slalom", "cannot be written")):
            with self.subTest(str(out)):
                self.assert_refused(run(*DRIVE, "--out", out), 3, part)
        self.assertEqual(self.entries(), ["file"])
        self.assertEqual(file.read_text(), "mine")

    def test_links_in_the_place_of_results_are_replaced_and_nothing_aside_is_left(self):
        victim, out = self.write("victim", "precious"), self.folder / "out"
        out.mkdir()
        for name in ("plant.csv", "report.html", "summary.json"):
            os.symlink(victim, out / name)
        (out / ".report.html.0123456789abcdef.aside").write_text("left by a run that was killed")
        self.assertEqual(run(*DRIVE, "--out", out, "--force", "--quiet").code, 0)
        self.assertEqual(victim.read_text(), "precious")
        for name in ("plant.csv", "report.html", "summary.json"):
            self.assertFalse((out / name).is_symlink(), name)
        self.assertEqual([name for name in self.entries(out) if name.endswith(".aside")], [])

    def test_a_folder_without_permission(self):
        out = self.folder / "out"
        out.mkdir(mode=0o500)
        self.assert_refused(run(*DRIVE, "--out", out, preexec_fn=obey_permissions), 3,
                            "cannot be written", "Permission denied")
        self.assertEqual(self.entries(out), [])

    def test_a_disk_that_fills_while_writing(self):
        """A limit on file size stands for the disk: like it, it shows in the middle of a write."""
        out = self.folder / "out"
        out.mkdir()
        (out / "notes.txt").write_text("mine")
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (8192, 8192))
        self.assert_refused(run(*DRIVE, "--out", out, preexec_fn=limit), 3, "cannot be written",
                            "File too large")
        self.assertEqual(self.entries(out), ["notes.txt"])

    def test_a_full_disk(self):
        disk = self.folder / "disk"
        disk.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", str(disk)],
                                 capture_output=True)
        if mounted.returncode != 0:
            self.skipTest("a disk of 64 kB needs the right to mount")
        self.addCleanup(subprocess.run, ["umount", str(disk)], check=True)
        # Room for the first files of a whole drive, not for all of them.
        self.assert_refused(run("simulate", "E_B", "--out", disk / "out"), 3, "cannot be written",
                            "No space left on device")
        self.assertEqual(self.entries(disk), ["out"])
        with open(disk / "filler", "wb", buffering=0) as filler:
            try:
                while filler.write(b"x" * 4096):
                    pass
            except OSError:
                pass
        self.assert_refused(run(*DRIVE, "--out", disk / "out"), 3, "No space left on device")
        self.assertEqual(self.entries(disk), ["filler", "out"])

    def test_standard_output_that_is_full(self):
        for command in (["list"], ["check", "E_B"], [*DRIVE, "--json"]):
            with self.subTest(command), open("/dev/full", "w") as full:
                result = run(*command, stdout=full)
                self.assertEqual(result.code, 3)
                self.assertIn("standard output: cannot be written", result.err)


if __name__ == "__main__":
    unittest.main()
