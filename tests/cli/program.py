"""Runs the program under test as a person or a script would. Standard library only."""

import os
import pathlib
import signal
import subprocess
import tempfile
import time
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("SLALOM") or str(SOURCE / "build" / "slalom")

GOOD = "start: {x: 0, y: 0}\ngoal: {x: 0, y: 100}\n"


class Result:
    """What a run printed, how it ended and how long it took [s]."""

    def __init__(self, code, out, err, seconds):
        self.code, self.out, self.err, self.seconds = code, out, err, seconds


def run(*arguments, timeout=300, **options):
    """Runs the program to its end; stdout and stderr are captured unless given."""
    options.setdefault("stdout", subprocess.PIPE)
    options.setdefault("stderr", subprocess.PIPE)
    begin = time.monotonic()
    done = subprocess.run([PROGRAM, *map(str, arguments)], timeout=timeout, text=True,
                          stdin=subprocess.DEVNULL, **options)
    return Result(done.returncode, done.stdout, done.stderr, time.monotonic() - begin)


def start(*arguments, **options):
    """Starts the program; the caller waits for it."""
    return subprocess.Popen([PROGRAM, *map(str, arguments)], text=True, stdin=subprocess.DEVNULL,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options)


def until(holds, seconds=60):
    """Waits until `holds()`; machines may be busy, so that the limit is far off."""
    end = time.monotonic() + seconds
    while not holds():
        if time.monotonic() > end:
            raise AssertionError(f"not within {seconds} s")
        time.sleep(0.01)


class ProgramTest(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        parent = os.environ.get("SLALOM_TEST_DIR")
        scratch = tempfile.TemporaryDirectory(prefix="cli-", dir=parent)
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def write(self, name, content):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def entries(self, folder=None):
        """All paths below a folder, hidden ones included."""
        root = folder or self.folder
        return sorted(str(p.relative_to(root)) for p in root.rglob("*"))

    def assert_refused(self, result, code, *parts):
        """One line on stderr with these parts, nothing on stdout."""
        self.assertEqual(result.code, code, result.err)
        self.assertEqual(result.out, "")
        self.assertEqual(result.err.count("\n"), 1, result.err)
        self.assertTrue(result.err.startswith("slalom: "), result.err)
        for part in parts:
            self.assertIn(part, result.err)


def interrupt(process, number=signal.SIGINT):
    """Sends a signal; returns the process's end as a Result, its seconds counted from the signal."""
    begin = time.monotonic()
    process.send_signal(number)
    out, err = process.communicate(timeout=60)
    return Result(process.returncode, out, err, time.monotonic() - begin)
