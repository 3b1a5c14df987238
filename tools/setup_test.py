#!/usr/bin/env python3
"""setup.sh asks before it installs, where somebody can answer, and names what each target lacks."""

import os
import pathlib
import pty
import re
import shutil
import subprocess
import tempfile
import unittest

SETUP = pathlib.Path(__file__).with_name("setup.sh")
# All but libFuzzer is there.
STUBS = {"apt-get": 'echo "$@" >>"$LOG"', "sudo": 'exec "$@"', "clang++": "exit 1",
         "dpkg-query": 'case "$*" in *clang*) exit 1 ;; esac; printf installed'}


class Setup(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        for name, body in STUBS.items():
            stub = self.folder / name
            stub.write_text(f"#!/bin/sh\n{body}\n")
            stub.chmod(0o755)

    def installs(self, answer=None, **environment):
        """Whether apt was called; `answer` is typed at a terminal, None: there is none."""
        log = self.folder / "log"
        log.unlink(missing_ok=True)
        keep = {k: v for k, v in os.environ.items() if k not in ("CI", "YES")}
        options = {"env": {**keep, "PATH": f"{self.folder}:{os.environ['PATH']}", "LOG": str(log), **environment},
                   "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True, "timeout": 60}
        if answer is None:
            done = subprocess.run([SETUP, "fuzz"], stdin=subprocess.DEVNULL, **options)
        else:
            ours, theirs = pty.openpty()
            os.write(ours, answer.encode())
            done = subprocess.run([SETUP, "fuzz"], stdin=theirs, **options)
            os.close(ours)
            os.close(theirs)
        self.assertEqual(done.returncode, 0)
        self.assertIn("libFuzzer, which runs them", done.stdout)  # said before anything is done
        return log.exists() and "install" in log.read_text()

    def test_somebody_at_a_terminal_is_asked(self):
        self.assertTrue(self.installs("y\n"))
        self.assertTrue(self.installs("Yes\n"))
        for answer in ("n\n", "\n", "what?\n", "\x04"):
            self.assertFalse(self.installs(answer), answer)

    def test_nobody_is_asked_where_the_environment_or_the_lack_of_a_terminal_says_so(self):
        self.assertTrue(self.installs("n\n", YES="1"))
        self.assertTrue(self.installs("n\n", CI="true"))
        self.assertTrue(self.installs())
        self.assertFalse(self.installs(YES="0"))
        self.assertFalse(self.installs("y\n", YES="0"))


class Purposes(unittest.TestCase):
    """On a path with nothing but what the script itself runs."""

    def lacking(self, purpose):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("bash", "sed", "awk", "id", "env", "cat"):
                os.symlink(shutil.which(name), pathlib.Path(folder) / name)
            stub = pathlib.Path(folder) / "dpkg-query"
            stub.write_text('#!/bin/sh\ncase "$*" in *pkg-config* | *clang-format* | *gtest* | *linux-perf*) exit 1 ;; esac\n'
                            "printf installed\n")  # fmt: skip
            stub.chmod(0o755)
            done = subprocess.run([SETUP, purpose], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60,
                                  env={"PATH": folder, "YES": "0"})  # fmt: skip
            return done.returncode, set(re.findall(r"(?m)^  (\S+)", done.stdout)) - {"libgtest-dev"}

    def test_each_has_its_packages(self):
        self.assertEqual(self.lacking("bench"), (0, {"pkg-config", "linux-perf"}))
        self.assertEqual(self.lacking("run"), (0, set()))
        self.assertEqual(self.lacking("format"), (0, {"clang-format"}))
        self.assertEqual(self.lacking("test"), (0, {"pkg-config", "clang-format"}))

    def test_others_are_refused(self):
        self.assertEqual(self.lacking("results")[0], 2)

    def test_make_asks_for_those_that_there_are(self):
        makefile = SETUP.parents[1].joinpath("Makefile").read_text()
        usage = re.search(r'usage: tools/setup.sh ([^"]+)"', SETUP.read_text())[1].split("|")
        self.assertEqual(set(re.findall(r"setup\.sh (\S+)", makefile)) - set(usage), set())


if __name__ == "__main__":
    unittest.main()
