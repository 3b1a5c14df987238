"""Drives and sweeps for the tools that write pages: run, read, counted and set in tables. Standard
library only."""

import csv
import json
import math
import pathlib
import shutil
import subprocess
import tempfile


def drive(program, scenario, planner, settings, out):
    """One drive with `settings` ("planner.N": 15) into a folder."""
    command = [program, "simulate", scenario, "--planner", planner, "--out", out, "--force", "--quiet"]
    for key, value in settings.items():
        command += ["--set", f"{key}={value}"]
    subprocess.run(command, check=True)


def driven(program, scenario, planner, settings):
    """One drive: its summary, and the rows of its cycles.csv."""
    with tempfile.TemporaryDirectory() as folder:
        drive(program, scenario, planner, settings, folder)
        out = pathlib.Path(folder)
        return json.loads((out / "summary.json").read_text()), rows_of(out / "cycles.csv")


def rows_of(path):
    """The rows of a CSV file."""
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def ended(summary):
    """Outcome, and what was hit."""
    return summary["outcome"] + (f" {summary['hit']}" if summary["hit"] else "")


def trials(folder):
    """The rows of a sweep's trials.csv."""
    return rows_of(pathlib.Path(folder) / "trials.csv")


def swept(program, study, out, *arguments):
    """Runs a study, or what is left of it, into `out`; its trials."""
    subprocess.run([program, "sweep", study, "--out", out, *arguments], check=True)
    return trials(out)


CHUNK = 200  # drives between which folders are thinned: each drive leaves more than a megabyte


def drive_folder(out, trial):
    """Where a sweep of a study with `keep: drives` has a trial's files."""
    return pathlib.Path(out) / "drives" / f"{int(trial['trial']):06}"


def thin(folder, kept):
    """Leaves the files named `kept` of a drive's folder; without any, nothing."""
    if not folder.is_dir():
        return
    if not kept:
        shutil.rmtree(folder)
        return
    for path in folder.iterdir():
        if path.is_dir():
            shutil.rmtree(path)
        elif path.name not in kept:
            path.unlink()


def swept_thinly(program, study, out, count, kept, *arguments):
    """As swept(), of a study of `count` trials with `keep: drives`, of which only the files `kept(trial)` stay."""
    found = []
    while len(found) < count:
        found = swept(program, study, out, "--limit", str(CHUNK), *arguments)
        for trial in found:
            thin(drive_folder(out, trial), kept(trial))
    return found


def arrives(trial):
    return trial["outcome"] == "goal"


def setting(values):
    """`values` as the map that stands behind `set:` in a study."""
    return "{" + ", ".join(f"{key}: {value}" for key, value in values.items()) + "}"


def quantile(values, share):
    """The value below which that share of `values` is, between two of them in proportion: median, least and greatest are
    those of .5, 0 and 1."""
    rising = sorted(values)
    at = share * (len(rising) - 1)
    low = rising[int(at)]
    return low + (at - int(at)) * (rising[min(int(at) + 1, len(rising) - 1)] - low)


def interval(k, n):
    """Exact 95 % interval of a share (Clopper and Pearson), by bisection on the binomial sum, whose terms are too
    large for numbers before they are multiplied."""
    def tail(p, at_least):
        return sum(math.exp(math.lgamma(n + 1) - math.lgamma(i + 1) - math.lgamma(n - i + 1)
                            + i * math.log(p) + (n - i) * math.log1p(-p))
                   for i in (range(k, n + 1) if at_least else range(k + 1)))

    def solve(at_least):
        lo, hi = 0.0, 1.0
        for _ in range(50):  # before p rounds to 1
            p = (lo + hi) / 2
            if (tail(p, at_least) < 0.025) == at_least:
                lo = p
            else:
                hi = p
        return lo
    return (solve(True) if k else 0.0), (solve(False) if k < n else 1.0)


def mcnemar(b, c):
    """Two-sided exact p of b and c discordant pairs."""
    n = b + c
    return min(1.0, 2 * sum(math.comb(n, i) for i in range(min(b, c) + 1)) / 2**n)


def row(cells):
    return "| " + " | ".join(map(str, cells)) + " |\n"


def head(cells):
    return row(cells) + "|---" * len(cells) + "|\n"


def table(columns, rows):
    return head(columns) + "".join(map(row, rows))
