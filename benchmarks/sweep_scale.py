#!/usr/bin/env python3
"""Sweeps very many very short trials, and measures what the sweep itself costs: its rate on one
process and on several, the memory of the process that leads, and how soon it goes on after a kill;
into docs/measured/sweep-scale.md.

A trial begins in the goal's square and ends after one cycle. Use a quiet machine. Linux only.

usage: sweep_scale.py [--program build/slalom] [--trials N] [--jobs J]
"""

import contextlib
import os
import pathlib
import resource
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from kills import SCENARIO  # noqa: E402
from measured import command_of, page_parser, stamp, write  # noqa: E402

STUDY = """
title: very short trials
scenario: scenario.yaml
axes:
  - key: start.ux
    range: {{from: 10, to: 15, count: {trials}}}
"""
SINGLE = 3000  # trials to time one process on


class Sweep:
    """A sweep at work, and what is known of it from outside."""

    def __init__(self, program, folder, out, *options):
        self.begin = time.monotonic()
        self.store = folder / out / "trials.sqlite"
        self.process = subprocess.Popen(
            [program, "sweep", folder / "study.yaml", "--out", folder / out, "--quiet", *map(str, options)])

    def recorded(self, above=0):
        """Trials in the store with numbers above one."""
        if not self.store.exists():
            return 0
        with contextlib.closing(sqlite3.connect(f"file:{self.store}?mode=ro", uri=True)) as database:
            try:
                return database.execute("SELECT count(*) FROM trials WHERE trial > ?",
                                        (above,)).fetchone()[0]
            except sqlite3.OperationalError:  # not made yet
                return 0

    def peak(self):
        """Greatest resident memory of the leading process so far [MB]; None once it has ended."""
        with contextlib.suppress(OSError):
            for line in pathlib.Path(f"/proc/{self.process.pid}/status").read_text().splitlines():
                if line.startswith("VmHWM"):
                    return int(line.split()[1]) / 1024
        return None

    def processor_time(self):
        """Of the leading process alone [s]."""
        with contextlib.suppress(OSError, IndexError):
            fields = pathlib.Path(f"/proc/{self.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
            return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
        return None

    def wait_for(self, count, every=0.5, above=0):
        while self.process.poll() is None and self.recorded(above) < count:
            time.sleep(every)
        return time.monotonic()

    def end(self):
        """Waits for the end; the last that was seen of its memory and processor time."""
        seen = (0.0, 0.0)
        while self.process.poll() is None:
            if (peak := self.peak()) and (used := self.processor_time()) is not None:
                seen = (peak, used)
            time.sleep(0.02)
        if self.process.returncode != 0:
            raise SystemExit(f"the sweep ended with {self.process.returncode}")
        return seen


def processor_time_of_children():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def single(program, folder, trials):
    """Trials a second on one process, its start left out, and the processor time of one [s], of all
    processes."""
    count = min(SINGLE, trials)
    before = processor_time_of_children()
    sweep = Sweep(program, folder, "single", "--jobs", 1, "--limit", count)
    first = sweep.wait_for(1, 0.01), sweep.recorded()
    sweep.end()
    rate = (count - first[1]) / (time.monotonic() - first[0])
    return rate, (processor_time_of_children() - before) / count


def measure(program, folder, trials, jobs):
    """Sweeps, kills and goes on; what was found, a sentence each."""
    before = os.getloadavg()[0]
    one, cost = single(program, folder, trials)
    yield f"One process: {one:.1f} trials a second, {1e3 * cost:.2f} ms of processor time a trial."

    peaks = []
    sweep = Sweep(program, folder, "pool", "--jobs", jobs)
    first = sweep.wait_for(trials // 100)
    peaks.append(sweep.peak())
    at = sweep.recorded()
    half = sweep.wait_for(trials // 2)
    done = sweep.recorded()
    peaks.append(sweep.peak())
    used = sweep.processor_time()
    several = (done - at) / (half - first)
    yield f"{jobs} processes: {several:.1f} trials a second, {several / one / jobs:.1%} of {jobs} times one."
    yield f"The leading process takes {1e3 * used / done:.2f} ms a trial, {used / done / cost:.1%} of all."

    os.kill(sweep.process.pid, signal.SIGKILL)
    sweep.process.wait()
    left = sweep.recorded()
    above = max(0, left - 1000)  # so that looking costs little: what is new has a number near the last ones
    near = sweep.recorded(above)
    sweep = Sweep(program, folder, "pool", "--jobs", jobs, "--resume")
    resumed = sweep.wait_for(near + 1, 0.01, above) - sweep.begin
    yield f"Killed at {left} trials: {resumed:.2f} s from the new start to the first new trial."
    peak, _ = sweep.end()
    peaks.append(peak)
    rows = (folder / "pool/trials.csv").read_text().count("\n") - 1
    yield ("Peak memory of the leading process at 1, 50 and 100 %: "
           + ", ".join(f"{peak:.0f}" for peak in peaks) + f" MB; {rows} rows at the end.")
    if rows != trials:
        raise SystemExit(f"found {rows} rows, expected {trials}")
    yield (f"Load of the machine, of {os.cpu_count()} processors: {before:.2f} before, {os.getloadavg()[0]:.2f} after.")


def page(found, trials, stamped):
    return "\n".join(["# What a sweep costs", "", stamped,
                      f"A sweep of {trials} trials that begin in the goal's square and end after one cycle.", "",
                      *(f"- {line}" for line in found), ""])


def main():
    parser = page_parser("sweep-scale", __doc__, keeps=False)
    parser.add_argument("--trials", type=int, default=100_000)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    given = parser.parse_args()
    made_by = command_of(parser, given, "sweep-scale", "trials", "jobs")
    found = []
    with tempfile.TemporaryDirectory(prefix="sweep-scale-") as folder:
        folder = pathlib.Path(folder)
        (folder / "scenario.yaml").write_text(SCENARIO)
        (folder / "study.yaml").write_text(STUDY.format(trials=given.trials))
        for line in measure(given.program, folder, given.trials, given.jobs):
            print(line, flush=True)
            found.append(line)
    write(given.out, page(found, given.trials, stamp(made_by, given.program)))


if __name__ == "__main__":
    main()
