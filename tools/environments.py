"""Environments for others' Python packages: virtual ones, made once for each list of packages, and that of a process
which is timed on one thread. Standard library only."""

import hashlib
import os
import pathlib
import re
import subprocess
import sys

STAMP = "made-of.txt"
ONE_THREAD = {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")}


def one_thread():
    """This process's variables, with one thread for the linear algebra that peers bring along: else it competes with
    itself for the cores, and its processor time is that of all its threads."""
    return os.environ | ONE_THREAD


def requirements(file, *names):
    """What a requirements file lists; of these packages alone, where any are named."""
    lines = [line.strip() for line in pathlib.Path(file).read_text().splitlines()]
    lines = [line for line in lines if line and not line.startswith("#")]
    return [line for line in lines if not names or re.split(r"[^\w.-]", line)[0] in names]


def made_of(packages):
    """A line for each; a file among them, such as a wheel, has a digest, for its name does not tell one build from
    another."""
    lines = []
    for package in map(str, packages):
        file = pathlib.Path(package.partition("[")[0])
        digest = f" {hashlib.sha256(file.read_bytes()).hexdigest()}" if file.is_file() else ""
        lines.append(package + digest)
    return lines


def environment(folder, packages, beside=None):
    """The interpreter of the virtual environment `folder`, which has `packages`, as pip takes them. It is made anew
    where it was made of others or by another Python, or where its making was cut short, for its stamp is written last.
    `beside`: packages by the folder in it where they are put as they are, without what they say they need."""
    folder, beside = pathlib.Path(folder), beside or {}
    python, stamp = folder / "bin/python", folder / STAMP
    wanted = [sys.version, *made_of(packages)]
    wanted += [f"{name}: {line}" for name, some in beside.items() for line in made_of(some)]
    wanted = "\n".join(wanted) + "\n"
    if python.exists() and stamp.is_file() and stamp.read_text() == wanted:
        return str(python)
    print(f"making the environment {folder}", file=sys.stderr, flush=True)
    install = [str(python), "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    subprocess.run([sys.executable, "-m", "venv", "--clear", str(folder)], check=True)
    subprocess.run([*install, *map(str, packages)], check=True)
    for name, some in beside.items():
        subprocess.run([*install, "--no-deps", "--target", str(folder / name), *map(str, some)], check=True)
    stamp.write_text(wanted)
    return str(python)
