"""A drive as `slalom simulate --out FOLDER` left it."""

from __future__ import annotations

import csv
import io
import json
import math
import os
import pathlib
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

import slalom

from ..importing._files import BadFile, readable

Array = npt.NDArray[Any]
EXPECTED = "a folder of results of 'slalom simulate'"
STATES = ("x", "y", "v", "r", "psi", "sa", "ux", "ax")
OF_CYCLES = ("cycle", "t0", "t_swap", "used")
"""Columns of cycles.csv that must have a number in each row."""


@dataclass(frozen=True)
class Drive:
    """The files of a results folder; docs/output-files.md says what the columns mean."""

    folder: pathlib.Path
    scenario: slalom.Scenario
    summary: dict[str, Any]
    plant: dict[str, Array]
    """Columns of plant.csv, one value for each sample."""
    plans: list[dict[str, Array]]
    """Of each cycle that has a plan, the columns of plans.csv at its nodes."""
    cycles: list[dict[str, Any]]
    """Rows of cycles.csv: numbers where they are numbers, else text."""

    @property
    def t(self) -> Array:
        return self.plant["t"]

    def at(self, times: Array) -> dict[str, Array]:
        """The plant's columns at these times [s], linear between samples."""
        return {name: np.interp(times, self.t, values) for name, values in self.plant.items()}

    def cycle(self, number: int) -> dict[str, Any]:
        """The row of a cycle."""
        row = next((row for row in self.cycles if row["cycle"] == number), None)
        if row is None:
            raise BadFile(self.folder / "cycles.csv", f"no row of cycle {number}", "one for each plan")
        return row

    def driven(self) -> list[tuple[float, dict[str, Any], dict[str, Array]]]:
        """The plans that were driven, each after its cycle's row and the time [s] from which on it was: when it begins,
        or later where it came late."""
        rows = [(self.cycle(int(plan["cycle"][0])), plan) for plan in self.plans]
        return [(max(float(plan["t_start"][0]), row["t_swap"]), row, plan) for row, plan in rows if row["used"]]


def read_drive(folder: str | os.PathLike[str]) -> Drive:
    """Reads a results folder. Raises BadFile with file and line for what is none."""
    with readable(folder, EXPECTED):
        return _read_drive(pathlib.Path(folder))


def _read_drive(path: pathlib.Path) -> Drive:
    if not path.is_dir():
        raise BadFile(path, "a file" if path.exists() else "no such folder", EXPECTED)
    for name in ("plant.csv", "plans.csv", "cycles.csv", "summary.json", "resolved.yaml"):
        if not (path / name).is_file():
            raise BadFile(path / name, "no such file", EXPECTED)
    plant = _columns(path / "plant.csv", ("t", "x", "y", "psi"), STATES)
    plans = _columns(path / "plans.csv", ("cycle", "t_start"), ("t", *STATES))
    if len(plant["t"]) < 2:
        raise BadFile(path / "plant.csv", f"{len(plant['t'])} samples", "a drive of at least two")
    try:
        summary = json.loads((path / "summary.json").read_text(encoding="utf-8"))
    except (ValueError, RecursionError) as error:
        raise BadFile(path / "summary.json", f"no JSON ({error})", EXPECTED) from None
    if not isinstance(summary, dict):
        raise BadFile(path / "summary.json", f"a {type(summary).__name__} of JSON", "an object")
    cycles = _rows(path / "cycles.csv", OF_CYCLES, ("status",))
    starts = np.flatnonzero(np.diff(plans["cycle"], prepend=-1.0))
    parts = (
        [
            {name: part for name, part in zip(plans, split)}
            for split in zip(*(np.split(values, starts[1:]) for values in plans.values()))
        ]
        if len(plans["t"])
        else []
    )
    drive = Drive(path, slalom.load_scenario(path / "resolved.yaml"), summary, plant, parts, cycles)
    for _, row, plan in drive.driven():
        if not all(np.isfinite(plan[name]).all() for name in ("t", "x", "y")):
            raise BadFile(path / "plans.csv", f"a node of cycle {row['cycle']:g} without t, x or y", "numbers")
    return drive


def _table(file: pathlib.Path, needed: tuple[str, ...]) -> tuple[list[str], list[tuple[int, list[str]]]]:
    """The columns' names, and each row with its line."""
    try:
        # Not by splitlines(): names of obstacles may have what Unicode takes for the end of a line.
        reader = csv.reader(io.StringIO(file.read_bytes().decode("utf-8"), newline=""))
        names = next(reader, [])
        rows = [(reader.line_num, row) for row in reader]
    except (UnicodeDecodeError, csv.Error) as error:
        raise BadFile(file, f"no table ({error})", EXPECTED) from None
    if not names:
        raise BadFile(file, "no table", EXPECTED)
    for name in needed:
        if name not in names:
            raise BadFile(file, f"no column {name}", EXPECTED, 1)
    for line, row in rows:
        if len(row) != len(names):
            raise BadFile(file, f"{len(row)} cells", f"{len(names)}, one for each column", line)
    return names, rows


def _columns(file: pathlib.Path, finite: tuple[str, ...], others: tuple[str, ...]) -> dict[str, Array]:
    """A table of numbers, an empty cell being none."""
    names, rows = _table(file, finite + others)
    values = np.empty((len(rows), len(names)))
    for k, (line, row) in enumerate(rows):
        try:
            values[k] = [float(cell or "nan") for cell in row]
        except ValueError as error:
            raise BadFile(file, str(error), "numbers", line) from None
        _check_finite(file, line, dict(zip(names, values[k].tolist())), finite)
    return {name: values[:, k] for k, name in enumerate(names)}


def _rows(file: pathlib.Path, finite: tuple[str, ...], others: tuple[str, ...]) -> list[dict[str, Any]]:
    names, rows = _table(file, finite + others)
    made = []
    for line, row in rows:
        made.append({name: _value(cell) for name, cell in zip(names, row)})
        _check_finite(file, line, made[-1], finite)
    return made


def _check_finite(file: pathlib.Path, line: int, row: dict[str, Any], names: tuple[str, ...]) -> None:
    for name in names:
        if not isinstance(row[name], float) or not math.isfinite(row[name]):
            raise BadFile(file, f"{name} {row[name]!r}", "a finite number", line)


def _value(cell: str) -> Any:
    try:
        return float(cell)
    except ValueError:
        return cell
