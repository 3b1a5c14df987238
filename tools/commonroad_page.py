#!/usr/bin/env python3
"""Imports, drives and judges CommonRoad scenarios, and writes docs/measured/commonroad.md.

    tools/commonroad_page.py FOLDER [--names NAME ...] [--python PYTHON] [--judge PYTHON]

FOLDER holds CommonRoad's XML files. Each is imported, driven by the planner that the import names, exported as a
solution, and judged by tools/commonroad_check.py, which knows nothing of Slalom. --python has the package with its
extra `commonroad`, --judge has commonroad-drivability-checker; where they are not given, they are made in
build/commonroad/. What was driven before, in --work, is not driven again. Standard library only.
"""

import json
import os
import pathlib
import subprocess
import sys

from environments import environment
from measured import ROOT, command_of, page_parser, stamp, write
from sweeps import table

CHECKER = ROOT / "tools/commonroad_check.py"
JUDGE = ("commonroad-drivability-checker", "commonroad-io<2026")
NOTE = "# - "  # of what an imported file does not carry over
KINDS = (("traffic sign", "traffic signs"), ("traffic light", "traffic lights"), ("intersection", "right of way"),
         ("stop line", "stop lines"))  # fmt: skip


def output_of(*command):
    """Standard output, or the message of an error."""
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    return done.returncode, done.stdout, " ".join(done.stderr.split())


def notes_of(scenario):
    """What the import could not carry over, from the file's comments."""
    return [line[len(NOTE):] for line in scenario.read_text().splitlines() if line.startswith(NOTE)]


def brief(notes):
    """In a cell: what there may be many of is counted."""
    counts = {plural: sum(note.startswith(kind) for note in notes) for kind, plural in KINDS}
    others = [note for note in notes if not any(note.startswith(kind) for kind, _ in KINDS)]
    return "; ".join([f"{plural} ({count})" for plural, count in counts.items() if count] + others) or "–"


def driven(args, xml):
    """Imports, drives, exports and has one file judged; what is there already is kept."""
    name, folder = xml.stem, args.work / xml.stem
    scenario, summary = args.work / f"{name}.yaml", folder / "summary.json"
    solution, verdict = folder / "solution.xml", folder / "judged.md"
    if not scenario.exists():
        code, _, message = output_of(args.python, "-m", "slalom.importing", "commonroad", xml, "--out", scenario)
        if code:
            return {"name": name, "refused": message}
    if not summary.exists():
        output_of(args.program, "simulate", scenario, "--out", folder, "--force", "--quiet")
        if folder.exists():
            (folder / "load").write_text(f"{os.getloadavg()[0]:.1f}")
    if not solution.exists():
        _, _, message = output_of(args.python, "-m", "slalom.exporting", "commonroad", folder, "--scenario", xml,
                                  "--force")  # fmt: skip
    if solution.exists() and not verdict.exists():
        _, table, message = output_of(args.judge, CHECKER, xml, solution)
        if name in table:
            verdict.write_text(table)
    load = folder / "load"
    return {"name": name, "notes": notes_of(scenario), "load": float(load.read_text()) if load.exists() else None,
             "summary": json.loads(summary.read_text()) if summary.exists() else {},
            "verdict": verdict_of(name, verdict.read_text()) if verdict.exists() else {"message": message}}  # fmt: skip


def verdict_of(name, table):
    """The checker's row of a drive, by its head."""
    lines = [[cell.strip() for cell in line.strip("|").split("|")] for line in table.splitlines() if line.startswith("|")]
    row = next(line for line in lines if line[0] == name)
    return dict(zip(lines[0], row))


# --- the page -----------------------------------------------------------------------------------


def number(value, form="{:.2f}"):
    return "–" if value is None else form.format(value)


def drives(rows):
    lines = []
    for row in rows:
        if "refused" in row:
            lines.append([row["name"], "not imported", *["–"] * 4])
            continue
        s = row["summary"]
        lines.append([row["name"], s.get("outcome", "–").replace("_", " "), number(s.get("time_s")),
                      number(s.get("least_clearance_m")), number(s.get("least_edge_distance_m")),
                      number(s.get("cpu_time_max_s"), "{:.3f}")])  # fmt: skip
    return table(["scenario", "drive ended as", "at [s]", "least true distance [m]", "least edge distance [m]",
                  "longest cycle [s]"], lines)  # fmt: skip


def verdicts(rows):
    head = ["collision", "off the road", "least distance [m]", "goal reached", "without", "judges"]
    lines = []
    for row in rows:
        verdict = row.get("verdict", {})
        if "scenario" in verdict:
            lines.append([row["name"], *(verdict[key] or "–" for key in head)])
        else:
            lines.append([row["name"], verdict.get("message") or row.get("refused", "–"), *["–"] * (len(head) - 1)])
    return table(["scenario", *head], lines)


def counts(rows):
    imported = [row for row in rows if "refused" not in row]
    judged = [row["verdict"] for row in imported if "scenario" in row["verdict"]]
    clean = [v["off the road"] for v in judged if v["collision"] == "no"]
    asked = [v for v in judged if v["goal reached"] != "none asked"]
    reached = [v for v in asked if v["goal reached"] != "no"]
    goal = sum(row["summary"].get("outcome") == "goal" for row in imported)
    return (f"Imported: {len(imported)} of {len(rows)}. Drives that ended at the goal: {goal}. By the checker: "
            f"{clean.count('no')} of {len(judged)} touch nothing and stay on the road, {clean.count('starts off it')} touch "
            f"nothing and start off it; of {len(asked)} with a goal {len(reached)} reach it.")  # fmt: skip


def load_line(rows):
    """How busy the machine was: planning time is thread time, but caches and cores are shared."""
    loads = sorted(row["load"] for row in rows if row.get("load") is not None)
    return (f"Load of the machine meanwhile: {loads[0]:.1f} to {loads[-1]:.1f} on {os.cpu_count()} cores."
            if loads else "")  # fmt: skip


def page(rows, stamped):
    left = [[row["name"], brief(row["notes"])] for row in rows if "refused" not in row]
    return "\n".join([
        "# CommonRoad scenarios", "", stamped,
        "Scenarios given to `make commonroad FILES=folder`, imported ([import.md](../import.md)) and driven in closed loop by",
        "the planner that the import names. Distances are the program's own: of the body to the nearest obstacle, and to",
        "the road's edge, at all times.", "", counts(rows), "", load_line(rows), "",
        drives(rows),
        "## The independent checker", "",
        "`tools/commonroad_check.py` judges the drives, exported as CommonRoad solutions ([export.md](../export.md)), from the",
        "XML files alone, at their time steps; `both` where two judges agree, in the first time steps too.", "",
        verdicts(rows),
        "## What was not carried over", "",
        table(["scenario", "left out, or not as in the source"], left)])  # fmt: skip


def with_package():
    wheels = (ROOT / "dist").glob("slalom-*.whl")
    newest = max(wheels, key=lambda wheel: wheel.stat().st_mtime, default=None)
    if newest is None:
        sys.exit("commonroad: no dist/slalom-*.whl: `make wheel` builds it, or --python names an interpreter that has it")
    return environment(ROOT / "build/commonroad/package", [f"{newest}[commonroad]"])


def main():
    parser = page_parser("commonroad", __doc__)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--names", nargs="*", help="of the scenarios; all by default")
    parser.add_argument("--python", help="an interpreter with the package slalom[commonroad]")
    parser.add_argument("--judge", help="an interpreter with commonroad-drivability-checker")
    args = parser.parse_args()
    files = sorted(args.folder.glob("*.xml"))
    if not files:
        sys.exit(f"{args.folder}: no NAME.xml of a CommonRoad scenario there")
    known = [xml.stem for xml in files]
    for name in args.names or []:
        if name not in known:
            sys.exit(f"'{name}': no such scenario; there are {', '.join(known)}")
    args.python = args.python or with_package()
    args.judge = args.judge or environment(ROOT / "build/commonroad/judge", JUDGE)
    args.work = args.work.resolve()
    args.work.mkdir(parents=True, exist_ok=True)
    rows = []
    for xml in files:
        if args.names and xml.stem not in args.names:
            continue
        rows.append(driven(args, xml))
        print(json.dumps({"name": xml.stem, "outcome": rows[-1].get("summary", {}).get("outcome"),
                          "refused": rows[-1].get("refused")}), flush=True)  # fmt: skip
    write(args.out, page(rows, stamp(command_of(parser, args, "commonroad FILES=folder", "names"), args.program)))


if __name__ == "__main__":
    main()
