#!/usr/bin/env python3
"""Laps of race tracks: the offline optimum, the second lap of two in closed loop, and how far apart they are.

    benchmarks/laps.py FOLDER [--vehicle bmw_320i] [--program build/slalom] [--tracks Austin Monza]

FOLDER holds race tracks as CSV files (x_m, y_m, w_tr_right_m, w_tr_left_m).
"""
import argparse
import json
import math
import pathlib
import subprocess
import tempfile

SCENARIO = """name: {name}
vehicle: {{base: {vehicle}, footprint: rectangle}}
planner: P_L
start: {{x: {x}, y: {y}, psi: {psi}, ux: 15}}
goal: {{laps: 2}}
road: {{closed: true, file: {file}}}
loop: {{tex: 0.1, timeout: 600, sm_crash: 0, on_failure: last_plan}}
"""


def start_of(file):
    """The first point of a track, and the direction of its line there."""
    rows = [line.split(",") for line in file.read_text().splitlines()[1:] if line.strip()]
    points = [(float(row[0]), float(row[1])) for row in rows]
    (x0, y0), (x1, y1), (x2, y2) = points[-1], points[0], points[1]
    return x1, y1, math.atan2(y2 - y0, x2 - x0)


def run(program, *arguments):
    done = subprocess.run([program, *arguments, "--json"], capture_output=True, text=True)
    return json.loads(done.stdout) if done.stdout.startswith("{") else {"message": done.stderr.strip()}


def row_of(program, vehicle, track, folder):
    x, y, psi = start_of(track)
    scenario = folder / f"{track.stem}.yaml"
    scenario.write_text(SCENARIO.format(name=track.stem, vehicle=vehicle, x=x, y=y, psi=psi, file=track.resolve()))
    lap = run(program, "lap", str(scenario), "--meshes", "3")
    drive = run(program, "simulate", str(scenario))
    ends = drive.get("lap_ends_s", [])
    flying = ends[1] - ends[0] if len(ends) > 1 else None
    best = lap.get("time_s") or None
    return {
        "track": track.stem,
        "length_m": lap.get("length_m"),
        "optimum_s": best,
        "status": lap.get("status"),
        "solve_s": sum(mesh["solve_s"] for mesh in lap.get("meshes", [])),
        "flying_s": flying,
        "slower": flying / best - 1 if flying and best else None,
        "outcome": drive.get("outcome", drive.get("message")),
        "edge_m": drive.get("least_edge_distance_m"),
    }


def cell(value, form):
    return "" if value is None else form.format(value)


def table(rows):
    head = "| track | length [m] | optimum [s] | refined | solves [s] | flying lap [s] | slower | drive | edge [m] |"
    lines = [head, "|---|---|---|---|---|---|---|---|---|"]
    for r in rows:
        lines.append(
            "| {} | {} | {} | {} | {} | {} | {} | {} | {} |".format(
                r["track"], cell(r["length_m"], "{:.0f}"), cell(r["optimum_s"], "{:.2f}"), r["status"],
                cell(r["solve_s"], "{:.1f}"), cell(r["flying_s"], "{:.2f}"), cell(r["slower"], "{:.1%}"),
                r["outcome"], cell(r["edge_m"], "{:.3f}")))
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--vehicle", default="bmw_320i")
    parser.add_argument("--program", default="build/slalom")
    parser.add_argument("--tracks", nargs="*")
    options = parser.parse_args()
    tracks = sorted(options.folder.glob("*.csv"))
    if options.tracks:
        tracks = [track for track in tracks if track.stem in options.tracks]
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for track in tracks:
            rows.append(row_of(options.program, options.vehicle, track, pathlib.Path(folder)))
            print(table(rows[-1:]).splitlines()[-1], flush=True)
    print()
    print(table(rows))


if __name__ == "__main__":
    main()
