"""Drives in other formats: `mcap` for Foxglove, `rerun`, and `commonroad_solution` for CommonRoad's checkers.

For example, `exporting.mcap("drives/E_C", "E_C.mcap")`.
"""

from __future__ import annotations

import contextlib
import os
import pathlib
import tempfile
from typing import Iterator

from ..importing._files import BadFile, write_whole
from ..importing._xml import MISSING, ExtraMissing
from ._drive import Drive, read_drive
from ._mcap import write_mcap
from ._rerun import write_rerun

__all__ = ["BadFile", "Drive", "ExtraMissing", "commonroad_solution", "mcap", "read_drive", "rerun"]

_Path = str | os.PathLike[str]


def mcap(folder: _Path, file: _Path, *, force: bool = False) -> None:
    """Writes the drive of a results folder as MCAP with Foxglove's messages, whole or not at all."""
    drive = read_drive(folder)
    with _beside(pathlib.Path(file), force) as part, open(part, "wb") as stream:
        write_mcap(drive, stream)


def rerun(folder: _Path, file: _Path, *, force: bool = False) -> None:
    """Writes the drive of a results folder as a recording of Rerun, whole or not at all."""
    drive = read_drive(folder)
    with _beside(pathlib.Path(file), force) as part:
        write_rerun(drive, part)


def commonroad_solution(
    folder: _Path, file: _Path, *, scenario: _Path, problem: int | None = None, cost: str = "JB1", force: bool = False
) -> None:
    """Writes the drive of a results folder as a solution of the CommonRoad scenario that its own was imported from."""
    try:
        from ._solution import solution
    except ImportError:
        raise ExtraMissing(MISSING) from None
    write_whole(pathlib.Path(file), solution(read_drive(folder), scenario, problem, cost), force)


@contextlib.contextmanager
def _beside(file: pathlib.Path, force: bool) -> Iterator[pathlib.Path]:
    """A file to write that takes the place of `file` once it is whole."""
    if file.exists() and not force:
        raise FileExistsError(f"{file}: stands already; --force replaces it")
    with tempfile.TemporaryDirectory(dir=file.parent, prefix=f".{file.name}.") as folder:
        part = pathlib.Path(folder) / file.name
        yield part
        os.replace(part, file)
