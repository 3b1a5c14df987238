#!/usr/bin/env python3
"""Judges each claim of the paper by our drives and sweeps, into docs/verdicts.md. Standard library only.

    tools/verdicts.py [--program build/slalom] [--sweep run/study] [--printed run/printed] [--repeats 9]

The drives are made anew, --repeats times for their solve times; the sweeps are the folders of
`slalom sweep paper` and `slalom sweep paper-printed`.
"""

import argparse
import pathlib
import platform
import tempfile

import verdict_drives
import verdict_sweep
from verdict_data import ROOT, Sweep, reproductions, simulate

SPEEDS = [40 * k / 19 for k in range(20)]  # of O2 [m/s], the grid of the sweep
HEAD = ["claim", "paper", "ours", "verdict"]


def seen_ahead(program, scenario):
    """How P_D ends in a scenario by the speed of O2."""
    return {speed: simulate(program, scenario, "--planner", "P_D", "--set",
                            f"obstacles.O2.vy={-speed:.12g}")["outcome"] for speed in SPEEDS}


def besides(program, folder):
    """Drives that only the verdicts need."""
    crossing = ("one-crossing", "--planner")
    return {
        "range": {50: seen_ahead(program, "E_C-range-50"), 90: seen_ahead(program, "E_C")},
        "case E": {tex: simulate(program, *crossing, "P_C", "--tex", str(tex))["outcome"]
                   for tex in (0.5, 0.25, 0.1, 0.05)},
        "kinematic F": simulate(program, *crossing, "P_D", "--set", "planner.model=kinematic")["outcome"],
        "ipopt": reproductions(program, folder / "ipopt", 3, "--set", "planner.solver=ipopt"),
    }


def table(claims):
    lines = ["| " + " | ".join(HEAD) + " |", "|---" * len(HEAD) + "|"]
    for claim, paper, ours, verdict in claims:
        cells = [claim, paper, ours, f"**{verdict}**"]
        lines.append("| " + " | ".join(c.replace("|", "\\|") for c in cells) + " |")
    return lines


def count(claims):
    names = ("holds", "holds in part", "does not hold")
    return ", ".join(f"{sum(c[3] == n for c in claims)} {n.replace('holds', 'hold', 1) if n != 'does not hold' else 'do not hold'}"
                     for n in names)


def cpu_model():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.processor() or "unknown"


def page(drives, sweep, printed, repeats):
    return "\n".join([
        "<!-- Written by tools/verdicts.py (`make verdicts`). -->",
        "# The paper's claims", "",
        f"Each claim of the paper, its figures, ours, and what they say of it: {count(drives + sweep)}.",
        "Every number of ours is computed from the files that the program left; a verdict is a rule on these numbers",
        "(`tools/verdict_drives.py`, `tools/verdict_sweep.py`), not an opinion. Where intervals stand in brackets they",
        "are of 95 %: of medians (also of ratios cycle by cycle) from order statistics, of ratios of two medians by",
        f"bootstrap over the cycles. Solve times are CPU time, of each cycle the median over {repeats} runs; the first cycle,",
        f"which the warm-up solves, is left out. Solve time counts as added where it grows beyond × {verdict_drives.DEARER:g}.",
        f"Machine: {cpu_model()}.", "",
        "## From the drives", "",
        "By `slalom reproduce`, default settings ([results.md](results.md)).", "", *table(drives), "",
        "## From the sweep", "",
        "By `slalom sweep paper`: E_C, 20 tex from .01 to 1 s, O2 at 20 speeds up to 40 m/s, the grid that the paper's",
        "figures fit ([formulation.md](formulation.md), section 5).", "", *table(sweep), "",
        "## From the sweep as the paper's text prints it", "",
        "By `slalom sweep paper-printed`: the same with O2 at up to 20 m/s.", "", *table(printed), "",
        "## Not judged", "",
        "- That MATLAB was far from real time: [long-solves.md](long-solves.md) sets the paper's times beside ours.",
        "- KNITRO's own solve times: it is not here.", ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", default=str(ROOT / "build/slalom"))
    parser.add_argument("--sweep", default=str(ROOT / "run/study"))
    parser.add_argument("--printed", default=str(ROOT / "run/printed"))
    parser.add_argument("--repeats", type=int, default=9)
    parser.add_argument("--out", default=str(ROOT / "docs/verdicts.md"))
    args = parser.parse_args()
    for folder, study in ((args.sweep, "paper"), (args.printed, "paper-printed")):
        if not (pathlib.Path(folder) / "trials.csv").is_file():
            parser.error(f"{folder} has no trials.csv: make it by `slalom sweep {study} --out {folder}`")
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        drives = reproductions(args.program, folder / "own", args.repeats)
        sweep = Sweep(args.sweep)
        claims = verdict_drives.all_of(drives, besides(args.program, folder), sweep)
    text = page(claims, verdict_sweep.all_of(sweep),
                verdict_sweep.all_of(Sweep(args.printed)), args.repeats)
    pathlib.Path(args.out).write_text(text)


if __name__ == "__main__":
    main()
