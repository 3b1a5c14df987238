#!/usr/bin/env python3
"""Runs clang-tidy over src/ and apps/ in parallel; any finding fails.

A file that passed is not looked at again until it, a header of this project it includes, its
compile command, .clang-tidy or clang-tidy itself changes: the record is in BUILD/tidy.

usage: tidy.py --build BUILD [--jobs N] [FILE...]
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

ROOT = pathlib.Path(__file__).resolve().parent.parent


def sources(build, only):
    """Compile commands of the files to look at, as (path, folder, arguments)."""
    with open(build / "compile_commands.json", encoding="utf-8") as file:
        entries = json.load(file)
    for entry in entries:
        path = pathlib.Path(entry["file"]).resolve()
        if not path.is_relative_to(ROOT):
            continue
        relative = path.relative_to(ROOT)
        if relative.parts[0] in ("src", "apps") and (not only or path in only):
            yield relative, entry["directory"], shlex.split(entry["command"])


def project_files(folder, arguments):
    """The files of this project a compile command reads, from the compiler's own list."""
    command = [a for a in arguments if a != "-c"]
    if "-o" in command:
        at = command.index("-o")
        del command[at:at + 2]
    listed = subprocess.run(command + ["-MM"], cwd=folder, text=True, stdout=subprocess.PIPE,
                            stderr=subprocess.DEVNULL, check=True).stdout
    names = re.sub(r"\\\n", " ", listed).split(":", 1)[1].split()
    return sorted({(pathlib.Path(folder) / name).resolve() for name in names})


def key_of(folder, arguments, version):
    """A digest of all that the outcome depends on; system headers count by the tool's version."""
    digest = hashlib.sha256(version + (ROOT / ".clang-tidy").read_bytes())
    digest.update("\0".join(arguments).encode())
    for path in project_files(folder, arguments):
        digest.update(str(path).encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()


def check(job, build, version):
    """(path, passed, output, seconds, whether the record answered)"""
    path, folder, arguments = job
    start = time.monotonic()
    stamp = None
    try:
        stamp = build / "tidy" / key_of(folder, arguments, version)
        if stamp.exists():
            return path, True, "", 0.0, True
    except subprocess.CalledProcessError:
        pass  # does not compile: clang-tidy says why
    result = subprocess.run(["clang-tidy", "--quiet", "-p", build, ROOT / path], text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    passed = result.returncode == 0
    if passed and stamp:
        stamp.write_text(f"{path}\n", encoding="utf-8")
    output = result.stdout if result.stdout.strip() or passed else result.stderr
    return path, passed, output, time.monotonic() - start, False


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=pathlib.Path, required=True,
                        help="build tree with compile_commands.json")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("files", nargs="*", help="only these (default: all)")
    options = parser.parse_args()

    build = options.build.resolve()
    (build / "tidy").mkdir(exist_ok=True)
    version = subprocess.run(["clang-tidy", "--version"], stdout=subprocess.PIPE,
                             check=True).stdout
    only = {pathlib.Path(name).resolve() for name in options.files}
    jobs = list(sources(build, only))
    if not jobs:
        print("tidy: no file to look at")
        return 1

    failed = 0
    known = 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for path, passed, output, seconds, recorded in pool.map(
                lambda job: check(job, build, version), jobs):
            known += recorded
            failed += not passed
            if not recorded:
                print(f"{'ok' if passed else 'FAILED':6} {seconds:5.1f} s  {path}", flush=True)
            if not passed:
                print(output, flush=True)
    print(f"tidy: {len(jobs)} files, {failed} with findings, {known} unchanged since they passed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
