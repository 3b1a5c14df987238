"""Race tracks: closed reference lines with widths, as CSV x_m,y_m,w_tr_right_m,w_tr_left_m."""

from __future__ import annotations

import io
import os
import pathlib

import numpy as np

from ._files import BadFile, read
from ._line import Array, crossings, curvature, headings, lengths
from ._scene import Scene, Vehicle, no_less

COLUMNS = "x_m,y_m,w_tr_right_m,w_tr_left_m"
EXPECTED = f"a race track: CSV with the columns {COLUMNS} [m]"
MOST_ROWS = 100_000
MOST_OF_RADIUS, FAR_TOO_MUCH = 0.9, 2.0
"""How much of a bend's radius the road may be wide inside it, and beyond which share the file is refused."""


def track(
    file: str | os.PathLike[str],
    *,
    vehicle: str = "bmw_320i",
    speed: float = 15.0,
    time: float = 60.0,
    laps: int | None = None,
) -> Scene:
    """A race track as a scenario: from its first point on along it at `speed` [m/s], as far as possible in `time`
    [s], or so many `laps`.

    Raises BadFile with file and line, and InvalidValue for a vehicle that is none.
    """
    car = Vehicle.load(vehicle)
    rows, numbers = _rows(file)
    line = rows[:, :2]
    _check_line(file, line, numbers)
    _check_widths(file, rows, numbers, car)
    notes = _narrow_in_bends(file, rows, numbers)
    _check_edges(file, rows, numbers)
    ring = np.vstack([line[-1:], line, line[:1]])
    psi = float(headings(ring)[1])
    total = float(lengths(np.vstack([line, line[:1]]))[-1])
    name = pathlib.Path(file).stem
    return Scene(
        name=name,
        file=pathlib.Path(file),
        source=[f"Imported from the race track {pathlib.Path(file).name}: {len(line)} points, {total:.0f} m"],
        vehicle=car,
        start={"x": float(line[0, 0]), "y": float(line[0, 1]), "psi": psi, "ux": max(speed, no_less(car.ux_min))},
        goal={"time": time} if laps is None else {"laps": laps},
        timeout=time + 1 if laps is None else float(np.ceil(laps * total / 5)),
        points=rows.tolist(),
        closed=True,
        planner={"base": "P_E_road" if laps is None else "P_L"},
        loop={} if laps is None else {"tex": 0.1, "on_failure": "last_plan"},
        notes=notes,
    )


def _rows(file: str | os.PathLike[str]) -> tuple[Array, list[int]]:
    """The table, and the line of the file of each row. A last row that repeats the first is left out."""
    content = read(file, EXPECTED)
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise BadFile(file, "bytes that are no text", EXPECTED, content.count(b"\n", 0, error.start) + 1) from None
    rows, numbers = [], []
    headed = False
    # Not by splitlines(): comments may have what Unicode takes for the end of a line.
    for number, line in enumerate(io.StringIO(text, newline=None).read().split("\n"), 1):
        words = [word.strip() for word in line.strip().lstrip("#").split(",")]
        if words == COLUMNS.split(","):
            headed = True
        elif line.strip() and not line.lstrip().startswith("#"):
            if not headed:
                raise BadFile(file, repr(line[:60]), f"the columns {COLUMNS}", number)
            rows.append(_row(file, words, number))
            numbers.append(number)
            if len(rows) > MOST_ROWS:
                raise BadFile(file, f"more than {MOST_ROWS} rows", f"at most {MOST_ROWS}", number)
    if len(rows) < 8:
        raise BadFile(file, f"{len(rows)} rows", "at least 8 of a closed line")
    table = np.array(rows)
    if np.hypot(*(table[0, :2] - table[-1, :2])) < 1e-6:
        table, numbers = table[:-1], numbers[:-1]
    return table, numbers


def _row(file: str | os.PathLike[str], words: list[str], line: int) -> list[float]:
    if len(words) != 4:
        raise BadFile(file, f"{len(words)} numbers", f"4: {COLUMNS}", line)
    row = []
    for name, word in zip(COLUMNS.split(","), words):
        try:
            value = float(word)
        except ValueError:
            raise BadFile(file, f"{name} {word[:40]!r}", "a number", line) from None
        if not np.isfinite(value) or abs(value) > 1e7:
            raise BadFile(file, f"{name} {word}", "a finite number of at most 1e7 m", line)
        row.append(value)
    return row


def _check_line(file: str | os.PathLike[str], line: Array, numbers: list[int]) -> None:
    steps = np.hypot(*np.diff(np.vstack([line, line[:1]]), axis=0).T)
    still = np.flatnonzero(steps < 1e-6)
    if len(still):
        raise BadFile(file, "the same point twice", "points that go on", numbers[(still[0] + 1) % len(numbers)])
    if steps[-1] > 5 * np.median(steps):
        raise BadFile(
            file,
            f"a gap of {steps[-1]:.1f} m from the last point to the first",
            f"a closed line, its points {np.median(steps):.1f} m apart",
            numbers[-1],
        )


def _check_widths(file: str | os.PathLike[str], rows: Array, numbers: list[int], car: Vehicle) -> None:
    widths = rows[:, 2] + rows[:, 3]
    for k in np.flatnonzero((rows[:, 2:] < 0).any(axis=1) | (widths < car.width)):
        raise BadFile(
            file,
            f"a width of {rows[k, 2]:g} m to the right and {rows[k, 3]:g} m to the left",
            f"none below zero, together at least the {car.width:g} m of the vehicle",
            numbers[k],
        )


def _narrow_in_bends(file: str | os.PathLike[str], rows: Array, numbers: list[int]) -> list[str]:
    """Inside a bend a road is narrower than the bend's radius. Takes off what little is too much, and says so."""
    ring = np.vstack([rows[-2:, :2], rows[:, :2], rows[:2, :2]])
    bend = curvature(ring)[2:-2]
    notes = []
    for column, side, inwards in ((2, "right", -bend), (3, "left", bend)):
        share = inwards * rows[:, column]
        for k in np.flatnonzero(share > MOST_OF_RADIUS):
            if share[k] > FAR_TOO_MUCH:
                raise BadFile(
                    file,
                    f"{rows[k, column]:g} m to the {side} in a bend of radius {1 / inwards[k]:.1f} m",
                    "a road that does not cross itself within its own width",
                    numbers[k],
                )
            narrowed = MOST_OF_RADIUS / inwards[k]
            notes.append(
                f"line {numbers[k]}: {narrowed:.2f} m to the {side} in place of {rows[k, column]:g} m, for the bend's radius"
            )
            rows[k, column] = narrowed
    return notes


def _check_edges(file: str | os.PathLike[str], rows: Array, numbers: list[int]) -> None:
    """The line must not cross itself, nor one edge of the road the line or the other edge."""
    ring = np.vstack([rows, rows[:1]])
    middle = ring[:, :2]
    psi = headings(np.vstack([rows[-1:, :2], middle, rows[1:2, :2]]))[1:-1]
    left = np.column_stack([-np.sin(psi), np.cos(psi)])
    edges = {"line": middle, "right edge": middle - ring[:, 2:3] * left, "left edge": middle + ring[:, 3:4] * left}
    for name, edge in edges.items():
        for k, m in crossings(edge, middle) if name != "line" else crossings(middle, middle):
            raise BadFile(
                file,
                f"the {name} of line {numbers[k]} crosses the line of line {numbers[m % len(numbers)]}",
                "a road that does not cross itself within its own width",
                numbers[k],
            )
    for k, m in crossings(edges["right edge"], edges["left edge"]):
        raise BadFile(
            file,
            f"the right edge of line {numbers[k]} crosses the left edge of line {numbers[m]}",
            "a road that does not cross itself within its own width",
            numbers[k],
        )
