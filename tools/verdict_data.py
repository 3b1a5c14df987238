"""What tools/verdicts.py measures and reads: drives, their solve times, and sweeps. Standard library only."""

import csv
import json
import math
import pathlib
import random
import re
import statistics
import subprocess

from sweeps import trials

ROOT = pathlib.Path(__file__).resolve().parents[1]


class Drive:
    """One drive of several runs: how it ended, and each cycle's CPU time, the median over the runs."""

    def __init__(self, folders):
        self.summary = json.loads((folders[0] / "summary.json").read_text())
        with open(folders[0] / "plant.csv", newline="") as file:
            self.rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
        runs = []
        for folder in folders:
            with open(folder / "cycles.csv", newline="") as file:
                cycles = list(csv.DictReader(file))
            runs.append([float(c["cpu_time_s"]) for c in cycles])
            self.t0 = [float(c["t0"]) for c in cycles]
            self.iterations = [int(c["iterations"]) for c in cycles]
        self.solves = [statistics.median(run[i] for run in runs) for i in range(len(runs[0]))]
        # The first plan is the warm-up's, confirmed: its time says nothing of a cycle's.
        self.later = self.solves[1:]

    @property
    def outcome(self):
        return self.summary["outcome"]

    @property
    def arrived(self):
        return self.outcome == "goal"

    @property
    def time(self):
        return self.summary["time_s"]

    def ended(self):
        s = self.summary
        words = {"goal": "arrives", "crash": f"crashes into {s['hit']}", "not_optimal": "has no plan",
                 "wheel_lift": "lifts a wheel"}.get(s["outcome"], s["outcome"])
        return f"{words} at {s['time_s']:.2f} s"

    def at(self, t, column):
        return next((row[column] for row in self.rows if row["t"] >= t - 1e-9), self.rows[-1][column])

    def effort(self):
        """.1 times the integrals of sa², sr² and jx², as in the paper's table."""
        return 0.1 * sum((b["t"] - a["t"]) * (a[c] ** 2 + a[c] * b[c] + b[c] ** 2) / 3
                         for a, b in zip(self.rows, self.rows[1:]) for c in ("sa", "sr", "jx"))


def reproductions(program, folder, repeats, *overrides):
    """The drives of `slalom reproduce`, run `repeats` times: {"E_A/P_A": Drive, ...}."""
    runs = []
    for k in range(repeats):
        out = folder / str(k)
        subprocess.run([program, "reproduce", "--out", out, "--quiet", *overrides], check=True)
        runs.append(out)
    names = sorted(str(p.parent.relative_to(runs[0])) for p in runs[0].glob("*/*/summary.json"))
    return {name: Drive([run / name for run in runs]) for name in names}


def simulate(program, scenario, *arguments):
    """The summary of one drive."""
    done = subprocess.run([program, "simulate", scenario, "--json", *arguments], check=True,
                          capture_output=True, text=True)
    return json.loads(done.stdout)


# --- statistics ------------------------------------------------------------------------------------


def median_interval(values, confidence=0.95):
    """Median and an interval for it from the order statistics (binomial, distribution-free)."""
    values = sorted(values)
    n = len(values)
    if n == 0:
        return math.nan, math.nan, math.nan
    k, tail = 0, 0.5 ** n
    while k < n // 2 and tail < (1 - confidence) / 2:
        k += 1
        tail += math.comb(n, k) * 0.5 ** n
    k = max(k - 1, 0)
    return statistics.median(values), values[k], values[n - 1 - k]


def ratio_interval(before, after, seed=1, draws=2000):
    """Ratio of the medians of two sets of solve times, after over before, with a 95 % bootstrap interval."""
    rng = random.Random(seed)
    ratios = sorted(statistics.median(rng.choices(after, k=len(after))) /
                    statistics.median(rng.choices(before, k=len(before))) for _ in range(draws))
    ratio = statistics.median(after) / statistics.median(before)
    return ratio, ratios[int(0.025 * draws)], ratios[int(0.975 * draws)]


def paired(before, after):
    """Each cycle's ratio of solve times, after over before, while both drive: median and interval."""
    return median_interval([b / a for a, b in zip(before, after)])


# --- sweeps ----------------------------------------------------------------------------------------


class Sweep:
    """The trials of a sweep over tex and the speed of O2."""

    def __init__(self, folder):
        self.trials = [{
            "planner": row["planner"], "tex": float(row["loop.tex"]),
            "speed": abs(float(row["obstacles.O2.vy"])), "passed": row["outcome"] == "goal",
            "outcome": row["outcome"], "hit": row["hit"],
            "max": float(row["max_cpu_time_s"] or "nan"),
            "max_wall": float(row["max_solve_time_s"] or "nan"),
            "median": float(row["median_cpu_time_s"] or "nan"),
        } for row in trials(folder)]
        self.texs = sorted({t["tex"] for t in self.trials})
        self.speeds = sorted({t["speed"] for t in self.trials})

    def of(self, planner, tex=(0, math.inf), speed=(-math.inf, math.inf)):
        """Trials with tex and speed in (low, high], the least values included."""
        return [t for t in self.trials if t["planner"] == planner and tex[0] < t["tex"] <= tex[1]
                and speed[0] < t["speed"] <= speed[1]]

    def nearest_tex(self, tex):
        return min(self.texs, key=lambda t: abs(t - tex))

    def pairs(self):
        """(P_C's, P_D's) of each tex and speed."""
        other = {(t["tex"], t["speed"]): t for t in self.trials if t["planner"] == "P_D"}
        return [(t, other[t["tex"], t["speed"]]) for t in self.trials if t["planner"] == "P_C"
                and (t["tex"], t["speed"]) in other]

    def rtf(self, planner, tex, most=math.inf, measure="max"):
        """The paper's real-time factor and probability of safety at one tex, speeds up to `most`; by
        CPU time, or by wall clock ("max_wall")."""
        own = [t for t in self.trials if t["planner"] == planner and t["tex"] == tex and t["speed"] <= most]
        longest = [t[measure] for t in own if math.isfinite(t[measure])]
        return statistics.mean(longest) / tex, share(own)


def passes(own):
    return sum(t["passed"] for t in own)


def share(own):
    return passes(own) / len(own) if own else math.nan


def of(own):
    """"k of n"."""
    return f"{passes(own)} of {len(own)}"


def paper_points():
    """The paper's real-time factors and probabilities, from config/paper/sweep.yaml."""
    text = (ROOT / "config/paper/sweep.yaml").read_text()
    return [{k: float(v) for k, v in re.findall(r"(tex|speed|rtf|pos): ([\d.]+)", line)}
            for line in re.findall(r"- \{planner: P_D, tex.*\}", text)]


def paper_counts():
    text = (ROOT / "config/paper/sweep.yaml").read_text()
    return {p: (int(k), int(n)) for p, k, n in
            re.findall(r"planner: (P_\w), passed: (\d+), trials: (\d+)", text)}
