"""A drive as `slalom simulate --out FOLDER` left it."""

from __future__ import annotations

import csv
import json
import os
import pathlib
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

import slalom

from ..importing._files import BadFile

Array = npt.NDArray[Any]
EXPECTED = "a folder of results of 'slalom simulate'"
STATES = ("x", "y", "v", "r", "psi", "sa", "ux", "ax")


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
        return next(row for row in self.cycles if row["cycle"] == number)


def read_drive(folder: str | os.PathLike[str]) -> Drive:
    """Reads a results folder. Raises BadFile with file and line for what is none."""
    path = pathlib.Path(folder)
    if not path.is_dir():
        raise BadFile(folder, "a file" if path.exists() else "no such folder", EXPECTED)
    for name in ("plant.csv", "plans.csv", "cycles.csv", "summary.json", "resolved.yaml"):
        if not (path / name).is_file():
            raise BadFile(path / name, "no such file", EXPECTED)
    plant = _columns(path / "plant.csv", ("t", *STATES))
    plans = _columns(path / "plans.csv", ("cycle", "t_start", "t", *STATES))
    try:
        summary = json.loads((path / "summary.json").read_text(encoding="utf-8"))
    except ValueError as error:
        raise BadFile(path / "summary.json", f"no JSON ({error})", EXPECTED) from None
    starts = np.flatnonzero(np.diff(plans["cycle"], prepend=-1.0))
    parts = (
        [
            {name: part for name, part in zip(plans, split)}
            for split in zip(*(np.split(values, starts[1:]) for values in plans.values()))
        ]
        if len(plans["t"])
        else []
    )
    return Drive(path, slalom.load_scenario(path / "resolved.yaml"), summary, plant, parts, _rows(path / "cycles.csv"))


def _table(file: pathlib.Path) -> tuple[list[str], list[list[str]]]:
    try:
        rows = list(csv.reader(file.read_text(encoding="utf-8").splitlines()))
    except (UnicodeDecodeError, csv.Error) as error:
        raise BadFile(file, f"no table ({error})", EXPECTED) from None
    if not rows:
        raise BadFile(file, "no table", EXPECTED)
    for number, row in enumerate(rows[1:], 2):
        if len(row) != len(rows[0]):
            raise BadFile(file, f"{len(row)} cells", f"{len(rows[0])}, one for each column", number)
    return rows[0], rows[1:]


def _columns(file: pathlib.Path, needed: tuple[str, ...]) -> dict[str, Array]:
    names, rows = _table(file)
    for name in needed:
        if name not in names:
            raise BadFile(file, f"no column {name}", EXPECTED, 1)
    try:
        values = np.array([[float(cell or "nan") for cell in row] for row in rows], dtype=float).reshape(
            len(rows), len(names)
        )
    except ValueError as error:
        raise BadFile(file, str(error), "numbers") from None
    if needed[0] == "t" and len(rows) < 2:
        raise BadFile(file, f"{len(rows)} samples", "a drive of at least two")
    return {name: values[:, k] for k, name in enumerate(names)}


def _rows(file: pathlib.Path) -> list[dict[str, Any]]:
    names, rows = _table(file)
    return [{name: _value(cell) for name, cell in zip(names, row)} for row in rows]


def _value(cell: str) -> Any:
    try:
        return float(cell)
    except ValueError:
        return cell
