#!/usr/bin/env python3
"""Drives the paper's environments over barrier floors, starts and execution horizons, into
docs/measured/robustness.csv, a figure of it and docs/measured/robustness.md. Standard library only.

    tools/robustness.py [--program build/slalom] [--jobs 2]
"""

import collections
import csv
import io
import json
import textwrap

from measured import page_parser, stamp, write
from sweeps import swept

FLOORS = (0.1, 0.2, 0.3, 0.5, 0.7, 0.75, 0.78, 0.8, 0.85, 0.9, 0.95, 1.0, 1.05, 1.1, 1.2, 1.5, 2.0)
DEFAULT = 0.9
TEXES = (0.5, 0.25)  # [s]
SHIFTS = (-0.1, 0.0, 0.1)  # of the start [m]
X = {"E_A": 200, "E_A-figure": 200, "E_B": 200, "E_C": 6}  # of the start [m]
# How the paper's drives end: outcome and obstacle.
PAPER = {
    ("E_A", "P_A"): "goal", ("E_A", "P_B"): "goal", ("E_A", "P_C"): "goal",
    ("E_A-figure", "P_A"): "goal", ("E_A-figure", "P_B"): "goal", ("E_A-figure", "P_C"): "goal",
    ("E_B", "P_C"): "crash O1", ("E_B", "P_D"): "goal",
    ("E_C", "P_C"): "crash O2", ("E_C", "P_D"): "goal",
}  # fmt: skip
COLUMNS = ("scenario", "planner", "planner.floor", "loop.tex", "start.x", "outcome", "hit", "time_s",
           "least_clearance_m")  # fmt: skip


# --- the drives ---------------------------------------------------------------------------------


def study(environment):
    axes = [{"key": "planner.floor", "values": list(FLOORS)}, {"key": "loop.tex", "values": list(TEXES)},
            {"key": "start.x", "values": [X[environment] + shift for shift in SHIFTS]}]
    return json.dumps({"title": f"robustness in {environment}", "scenario": environment,
                       "planners": [p for e, p in PAPER if e == environment], "axes": axes})  # JSON is YAML


def sweep(options, environment):
    options.work.mkdir(parents=True, exist_ok=True)
    file = options.work / f"{environment}.yaml"
    file.write_text(study(environment))
    return swept(options.program, file, options.work / environment, "--jobs", str(options.jobs))


class Drive:
    def __init__(self, trial):
        self.trial = trial
        self.key = trial["scenario"], trial["planner"]
        self.floor, self.tex = float(trial["planner.floor"]), float(trial["loop.tex"])
        self.shift = round(float(trial["start.x"]) - X[trial["scenario"]], 9)
        self.end = f"{trial['outcome']} {trial['hit']}".strip()
        self.as_paper = self.end == PAPER[self.key]


def table(drives):
    """A row a drive; the last column says whether it ends as the paper's."""
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow([*COLUMNS, "as_paper"])
    for drive in drives:
        writer.writerow([*(drive.trial[c] for c in COLUMNS), int(drive.as_paper)])
    return file.getvalue()


# --- the figure ---------------------------------------------------------------------------------

CELL, HALF_GAP, GAP, LEFT, TOP = (11, 20), 3, 8, 44, 66  # sizes [px]
KINDS = {"as the paper's": "#d9e2ec", "arrives": "#3b7dd8", "crashes": "#d95f02", "has no plan": "#1b1b1b",
         "ends otherwise": "#8c6bb1"}


def kind(drive):
    if drive.as_paper:
        return "as the paper's"
    return {"goal": "arrives", "crash": "crashes", "not_optimal": "has no plan"}.get(
        drive.trial["outcome"], "ends otherwise")


def text_at(x, y, words, anchor="middle", size=12, weight="normal"):
    return (f'<text x="{x:g}" y="{y:g}" text-anchor="{anchor}" font-size="{size}" '
            f'font-weight="{weight}">{words}</text>')


def legend(x, y, kinds):
    parts = []
    for words in kinds:
        parts.append(f'<rect x="{x}" y="{y - 11}" width="13" height="13" fill="{KINDS[words]}" stroke="#666"/>')
        parts.append(text_at(x + 18, y, words, "start"))
        x += 34 + 7 * len(words)
    return parts


def figure(drives):
    """A heat map: floors down; across, a block of columns a drive: horizons, and in each the starts."""
    width, height = CELL
    half = len(SHIFTS) * width + HALF_GAP
    across = len(TEXES) * half - HALF_GAP
    block = across + GAP
    bottom = TOP + len(FLOORS) * height
    size = LEFT + len(PAPER) * block + 8, bottom + 82
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {size[0]} {size[1]}" width="{size[0]}" '
             f'height="{size[1]}" font-family="Helvetica, Arial, sans-serif">',
             f'<rect width="{size[0]}" height="{size[1]}" fill="#fff"/>']  # fmt: skip
    for row, floor in enumerate(FLOORS):
        bold = "bold" if floor == DEFAULT else "normal"
        parts.append(text_at(LEFT - 6, TOP + (row + 0.7) * height, f"{floor:g}", "end", weight=bold))
    parts.append(text_at(LEFT - 6, TOP - 5, "floor", "end"))
    parts.append(text_at(LEFT - 6, TOP - 20, "paper:", "end", size=11))
    for number, (environment, planner) in enumerate(PAPER):
        x = LEFT + number * block
        middle = x + across / 2
        parts.append(text_at(middle, TOP - 48, environment, size=11, weight="bold"))
        parts.append(text_at(middle, TOP - 34, planner, size=12, weight="bold"))
        parts.append(text_at(middle, TOP - 20, PAPER[environment, planner], size=11))
        for k, tex in enumerate(TEXES):
            parts.append(text_at(x + k * half + (half - HALF_GAP) / 2, bottom + 16, f"{tex:g}", size=11))
    cells = {}
    for drive in drives:
        x = (LEFT + list(PAPER).index(drive.key) * block + TEXES.index(drive.tex) * half
             + SHIFTS.index(drive.shift) * width)
        y = TOP + FLOORS.index(drive.floor) * height
        cells.setdefault(kind(drive), []).append(f"M{x} {y}h{width}v{height}h-{width}z")
    kinds = [name for name in KINDS if name in cells]
    parts += [f'<path fill="{KINDS[name]}" stroke="#fff" d="{"".join(cells[name])}"/>' for name in kinds]
    shifts = ", ".join(f"{shift:+g}" if shift else "0" for shift in SHIFTS)
    parts.append(text_at(LEFT, bottom + 36, f"tex [s]; in each, the start at x {shifts} m", "start"))
    return "\n".join([*parts, *legend(LEFT, bottom + 64, kinds), "</svg>"]) + "\n"


# --- the page -----------------------------------------------------------------------------------


def of(drives):
    return f"{sum(d.as_paper for d in drives)} of {len(drives)}"


def band(drives, tex):
    """The widest range of floors about the default in which all end as the paper's, in words."""
    good = [all(d.as_paper for d in drives if d.floor == floor and d.tex == tex) for floor in FLOORS]
    first = last = FLOORS.index(DEFAULT)
    if not good[first]:
        return f"at tex {tex:g} s not even at {DEFAULT:g}"
    while first > 0 and good[first - 1]:
        first -= 1
    while last + 1 < len(FLOORS) and good[last + 1]:
        last += 1
    return f"at tex {tex:g} s from {FLOORS[first]:g} to {FLOORS[last]:g}"


def others(drives):
    """How the drives end that do not end as the paper's, the most frequent first."""
    def end(drive):
        return "crash into a cone" if drive.trial["hit"].startswith("cone") else drive.end.replace("_", " ")
    counts = collections.Counter((*d.key, end(d)) for d in drives if not d.as_paper)
    return "; ".join(f"{planner} in {environment}: {words}, {count}"
                     for (environment, planner, words), count in counts.most_common())


def page(drives, stamped):
    default = [d for d in drives if d.floor == DEFAULT]
    bands = " and ".join(band(drives, tex) for tex in TEXES)
    text = f"""Every drive of the paper's figures at {len(FLOORS)} barrier floors, {len(TEXES)} execution horizons and
{len(SHIFTS)} starts; all else is by default. A drive counts as the paper's if outcome and obstacle are the
same; times and positions are not compared here. {of(drives)} drives end as the paper's, {of(default)}
at the default floor of {DEFAULT:g}. About that floor, every drive does so {bands}.
Those that end otherwise, with their number: {others(drives) or "none"}. Each drive, with its time and
its least clearance to an obstacle grown by the crash margin: [robustness.csv](robustness.csv)."""
    return "\n".join(["# Robustness of the outcomes", "", stamped, *textwrap.wrap(text, 110), "",
                      "![Outcomes over floors, horizons and starts](robustness.svg)", ""])  # fmt: skip


def main():
    parser = page_parser("robustness", __doc__)
    parser.add_argument("--jobs", type=int, default=2, help="worker processes")
    options = parser.parse_args()
    drives = [Drive(trial) for environment in X for trial in sweep(options, environment)]
    write(options.out.with_suffix(".csv"), table(drives))
    write(options.out.with_suffix(".svg"), figure(drives))
    write(options.out, page(drives, stamp("make robustness", options.program)))


if __name__ == "__main__":
    main()
