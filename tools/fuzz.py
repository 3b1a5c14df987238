#!/usr/bin/env python3
"""Builds the fuzzers of tests/fuzz with clang and runs each for its share of the time.

Each begins with the inputs of tests/fuzz/seeds/NAME and what earlier runs found, which stays in
build-fuzz/corpus/NAME, cut down to what covers the same. An input that ends a reader by anything but an Error is
kept as build-fuzz/found-NAME-...; this then fails, and says how to run it alone."""

import argparse
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[1]
BUILD = SOURCE / "build-fuzz"
# Files of the project that are good inputs.
EXAMPLES = {"scenario_fuzz": "config/scenarios/*.yaml", "study_fuzz": "config/studies/*.yaml"}
SANITIZERS = {"ASAN_OPTIONS": "allocator_may_return_null=1:detect_leaks=1", "UBSAN_OPTIONS": "print_stacktrace=1"}


def build(jobs):
    subprocess.run(["cmake", "--preset", "fuzz"], cwd=SOURCE, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", "--preset", "fuzz", "-j", str(jobs)], cwd=SOURCE, check=True)


def fuzzers():
    return sorted(file.stem for file in (SOURCE / "tests/fuzz").glob("*_fuzz.cpp"))


def seeds(name):
    """Folder of the inputs to begin with: its own, and examples of the project."""
    folder = BUILD / "seeds" / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    files = [*(SOURCE / "tests/fuzz/seeds" / name).glob("*"), *SOURCE.glob(EXAMPLES.get(name, "no examples"))]
    for file in files:
        shutil.copy(file, folder / file.name)
    return folder


def call(name, *arguments):
    environment = {**os.environ, "SLALOM_CONFIG_DIR": str(SOURCE / "config"), **SANITIZERS}
    return subprocess.run([BUILD / "tests/fuzz" / name, *arguments], cwd=BUILD, env=environment, text=True,
                          errors="replace", stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def cut_down(name, corpus):
    """Leaves of a corpus what covers as much."""
    small = corpus.with_name(name + ".small")
    shutil.rmtree(small, ignore_errors=True)
    small.mkdir()
    if call(name, "-merge=1", str(small), str(corpus)).returncode == 0:
        shutil.rmtree(corpus)
        small.rename(corpus)


def run(name, seconds):
    """Returns name, executions, inputs that cover something new, and what went wrong."""
    corpus = BUILD / "corpus" / name
    corpus.mkdir(parents=True, exist_ok=True)
    done = call(name, f"-max_total_time={seconds}", "-timeout=20", "-rss_limit_mb=3000", "-max_len=20000",
                "-print_final_stats=1", f"-artifact_prefix=found-{name}-", str(corpus), str(seeds(name)))
    stat = {key: int(value) for key, value in re.findall(r"stat::(\w+):\s+(\d+)", done.stdout)}
    wrong = "" if done.returncode == 0 else done.stdout[-6000:]
    if not wrong:
        cut_down(name, corpus)
    return name, stat.get("number_of_executed_units", 0), sum(1 for _ in corpus.iterdir()), wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=600, help="of all fuzzers together, on each processor")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="fuzzers at once")
    parser.add_argument("names", nargs="*", help="fuzzers; all by default")
    given = parser.parse_args()
    build(given.jobs)
    names = given.names or fuzzers()
    jobs = min(given.jobs, len(names))
    share = max(1, round(given.seconds * jobs / len(names)))
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        results = list(pool.map(lambda name: run(name, share), names))
    print(f"{'reader':<22} {'executions':>12} {'corpus':>8}   in {share} s each")
    for name, executions, corpus, wrong in results:
        print(f"{name.removesuffix('_fuzz'):<22} {executions:>12,} {corpus:>8}   {'FAILED' if wrong else 'ok'}")
    for name, _, _, wrong in results:
        if wrong:
            print(f"\n== {name}\n{wrong}\nagain: build-fuzz/tests/fuzz/{name} build-fuzz/found-{name}-...")
    return 1 if any(wrong for *_, wrong in results) else 0


if __name__ == "__main__":
    sys.exit(main())
