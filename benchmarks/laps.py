#!/usr/bin/env python3
"""Laps of race tracks: the offline optimum, the same statement by CasADi with Ipopt, and the second lap of two in
closed loop, into docs/measured/laps.md.

    benchmarks/laps.py FOLDER [--tracks Monza ...] [--peers Monza ...] [--python PYTHON]

FOLDER holds race tracks as CSV files (x_m, y_m, w_tr_right_m, w_tr_left_m); the built-in `circuit` is driven
first. --peers names those that CasADi solves, all by default. --python takes an interpreter that has CasADi; else
one is made from requirements.txt. Standard library only.
"""
import json
import math
import os
import pathlib
import subprocess
import sys
import time

from contestants import HERE, build_ours, program
from environments import one_thread
from long_solves import casadi_python
from measured import command_of, page_parser, stamp, write
from sweeps import head, row

BUILT_IN = "circuit"
SAME_TIME = 1e-4
NEAR, TIMES_FASTER = 0.03, 5  # what is looked for: a flying lap so near, a peer so much slower
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


def scenario_of(track, vehicle, folder):
    """The scenario file of a track's, or a built-in's name."""
    if track == BUILT_IN:
        return BUILT_IN
    x, y, psi = start_of(track)
    file = folder / f"{track.stem}.yaml"
    file.write_text(SCENARIO.format(name=track.stem, vehicle=vehicle, x=x, y=y, psi=psi, file=track.resolve()))
    return str(file)


def failure(done):
    """What is kept of a program that gave no answer: its last words."""
    return {"failure": (done.stderr.strip().splitlines() or [f"ended with {done.returncode}"])[-1]}


def output_of(*command):
    """The JSON that a program prints, or why it printed none."""
    done = subprocess.run([*command, "--json"], capture_output=True, text=True)
    return json.loads(done.stdout) if done.stdout.startswith("{") else failure(done)


def peer_of(args, scenario, intervals, name):
    """Ours and CasADi's solves of the last mesh's problem, one after the other."""
    case, answer = args.work / f"{name}.case.json", args.work / f"{name}.casadi.json"
    for file in (case, answer):
        file.unlink(missing_ok=True)
    done = subprocess.run([args.bench, scenario, str(case), "--intervals", str(intervals)], capture_output=True, text=True)
    if not case.exists():
        return failure(done)
    done = subprocess.run([args.python, str(HERE / "lap_casadi.py"), str(case), str(answer), "--limit", str(args.limit)],
                          cwd=args.work, env=one_thread(), capture_output=True, text=True)  # fmt: skip
    ours = json.loads(case.read_text())["ours"]
    del ours["points"]
    case.unlink()
    return {"ours": ours, "limit": args.limit, "casadi": json.loads(answer.read_text()) if answer.exists() else failure(done)}


def failed(part):
    """Whether a part of a row is none to keep: what broke down is tried again by the next run."""
    return isinstance(part, dict) and ("failure" in part or "failure" in part.get("casadi", {}))


def measured_row(args, track):
    """One track's; what was measured before is not measured again."""
    name = track if track == BUILT_IN else track.stem
    file = args.work / f"{name}.json"
    found = json.loads(file.read_text()) if file.exists() else {}
    if found.get("vehicle") != args.vehicle:
        found = {"track": name, "vehicle": args.vehicle}
    if "peer" in found and found["peer"]["limit"] != args.limit:
        del found["peer"]

    def keep(**more):
        found.update(more)
        found["loads"] = [*found.get("loads", []), os.getloadavg()[0]]
        write(file, json.dumps({part: value for part, value in found.items() if not failed(value)}))

    scenario = scenario_of(track, args.vehicle, args.work)
    if "lap" not in found:
        keep(lap=output_of(args.program, "lap", scenario))
    meshes = found["lap"].get("meshes", [])
    wanted = args.peers is None or name in args.peers
    if "peer" not in found and wanted and meshes:
        keep(peer=peer_of(args, scenario, meshes[-1]["intervals"], name))
    if "drive" not in found and not args.no_drives:
        keep(drive=output_of(args.program, "simulate", scenario))
    return found


# --- the page -----------------------------------------------------------------------------------


def figures_of(measured):
    """What the tables say of a track; None for what is not known."""
    lap, drive, peer = measured["lap"], measured.get("drive", {}), measured.get("peer", {})
    meshes = lap.get("meshes", [])
    ends = drive.get("lap_ends_s", [])
    flying = ends[1] - ends[0] if len(ends) > 1 else None
    best = lap.get("time_s") or None
    ours, casadi = peer.get("ours"), peer.get("casadi", {})
    both = bool(ours and ours["solved"] and casadi.get("solved"))
    return {
        "track": measured["track"], "length": lap.get("length_m"), "best": best,
        "status": (lap.get("status") or lap.get("failure", "")).replace("_", " "),
        "intervals": [mesh["intervals"] for mesh in meshes], "iterations": [mesh["iterations"] for mesh in meshes],
        "solves": sum(mesh["solve_s"] for mesh in meshes) if meshes else None,
        "ours": ours, "casadi": casadi or None, "both": both, "not_compared": peer.get("failure"),
        "ratio": casadi["cpu_s"] / ours["cpu_s"] if both else None,
        "apart": abs(casadi["time_s"] / ours["time_s"] - 1) if both else None,
        "flying": flying, "slower": flying / best - 1 if flying and best else None,
        "outcome": drive.get("outcome", drive.get("failure")), "edge": drive.get("least_edge_distance_m"),
    }  # fmt: skip


def cell(value, form="{}"):
    return "–" if value is None else form.format(value)


def table(names, rows):
    return head(names) + "".join(map(row, rows))


def optima(figures):
    return table(
        ["track", "length [m]", "optimum [s]", "refinement", "intervals", "iterations", "solves [s]"],
        [[f["track"], cell(f["length"], "{:.0f}"), cell(f["best"], "{:.3f}"), f["status"],
          ", ".join(map(str, f["intervals"])), ", ".join(map(str, f["iterations"])), cell(f["solves"], "{:.1f}")]
         for f in figures])  # fmt: skip


def solve_cell(answer):
    if "failure" in answer:
        return f"failed: {answer['failure'].replace('|', '/')}"
    end = "" if answer["solved"] else f", {answer['status'].replace('_', ' ')}"
    return f"{answer['cpu_s']:.2f} s, {answer['iterations']}{end}"


def peers(figures):
    return table(
        ["track", "intervals", "ours: time, iterations", "CasADi: time, iterations", "ours faster by",
         "lap times: ours, CasADi's [s]", "apart", "violation of ours, by CasADi"],
        [[f["track"], str(f["intervals"][-1]), solve_cell(f["ours"]), solve_cell(f["casadi"]),
          cell(f["ratio"], "× {:.1f}"),
          f"{f['ours']['time_s']:.4f}, {cell(f['casadi'].get('time_s'), '{:.4f}')}",
          cell(f["apart"], "{:.1e}"),
          cell(f["casadi"].get("ours_here", {}).get("violation"), "{:.1e}")]
         for f in figures if f["ours"]])  # fmt: skip


def drives(figures):
    return table(
        ["track", "optimum [s]", "flying lap [s]", "slower", "drive ended as", "least edge distance [m]"],
        [[f["track"], cell(f["best"], "{:.2f}"), cell(f["flying"], "{:.2f}"), cell(f["slower"], "{:.1%}"),
          f["outcome"], cell(f["edge"], "{:.3f}")] for f in figures if f["outcome"]])  # fmt: skip


def counts(figures):
    """The tables in numbers."""
    compared = [f for f in figures if f["casadi"]]
    driven = [f for f in figures if f["outcome"]]
    lines = [f"Laps solved: {sum(f['best'] is not None for f in figures)} of {len(figures)}, refined until the cost "
             f"changes by less than the tolerance: {sum(f['status'] == 'converged' for f in figures)}."]  # fmt: skip
    lines += [f"{f['track']} was not compared with CasADi: {f['not_compared']}." for f in figures if f["not_compared"]]
    if compared:
        ratios = sorted(f["ratio"] for f in compared if f["both"])
        lines.append(
            f"CasADi solved {sum(bool(f['casadi'].get('solved')) for f in compared)} of {len(compared)}; same lap time to "
            f"{SAME_TIME:g}: {sum(f['both'] and f['apart'] <= SAME_TIME for f in compared)}; ours at least "
            f"{TIMES_FASTER} times faster: {sum(r >= TIMES_FASTER for r in ratios)}"
            + (f" (from × {ratios[0]:.1f} to × {ratios[-1]:.1f})." if ratios else "."))  # fmt: skip
    if driven:
        near = sum(f["slower"] is not None and f["slower"] <= NEAR for f in driven)
        on = sum(f["edge"] is not None and f["edge"] >= 0 for f in driven)
        lines.append(f"In closed loop: {near} of {len(driven)} flying laps within {NEAR:.0%} of the optimum; "
                     f"{on} of the drives on the road throughout.")  # fmt: skip
    return "\n".join(lines)


def load_line(rows):
    """How busy the machine was."""
    loads = sorted(load for each in rows for load in each.get("loads", []))
    return (f"Load of the machine meanwhile: {loads[0]:.1f} to {loads[-1]:.1f} on {os.cpu_count()} cores."
            if loads else "")  # fmt: skip


def page(rows, stamped, limit, casadi):
    figures = [figures_of(each) for each in rows]
    text = ["# Laps", "", stamped,
            "The fastest flying lap by `slalom lap` ([laps.md](../laps.md)), the same statement by CasADi with Ipopt, and",
            "two laps in closed loop by planner P_L, of which the second is the flying lap. `circuit` is built in; the",
            "others are files of race tracks, given to `make laps TRACKS=folder`.", "", counts(figures), "", load_line(rows), "",
            "## The optimum", "",
            "Meshes of ever shorter intervals, each solved from the calm guess; solves by the clock, all meshes.", "",
            optima(figures)]  # fmt: skip
    if any(f["ours"] for f in figures):
        text += ["## Beside CasADi with Ipopt", "",
                 f"CasADi {casadi} (wheel): the lap stated anew from the pages (`benchmarks/lap_casadi.py`) on the last",
                 "mesh of the table above, from the same guess, to 1e-8: MUMPS, exact Hessian, monotone barrier, the",
                 "functions of a point compiled (-O3 -march=native). Ours and CasADi's run one after the other; times are",
                 f"processor time, ours with transcription and check, CasADi's of the solve alone; at most {limit:g} s.",
                 "The last column is the largest violation of bounds and rows that CasADi's statement finds in our answer.",
                 "", peers(figures)]  # fmt: skip
    if any(f["outcome"] for f in figures):
        text += ["## In closed loop", "", drives(figures)]
    return "\n".join(text)


def wanted_tracks(args):
    """The built-in, then the folder's, shortest file first."""
    files = sorted(args.folder.glob("*.csv"), key=lambda file: (len(file.read_text().splitlines()), file.name))
    if not files:
        sys.exit(f"{args.folder}: no NAME.csv of a race track there")
    known = [BUILT_IN, *(file.stem for file in files)]
    for name in (args.tracks or []) + (args.peers or []):
        if name not in known:
            sys.exit(f"'{name}': no such track; there are {', '.join(known)}")
    return [track for track in [BUILT_IN, *files]
            if not args.tracks or (track if track == BUILT_IN else track.stem) in args.tracks]  # fmt: skip


def parser_of():
    parser = page_parser("laps", __doc__)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--vehicle", default="bmw_320i")
    parser.add_argument("--tracks", nargs="*")
    parser.add_argument("--peers", nargs="*", help="tracks that CasADi solves, too; all by default")
    parser.add_argument("--no-drives", action="store_true")
    parser.add_argument("--python", help="an interpreter that has CasADi")
    parser.add_argument("--bench", help="bench_lap; built where it is not given")
    parser.add_argument("--limit", type=float, default=600, help="of one solve of CasADi's [s]")
    parser.add_argument("--minutes", type=float, default=math.inf, help="no further track is begun after so many")
    return parser


def made_by(parser, args):
    return command_of(parser, args, "laps TRACKS=folder", "vehicle", "tracks", "peers", "no_drives", "limit", "minutes")


def main():
    parser = parser_of()
    args = parser.parse_args()
    tracks = wanted_tracks(args)
    args.work = args.work.resolve()
    args.work.mkdir(parents=True, exist_ok=True)
    if args.peers != []:
        if not args.bench:
            build_ours("lap")
        args.bench = args.bench or program("bench_lap")
        args.python = args.python or casadi_python()
    began, rows = time.monotonic(), []
    for track in tracks:
        if time.monotonic() - began > 60 * args.minutes:
            break
        rows.append(measured_row(args, track))
        print(json.dumps({k: v for k, v in figures_of(rows[-1]).items() if k not in ("ours", "casadi")}), flush=True)
    rows[-1]["loads"] = [*rows[-1].get("loads", []), os.getloadavg()[2]]  # of the last quarter of an hour
    casadi = next((peer["casadi"]["casadi"] for r in rows if (peer := r.get("peer")) and not failed(peer)), "")
    write(args.out, page(rows, stamp(made_by(parser, args), args.program), args.limit, casadi))


if __name__ == "__main__":
    main()
