"""`slalom make-scenarios`: the same files for the same numbers, read back by `check`, never replaced
unasked."""

import os
import pathlib
import shutil
import subprocess

SLALOM = os.environ["SLALOM"]
DIR = pathlib.Path(os.environ["SLALOM_TEST_DIR"])


def run(*arguments):
    return subprocess.run([SLALOM, *map(str, arguments)], capture_output=True, text=True)


def make(out, *more):
    return run("make-scenarios", "gates", "--count", 2, "--seed", 5, "--out", out, *more)


one, two = DIR / "one", DIR / "two"
for folder in (one, two):  # of an earlier run
    shutil.rmtree(folder, ignore_errors=True)
assert make(one).returncode == 0
assert make(two, "--quiet").stdout == ""
files = sorted(p.name for p in one.iterdir())
assert files == ["gates-0001.yaml", "gates-0002.yaml"], files
for name in files:
    assert (one / name).read_bytes() == (two / name).read_bytes()
    assert run("check", one / name).returncode == 0

again = make(one)
assert again.returncode == 3 and "--force" in again.stderr and again.stderr.count("\n") == 1, again
assert make(one, "--force").returncode == 0

wrong = run("make-scenarios", "gate", "--out", DIR / "three")
assert wrong.returncode == 2 and "did you mean 'gates'?" in wrong.stderr, wrong
assert not (DIR / "three").exists()
assert run("make-scenarios", "gates", "--count", 0, "--out", DIR / "three").returncode == 2
assert run("make-scenarios", "gates", "--difficulty", 2, "--out", DIR / "three").returncode == 2
