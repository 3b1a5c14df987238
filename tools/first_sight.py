"""Whether a drive by `known: range` could still be saved once the obstacle that it hit was seen: a drive from where the
first plan that knows of it begins, an execution horizon later, with all known and searched for without a clock. Standard
library only."""

import math
import pathlib
import re
import tempfile

from sweeps import drive, driven, rows_of

STATE = ("x", "y", "v", "r", "psi", "sa", "ux", "ax")  # keys of a start, and columns of plant.csv


def first_knowing(rows, place, reach, horizon):
    """The row at which the first plan begins that knows of an obstacle: a horizon after the first planning instant at
    which it is within `reach` of the vehicle; `place`: where it is at a time. None where it never is."""
    seen = None
    for row in rows:
        t = float(row["t"])
        planning = abs(t / horizon - round(t / horizon)) < 1e-6
        if seen is None and planning and math.dist(place(t), (float(row["x"]), float(row["y"]))) <= reach:
            seen = t
        if seen is not None and t >= seen + horizon - 1e-6:
            return row
    return None


def from_there(scenario, row, moved):
    """The text of a scenario whose start is a row's state, and whose obstacles have moved so far."""
    state = ", ".join(f"{key}: {row[key]}" for key in STATE)
    text = re.sub(r"(?m)^start: .*$", f"start: {{{state}}}", scenario)
    for name, (x, y) in moved.items():
        text = re.sub(rf"(?m)^(  - \{{name: {name}), x: [^,]+, y: [^,]+,", rf"\1, x: {x!r}, y: {y!r},", text)
    return text


def saved(program, scenario, settings, obstacle, offline):
    """Drives `scenario` (a file) again with settings, and from the first plan that knows of `obstacle` (name, place at 0,
    velocity, radius) once more with all known and the offline settings: the moment and that drive's outcome. None where
    that drive ends before such a plan begins."""
    name, at, velocity, radius = obstacle

    def place(t):
        return at[0] + velocity[0] * t, at[1] + velocity[1] * t

    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        drive(program, scenario, "P_E", settings, folder / "drive")
        reach = float(settings["planner.L_range"]) + radius
        row = first_knowing(rows_of(folder / "drive/plant.csv"), place, reach, float(settings["loop.tex"]))
        if row is None:
            return None
        file = folder / "from-there.yaml"
        file.write_text(from_there(pathlib.Path(scenario).read_text(), row, {name: place(float(row["t"]))}))
        keep = {key: value for key, value in settings.items() if key.startswith("obstacles.")}
        summary, _ = driven(program, file, "P_E", keep | offline)
        return float(row["t"]), summary["outcome"]
