"""Runs the program and reads the drives it leaves. Standard library only.

The program is $SLALOM_BIN or $SLALOM; drives are kept in $SLALOM_TEST_DIR or a temporary folder.
"""

import bisect
import concurrent.futures
import csv
import json
import math
import os
import pathlib
import re
import subprocess
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("SLALOM_BIN") or os.environ.get("SLALOM") or str(SOURCE / "build/slalom")

STATES = ("x", "y", "v", "r", "psi", "sa", "ux", "ax")
CONTROLS = ("sr", "jx")
WHEELS = ("Fz_rl", "Fz_rr", "Fz_fl", "Fz_fr")


def scratch():
    """A folder for this run, removed at its end."""
    parent = os.environ.get("SLALOM_TEST_DIR")
    return tempfile.TemporaryDirectory(prefix="acceptance-", dir=parent)


def run(*arguments, cwd=None):
    """Runs the program; raises with what it printed unless it exits with 0."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, cwd=cwd)
    if done.returncode != 0:
        raise AssertionError(
            f"slalom {' '.join(map(str, arguments))}: exit {done.returncode}\n{done.stderr}")
    return done.stdout


class Drive:
    """What a drive left in its folder."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.summary = json.loads((self.folder / "summary.json").read_text())
        with open(self.folder / "plant.csv", newline="") as file:
            self.plant = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
        self.t = [row["t"] for row in self.plant]
        self.resolved = (self.folder / "resolved.yaml").read_text()

    @property
    def outcome(self):
        return self.summary["outcome"]

    @property
    def time(self):
        return self.summary["time_s"]

    @property
    def end(self):
        return self.plant[-1]

    def ended(self):
        """One line for messages."""
        s = self.summary
        return f"{s['scenario']} {s['planner']}: {s['outcome']} {s['hit'] or ''} {s['time_s']:.3f} s"

    def at(self, t, column):
        """A column at time t, linear between samples."""
        k = min(max(bisect.bisect_right(self.t, t), 1), len(self.t) - 1)
        share = (t - self.t[k - 1]) / (self.t[k] - self.t[k - 1])
        a, b = self.plant[k - 1][column], self.plant[k][column]
        return a + share * (b - a)


def simulate(folder, scenario, *options):
    run("simulate", scenario, "--out", folder, "--quiet", *options)
    return Drive(folder)


def simulate_all(parent, jobs):
    """Drives {name: (scenario, *options)}, as many at a time as there are processors up to two."""
    workers = min(2, os.cpu_count() or 1)
    with concurrent.futures.ThreadPoolExecutor(workers) as pool:
        futures = {name: pool.submit(simulate, pathlib.Path(parent) / name.replace(" ", "_"), *job)
                   for name, job in jobs.items()}
        return {name: future.result() for name, future in futures.items()}


def obstacles(resolved):
    """The obstacles of a resolved.yaml as dictionaries of numbers, with their names."""
    found = []
    for line in resolved.splitlines():
        if line.startswith("  - {"):
            entry = dict(re.findall(r"(\w+): (\"[^\"]*\"|[^,}]+)", line))
            found.append({k: v.strip('"') if k == "name" else float(v) for k, v in entry.items()})
    return found


def rewrite(resolved, change):
    """A resolved.yaml with every position, direction and velocity put through `change`, a function
    from (section, {key: number}) to {key: number}."""
    lines = []
    for line in resolved.splitlines():
        section = "obstacle" if line.startswith("  - {") else line.split(":")[0]
        if section in ("start", "goal", "region", "obstacle") and "{" in line:
            name = re.search(r"name: \"[^\"]*\"", line)
            numbers = {k: float(v) for k, v in re.findall(r"(\w+): ([-+.\d][-+.\deE]*)", line)}
            items = [f"{k}: {v!r}" for k, v in change(section, numbers).items()]
            if name:
                items.insert(0, name.group(0))
            line = line.split("{")[0] + "{" + ", ".join(items) + "}"
        lines.append(line)
    return "\n".join(lines) + "\n"


def moved(east, north):
    """A change for rewrite(): everything moved."""
    by = {"x": east, "y": north, "x_min": east, "x_max": east, "y_min": north, "y_max": north}
    return lambda section, numbers: {k: v + by.get(k, 0) for k, v in numbers.items()}


def mirrored(section, numbers):
    """A change for rewrite(): left for right, by y -> -y. The bounds of psi, +-2 pi, are their own
    mirror image about the x axis."""
    result = {}
    for key, value in numbers.items():
        if key in ("y", "v", "r", "psi", "sa", "vy"):
            result[key] = -value
        elif key in ("y_min", "y_max"):
            result["y_max" if key == "y_min" else "y_min"] = -value
        else:
            result[key] = value
    return result


def mirrored_about(x0):
    """A change for rewrite(): left for right, by x -> 2 x0 - x. This sends psi to pi - psi and so the
    bounds of psi, +-2 pi, to others: at a barrier floor they count, however far off."""
    def change(section, numbers):
        result = {}
        for key, value in numbers.items():
            if key in ("v", "r", "sa", "vx"):
                result[key] = -value
            elif key == "x":
                result[key] = 2 * x0 - value
            elif key == "psi":
                result[key] = math.pi - value
            elif key in ("x_min", "x_max"):
                result["x_max" if key == "x_min" else "x_min"] = 2 * x0 - value
            else:
                result[key] = value
        return result
    return change
