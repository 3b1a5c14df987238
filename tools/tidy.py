#!/usr/bin/env python3
"""Runs clang-tidy over src/, apps/ and benchmarks/ in parallel; any finding fails.

Files that are compiled as one are looked at as one, and without clang's static analyzer and the
checks that take longest in library headers, which takes much less time; --alone looks at each by
itself and with all of them, which also finds a using-declaration that only a neighbour in the batch
needs; so are FILEs that are named. --changed looks at the batches that hold a file which differs from
the last tag (from the last commit, where there is no tag), or which names a header that differs; at
all of them where SLALOM_TIDY=all stands in the environment.

What passed is not looked at again until its text, a header of this project it includes, its
compile command, .clang-tidy or clang-tidy itself changes: the record is in BUILD/tidy.

usage: tidy.py --build BUILD [--jobs N] [--alone] [--changed] [FILE...]
"""

import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import time

from quick import changed_files

ROOT = pathlib.Path(__file__).resolve().parent.parent
INCLUDED = re.compile(r'^#include "(.+)"$', re.MULTILINE)


def batches(build, only, alone):
    """What to look at, longest first: the files, and the folder and arguments of their command."""
    with open(build / "compile_commands.json", encoding="utf-8") as file:
        entries = json.load(file)
    found = []
    for entry in entries:
        path = pathlib.Path(entry["file"]).resolve()
        files = [path]
        if path.parent.name == "Unity":
            files = [pathlib.Path(name) for name in INCLUDED.findall(path.read_text("utf-8"))]
        files = [file for file in files if file.is_relative_to(ROOT) and
                 file.relative_to(ROOT).parts[0] in ("src", "apps", "benchmarks") and
                 (not only or file in only)]
        command = flags(shlex.split(entry["command"]), files)
        found += [([file], entry["directory"], command) for file in files] if alone else (
            [(files, entry["directory"], command)] if files else [])
    return sorted(found, key=lambda job: -sum(file.stat().st_size for file in job[0]))


def last_tag():
    """The newest tag that the commit stands on; `HEAD` where there is none."""
    found = subprocess.run(["git", "describe", "--tags", "--abbrev=0"], cwd=ROOT, text=True,
                           stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)
    return found.stdout.strip() or "HEAD"


def touched(files, changed):
    """Whether a file is among `changed` (relative to the root), or names one of its headers."""
    headers = {name for path in changed if path.suffix == ".hpp"
               for name in (path.name, str(path).removeprefix("include/"))}
    return any(file.relative_to(ROOT) in changed or
               headers & set(INCLUDED.findall(file.read_text("utf-8"))) for file in files)


def flags(command, files):
    """A compile command without what it compiles and the compiler's precompiled headers; the files' own
    folders are looked in for headers."""
    kept = command[:command.index("-o")] if "-o" in command else command[:]
    while "-include" in kept:
        at = kept.index("-include")
        del kept[at:at + 2]
    for folder in sorted({file.parent for file in files}):
        kept += ["-iquote", str(folder)]
    return kept


def project_files(files, folder, command):
    """The files of this project that are read, from the compiler's own list."""
    listed = subprocess.run([*command, "-MM", *map(str, files)], cwd=folder, text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=True).stdout
    names = re.sub(r"\\\n|\S+:\s", " ", listed).split()
    return sorted({(pathlib.Path(folder) / name).resolve() for name in names})


def key_of(files, folder, command, checks, version):
    """A digest of all that the outcome depends on; system headers count by the tool's version."""
    digest = hashlib.sha256(version + (ROOT / ".clang-tidy").read_bytes() + checks.encode())
    digest.update("\0".join(command).encode())
    for path in project_files(files, folder, command):
        digest.update(str(path).encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()


def joined(files, path):
    """Writes the files one after the other to `path`; returns each one's first line in it."""
    starts, lines = [], []
    for file in files:
        starts.append((len(lines), file))
        lines += file.read_text(encoding="utf-8").splitlines()
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return starts


def placed(output, path, starts):
    """The output, with lines of the joined file given as lines of the files it joins."""
    def place(match):
        line = int(match[1])
        before, file = [start for start in starts if start[0] < line][-1]
        return f"{file}:{line - before}:"
    return re.sub(re.escape(str(path)) + r":(\d+):", place, output)


def check(job, build, checks, version):
    """(name, passed, output, seconds, whether the record answered)"""
    files, folder, command = job
    name = ", ".join(str(file.relative_to(ROOT)) for file in files)
    start = time.monotonic()
    stamp = None
    try:
        stamp = build / "tidy" / key_of(files, folder, command, checks, version)
        if stamp.exists():
            return name, True, "", 0.0, True
    except subprocess.CalledProcessError:
        pass  # does not compile: clang-tidy says why
    path = files[0]
    if len(files) > 1:
        path = build / "tidy" / (hashlib.sha256(name.encode()).hexdigest()[:16] + ".cpp")
        starts = joined(files, path)
    result = subprocess.run(
        ["clang-tidy", "--quiet", f"--config-file={ROOT / '.clang-tidy'}",
         f"--checks={checks}", path, "--", *command[1:]],
        cwd=folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    passed = result.returncode == 0
    if passed and stamp:
        stamp.write_text(f"{name}\n", encoding="utf-8")
    output = result.stdout if result.stdout.strip() or passed else result.stderr
    if len(files) > 1:
        output = placed(output, path, starts)
    return name, passed, output, time.monotonic() - start, False


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=pathlib.Path, required=True,
                        help="build tree with compile_commands.json")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--alone", action="store_true", help="look at each file by itself")
    parser.add_argument("--changed", action="store_true", help="only what differs from the last tag")
    parser.add_argument("files", nargs="*", help="only these (default: all)")
    options = parser.parse_args()

    build = options.build.resolve()
    (build / "tidy").mkdir(exist_ok=True)
    version = subprocess.run(["clang-tidy", "--version"], stdout=subprocess.PIPE,
                             check=True).stdout
    only = {pathlib.Path(name).resolve() for name in options.files}
    jobs = batches(build, only, options.alone or only)
    if not jobs:
        print("tidy: no file to look at")
        return 1
    if options.changed and os.environ.get("SLALOM_TIDY") != "all":
        changed = set(changed_files(last_tag()))
        jobs = [job for job in jobs if touched(job[0], changed)]

    checks = "" if options.alone or only else (
        "-clang-analyzer-*,-performance-unnecessary-value-param,-bugprone-reserved-identifier")
    failed = 0
    known = 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for job, (name, passed, output, seconds, recorded) in zip(jobs, pool.map(
                lambda job: check(job, build, checks, version), jobs)):
            known += recorded * len(job[0])
            failed += not passed
            if not recorded:
                print(f"{'ok' if passed else 'FAILED':6} {seconds:5.1f} s  {name}", flush=True)
            if not passed:
                print(output, flush=True)
    count = sum(len(job[0]) for job in jobs)
    print(f"tidy: {count} files, {failed} with findings, {known} unchanged since they passed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
