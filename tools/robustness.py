#!/usr/bin/env python3
"""Drives the paper's environments over barrier floors, starts and execution horizons and writes the
table docs/robustness.md. Standard library only.

    tools/robustness.py --program build/slalom [--out docs/robustness.md] [--jobs 2]

The comments on where ours differ from the paper's stand in tools/robustness_notes.md and are put
beneath the tables as they are; look at them again when the numbers change.
"""

import argparse
import concurrent.futures
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]

FLOORS = (0.1, 0.2, 0.3, 0.5, 0.7, 0.75, 0.78, 0.8, 0.85, 0.9, 0.95, 1.0, 1.05, 1.1, 1.2, 1.5, 2.0)
STARTS = (-0.1, 0.0, 0.1)  # added to the start's x [m]
TEXES = (0.5, 0.25)  # [s]
X = {"E_A": 200, "E_A-figure": 200, "E_B": 200, "E_C": 6}  # the start's x [m]

# What the paper's drives do, and where the positions and times of section 5 leave room.
PAPER = {
    ("E_A", "P_A"): ("goal", None, 8, 9.5), ("E_A", "P_B"): ("goal", None, 5.5, 7),
    ("E_A", "P_C"): ("goal", None, 5.5, 7), ("E_A-figure", "P_A"): ("goal", None, 8, 9.5),
    ("E_A-figure", "P_B"): ("goal", None, 5.5, 7), ("E_A-figure", "P_C"): ("goal", None, 5.5, 7),
    ("E_B", "P_C"): ("crash", "O1", 2.7, 3.2), ("E_B", "P_D"): ("goal", None, 5.5, 7),
    ("E_C", "P_C"): ("crash", "O2", 18.9, 19.9), ("E_C", "P_D"): ("goal", None, 27, 29),
}


def drive(program, environment, planner, floor, shift, tex):
    done = subprocess.run(
        [program, "simulate", environment, "--planner", planner, "--json", "--tex", str(tex),
         "--set", f"planner.floor={floor}", "--set", f"start.x={X[environment] + shift}"],
        capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{environment} {planner} floor {floor} x {shift:+} tex {tex}: {done.stderr}")
    return json.loads(done.stdout)


def cases():
    for environment, planner in reversed(PAPER):  # the longest drives first
        for floor in FLOORS:
            for tex in TEXES:
                for shift in STARTS:
                    yield environment, planner, floor, shift, tex


def as_paper(key, s):
    outcome, hit, earliest, latest = PAPER[key]
    return s["outcome"] == outcome and s["hit"] == hit and earliest <= s["time_s"] <= latest


def cell(key, s):
    """Outcome, time [s], least clearance [m]; * where not as the paper's."""
    end = s["outcome"] if not s["hit"] else f"{s['outcome']} {s['hit']}"
    text = f"{end} {s['time_s']:.2f}"
    if s["outcome"] != "crash":
        text += f", {s['least_clearance_m']:.2f}"
    return text + ("" if as_paper(key, s) else " \\*")


def table(key, results):
    environment, planner = key
    columns = [(tex, shift) for tex in TEXES for shift in STARTS]
    lines = [f"## {environment}, {planner}", ""]
    lines.append("| floor | " + " | ".join(f"tex {tex:g}, x {shift:+g}" if shift else f"tex {tex:g}"
                                           for tex, shift in columns) + " |")
    lines.append("|---|" + "---|" * len(columns))
    for floor in FLOORS:
        cells = [cell(key, results[(*key, floor, shift, tex)]) for tex, shift in columns]
        lines.append(f"| {floor:g} | " + " | ".join(cells) + " |")
    return lines + [""]


def page(results, notes):
    lines = [
        "# Robustness of the outcomes", "",
        "Every drive of the paper's figures over barrier floors, starts moved in x [m] and two",
        "execution horizons [s]; all else is by default. Written by `make robustness`",
        "(`tools/robustness.py`); what is said on it at the end is by hand",
        "(`tools/robustness_notes.md`).", "",
        "A cell has the outcome, the time at which the drive ended [s] and the least clearance to an",
        "obstacle grown by 2 m [m] (none for a crash, where it is 0). \\* marks a drive that does not",
        "end as the paper's: another outcome, another obstacle, or a time outside", "",
        "| drive | as the paper's |", "|---|---|"]
    for (environment, planner), (outcome, hit, earliest, latest) in PAPER.items():
        lines.append(f"| {environment}, {planner} | {outcome}{' ' + hit if hit else ''}, "
                     f"{earliest:g}–{latest:g} s |")
    lines.append("")
    starred = sum(not as_paper(case[:2], s) for case, s in results.items())
    near = [(case, s) for case, s in results.items() if 0.78 <= case[2] <= 1.05]
    near_starred = sum(not as_paper(case[:2], s) for case, s in near)
    lines += [f"Of {len(results)} drives, {len(results) - starred} end as the paper's; of the "
              f"{len(near)} with a floor from 0.78 to 1.05, {len(near) - near_starred} do.", ""]
    for key in PAPER:
        lines += table(key, results)
    return "\n".join(lines) + "\n" + notes


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", default=str(ROOT / "build/slalom"))
    parser.add_argument("--out", default=str(ROOT / "docs/robustness.md"))
    parser.add_argument("--jobs", type=int, default=2, help="drives at a time")
    parser.add_argument("--cache", help="JSON file of results to take up and add to")
    args = parser.parse_args()

    results = {}
    cache = pathlib.Path(args.cache) if args.cache else None
    if cache and cache.exists():
        results = {tuple(case): s for case, s in json.loads(cache.read_text())}
    todo = [case for case in cases() if case not in results]
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        futures = {pool.submit(drive, args.program, *case): case for case in todo}
        for count, future in enumerate(concurrent.futures.as_completed(futures), 1):
            results[futures[future]] = future.result()
            if sys.stderr.isatty():
                print(f"\r{count}/{len(todo)}", end="", file=sys.stderr)
            if cache:
                cache.write_text(json.dumps([[list(k), v] for k, v in results.items()]))
    notes = ROOT / "tools/robustness_notes.md"
    text = page(results, notes.read_text() if notes.exists() else "")
    out = pathlib.Path(args.out)
    aside = out.with_suffix(".part")
    aside.write_text(text)
    aside.rename(out)


if __name__ == "__main__":
    main()
