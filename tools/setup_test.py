#!/usr/bin/env python3
"""setup.sh asks before it installs, where somebody can answer."""

import os
import pathlib
import pty
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


if __name__ == "__main__":
    unittest.main()
