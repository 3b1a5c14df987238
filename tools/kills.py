#!/usr/bin/env python3
"""Kills sweeps, their workers, shards, merges and replacements at random moments, goes on, and looks whether anything
is lost, doubled, or recorded as failed; into docs/measured/kills.md. Standard library only; Linux.

    tools/kills.py [--program build/slalom] [--kills 100]
"""

import collections
import contextlib
import math
import os
import pathlib
import random
import shutil
import signal
import sqlite3
import subprocess
import tempfile
import time

from measured import command_of, page_parser, stamp, write
from sweeps import head, row, trials

SEED = 1
TRIALS = 40
# Drives that end where they begin, after one cycle.
SCENARIO = """name: at the goal
vehicle: hmmwv
planner: {base: P_D, N: 5, w_t: 0}
start: {x: 0, y: 0, ux: 10}
goal: {x: 0, y: 3, sigma: 5}
loop: {tex: 0.1, warm_up: false}
"""
STUDY = f"""title: {{title}}
scenario: scenario.yaml
retries: 0
axes:
  - key: start.ux
    range: {{{{from: {{first}}, to: 15, count: {TRIALS}}}}}
"""
MEASURED = {"max_solve_time_s", "median_solve_time_s", "max_cpu_time_s", "p99_cpu_time_s", "median_cpu_time_s"}
ENDS = {0, 3, 130, -signal.SIGKILL, -signal.SIGTERM}  # done, refused, interrupted, killed


class Fault(Exception):
    """What must not happen."""


class Bench:
    """A folder with the studies, and how they end undisturbed."""

    def __init__(self, program, folder):
        self.program, self.folder = str(pathlib.Path(program).resolve()), folder
        (folder / "scenario.yaml").write_text(SCENARIO)
        self.tables = {}
        self.kind, self.takes_s, self.struck = "", {}, collections.Counter()  # by kind: undisturbed, and how often
        for name, first in (("study", 10), ("other", 11.5)):
            (folder / f"{name}.yaml").write_text(STUDY.format(title=name, first=first))
            self.finish("alone-" + name, name)
            self.tables[name] = table(folder / ("alone-" + name))

    def start(self, *arguments):
        return subprocess.Popen([self.program, *map(str, arguments), "--quiet"], cwd=self.folder,
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, start_new_session=True)  # fmt: skip

    def sweep(self, out, study="study", *options):
        return self.start("sweep", f"{study}.yaml", "--out", out, "--jobs", "2", *options)

    def finish(self, out, study="study", *options):
        """Goes on until all is done."""
        for _ in range(5):
            process = self.sweep(out, study, *options)
            message = process.communicate()[1].decode()
            if process.returncode == 0:
                return
            if process.returncode != 130:
                raise Fault(f"going on ended with {process.returncode}: {message.strip()}")
        raise Fault("going on five times was not enough")

    def judge(self, out, kept=(), study="study"):
        """The table is the undisturbed one's, and what was recorded before is as it was."""
        found = table(self.folder / out)
        if found != self.tables[study]:
            failed = sum(row["outcome"] == "failed" for row in found)
            raise Fault(f"the table differs: {len(found)} of {TRIALS} trials, {failed} failed")
        now = {trial[0]: trial for trial in recorded(self.folder / out)}
        if changed := [trial[0] for trial in kept if now.get(trial[0]) != trial]:
            raise Fault(f"{len(changed)} recorded trials were run again")


def table(folder):
    """The rows of trials.csv without what is measured."""
    return [{k: v for k, v in row.items() if k not in MEASURED} for row in trials(folder)]


def recorded(folder):
    """All rows of the stores of a folder."""
    rows = []
    for store in sorted(folder.glob("trials*.sqlite")) if folder.is_dir() else ():
        with contextlib.closing(sqlite3.connect(f"file:{store}?mode=ro", uri=True)) as database:
            with contextlib.suppress(sqlite3.OperationalError):  # killed as it was made
                rows += database.execute("SELECT * FROM trials").fetchall()
    return rows


def runs(number):
    """Whether a process runs: one that has ended stands in the list of its parent until that looks."""
    try:
        return pathlib.Path(f"/proc/{number}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def workers_of(process):
    """Numbers of its child processes that run."""
    listing = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children")
    return [number for number in map(int, listing.read_text().split()) if runs(number)] if listing.exists() else []


def ended(process):
    """Waits for its end, which is one of those that are documented."""
    message = process.communicate()[1].decode()
    if process.returncode not in ENDS:
        raise Fault(f"ended with {process.returncode}: {message.strip()}")


def struck(draw, bench, processes, strike):
    """Strikes one of the processes at a random moment of the time that this kind takes undisturbed, which its first run
    shows, and waits for the end of all. The process that was struck; None where none ran any more."""
    begin, found = time.monotonic(), None
    moment = draw.random() ** 2 * bench.takes_s.get(bench.kind, math.inf)  # more often early, where stores are made
    for process in processes:
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(max(begin + moment - time.monotonic(), 0) if math.isfinite(moment) else None)
    bench.takes_s.setdefault(bench.kind, time.monotonic() - begin)
    running = [process for process in processes if process.poll() is None]
    with contextlib.suppress(ProcessLookupError):
        target = draw.choice(running) if running else None
        if target and strike(target) is not False:
            bench.struck[bench.kind] += 1
            found = target
    for process in processes:
        ended(process)
    return found


# --- what is killed -------------------------------------------------------------------------------


def kill(process):
    process.kill()


def one_sweep(strike):
    """Kills one sweep by strike(draw, process), and goes on."""

    def kind(draw, bench, out):
        struck(draw, bench, [bench.sweep(out)], lambda process: strike(draw, process))
        kept = recorded(bench.folder / out)
        bench.finish(out)
        bench.judge(out, kept)

    return kind


def kill_workers(draw, process):
    workers = workers_of(process)[: draw.choice((1, 2))]
    for number in workers:
        os.kill(number, draw.choice((signal.SIGKILL, signal.SIGTERM)))
    return bool(workers)


def shard(draw, bench, out):
    """One of two at work in one folder."""
    struck(draw, bench, [bench.sweep(out, "study", "--shard", f"{k}/2") for k in (1, 2)], kill)
    kept = recorded(bench.folder / out)
    for k in (1, 2):
        bench.finish(out, "study", "--shard", f"{k}/2")
    bench.judge(out, kept)


def replacement(draw, bench, out):
    """--force over another study."""
    shutil.copytree(bench.folder / "alone-other", bench.folder / out)
    struck(draw, bench, [bench.sweep(out, "study", "--force")], kill)
    rows, study = recorded(bench.folder / out), "study"
    if {row[1] for row in rows} <= {row[1] for row in recorded(bench.folder / "alone-other")} and len(rows) == TRIALS:
        study = "other"  # before anything was replaced: the old results stand
    bench.finish(out, study)
    bench.judge(out, rows, study)


def merge(draw, bench, out):
    struck(draw, bench, [bench.start("merge", "half-1", "half-2", "--out", out)], kill)
    process = bench.start("merge", "half-1", "half-2", "--out", out, "--force")
    ended(process)
    if process.returncode != 0:
        raise Fault(f"merging again ended with {process.returncode}")
    bench.judge(out, recorded(bench.folder / "half-1") + recorded(bench.folder / "half-2"))


def two_studies(draw, bench, out):
    """Two studies into one folder at once, one of them killed: one has it, or neither yet."""
    both = {name: bench.sweep(out, name) for name in ("study", "other")}
    killed = struck(draw, bench, list(both.values()), kill)
    if all(process.returncode == 0 for process in both.values()):
        raise Fault("both were taken")
    left, other = sorted(both, key=lambda name: both[name] is killed)
    kept = recorded(bench.folder / out)
    of_left = {row[1] for row in recorded(bench.folder / f"alone-{left}")}
    owner = left if not kept or kept[0][1] in of_left else other
    # Of a store killed before its first trial nobody can see from outside whose it is.
    bench.finish(out, owner, *(() if kept else ("--force",)))
    bench.judge(out, kept, owner)


KINDS = {
    "the supervisor": one_sweep(lambda _, process: kill(process)),
    "workers": one_sweep(kill_workers),
    "the process group, by SIGTERM": one_sweep(lambda _, process: os.killpg(process.pid, signal.SIGTERM)),
    "one of two shards": shard,
    "`--force` over another study": replacement,
    "`merge`, merged again by `--force`": merge,
    "one of two studies begun into one folder": two_studies,
}


def run_all(program, kills, folder):
    """The bench, which has counted the strikes; kind -> Counter of clean runs; and all faults as sentences. The first run
    of each kind is undisturbed, and counts for its time and faults alone."""
    bench = Bench(program, folder)
    for k in (1, 2):
        bench.finish(f"half-{k}", "study", "--shard", f"{k}/2")
    draw, faults, clean = random.Random(SEED), [], collections.Counter()
    for number in range(kills + 1):
        for bench.kind, kind in KINDS.items():
            out = f"out-{number}"
            try:
                kind(draw, bench, out)
                clean[bench.kind] += number > 0
            except Fault as fault:
                faults.append(f"{bench.kind}, {f'number {number}' if number else 'undisturbed'}: {fault}")
            shutil.rmtree(folder / out, ignore_errors=True)
    return bench, clean, faults


def page(kills, bench, clean, faults, stamped):
    lines = ["# Kills", "", stamped,
             f"A study of {TRIALS} very short trials with `retries: 0` on two workers, killed at a moment drawn at random (seed",
             f"{SEED}, more often early, where stores are made) of the time that a run of this kind takes undisturbed, then run on",
             "until it is done. Where it was over by then, nothing was struck. Clean: each run ended in one of the ways that are",
             "documented, the table is that of an undisturbed run, no trial was recorded as failed, and no recorded trial was run",
             "again."]  # fmt: skip
    rows = "".join(row([name, f"{bench.takes_s[name]:.2f}", kills, bench.struck[name], clean[name]]) for name in KINDS)
    lines += ["", head(["killed", "undisturbed [s]", "runs", "struck", "clean"]) + rows.rstrip()]
    if faults:
        lines += ["", "What was not clean:", "", *(f"- {fault}" for fault in faults)]
    return "\n".join(lines) + "\n"


def main():
    parser = page_parser("kills", __doc__, keeps=False)
    parser.add_argument("--kills", type=int, default=100, help="of each kind")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        found = run_all(args.program, args.kills, pathlib.Path(folder))
    write(args.out, page(args.kills, *found, stamp(command_of(parser, args, "kills", "kills"), args.program)))


if __name__ == "__main__":
    main()
