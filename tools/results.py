#!/usr/bin/env python3
"""Drives all drives of the paper's figures and writes docs/results.md and docs/figures/ from them.
Standard library only.

    tools/results.py [--program build/slalom] [--drives FOLDER]

--drives takes the folder of a finished `slalom reproduce` instead of driving again.
"""

import argparse
import bisect
import csv
import json
import math
import pathlib
import re
import shutil
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
DRIVES = (("E_A", "P_A"), ("E_A", "P_B"), ("E_A", "P_C"), ("E_A-figure", "P_A"),
          ("E_A-figure", "P_B"), ("E_A-figure", "P_C"), ("E_B", "P_C"), ("E_B", "P_D"),
          ("E_C", "P_C"), ("E_C", "P_D"))
VARIANTS = (("E_C-range-50", "P_C"), ("E_C-range-50", "P_D"), ("E_C-no-cones", "P_C"),
            ("E_C-no-cones", "P_D"))
# Pictures kept: the file in the reproduction's folder, its name in docs/figures, what it shows.
FIGURES = (
    ("figures/E_A-figure.svg", "E_A-figure.svg", "E_A-figure: P_A, P_B, P_C; rings are the paper's vehicles"),
    ("figures/E_B.svg", "E_B.svg", "E_B: P_C to the left and into O1, P_D to the right and behind it"),
    ("figures/E_C.svg", "E_C.svg", "E_C: P_C into O2, P_D out of its way"),
    ("figures/E_C_crash.svg", "E_C_crash.svg", "E_C at 19.5 s: P_C's plan takes O2 to stand where it was (dashed)"),
    ("figures/E_C_dynamics.svg", "E_C_dynamics.svg", "E_C: lateral speed, yaw rate, controls, least wheel load"),
    ("figures/E_C-range-50_crash.svg", "E_C-range-50_crash.svg", "E_C seen 50 m ahead: both crash into O2"),
    ("figures/E_C-no-cones_path.svg", "E_C-no-cones_path.svg", "E_C without cones: the lane is changed at once"),
    ("figures/cases.svg", "cases.svg", "The cases of the paper's conceptual figure, driven; vehicles every 2 s"),
    ("E_C/P_D/figures/path.svg", "E_C-P_D.svg", "E_C with P_D"),
)
TERMS = (("steering angle", "sa", "steering_angle", 0.1), ("steering rate", "sr", "steering_rate", 1),
         ("longitudinal jerk", "jx", "jerk", 0.01))


CASES = "ABCDEF"


class Drive:
    def __init__(self, folder):
        self.summary = json.loads((folder / "summary.json").read_text())
        with open(folder / "plant.csv", newline="") as file:
            self.rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
        self.t = [row["t"] for row in self.rows]

    def at(self, t, column):
        k = min(max(bisect.bisect_right(self.t, t), 1), len(self.t) - 1)
        share = (t - self.t[k - 1]) / (self.t[k] - self.t[k - 1])
        a, b = self.rows[k - 1][column], self.rows[k][column]
        return a + share * (b - a)

    def square(self, column):
        """Integral of the column's square, exact where it is linear between samples."""
        return sum((b["t"] - a["t"]) * (a[column] ** 2 + a[column] * b[column] + b[column] ** 2) / 3
                   for a, b in zip(self.rows, self.rows[1:]))


def read(folder):
    """All drives of a reproduction's folder, by environment and planner."""
    drives = {key: Drive(folder / key[0] / key[1]) for key in DRIVES + VARIANTS}
    return drives | {("cases", c): Drive(folder / "cases" / c) for c in CASES}


def paper_drives():
    """What config/paper/drives.yaml keeps, read line by line."""
    found, key = {}, {}
    for line in (ROOT / "config/paper/drives.yaml").read_text().splitlines():
        pair = re.match(r"  [- ] (environment|planner|outcome|time|hit): *(\S+)", line)
        if pair:
            if pair.group(1) == "environment":
                key = {"snapshots": []}
            key[pair.group(1)] = pair.group(2)
            if "environment" in key and "planner" in key:
                found[key["environment"], key["planner"]] = key
        snapshot = re.match(r"      - \{(.*)\}", line)
        if snapshot:
            key["snapshots"].append(dict(re.findall(r"(\w+): ([^,]+)", snapshot.group(1))))
    return found


def paper_effort():
    text = (ROOT / "config/paper/results.yaml").read_text()
    return {planner: {k: float(v) for k, v in re.findall(
        r"(\w+): ([\d.e-]+)", re.search(rf"effort_{planner}: \{{(.*)\}}", text).group(1))}
        for planner in ("P_B", "P_C")}


def drives_table(drives, paper):
    lines = ["| drive | outcome | time [s] | goal entered [s] | end (x, y) [m] | ux at end [m/s] | "
             "least clearance [m] | paper: outcome, time [s] |", "|---|---|---|---|---|---|---|---|"]
    for key in DRIVES:
        drive, printed = drives[key], paper[key]
        s, end = drive.summary, drive.rows[-1]
        entered = "–" if s["goal_time_s"] is None else f"{s['goal_time_s']:.3f}"
        clearance = "0" if s["outcome"] == "crash" else f"{s['least_clearance_m']:.3f}"
        lines.append(
            f"| {key[0]}, {key[1]} | {s['outcome']}{' ' + s['hit'] if s['hit'] else ''} | "
            f"{s['time_s']:.3f} | {entered} | ({end['x']:.2f}, {end['y']:.2f}) | {end['ux']:.2f} | "
            f"{clearance} | {printed['outcome']}, {float(printed['time']):.1f} |")
    return lines


def lane_change(drive):
    """y at which the vehicle comes into E_C's other lane, beyond x = 12 [m]."""
    return next((row["y"] for row in drive.rows if row["x"] >= 12), math.nan)


def variants_lines(drives):
    """What the paper's text says of E_C seen 50 m ahead and without its cones."""
    def ended(key):
        s = drives[key].summary
        return f"{key[1]} {s['outcome']}{' ' + s['hit'] if s['hit'] else ''} at {s['time_s']:.2f} s"

    seen = ", ".join(ended(("E_C-range-50", p)) for p in ("P_C", "P_D"))
    bare = ", ".join(f"{ended(('E_C-no-cones', p))}, other lane from y = "
                     f"{lane_change(drives['E_C-no-cones', p]):.0f} m (with cones "
                     f"{lane_change(drives['E_C', p]):.0f} m)" for p in ("P_C", "P_D"))
    return ["Of E_C the paper says that with an L_range of 50 m the vehicle crashes into O2 over a large range of",
            f"speeds of O2; ours, by L_range 50 m, N 10, kappa 5 m: {seen}. And that without the cones it",
            f"changes lanes earlier; ours: {bare}."]


def cases():
    """What config/paper/cases.yaml keeps, read line by line."""
    found = []
    for line in (ROOT / "config/paper/cases.yaml").read_text().splitlines():
        pair = re.match(r"  [- ] (\w+): *(.+)", line)
        if pair and pair.group(1) == "case":
            found.append({})
        if pair:
            found[-1][pair.group(1)] = pair.group(2)
    return found


def cases_table(drives):
    lines = ["| case | has | planner | way | the paper's text | ours |", "|---|---|---|---|---|---|"]
    for one in cases():
        s = drives["cases", one["case"]].summary
        ended = (f"arrives at {s['goal_time_s']:.2f} s" if s["outcome"] == "goal"
                 else f"{s['outcome']} {s['hit'] or ''} at {s['time_s']:.2f} s")
        says = one["says"] + (f" (than {one['faster_than']})" if "faster_than" in one else "")
        planner = one["planner"] + (f", {one['set']}" if "set" in one else "")
        lines.append(f"| {one['case']} | {one['specifications']} | {planner} | {s['scenario']} | "
                     f"{says} | {ended} |")
    return lines


def snapshot_table(drives, paper):
    lines = ["| drive | t [s] | ours (x, y) [m] | paper's (x, y) [m] | apart [m] | compared |",
             "|---|---|---|---|---|---|"]
    for key in DRIVES:
        for shot in paper[key]["snapshots"]:
            t = float(shot["t"])
            if t == 0:
                continue
            drive = drives[key]
            x, y = float(shot["x"]), float(shot["y"])
            place = f"| {key[0]}, {key[1]} | {t:g} | "
            if t > drive.time_at_end + 0.02:
                lines.append(place + f"– | ({x:.2f}, {y:.2f}) | – | ours has ended |")
                continue
            t = min(t, drive.time_at_end)
            ox, oy = drive.at(t, "x"), drive.at(t, "y")
            compared = (f"within {float(shot['tolerance']):g} m"
                        if shot["comparable"] == "true" else "no: the paper's series lags")
            lines.append(place + f"({ox:.2f}, {oy:.2f}) | ({x:.2f}, {y:.2f}) | "
                         f"{math.hypot(ox - x, oy - y):.2f} | {compared} |")
    return lines


def change(before, after):
    """In per cent; what rounds to nothing has no sign."""
    percent = round(100 * (after / before - 1), 1)
    return f"{percent:+.1f} %" if percent else "0.0 %"


def effort_table(drives, environment, paper, by_paper):
    b, c = drives[environment, "P_B"], drives[environment, "P_C"]
    head = "| term | P_B | P_C | change |"
    lines = [head + (" paper: P_B | P_C | change |" if paper else ""),
             "|---|---|---|---|" + ("---|---|---|" if paper else "")]
    total_b = total_c = 0
    for name, column, kept, weight in TERMS:
        weight = 0.1 if by_paper else weight
        eb, ec = weight * b.square(column), weight * c.square(column)
        total_b, total_c = total_b + eb, total_c + ec
        line = f"| {name} | {eb:.3g} | {ec:.3g} | {change(eb, ec)} |"
        if paper:
            pb, pc = paper["P_B"][kept], paper["P_C"][kept]
            line += f" {pb:.3g} | {pc:.3g} | {change(pb, pc)} |"
        lines.append(line)
    line = f"| total | {total_b:.4f} | {total_c:.4f} | {change(total_b, total_c)} |"
    if paper:
        pb, pc = paper["P_B"]["total"], paper["P_C"]["total"]
        line += f" {pb:.3g} | {pc:.3g} | {change(pb, pc)} |"
    return lines + [line]


def page(drives):
    paper, effort = paper_drives(), paper_effort()
    for drive in drives.values():
        drive.time_at_end = drive.t[-1]
    lines = [
        "# Results", "",
        "The ten drives of the paper's figures, all by the same default settings (barrier floor 0.9,",
        "tex 0.5 s, interior point). Written by `make results` (`tools/results.py`); the numbers are",
        "those of that run, and `slalom reproduce` makes them again.", "", "## Drives", "",
        *drives_table(drives, paper), "",
        *variants_lines(drives), "",
        "The paper reports ends of execution horizons, so its times carry up to 0.5 s; a drive of ours",
        "ends at the check after an execution horizon too, and the moment at which it entered the",
        "goal's square stands beside. A crash is timed where the front axle's centre touches the",
        "obstacle grown by 2 m. For P_B in E_A-figure the paper's text says 7.0 s and its file 6.5 s.", "",
        "As in the paper: P_B and P_C arrive well before P_A, gaining speed where P_A slows; in E_B, P_C",
        "passes left of O1, which it takes as standing still, and is hit, while P_D passes right, behind",
        "it; in E_C, P_C meets the oncoming O2 and crashes, and P_D gives way in time.", "",
        "## Positions", "",
        *snapshot_table(drives, paper), "",
        "The figures mark thirds of a drive; their printed times are rounded. Why two series are not",
        "compared is in section 5 of [formulation.md](formulation.md).", "",
        "## Control effort", "",
        "By the paper's table, 0.1 ∫(·)² along the drive for all three terms, in E_A-figure:", "",
        *effort_table(drives, "E_A-figure", effort, True), "",
        "In E_A:", "", *effort_table(drives, "E_A", None, True), "",
        "By the weights of the cost (0.1, 1, 0.01), in E_A-figure:", "",
        *effort_table(drives, "E_A-figure", None, False), "",
        "P_C spends no more than P_B, as in the paper, but the decrease is of another size. Ours compares",
        "two drives of the same length; the paper's two end at 6.5 s and 7.0 s, and its series of P_C lags",
        "by about .4 s. The weight of the control effort is small beside that of time: at 100 a second,",
        "the whole effort of a drive costs less than a thousandth of a second does.", "",
        "## What planners lack", "",
        "The paper's conceptual figure is drawn by hand. Here its six cases are driven by the 3DoF vehicle from",
        "17 m/s, tex .5 s, past one obstacle that stands (A to D) or crosses from the right (E, F). By the",
        "specifications of the paper's table: S1 static obstacles, S2 minimum time, S3 dynamic vehicle model, S4 minimum",
        "control effort, S5 speed and steering together, S6 moving obstacles.", "",
        *cases_table(drives), "",
        "## Pictures", ""]
    for _, name, caption in FIGURES:
        lines += [f"![{caption}](figures/{name})", "", f"*{caption}*", ""]
    lines += ["## Solve times", "",
              "Solve times depend on the machine, so no table of them is kept here; `cycles.csv` and the report of each",
              "drive have them beside tex, [realtime.md](realtime.md) a measurement.", ""]
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", default=str(ROOT / "build/slalom"))
    parser.add_argument("--drives")
    parser.add_argument("--out", default=str(ROOT / "docs"))
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(args.drives or pathlib.Path(scratch) / "paper")
        if not args.drives:
            subprocess.run([args.program, "reproduce", "--out", folder, "--quiet"], check=True)
        drives = read(folder)
        out = pathlib.Path(args.out)
        (out / "figures").mkdir(exist_ok=True)
        for source, name, _ in FIGURES:
            shutil.copyfile(folder / source, out / "figures" / name)
        (out / "results.md").write_text(page(drives))


if __name__ == "__main__":
    main()
