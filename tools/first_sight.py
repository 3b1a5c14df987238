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


def obstacles_of(resolved):
    """The numbers of each obstacle of a resolved scenario, by name."""
    return {re.search(r'name: "([^"]*)"', line)[1]:
            {key: float(value) for key, value in re.findall(r"(\w+): ([-+.\d][-+.\deE]*)", line)}
            for line in resolved.splitlines() if line.startswith("  - {")}  # fmt: skip


def place(obstacle, t):
    """Where an obstacle is at a time."""
    return obstacle["x"] + obstacle["vx"] * t, obstacle["y"] + obstacle["vy"] * t


def from_there(scenario, row, obstacles):
    """The text of a scenario whose start is a row's state, with these obstacles where they are by then."""
    def line(name, numbers):
        x, y = place(numbers, float(row["t"]))
        return f'  - {{name: "{name}", ' + ", ".join(f"{k}: {v!r}" for k, v in (numbers | {"x": x, "y": y}).items()) + "}\n"
    state = ", ".join(f"{key}: {row[key]}" for key in STATE)
    lines = "".join(line(name, numbers) for name, numbers in obstacles.items())
    text = re.sub(r"(?m)^start: .*$", f"start: {{{state}}}", scenario)
    return re.sub(r"(?m)^obstacles:\n(  - .*\n)+", lambda _: "obstacles:\n" + lines, text)


def saved(program, scenario, settings, hit, offline):
    """Drives `scenario` (a file) again with settings, and from the first plan that knows of the obstacle `hit` once more
    with all known and the offline settings: the moment and that drive's outcome. None where that drive ends before such
    a plan begins."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        drive(program, scenario, "P_E", settings, folder / "drive")
        obstacles = obstacles_of((folder / "drive/resolved.yaml").read_text())
        own = obstacles[hit]
        reach = float(settings["planner.L_range"]) + max(own["a"], own["b"])
        row = first_knowing(rows_of(folder / "drive/plant.csv"), lambda t: place(own, t), reach, float(settings["loop.tex"]))
        if row is None:
            return None
        file = folder / "from-there.yaml"
        file.write_text(from_there(pathlib.Path(scenario).read_text(), row, obstacles))
        summary, _ = driven(program, file, "P_E", offline)
        return float(row["t"]), summary["outcome"]
